#include "modules/bake/voxelize.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "modules/bake/alpha_hash.h"
#include "modules/bake/brick_grid.h"
#include "modules/bake/density_bake.h"
#include "modules/bake/distance_bake.h"
#include "modules/bake/edit.h"
#include "modules/bake/rasterize.h"
#include "modules/bake/surfel_bake.h"
#include "modules/bake/surfel_levels.h"
#include <stdlib.h>
#include <xxhash.h>

/* ---- The two passes --------------------------------------------------------------------------------------------- */

typedef struct passes {
    const nook_triangles *triangles;
    const nook_alphas *alphas; /* NULL: none of them is masked */
    const nook_grid_frame *frame;
    nook_voxel_grid *rasterized; /* written by the first pass, only read by the second: also where a mask has a hole */
    nook_voxel_grid *kept;       /* what of that is there; `rasterized` itself without masks */
    nook_voxel_grid *extra;      /* written by the second */
} passes;

/* A triangle that is being rasterised. */
typedef struct marker {
    const passes *p;
    size_t triangle;
    const nook_alpha_part *mask; /* NULL: none */
} marker;

/* Blended ones are whole: what is bright through them is not for voxels to say. */
static const nook_alpha_part *mask_of(const passes *p, size_t triangle)
{
    const nook_alpha_part *part = nook_alpha_part_of(p->alphas, triangle);
    return part && part->masked ? part : NULL;
}

static bool is_there(const marker *m, const double weight[3])
{
    const uint32_t *corners = m->p->triangles->indices + 3 * m->triangle;
    return !m->mask || nook_alpha_at(m->p->alphas, m->mask, corners, weight) > 0.0;
}

static void mark_rasterized(void *user, const int32_t voxel[3], const double weight[3])
{
    const marker *m = user;
    nook_voxel_grid_set(m->p->rasterized, voxel);
    if (m->p->kept != m->p->rasterized && is_there(m, weight))
        nook_voxel_grid_set(m->p->kept, voxel);
}

static void mark_extra(void *user, const int32_t voxel[3], const double weight[3])
{
    const marker *m = user;
    if (is_there(m, weight))
        nook_voxel_grid_set(m->p->extra, voxel);
}

static void rasterize_triangles(void *user, size_t first, size_t last, unsigned worker)
{
    const passes *p = user;
    (void)worker;
    nook_snapped_triangle snapped;
    for (size_t t = first; t < last; t++) {
        marker m = { p, t, mask_of(p, t) };
        if (nook_grid_snap(p->frame, p->triangles, t, &snapped))
            nook_rasterize_three_way(&snapped, p->frame->inner, mark_rasterized, &m);
    }
}

static void rasterize_narrow_triangles(void *user, size_t first, size_t last, unsigned worker)
{
    const passes *p = user;
    (void)worker;
    nook_snapped_triangle snapped;
    for (size_t t = first; t < last; t++) {
        marker m = { p, t, mask_of(p, t) };
        if (nook_grid_snap(p->frame, p->triangles, t, &snapped))
            nook_rasterize_narrow(&snapped, p->frame->inner, p->rasterized, mark_extra, &m);
    }
}

static bool has_masks(const nook_alphas *alphas)
{
    bool found = false;
    for (uint32_t i = 0; alphas && i < alphas->part_count && !found; i++)
        found = alphas->parts[i].masked;
    return found;
}

