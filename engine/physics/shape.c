#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "engine/physics/internal.h"
#include <stdlib.h>
#include <string.h>

static const double size_min = 1e-4, size_max = 1e5; /* metres: what ODE's closed forms can square and divide by */

static const char *kind_name(nook_shape_kind kind)
{
    static const char *const names[] = { "box", "sphere", "cylinder", "capsule", "mesh" };
    return names[kind];
}

static int half_count(nook_shape_kind kind)
{
    static const int counts[] = { 3, 1, 2, 2, 0 };
    return counts[kind];
}

/* ---- checks ---- */

static nook_result check_mesh(const nook_shape *shape)
{
    if (shape->index_count == 0 || shape->index_count % 3 != 0)
        return nook_fail(NOOK_E_ARG, "physics: a mesh shape with %u indices; give three a triangle",
                         shape->index_count);
    for (uint32_t i = 0; i < shape->index_count; i++)
        if (shape->indices[i] >= shape->vertex_count)
            return nook_fail(NOOK_E_ARG, "physics: index %u of a mesh shape is %u, but it has %u vertices", i,
                             shape->indices[i], shape->vertex_count);
    for (size_t i = 0; i < (size_t)shape->vertex_count * 3; i++)
        if (!isfinite(shape->positions[i]))
            return nook_fail(NOOK_E_ARG, "physics: vertex %zu of a mesh shape is not finite", i / 3);
    return NOOK_OK;
}

nook_result nook_physics_check_shape(const nook_shape *shape, nook_body_motion motion)
{
    if (!nook_pose_valid(&shape->body_from_shape))
        return nook_fail(NOOK_E_ARG, "physics: body_from_shape of a %s is not finite or its rotation not unit",
                         kind_name(shape->kind));
    if (shape->kind == NOOK_SHAPE_MESH && motion == NOOK_BODY_DYNAMIC)
        return nook_fail(NOOK_E_ARG, "physics: a mesh cannot be the shape of a dynamic body; give it simple shapes");
    if (shape->kind == NOOK_SHAPE_MESH)
        return check_mesh(shape);
    for (int i = 0; i < half_count(shape->kind); i++)
        if (!(shape->half[i] >= size_min && shape->half[i] <= size_max))
            return nook_fail(NOOK_E_ARG, "physics: half[%d] of a %s is %g m; it must be in [%g, %g]", i,
                             kind_name(shape->kind), shape->half[i], size_min, size_max);
    return NOOK_OK;
}

/* ---- geoms ---- */

bool nook_physics_has_area(const float *positions, const uint32_t triangle[3])
{
    double e1[3], e2[3], normal[3];
    nook_vector_between(positions + 3 * (size_t)triangle[0], positions + 3 * (size_t)triangle[1], e1);
    nook_vector_between(positions + 3 * (size_t)triangle[0], positions + 3 * (size_t)triangle[2], e2);
    nook_vector_cross(e1, e2, normal);
    double longest = fmax(nook_vector_dot(e1, e1), nook_vector_dot(e2, e2));
    return nook_vector_length(normal) > 1e-7 * longest; /* ODE divides by it */
}

/* Triangles that are lines have no normal to push along and are left out. */
static nook_result make_mesh(physics_shape *shape, const nook_shape *desc, dSpaceID space)
{
    size_t positions_size = (size_t)desc->vertex_count * 3 * sizeof(float);
    shape->positions = malloc(positions_size);
    shape->indices = malloc(desc->index_count * sizeof(uint32_t));
    if (!shape->positions || !shape->indices)
        return nook_fail(NOOK_E_MEMORY, "physics: no memory for a mesh of %u triangles", desc->index_count / 3);
    memcpy(shape->positions, desc->positions, positions_size);
    uint32_t count = 0;
    for (uint32_t i = 0; i < desc->index_count; i += 3)
        if (nook_physics_has_area(desc->positions, desc->indices + i)) {
            memcpy(shape->indices + count, desc->indices + i, 3 * sizeof(uint32_t));
            count += 3;
        }
    if (count == 0)
        return nook_fail(NOOK_E_ARG, "physics: all %u triangles of a mesh shape are points or lines",
                         desc->index_count / 3);
    shape->mesh = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildSingle(shape->mesh, shape->positions, 3 * sizeof(float), (int)desc->vertex_count,
                                shape->indices, (int)count, 3 * sizeof(uint32_t));
    shape->geom = dCreateTriMesh(space, shape->mesh, NULL, NULL, NULL);
    return NOOK_OK;
}

/* Cylinders and capsules of ODE stand along Z, ours along Y. */
static nook_pose geom_turn(nook_shape_kind kind)
{
    const double h = 0.70710678118654752440;
    nook_pose pose = nook_pose_identity();
    if (kind == NOOK_SHAPE_CYLINDER || kind == NOOK_SHAPE_CAPSULE)
        pose = (nook_pose){ .rotation = { -h, 0, 0, h } };
    return pose;
}

