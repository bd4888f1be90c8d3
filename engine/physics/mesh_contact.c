#include "engine/core/vector.h"
#include "engine/physics/internal.h"
#include <string.h>

/*
 * ODE looks at one triangle of a mesh at a time. Of a floor of many triangles it pushes a box on along the shallowest way out of
 * each, which at the rim of the box is sideways: over the edge to the next triangle, where there is no way out. The box trips
 * over edges that are not there. So contacts that push out of a triangle sideways, while the surface that it is a part of pushes
 * out along its normal, are replaced by what the triangle should have said: where the shape's lowest face lies below it.
 */

enum { FLATTENED_MAX = 128 };

static const double face_cosine = 0.995;     /* a contact along its triangle's normal */
static const double coplanar_cosine = 0.999; /* two triangles of one plane */
static const double coplanar_metres = 0.001;

typedef struct triangle {
    double corners[3][3], normal[3];
} triangle;

/* The pair that is looked at; the mesh is the second of the two, or contacts are turned round. */
typedef struct mesh_pair {
    dGeomID mesh, other;
    double sign; /* times a contact's normal: out of the mesh */
    bool mesh_first;
} mesh_pair;

static int triangle_index(const mesh_pair *pair, const dContactGeom *contact)
{
    return pair->mesh_first ? contact->side1 : contact->side2;
}

static bool triangle_of(const mesh_pair *pair, const dContactGeom *contact, triangle *out)
{
    int index = triangle_index(pair, contact);
    if (index < 0)
        return false;
    dVector3 corners[3];
    double e1[3], e2[3];
    dGeomTriMeshGetTriangle(pair->mesh, index, &corners[0], &corners[1], &corners[2]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            out->corners[i][k] = corners[i][k];
    nook_vector_add_scaled(out->corners[1], -1.0, out->corners[0], e1);
    nook_vector_add_scaled(out->corners[2], -1.0, out->corners[0], e2);
    nook_vector_cross(e1, e2, out->normal);
    return nook_vector_normalize(out->normal, out->normal);
}

static bool along_face(const mesh_pair *pair, const dContactGeom *contact, const triangle *t)
{
    return pair->sign * nook_vector_dot(contact->normal, t->normal) > face_cosine;
}

static double height_above(const triangle *t, const double point[3])
{
    double way[3];
    nook_vector_add_scaled(point, -1.0, t->corners[0], way);
    return nook_vector_dot(way, t->normal);
}

/* ---- clipped to the triangle ---- */

static int clip_to_triangle(const triangle *t, double points[PHYSICS_CLIPPED_MAX][3], int count)
{
    for (int i = 0; i < 3 && count > 0; i++) {
        double edge[3], inwards[3];
        nook_vector_add_scaled(t->corners[(i + 1) % 3], -1.0, t->corners[i], edge);
        nook_vector_cross(t->normal, edge, inwards);
        count = nook_physics_clip(points, count, t->corners[i], inwards);
    }
    return count;
}

/* The contacts that a triangle makes along its normal. @return how many */
static uint32_t flatten(const mesh_pair *pair, const dContactGeom *like, const triangle *t, dContactGeom *out,
                        uint32_t room)
{
    double points[PHYSICS_CLIPPED_MAX][3];
    int count = clip_to_triangle(t, points, nook_physics_face_against(pair->other, t->normal, points));
    uint32_t made = 0;
    for (int i = 0; i < count && made < room; i++) {
        double depth = -height_above(t, points[i]);
        if (depth < 0.0)
            continue;
        dContactGeom *c = &out[made++];
        *c = *like;
        c->depth = depth;
        memcpy(c->pos, points[i], sizeof points[i]);
        for (int k = 0; k < 3; k++)
            c->normal[k] = pair->sign * t->normal[k];
    }
    return made;
}

/* ---- which ones ---- */

/* Whether one of the face contacts, which stand first, is of the plane of this triangle. */
static bool has_flat_neighbour(const triangle *t, const triangle *faces, uint32_t face_count)
{
    for (uint32_t i = 0; i < face_count; i++)
        if (nook_vector_dot(t->normal, faces[i].normal) > coplanar_cosine &&
            fabs(height_above(t, faces[i].corners[0])) < coplanar_metres)
            return true;
    return false;
}

/* The planes of the face contacts, each once. */
static uint32_t collect_planes(const mesh_pair *pair, const dContactGeom *contacts, uint32_t count, triangle *planes,
                               uint32_t room)
{
    uint32_t found = 0;
    for (uint32_t i = 0; i < count && found < room; i++) {
        triangle t;
        if (triangle_of(pair, &contacts[i], &t) && along_face(pair, &contacts[i], &t) &&
            !has_flat_neighbour(&t, planes, found))
            planes[found++] = t;
    }
    return found;
}

uint32_t nook_physics_flatten_contacts(dGeomID g1, dGeomID g2, dContactGeom *contacts, uint32_t count,
                                       uint32_t capacity)
{
    const mesh_pair pair = { .mesh_first = dGeomGetClass(g1) == dTriMeshClass,
                             .mesh = dGeomGetClass(g1) == dTriMeshClass ? g1 : g2,
                             .other = dGeomGetClass(g1) == dTriMeshClass ? g2 : g1,
                             .sign = dGeomGetClass(g1) == dTriMeshClass ? -1.0 : 1.0 };
    triangle planes[16];
    dContactGeom flattened[FLATTENED_MAX];
    uint32_t plane_count = collect_planes(&pair, contacts, count, planes, 16), made = 0, kept = 0;
    int last = -1;
    for (uint32_t i = 0; i < count; i++) {
        triangle t;
        if (!triangle_of(&pair, &contacts[i], &t) || along_face(&pair, &contacts[i], &t) ||
            !has_flat_neighbour(&t, planes, plane_count)) {
            contacts[kept++] = contacts[i];
            continue;
        }
        int index = triangle_index(&pair, &contacts[i]);
        if (index != last) /* contacts of a triangle stand together */
            made += flatten(&pair, &contacts[i], &t, flattened + made, FLATTENED_MAX - made);
        last = index;
    }
    for (uint32_t i = 0; i < made && kept < capacity; i++)
        contacts[kept++] = flattened[i];
    return kept;
}
