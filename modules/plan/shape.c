#include "modules/plan/shape.h"
#include "engine/core/vector.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TRIANGLES_MAX = 2048 };

static const double flatness = 1e-5; /* of the longest side: what floats and exporters round */

/* An edge from one corner to the next, by their positions: meshes hold a corner once for every normal. */
typedef struct edge {
    float from[3], to[3];
} edge;

static int compare_edges(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(edge));
}

/* -0 and 0 are one place. */
static void put(float out[3], const float p[3])
{
    for (int axis = 0; axis < 3; axis++)
        out[axis] = p[axis] + 0.0f;
}

/* Every edge has as many opposites as there are of it. */
static bool edges_match(const float *positions, const uint32_t *indices, size_t index_count, edge *edges,
                        edge *opposites)
{
    for (size_t i = 0; i < index_count; i++) {
        const float *from = positions + (size_t)indices[i] * 3;
        const float *to = positions + (size_t)indices[i % 3 == 2 ? i - 2 : i + 1] * 3;
        put(edges[i].from, from), put(edges[i].to, to);
        put(opposites[i].from, to), put(opposites[i].to, from);
    }
    qsort(edges, index_count, sizeof *edges, compare_edges);
    qsort(opposites, index_count, sizeof *opposites, compare_edges);
    return memcmp(edges, opposites, index_count * sizeof *edges) == 0;
}

static bool is_closed(const float *positions, const uint32_t *indices, size_t index_count)
{
    edge *edges = calloc(2 * index_count, sizeof *edges);
    bool closed = edges && edges_match(positions, indices, index_count, edges, edges + index_count);
    free(edges);
    return closed;
}

static double longest_side(const float *positions, const uint32_t *indices, size_t index_count)
{
    double longest = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < index_count; i++) {
            double value = positions[(size_t)indices[i] * 3 + (size_t)axis];
            low = fmin(low, value), high = fmax(high, value);
        }
        longest = fmax(longest, high - low);
    }
    return longest;
}

/* The farthest corner in front of a triangle's plane, and the farthest behind it. @return false: it has no plane */
static bool reach(const float *positions, const uint32_t *indices, size_t index_count, size_t triangle,
                  double *out_front, double *out_behind)
{
    const float *corner = positions + (size_t)indices[triangle] * 3;
    double u[3], v[3], normal[3];
    nook_vector_between(corner, positions + (size_t)indices[triangle + 1] * 3, u);
    nook_vector_between(corner, positions + (size_t)indices[triangle + 2] * 3, v);
    nook_vector_cross(u, v, normal);
    *out_front = *out_behind = 0.0;
    if (!nook_vector_normalize(normal, normal))
        return false;
    for (size_t i = 0; i < index_count; i++) {
        double to[3];
        nook_vector_between(corner, positions + (size_t)indices[i] * 3, to);
        double height = nook_vector_dot(normal, to);
        *out_front = fmax(*out_front, height);
        *out_behind = fmax(*out_behind, -height);
    }
    return true;
}

bool nook_plan_is_convex(const float *positions, const uint32_t *indices, size_t index_count)
{
    if (index_count < 12 || index_count > 3 * TRIANGLES_MAX)
        return false;
    double allowed = flatness * longest_side(positions, indices, index_count), front, behind;
    bool outward = true, inward = true; /* a mirrored mesh has its triangles the other way around */
    for (size_t t = 0; t < index_count && (outward || inward); t += 3) {
        if (!reach(positions, indices, index_count, t, &front, &behind))
            continue; /* a triangle without area hides nothing */
        outward = outward && front <= allowed;
        inward = inward && behind <= allowed;
    }
    return outward != inward && is_closed(positions, indices, index_count);
}
