#include "engine/animation/deform.h"
#include "engine/core/vector.h"
#include <math.h>
#include <string.h>

/* ---- A vertex ---------------------------------------------------------------------------------------------------- */

static void morph(const nook_scene_pose *pose, const nook_deformable *d, uint32_t vertex, double position[3],
                  double normal[3])
{
    for (uint32_t t = 0; t < d->target_count; t++) {
        const nook_morph_delta *delta =
            &pose->scene->morph_deltas[d->first_delta + (size_t)t * d->vertex_count + vertex];
        double weight = (double)pose->morph[d->first_weight + t];
        for (int k = 0; k < 3; k++) {
            position[k] += weight * (double)delta->position[k];
            normal[k] += weight * (double)delta->normal[k];
        }
    }
}

static void blend(const nook_joint_matrix *joints, const nook_influence *influence, double out[3][4])
{
    memset(out, 0, 12 * sizeof(double));
    for (int i = 0; i < NOOK_INFLUENCES; i++)
        for (int row = 0; row < 3 && influence->weights[i] > 0.0f; row++)
            for (int column = 0; column < 4; column++)
                out[row][column] +=
                    (double)influence->weights[i] * (double)joints[influence->joints[i]].row[row][column];
}

/* Inverse transpose times determinant: its rows are cross products of the matrix's rows. The sign makes up for mirroring. */
static void transform_normal(double m[3][4], double normal[3])
{
    double cofactors[3][3], out[3];
    for (int row = 0; row < 3; row++)
        nook_vector_cross(m[(row + 1) % 3], m[(row + 2) % 3], cofactors[row]);
    double side = nook_vector_dot(m[0], cofactors[0]) < 0.0 ? -1.0 : 1.0;
    for (int row = 0; row < 3; row++)
        out[row] = side * nook_vector_dot(cofactors[row], normal);
    memcpy(normal, out, sizeof out);
}

static void transform_tangent(double m[3][4], nook_vertex *vertex)
{
    const double t[3] = { vertex->tangent[0], vertex->tangent[1], vertex->tangent[2] };
    double out[3], cross[3];
    for (int row = 0; row < 3; row++)
        out[row] = nook_vector_dot(m[row], t);
    if (!nook_vector_normalize(out, out))
        return; /* it has none */
    nook_vector_cross(m[1], m[2], cross);
    if (nook_vector_dot(m[0], cross) < 0.0)
        vertex->tangent[3] = -vertex->tangent[3];
    for (int k = 0; k < 3; k++)
        vertex->tangent[k] = (float)out[k];
}

static void skin(double m[3][4], double position[3], double normal[3], nook_vertex *out)
{
    double moved[3];
    for (int row = 0; row < 3; row++)
        moved[row] = nook_vector_dot(m[row], position) + m[row][3];
    memcpy(position, moved, sizeof moved);
    transform_normal(m, normal);
    transform_tangent(m, out);
}

static void deform_vertex(const nook_scene_pose *pose, const nook_deformable *d, const nook_joint_matrix *joints,
                          uint32_t vertex, nook_vertex *out)
{
    double position[3], normal[3];
    for (int k = 0; k < 3; k++) {
        position[k] = (double)out->position[k];
        normal[k] = (double)out->normal[k];
    }
    morph(pose, d, vertex, position, normal);
    if (joints) {
        double m[3][4];
        blend(joints, &pose->scene->influences[d->first_influence + vertex], m);
        skin(m, position, normal, out);
    }
    bool has_direction = nook_vector_normalize(normal, normal);
    for (int k = 0; k < 3; k++) {
        out->position[k] = (float)position[k];
        out->normal[k] = has_direction ? (float)normal[k] : out->normal[k];
    }
}

void nook_deform(const nook_scene_pose *pose, uint32_t deformable, const nook_vertex *rest, nook_vertex *out)
{
    const nook_scene *scene = pose->scene;
    const nook_deformable *d = &scene->deformables[deformable];
    const nook_mesh *mesh = &scene->meshes[d->mesh];
    for (uint32_t v = 0; v < d->vertex_count; v++) {
        nook_vertex vertex = rest[v];
        deform_vertex(pose, d, pose->meshes[deformable].joints, v, &vertex);
        out[v] = vertex;
    }
    for (uint32_t p = 0; p < mesh->primitive_count; p++) {
        const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + p];
        if (primitive->flat)
            nook_scene_make_flat_normals(out + (primitive->first_vertex - d->first_vertex), primitive->vertex_count);
    }
}