static nook_result voxelize_binary(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                                   const nook_grid_frame *frame, nook_volume *out_volume)
{
    size_t voxel_count = (size_t)frame->size[0] * frame->size[1] * frame->size[2];
    bool masks = has_masks(desc->alphas);
    passes p = { .triangles = triangles, .alphas = masks ? desc->alphas : NULL, .frame = frame };
    p.rasterized = nook_voxel_grid_create(frame->size);
    p.extra = nook_voxel_grid_create(frame->size);
    p.kept = masks ? nook_voxel_grid_create(frame->size) : p.rasterized;
    uint8_t *voxels = malloc(voxel_count);
    nook_result result = NOOK_OK;
    if (p.rasterized && p.extra && p.kept && voxels) {
        nook_parallel_for(triangles->index_count / 3, desc->threads, rasterize_triangles, &p);
        nook_parallel_for(triangles->index_count / 3, desc->threads, rasterize_narrow_triangles, &p);
        uint64_t occupied = nook_voxel_grid_expand(p.kept, p.extra, voxels);
        *out_volume = (nook_volume){ .info = { .occupied = occupied }, .voxels = voxels };
    } else {
        free(voxels);
        result = nook_fail(NOOK_E_MEMORY, "voxelize: no memory for %ux%ux%u voxels; lower the resolution",
                           frame->size[0], frame->size[1], frame->size[2]);
    }
    if (masks)
        nook_voxel_grid_destroy(p.kept);
    nook_voxel_grid_destroy(p.rasterized);
    nook_voxel_grid_destroy(p.extra);
    return result;
}

/* ---- Public ----------------------------------------------------------------------------------------------------- */

static bool looks_at_alphas(const nook_voxelize_desc *desc)
{
    return desc->kind == NOOK_VOLUME_DENSITY || desc->kind == NOOK_VOLUME_SURFEL ||
           (desc->kind == NOOK_VOLUME_BINARY && has_masks(desc->alphas));
}

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
    const uint64_t level[] = { desc->level, NOOK_SURFEL_LEVELS_VERSION };
    if (desc->level > 0)
        hash = XXH3_64bits_withSeed(level, sizeof level, hash);
    if (looks_at_alphas(desc))
        hash = nook_alphas_hash(triangles, desc->alphas, hash);
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
        return nook_surfel_bake(triangles, desc, frame, NULL, out_volume);
    case NOOK_VOLUME_DISTANCE:
        return nook_distance_bake(triangles, desc->threads, frame, out_volume);
    }
    return voxelize_binary(triangles, desc, frame, out_volume);
}

static nook_volume_info describe(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                                 const nook_grid_frame *frame, uint64_t occupied)
{
    return (nook_volume_info){ .kind = desc->kind,
                               .width = frame->size[0],
                               .height = frame->size[1],
                               .depth = frame->size[2],
                               .voxel_size = frame->voxel_size,
                               .origin = { frame->origin[0], frame->origin[1], frame->origin[2] },
                               .content_hash = nook_voxelize_hash(triangles, desc),
                               .occupied = occupied };
}

/* @param frame  of level 0 */
static nook_result make_levels(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                               const nook_grid_frame *frame, uint32_t levels, nook_volume *out_volumes)
{
    nook_result result = nook_surfel_bake_levels(triangles, desc, frame, levels, out_volumes);
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS && result == NOOK_OK; level++) {
        if (!(levels >> level & 1))
            continue;
        const nook_grid_frame merged = nook_grid_level(frame, level);
        nook_voxelize_desc of_level = *desc;
        of_level.level = level;
        out_volumes[level].info = describe(triangles, &of_level, &merged, out_volumes[level].info.occupied);
    }
    return result;
}

/* @param frame  of level 0 */
static nook_result make(const nook_triangles *triangles, const nook_voxelize_desc *desc, const nook_grid_frame *frame,
                        nook_volume *out_volume)
{
    nook_volume volume, volumes[NOOK_VOXELIZE_LEVELS];
    if (desc->level > 0) {
        nook_result made = make_levels(triangles, desc, frame, 1u << desc->level, volumes);
        if (made == NOOK_OK)
            *out_volume = volumes[desc->level];
        return made;
    }
    nook_result result = make_kind(triangles, desc, frame, &volume);
    if (result != NOOK_OK)
        return result;
    volume.info = describe(triangles, desc, frame, volume.info.occupied);
    *out_volume = volume;
    return NOOK_OK;
}

nook_result nook_voxelize(const nook_triangles *triangles, const nook_voxelize_desc *desc, nook_volume *out_volume)
{
    nook_grid_frame frame;
    nook_result result = nook_grid_place(triangles, desc, &frame);
    return result == NOOK_OK ? make(triangles, desc, &frame, out_volume) : result;
}

