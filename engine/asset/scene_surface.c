/* Normals and tangents that a file lacks. Computed in double: a dragon's triangles are 1e-4 m wide, their areas 1e-8. */
#include "engine/asset/scene_internal.h"
#include "engine/core/vector.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void store(const double v[3], float out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (float)v[k];
}

/* Twice the area along the normal; counter-clockwise is the front (glTF 2.0, section 3.7.2.1). */
static void face_normal(const nook_vertex *a, const nook_vertex *b, const nook_vertex *c, double out[3])
{
    double ab[3], ac[3];
    nook_vector_between(a->position, b->position, ab);
    nook_vector_between(a->position, c->position, ac);
    nook_vector_cross(ab, ac, out);
}

void nook_scene_make_flat_normals(nook_vertex *vertices, uint32_t vertex_count)
{
    for (uint32_t i = 0; i + 2 < vertex_count; i += 3) {
        double normal[3], unit[3] = { 0.0, 1.0, 0.0 }; /* a degenerate triangle shows no side */
        face_normal(&vertices[i], &vertices[i + 1], &vertices[i + 2], normal);
        nook_vector_normalize(normal, unit);
        for (uint32_t k = 0; k < 3; k++)
            store(unit, vertices[i + k].normal);
    }
}

/* Makes good normals unit and broken ones zero. @return how many are broken */
static uint32_t mark_broken(nook_vertex *vertices, uint32_t vertex_count)
{
    uint32_t broken = 0;
    for (uint32_t i = 0; i < vertex_count; i++) {
        float *n = vertices[i].normal;
        double normal[3] = { (double)n[0], (double)n[1], (double)n[2] }, unit[3] = { 0.0 };
        bool good = isfinite(n[0]) && isfinite(n[1]) && isfinite(n[2]) && nook_vector_normalize(normal, unit);
        store(unit, n);
        broken += !good;
    }
    return broken;
}

static bool is_zero(const float n[3])
{
    return n[0] == 0.0f && n[1] == 0.0f && n[2] == 0.0f;
}

uint32_t nook_scene_repair_normals(nook_vertex *vertices, uint32_t vertex_count, const uint32_t *indices,
                                   uint32_t index_count)
{
    uint32_t broken = mark_broken(vertices, vertex_count);
    double(*sums)[3] = broken ? calloc(vertex_count, sizeof *sums) : NULL;
    for (uint32_t i = 0; sums && i + 2 < index_count; i += 3) {
        double normal[3];
        face_normal(&vertices[indices[i]], &vertices[indices[i + 1]], &vertices[indices[i + 2]], normal);
        for (uint32_t k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++)
                sums[indices[i + k]][axis] += normal[axis];
    }
    for (uint32_t i = 0; broken && i < vertex_count; i++) {
        double unit[3] = { 0.0, 1.0, 0.0 };
        if (!is_zero(vertices[i].normal))
            continue;
        if (sums)
            nook_vector_normalize(sums[i], unit);
        store(unit, vertices[i].normal);
    }
    free(sums);
    return broken;
}

/* Adds this triangle's directions of u and v to its corners (Lengyel, Mathematics for 3D Game Programming, 7.8). */
static void add_directions(const nook_vertex *vertices, const uint32_t corner[3], double (*sums)[2][3])
{
    const nook_vertex *a = &vertices[corner[0]], *b = &vertices[corner[1]], *c = &vertices[corner[2]];
    double ab[3], ac[3];
    nook_vector_between(a->position, b->position, ab);
    nook_vector_between(a->position, c->position, ac);
    double u1 = (double)b->uv[0] - (double)a->uv[0], v1 = (double)b->uv[1] - (double)a->uv[1];
    double u2 = (double)c->uv[0] - (double)a->uv[0], v2 = (double)c->uv[1] - (double)a->uv[1];
    double side = u1 * v2 - u2 * v1 < 0.0 ? -1.0 : 1.0; /* weight by area in space, not by 1 / area in the texture */
    for (int k = 0; k < 3; k++) {
        double along_u = side * (v2 * ab[k] - v1 * ac[k]), along_v = side * (u1 * ac[k] - u2 * ab[k]);
        for (int i = 0; i < 3; i++) {
            sums[corner[i]][0][k] += along_u;
            sums[corner[i]][1][k] += along_v;
        }
    }
}

static void make_tangent(nook_vertex *vertex, double sums[2][3])
{
    double n[3] = { (double)vertex->normal[0], (double)vertex->normal[1], (double)vertex->normal[2] };
    double axis[3] = { fabs(n[0]) < 0.5 ? 1.0 : 0.0, fabs(n[0]) < 0.5 ? 0.0 : 1.0, 0.0 };
    double tangent[3], bitangent[3], *from = sums[0];
    for (int attempt = 0; attempt < 2; attempt++, from = axis) {
        nook_vector_add_scaled(from, -nook_vector_dot(from, n), n, tangent);
        if (nook_vector_normalize(tangent, tangent))
            break;
    }
    nook_vector_cross(n, tangent, bitangent);
    store(tangent, vertex->tangent);
    vertex->tangent[3] = nook_vector_dot(bitangent, sums[1]) < 0.0 ? -1.0f : 1.0f;
}

void nook_scene_make_tangents(nook_vertex *vertices, uint32_t vertex_count, const uint32_t *indices,
                              uint32_t index_count)
{
    double(*sums)[2][3] = calloc(vertex_count ? vertex_count : 1, sizeof *sums);
    if (!sums)
        return; /* tangents stay zero: drawn without the normal map */
    for (uint32_t i = 0; i + 2 < index_count; i += 3)
        add_directions(vertices, indices + i, sums);
    for (uint32_t i = 0; i < vertex_count; i++)
        make_tangent(&vertices[i], sums[i]);
    free(sums);
}