static nook_result make_geom(physics_shape *shape, const nook_shape *desc, dSpaceID space)
{
    const double *half = desc->half;
    nook_pose turn = geom_turn(desc->kind);
    shape->body_from_shape = nook_pose_multiply(&desc->body_from_shape, &turn);
    switch (desc->kind) {
    case NOOK_SHAPE_BOX:
        shape->geom = dCreateBox(space, 2 * half[0], 2 * half[1], 2 * half[2]);
        break;
    case NOOK_SHAPE_SPHERE:
        shape->geom = dCreateSphere(space, half[0]);
        break;
    case NOOK_SHAPE_CYLINDER:
        shape->geom = dCreateCylinder(space, half[0], 2 * half[1]);
        break;
    case NOOK_SHAPE_CAPSULE:
        shape->geom = dCreateCapsule(space, half[0], 2 * half[1]);
        break;
    case NOOK_SHAPE_MESH:
        return make_mesh(shape, desc, space);
    }
    return NOOK_OK;
}

static double thickness_of(const nook_shape *shape)
{
    const double *half = shape->half;
    switch (shape->kind) {
    case NOOK_SHAPE_BOX:
        return 2 * fmin(half[0], fmin(half[1], half[2]));
    case NOOK_SHAPE_CYLINDER:
        return 2 * fmin(half[0], half[1]);
    case NOOK_SHAPE_SPHERE:
    case NOOK_SHAPE_CAPSULE:
        return 2 * half[0];
    case NOOK_SHAPE_MESH:
        break;
    }
    return INFINITY;
}

nook_result nook_physics_make_shapes(physics_body *body, const nook_body_desc *desc, dSpaceID space)
{
    body->shapes = calloc(desc->shape_count, sizeof *body->shapes);
    if (!body->shapes)
        return nook_fail(NOOK_E_MEMORY, "physics: no memory for %u shapes", desc->shape_count);
    body->shape_count = desc->shape_count;
    body->thickness = INFINITY;
    for (uint32_t i = 0; i < desc->shape_count; i++) {
        nook_result result = make_geom(&body->shapes[i], &desc->shapes[i], space);
        if (result != NOOK_OK)
            return result;
        dGeomSetData(body->shapes[i].geom, body);
        if (desc->shapes[i].kind != NOOK_SHAPE_BOX && desc->shapes[i].kind != NOOK_SHAPE_MESH)
            body->rim = fmax(body->rim, desc->shapes[i].half[0]);
        body->thickness = fmin(body->thickness, thickness_of(&desc->shapes[i]));
    }
    return NOOK_OK;
}

void nook_physics_free_shapes(physics_body *body)
{
    for (uint32_t i = 0; i < body->shape_count; i++) {
        physics_shape *shape = &body->shapes[i];
        if (shape->geom)
            dGeomDestroy(shape->geom);
        if (shape->mesh)
            dGeomTriMeshDataDestroy(shape->mesh);
        free(shape->positions);
        free(shape->indices);
    }
    free(body->shapes);
}

/* ---- mass ---- */

/* At density 1 about the shape's middle, in its own space. */
static void mass_of(const nook_shape *shape, dMass *mass)
{
    const double *half = shape->half;
    switch (shape->kind) {
    case NOOK_SHAPE_BOX:
        dMassSetBox(mass, 1.0, 2 * half[0], 2 * half[1], 2 * half[2]);
        break;
    case NOOK_SHAPE_SPHERE:
        dMassSetSphere(mass, 1.0, half[0]);
        break;
    case NOOK_SHAPE_CYLINDER:
        dMassSetCylinder(mass, 1.0, 2, half[0], 2 * half[1]); /* 2: along Y */
        break;
    case NOOK_SHAPE_CAPSULE:
        dMassSetCapsule(mass, 1.0, 2, half[0], 2 * half[1]);
        break;
    case NOOK_SHAPE_MESH:
        break; /* never of a dynamic body */
    }
}

static void ode_rotation(const double rotation[4], double out[12])
{
    const dQuaternion q = { rotation[3], rotation[0], rotation[1], rotation[2] };
    dRfromQ(out, q);
}

void nook_physics_spread_mass(const nook_body_desc *desc, dMass *out_mass, double out_centre[3])
{
    dMassSetZero(out_mass);
    for (uint32_t i = 0; i < desc->shape_count; i++) {
        const nook_shape *shape = &desc->shapes[i];
        const double *at = shape->body_from_shape.position;
        dMass mass;
        double rotation[12]; /* a dMatrix3 */
        mass_of(shape, &mass);
        ode_rotation(shape->body_from_shape.rotation, rotation);
        dMassRotate(&mass, rotation);
        dMassTranslate(&mass, at[0], at[1], at[2]);
        dMassAdd(out_mass, &mass);
    }
    memcpy(out_centre, out_mass->c, 3 * sizeof(double));
    dMassTranslate(out_mass, -out_mass->c[0], -out_mass->c[1], -out_mass->c[2]);
    memset(out_mass->c, 0, sizeof out_mass->c); /* dBodySetMass asks for an exact 0 */
    dMassAdjust(out_mass, desc->mass);
}