/* ---- Levels ----------------------------------------------------------------------------------------------------- */

uint32_t nook_voxelize_level_resolution(uint32_t resolution, uint32_t level)
{
    return (uint32_t)nook_grid_level_layer((int32_t)resolution, level);
}

nook_result nook_voxelize_levels(const nook_triangles *triangles, const nook_voxelize_desc *desc, uint32_t levels,
                                 nook_volume *out_volumes)
{
    nook_grid_frame frame;
    nook_voxelize_desc finest = *desc;
    finest.level = 0;
    if (levels == 0 || levels >> NOOK_VOXELIZE_LEVELS || desc->kind != NOOK_VOLUME_SURFEL)
        return nook_fail(NOOK_E_RANGE, "voxelize: levels %#x of kind %d; surfels alone have levels, 0 to %d, as bits",
                         levels, (int)desc->kind, NOOK_VOXELIZE_LEVELS - 1);
    nook_result result = nook_grid_place(triangles, &finest, &frame);
    return result == NOOK_OK ? make_levels(triangles, &finest, &frame, levels, out_volumes) : result;
}

/* ---- Again ------------------------------------------------------------------------------------------------------ */

static bool is_same_grid(const nook_volume_info *info, const nook_grid_frame *frame)
{
    bool same = info->voxel_size == frame->voxel_size && info->width == frame->size[0] &&
                info->height == frame->size[1] && info->depth == frame->size[2];
    for (int axis = 0; axis < 3; axis++)
        same = same && info->origin[axis] == frame->origin[axis];
    return same;
}

static nook_result check_before(const nook_voxelize_desc *desc, const nook_voxelize_before *before)
{
    nook_voxelize_desc then = *desc;
    then.alphas = before->alphas;
    if (before->volume->info.kind == desc->kind &&
        before->volume->info.content_hash == nook_voxelize_hash(before->triangles, &then))
        return NOOK_OK;
    return nook_fail(NOOK_E_ARG, "voxelize: the volume before is not that of the triangles before");
}

/* @param frame  of both */
static nook_result make_changed(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                                const nook_voxelize_before *before, const nook_grid_frame *frame,
                                nook_volume *out_volume, size_t *out_bricks)
{
    uint8_t *changed = calloc(nook_brick_total(&before->volume->info), 1);
    nook_result result = NOOK_E_MEMORY;
    if (changed)
        result = nook_edit_find(&(nook_edit_soup){ before->triangles, before->alphas },
                                &(nook_edit_soup){ triangles, desc->alphas }, frame, changed, out_bricks);
    if (result == NOOK_OK)
        result = nook_surfel_bake(triangles, desc, frame, &(nook_surfel_before){ before->volume, changed }, out_volume);
    else
        result = nook_fail(NOOK_E_MEMORY, "voxelize: no memory to tell %zu triangles from those before",
                           triangles->index_count / 3);
    free(changed);
    return result;
}

nook_result nook_voxelize_again(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                                const nook_voxelize_before *before, nook_volume *out_volume, size_t *out_bricks)
{
    nook_grid_frame frame;
    nook_volume volume;
    size_t bricks = 0;
    nook_result result = nook_grid_place(triangles, desc, &frame);
    if (result == NOOK_OK)
        result = check_before(desc, before);
    if (result != NOOK_OK)
        return result;
    if (desc->kind == NOOK_VOLUME_SURFEL && desc->level == 0 && is_same_grid(&before->volume->info, &frame)) {
        result = make_changed(triangles, desc, before, &frame, &volume, &bricks);
        if (result == NOOK_OK)
            volume.info = describe(triangles, desc, &frame, volume.info.occupied);
    } else {
        result = make(triangles, desc, &frame, &volume); /* not nook_voxelize, which would warn once more */
        bricks = nook_brick_total(&before->volume->info);
    }
    if (result != NOOK_OK)
        return result;
    *out_volume = volume;
    if (out_bricks)
        *out_bricks = bricks;
    return NOOK_OK;
}
