#include "modules/bake/voxelize.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "modules/bake/density_bake.h"
#include "modules/bake/distance_bake.h"
#include "modules/bake/rasterize.h"
#include "modules/bake/surfel_bake.h"
#include <stdlib.h>
#include <xxhash.h>

/* ---- The two passes --------------------------------------------------------------------------------------------- */

static void mark_grid(void *user, const int32_t voxel[3], const double weight[3])
{
    (void)weight;
    nook_voxel_grid_set(user, voxel);
}

typedef struct passes {
    const nook_triangles *triangles;
    const nook_grid_frame *frame;
    nook_voxel_grid *rasterized; /* written by the first pass, only read by the second */
    nook_voxel_grid *extra;      /* written by the second */
} passes;

static void rasterize_triangles(void *user, size_t first, size_t last, unsigned worker)
{
    const passes *p = user;
    (void)worker;
    nook_snapped_triangle snapped;
    for (size_t t = first; t < last; t++)
        if (nook_grid_snap(p->frame, p->triangles, t, &snapped))
            nook_rasterize_three_way(&snapped, p->frame->inner, mark_grid, p->rasterized);
}

static void rasterize_narrow_triangles(void *user, size_t first, size_t last, unsigned worker)
{
    const passes *p = user;
    (void)worker;
    nook_snapped_triangle snapped;
    for (size_t t = first; t < last; t++)
        if (nook_grid_snap(p->frame, p->triangles, t, &snapped))
            nook_rasterize_narrow(&snapped, p->frame->inner, p->rasterized, mark_grid, p->extra);
}

static nook_result voxelize_binary(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                                   const nook_grid_frame *frame, nook_volume *out_volume)
{
    size_t voxel_count = (size_t)frame->size[0] * frame->size[1] * frame->size[2];
    nook_voxel_grid *rasterized = nook_voxel_grid_create(frame->size), *extra = nook_voxel_grid_create(frame->size);
    uint8_t *voxels = malloc(voxel_count);
    nook_result result = NOOK_OK;
    if (rasterized && extra && voxels) {
        passes p = { triangles, frame, rasterized, extra };
        nook_parallel_for(triangles->index_count / 3, desc->threads, rasterize_triangles, &p);
        nook_parallel_for(triangles->index_count / 3, desc->threads, rasterize_narrow_triangles, &p);
        uint64_t occupied = nook_voxel_grid_expand(rasterized, extra, voxels);
        *out_volume = (nook_volume){ .info = { .occupied = occupied }, .voxels = voxels };
    } else {
        free(voxels);
        result = nook_fail(NOOK_E_MEMORY, "voxelize: no memory for %ux%ux%u voxels; lower the resolution",
                           frame->size[0], frame->size[1], frame->size[2]);
    }
    nook_voxel_grid_destroy(rasterized);
    nook_voxel_grid_destroy(extra);
    return result;
}

/* ---- Public ----------------------------------------------------------------------------------------------------- */

uint64_t nook_voxelize_hash(const nook_triangles *triangles, const nook_voxelize_desc *desc)
{
    enum { CHUNK = 1024 };
    const uint64_t settings[] = { NOOK_VOXELIZE_VERSION, NOOK_VOLUME_VERSION, desc->resolution, triangles->vertex_count,
                                  triangles->index_count };
    static const uint64_t versions[NOOK_VOLUME_KINDS] = { [NOOK_VOLUME_DENSITY] = NOOK_DENSITY_BAKE_VERSION,
                                                          [NOOK_VOLUME_SURFEL] = NOOK_SURFEL_BAKE_VERSION,
                                                          [NOOK_VOLUME_DISTANCE] = NOOK_DISTANCE_BAKE_VERSION };
    const uint64_t kind[] = { (uint64_t)desc->kind,
                              (uint32_t)desc->kind < NOOK_VOLUME_KINDS ? versions[desc->kind] : 0 };
    uint64_t hash = XXH3_64bits(settings, sizeof settings);
    if (desc->kind != NOOK_VOLUME_BINARY)
        hash = XXH3_64bits_withSeed(kind, sizeof kind, hash);
    if (desc->kind == NOOK_VOLUME_DENSITY)
        hash = nook_density_hash(triangles, desc->alphas, hash);
    hash = XXH3_64bits_withSeed(triangles->indices, triangles->index_count * sizeof(uint32_t), hash);
    float chunk[CHUNK][3];
    for (uint32_t first = 0; first < triangles->vertex_count; first += CHUNK) {
        uint32_t left = triangles->vertex_count - first, count = left < CHUNK ? left : CHUNK;
        for (uint32_t i = 0; i < count; i++)
            nook_grid_read_position(triangles, first + i, chunk[i]);
        hash = XXH3_64bits_withSeed(chunk, count * sizeof chunk[0], hash);
        if (left <= CHUNK)
            break;
    }
    return hash;
}

static nook_result make_kind(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                             const nook_grid_frame *frame, nook_volume *out_volume)
{
    switch (desc->kind) {
    case NOOK_VOLUME_BINARY:
        break;
    case NOOK_VOLUME_DENSITY:
        return nook_density_bake(triangles, desc->alphas, desc->threads, frame, out_volume);
    case NOOK_VOLUME_SURFEL:
        return nook_surfel_bake(triangles, desc->threads, frame, out_volume);
    case NOOK_VOLUME_DISTANCE:
        return nook_distance_bake(triangles, desc->threads, frame, out_volume);
    }
    return voxelize_binary(triangles, desc, frame, out_volume);
}

nook_result nook_voxelize(const nook_triangles *triangles, const nook_voxelize_desc *desc, nook_volume *out_volume)
{
    nook_grid_frame frame;
    nook_volume volume;
    nook_result result = nook_grid_place(triangles, desc, &frame);
    if (result == NOOK_OK)
        result = make_kind(triangles, desc, &frame, &volume);
    if (result != NOOK_OK)
        return result;
    volume.info = (nook_volume_info){ .kind = desc->kind,
                                      .width = frame.size[0],
                                      .height = frame.size[1],
                                      .depth = frame.size[2],
                                      .voxel_size = frame.voxel_size,
                                      .origin = { frame.origin[0], frame.origin[1], frame.origin[2] },
                                      .content_hash = nook_voxelize_hash(triangles, desc),
                                      .occupied = volume.info.occupied };
    *out_volume = volume;
    return NOOK_OK;
}
