#include "modules/trace/ray_filter.h"
#include <stdlib.h>
#include <string.h>

struct nook_ray_filter {
    const nook_alphas *alphas;
    const uint32_t *indices;
};

/* Embree's packets are arrays of N, one for each number of a ray or hit (rtcore_ray.h); its functions for them are C++. */
enum { RAY_ORIGIN = 0, RAY_DIRECTION = 4, HIT_U = 3, HIT_V = 4, HIT_TRIANGLE = 5 };

static float number_of(const void *packet, unsigned n, unsigned i, int which)
{
    float number;
    memcpy(&number, (const char *)packet + ((size_t)which * n + i) * sizeof number, sizeof number);
    return number;
}

static uint32_t bits_of(const void *packet, unsigned n, unsigned i, int which)
{
    uint32_t bits;
    memcpy(&bits, (const char *)packet + ((size_t)which * n + i) * sizeof bits, sizeof bits);
    return bits;
}

/* Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014: the finaliser. */
static uint64_t mix(uint64_t bits)
{
    bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ bits >> 27) * 0x94d049bb133111ebu;
    return bits ^ bits >> 31;
}

/* In [0, 1), of a ray and a triangle. */
static double chance(const void *ray, unsigned n, unsigned i, uint32_t triangle)
{
    uint64_t bits = triangle;
    for (int k = 0; k < 3; k++) {
        bits = mix(bits + 0x9e3779b97f4a7c15u + bits_of(ray, n, i, RAY_ORIGIN + k));
        bits = mix(bits + 0x9e3779b97f4a7c15u + bits_of(ray, n, i, RAY_DIRECTION + k));
    }
    return (double)(bits >> 11) * 0x1p-53;
}

static int counts(const nook_ray_filter *f, const struct RTCFilterFunctionNArguments *hits, unsigned i)
{
    uint32_t triangle = bits_of(hits->hit, hits->N, i, HIT_TRIANGLE);
    const nook_alpha_part *part = nook_alpha_part_of(f->alphas, triangle);
    if (!part)
        return 1;
    double u = (double)number_of(hits->hit, hits->N, i, HIT_U), v = (double)number_of(hits->hit, hits->N, i, HIT_V);
    const double weight[3] = { 1.0 - u - v, u, v };
    double alpha = nook_alpha_at(f->alphas, part, f->indices + 3 * (size_t)triangle, weight);
    return alpha >= 1.0 || (alpha > 0.0 && chance(hits->ray, hits->N, i, triangle) < alpha);
}

static void ask(const struct RTCFilterFunctionNArguments *hits)
{
    for (unsigned i = 0; i < hits->N; i++)
        if (hits->valid[i] == -1 && !counts(hits->geometryUserPtr, hits, i))
            hits->valid[i] = 0;
}

nook_ray_filter *nook_ray_filter_create(const nook_ao_mesh_view *mesh)
{
    nook_ray_filter *filter = malloc(sizeof *filter);
    if (filter)
        *filter = (nook_ray_filter){ mesh->alphas, mesh->indices };
    return filter;
}

void nook_ray_filter_destroy(nook_ray_filter *filter)
{
    free(filter);
}

void nook_ray_filter_apply(nook_ray_filter *filter, RTCGeometry geometry)
{
    rtcSetGeometryUserData(geometry, filter);
    rtcSetGeometryIntersectFilterFunction(geometry, ask);
    rtcSetGeometryOccludedFilterFunction(geometry, ask);
}
