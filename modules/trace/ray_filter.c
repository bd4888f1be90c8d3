#include "modules/trace/ray_filter.h"
#include "modules/trace/ray_chance.h"
#include <stdlib.h>

struct nook_ray_filter {
    const nook_alphas *alphas;
    const uint32_t *indices;
};

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
