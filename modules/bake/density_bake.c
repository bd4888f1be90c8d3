#include "modules/bake/density_bake.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "modules/bake/rasterize.h"
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

typedef struct bake {
    const nook_triangles *triangles;
    const nook_alphas *alphas; /* NULL: all is opaque */
    const nook_grid_frame *frame;
    nook_voxel_grid *rasterized; /* written by the first pass, only read by the second */
    atomic_uchar *densities;     /* of each voxel; the largest wins, so that no order shows */
} bake;

/* A triangle that is being rasterised. */
typedef struct marker {
    bake *b;
    size_t triangle;
    const nook_alpha_part *part; /* NULL: opaque */
    bool first_pass;
} marker;

static uint8_t alpha_at(const marker *m, const double weight[3])
{
    if (!m->part)
        return UINT8_MAX;
    const uint32_t *corners = m->b->triangles->indices + 3 * m->triangle;
    return (uint8_t)lround(nook_alpha_at(m->b->alphas, m->part, corners, weight) * UINT8_MAX);
}

/* ---- Marking ------------------------------------------------------------------------------------------------------ */

static void mark(void *user, const int32_t voxel[3], const double weight[3])
{
    const marker *m = user;
    const uint32_t *size = m->b->frame->size;
    size_t index = ((size_t)voxel[2] * size[1] + (size_t)voxel[1]) * size[0] + (size_t)voxel[0];
    atomic_uchar *held = &m->b->densities[index];
    unsigned char alpha = alpha_at(m, weight), before = atomic_load_explicit(held, memory_order_relaxed);
    if (m->first_pass)
        nook_voxel_grid_set(m->b->rasterized, voxel); /* also where a mask has a hole: the triangle was here */
    while (before < alpha && !atomic_compare_exchange_weak(held, &before, alpha))
        ;
}

static void rasterize(bake *b, size_t first, size_t last, bool first_pass)
{
    for (size_t t = first; t < last; t++) {
        nook_snapped_triangle snapped;
        marker m = { b, t, nook_alpha_part_of(b->alphas, t), first_pass };
        if (!nook_grid_snap(b->frame, b->triangles, t, &snapped))
            continue;
        if (first_pass)
            nook_rasterize_three_way(&snapped, b->frame->inner, mark, &m);
        else
            nook_rasterize_narrow(&snapped, b->frame->inner, b->rasterized, mark, &m);
    }
}

static void rasterize_triangles(void *user, size_t first, size_t last, unsigned worker)
{
    (void)worker;
    rasterize(user, first, last, true);
}

static void rasterize_narrow_triangles(void *user, size_t first, size_t last, unsigned worker)
{
    (void)worker;
    rasterize(user, first, last, false);
}

/* ---- Public ------------------------------------------------------------------------------------------------------- */

nook_result nook_density_bake(const nook_triangles *triangles, const nook_alphas *alphas, unsigned threads,
                              const nook_grid_frame *frame, nook_volume *out_volume)
{
    size_t count = (size_t)frame->size[0] * frame->size[1] * frame->size[2];
    bake b = {
        .triangles = triangles, .alphas = alphas, .frame = frame, .rasterized = nook_voxel_grid_create(frame->size)
    };
    b.densities = malloc(count * sizeof *b.densities);
    uint8_t *voxels = malloc(count);
    nook_result result = NOOK_OK;
    if (b.rasterized && b.densities && voxels) {
        uint64_t occupied = 0;
        for (size_t i = 0; i < count; i++)
            atomic_init(&b.densities[i], 0);
        nook_parallel_for(triangles->index_count / 3, threads, rasterize_triangles, &b);
        nook_parallel_for(triangles->index_count / 3, threads, rasterize_narrow_triangles, &b);
        for (size_t i = 0; i < count; i++) {
            voxels[i] = atomic_load_explicit(&b.densities[i], memory_order_relaxed);
            occupied += voxels[i] > 0;
        }
        *out_volume = (nook_volume){ .info = { .occupied = occupied }, .voxels = voxels };
    } else {
        free(voxels);
        result = nook_fail(NOOK_E_MEMORY, "voxelize: no memory for densities in %ux%ux%u voxels; lower the resolution",
                           frame->size[0], frame->size[1], frame->size[2]);
    }
    free(b.densities);
    nook_voxel_grid_destroy(b.rasterized);
    return result;
}
