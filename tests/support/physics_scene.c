#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <cmocka.h>

nook_physics *physics_scene_create(void)
{
    nook_physics *physics;
    assert_int_equal(nook_physics_create(&(nook_physics_desc){ .seed = 1 }, &physics), NOOK_OK);
    return physics;
}

nook_body_desc physics_scene_desc(const nook_shape *shape, nook_body_motion motion, double mass, double x, double y,
                                  double z)
{
    return (nook_body_desc){ .motion = motion,
                             .shapes = shape,
                             .shape_count = 1,
                             .mass = mass,
                             .pose = { .position = { x, y, z }, .rotation = { 0, 0, 0, 1 } },
                             .friction = 0.6 };
}

nook_body physics_scene_add(nook_physics *physics, const nook_body_desc *desc)
{
    nook_body body = { 0 };
    assert_int_equal(nook_physics_add(physics, desc, &body), NOOK_OK);
    return body;
}

nook_shape physics_scene_box(double half_x, double half_y, double half_z)
{
    return (nook_shape){ .kind = NOOK_SHAPE_BOX,
                         .half = { half_x, half_y, half_z },
                         .body_from_shape = nook_pose_identity() };
}

nook_shape physics_scene_round(nook_shape_kind kind, double radius, double half_height)
{
    return (nook_shape){ .kind = kind, .half = { radius, half_height }, .body_from_shape = nook_pose_identity() };
}

nook_body physics_scene_floor(nook_physics *physics, double half)
{
    nook_shape box = physics_scene_box(half, 1.0, half);
    nook_body_desc desc = physics_scene_desc(&box, NOOK_BODY_STATIC, 0, 0, -1, 0);
    return physics_scene_add(physics, &desc);
}

nook_body physics_scene_crate(nook_physics *physics, double half, double mass, double x, double y, double z)
{
    nook_shape box = physics_scene_box(half, half, half);
    nook_body_desc desc = physics_scene_desc(&box, NOOK_BODY_DYNAMIC, mass, x, y, z);
    return physics_scene_add(physics, &desc);
}

/* ---- meshes ---- */

static physics_scene_mesh reserve_mesh(uint32_t faces, uint32_t cells)
{
    size_t vertices = (size_t)faces * (cells + 1) * (cells + 1), indices = (size_t)faces * cells * cells * 6;
    physics_scene_mesh mesh = { .positions = malloc(vertices * 3 * sizeof(float)),
                                .indices = malloc(indices * sizeof(uint32_t)) };
    assert_non_null(mesh.positions);
    assert_non_null(mesh.indices);
    return mesh;
}

/* A square of cells from `corner` along u and v, which faces u x v. */
static void add_face(physics_scene_mesh *mesh, uint32_t cells, const double corner[3], const double u[3],
                     const double v[3])
{
    nook_shape *s = &mesh->shape;
    uint32_t first = s->vertex_count;
    for (uint32_t j = 0; j <= cells; j++)
        for (uint32_t i = 0; i <= cells; i++, s->vertex_count++)
            for (int k = 0; k < 3; k++)
                mesh->positions[3 * s->vertex_count + (uint32_t)k] =
                    (float)(corner[k] + u[k] * i / cells + v[k] * j / cells);
    for (uint32_t j = 0; j < cells; j++)
        for (uint32_t i = 0; i < cells; i++) {
            uint32_t a = first + j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
            const uint32_t square[6] = { a, b, d, a, d, c };
            for (int k = 0; k < 6; k++)
                mesh->indices[s->index_count++] = square[k];
        }
}

static void finish_mesh(physics_scene_mesh *mesh)
{
    mesh->shape.kind = NOOK_SHAPE_MESH;
    mesh->shape.body_from_shape = nook_pose_identity();
    mesh->shape.positions = mesh->positions;
    mesh->shape.indices = mesh->indices;
}

physics_scene_mesh physics_scene_grid(double half, uint32_t cells)
{
    physics_scene_mesh mesh = reserve_mesh(1, cells);
    add_face(&mesh, cells, (double[3]){ -half, 0, -half }, (double[3]){ 0, 0, 2 * half },
             (double[3]){ 2 * half, 0, 0 });
    finish_mesh(&mesh);
    return mesh;
}

physics_scene_mesh physics_scene_mesh_box(const double half[3], uint32_t cells, bool inwards)
{
    physics_scene_mesh mesh = reserve_mesh(6, cells);
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side <= 1; side += 2) {
            int a = (axis + 1) % 3, b = (axis + 2) % 3; /* a x b points along the axis */
            bool turned = (side > 0) == inwards;
            double corner[3], u[3] = { 0 }, v[3] = { 0 };
            corner[axis] = side * half[axis], corner[a] = -half[a], corner[b] = -half[b];
            u[turned ? b : a] = 2 * half[turned ? b : a];
            v[turned ? a : b] = 2 * half[turned ? a : b];
            add_face(&mesh, cells, corner, u, v);
        }
    finish_mesh(&mesh);
    return mesh;
}

void physics_scene_mesh_free(physics_scene_mesh *mesh)
{
    free(mesh->positions);
    free(mesh->indices);
    *mesh = (physics_scene_mesh){ 0 };
}

/* ---- time, and looking ---- */

void physics_scene_step(nook_physics *physics, uint32_t steps)
{
    for (uint32_t i = 0; i < steps; i++)
        assert_int_equal(nook_physics_step(physics), NOOK_OK);
}

void physics_scene_position(const nook_physics *physics, nook_body body, double out[3])
{
    nook_pose pose = nook_physics_pose(physics, body, 1.0);
    for (int i = 0; i < 3; i++)
        out[i] = pose.position[i];
}

double physics_scene_height(const nook_physics *physics, nook_body body)
{
    return nook_physics_pose(physics, body, 1.0).position[1];
}

double physics_scene_tilt(const nook_physics *physics, nook_body body)
{
    nook_pose pose = nook_physics_pose(physics, body, 1.0);
    double up[3] = { 0, 1, 0 };
    nook_pose_apply_vector(&pose, up, up);
    return acos(fmax(-1.0, fmin(1.0, up[1])));
}

void physics_assert_near(double actual, double expected, double tolerance)
{
    if (!(fabs(actual - expected) <= tolerance))
        fail_msg("%.17g is not within %g of %.17g", actual, tolerance, expected);
}
