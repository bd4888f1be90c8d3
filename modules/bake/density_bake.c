#include "modules/bake/density_bake.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "modules/bake/rasterize.h"
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

enum { TEXEL_BYTES = 4, ALPHA = 3 };

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

/* ---- Alpha at a point of a triangle ------------------------------------------------------------------------------- */

/* Textures repeat. */
static uint32_t texel_at(double coordinate, uint32_t size)
{
    double within = coordinate - floor(coordinate);
    uint32_t texel = (uint32_t)(within * size);
    return texel < size ? texel : size - 1;
}

static double texture_alpha(const marker *m, const double weight[3])
{
    const nook_alpha_part *part = m->part;
    double uv[2] = { 0.0, 0.0 };
    for (size_t k = 0; k < 3; k++) {
        const float *corner = m->b->alphas->uvs + 2 * (size_t)m->b->triangles->indices[3 * m->triangle + k];
        for (int i = 0; i < 2; i++)
            uv[i] += weight[k] * (double)corner[i];
    }
    if (!isfinite(uv[0]) || !isfinite(uv[1]))
        return 1.0;
    size_t texel = (size_t)texel_at(uv[1], part->height) * part->width + texel_at(uv[0], part->width);
    return part->texels[texel * TEXEL_BYTES + ALPHA] / 255.0;
}

static uint8_t alpha_at(const marker *m, const double weight[3])
{
    const nook_alpha_part *part = m->part;
    if (!part)
        return UINT8_MAX;
    double alpha = (double)part->alpha * (part->texels ? texture_alpha(m, weight) : 1.0);
    if (part->masked)
        return alpha >= (double)part->cutoff ? UINT8_MAX : 0;
    return (uint8_t)lround(fmin(fmax(alpha, 0.0), 1.0) * UINT8_MAX);
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

/* The part in which a triangle lies; parts are in the order of their triangles. */
static const nook_alpha_part *part_of(const nook_alphas *alphas, size_t triangle)
{
    uint32_t first = 0, end = alphas ? alphas->part_count : 0;
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        if (alphas->parts[middle].first_index <= 3 * triangle)
            first = middle + 1;
        else
            end = middle;
    }
    if (first == 0)
        return NULL;
    const nook_alpha_part *part = &alphas->parts[first - 1];
    return 3 * triangle < part->first_index + part->index_count ? part : NULL;
}

static void rasterize(bake *b, size_t first, size_t last, bool first_pass)
{
    for (size_t t = first; t < last; t++) {
        nook_snapped_triangle snapped;
        marker m = { b, t, part_of(b->alphas, t), first_pass };
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

uint64_t nook_density_hash(const nook_triangles *triangles, const nook_alphas *alphas, uint64_t seed)
{
    uint64_t hash = seed;
    bool textured = false;
    for (uint32_t i = 0; alphas && i < alphas->part_count; i++) {
        const nook_alpha_part *part = &alphas->parts[i];
        const float numbers[] = { part->alpha, part->masked ? part->cutoff : -1.0f };
        const uint64_t places[] = { part->first_index, part->index_count, part->texels ? part->width : 0,
                                    part->texels ? part->height : 0 };
        hash = XXH3_64bits_withSeed(numbers, sizeof numbers, hash);
        hash = XXH3_64bits_withSeed(places, sizeof places, hash);
        if (part->texels)
            hash = XXH3_64bits_withSeed(part->texels, (size_t)part->width * part->height * TEXEL_BYTES, hash);
        textured = textured || part->texels;
    }
    if (textured)
        hash = XXH3_64bits_withSeed(alphas->uvs, (size_t)triangles->vertex_count * 2 * sizeof(float), hash);
    return hash;
}
