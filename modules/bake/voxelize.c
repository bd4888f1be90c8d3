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
           (desc->kind == NOOK_VOLUME_DISTANCE && desc->alphas && desc->alphas->part_count > 0) ||
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
        return nook_surfel_bake(triangles, desc, frame, out_volume);
    case NOOK_VOLUME_DISTANCE:
        return nook_distance_bake(triangles, desc->alphas, desc->threads, frame, out_volume);
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

/* @param frame  of level 0 @param before  NULL: all is made */
static nook_result make_levels(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                               const nook_grid_frame *frame, uint32_t levels, const nook_surfel_before *before,
                               nook_volume *out_volumes)
{
    nook_result result = nook_surfel_bake_levels(triangles, desc, frame, levels, before, out_volumes);
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
        nook_result made = make_levels(triangles, desc, frame, 1u << desc->level, NULL, volumes);
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

static nook_result check_levels(const nook_voxelize_desc *desc, uint32_t levels)
{
    if (levels == 0 || levels >> NOOK_VOXELIZE_LEVELS || desc->kind != NOOK_VOLUME_SURFEL)
        return nook_fail(NOOK_E_RANGE, "voxelize: levels %#x of kind %d; surfels alone have levels, 0 to %d, as bits",
                         levels, (int)desc->kind, NOOK_VOXELIZE_LEVELS - 1);
    return NOOK_OK;
}

nook_result nook_voxelize_levels(const nook_triangles *triangles, const nook_voxelize_desc *desc, uint32_t levels,
                                 nook_volume *out_volumes)
{
    nook_grid_frame frame;
    nook_voxelize_desc finest = *desc;
    finest.level = 0;
    nook_result result = check_levels(desc, levels);
    if (result == NOOK_OK)
        result = nook_grid_place(triangles, &finest, &frame);
    return result == NOOK_OK ? make_levels(triangles, &finest, &frame, levels, NULL, out_volumes) : result;
}

/* ---- Again ------------------------------------------------------------------------------------------------------ */

/* What levels were before: pointers, as there may be one alone. NULL: not asked for. */
typedef struct older {
    const nook_triangles *triangles;
    const nook_alphas *alphas;
    const nook_volume *volumes[NOOK_VOXELIZE_LEVELS];
} older;

static nook_result check_before(const nook_voxelize_desc *desc, const older *before)
{
    nook_voxelize_desc then = *desc;
    then.alphas = before->alphas;
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
        const nook_volume *volume = before->volumes[level];
        then.level = level;
        if (volume && (volume->info.kind != desc->kind ||
                       volume->info.content_hash != nook_voxelize_hash(before->triangles, &then)))
            return nook_fail(NOOK_E_ARG, "voxelize: the volume before is not that of the triangles before");
    }
    return NOOK_OK;
}

/*
 * Whether level 0 has the same grid as it had. Of coarser levels it does not show: with another voxel at the end of an odd side theirs stays, and
 * what was put into the last layer lies in the next one.
 */
static bool is_same_grid(const older *before, const nook_voxelize_desc *desc, const nook_grid_frame *frame)
{
    nook_grid_frame then;
    const nook_volume *finest = before->volumes[0];
    if (finest)
        then = (nook_grid_frame){ .voxel_size = finest->info.voxel_size,
                                  .origin = { finest->info.origin[0], finest->info.origin[1], finest->info.origin[2] },
                                  .size = { finest->info.width, finest->info.height, finest->info.depth } };
    else
        nook_grid_find(before->triangles, desc->resolution, &then); /* finite ones: a volume was made of them */
    bool same = then.voxel_size == frame->voxel_size;
    for (int axis = 0; axis < 3; axis++)
        same = same && then.origin[axis] == frame->origin[axis] && then.size[axis] == frame->size[axis];
    return same;
}

/* @param frame  of level 0, of both */
static nook_result make_changed(const nook_triangles *triangles, const nook_voxelize_desc *desc, uint32_t levels,
                                const older *before, const nook_grid_frame *frame, nook_volume *out_volumes,
                                size_t *out_bricks)
{
    uint8_t *changed[NOOK_VOXELIZE_LEVELS] = { NULL };
    nook_surfel_before kept[NOOK_VOXELIZE_LEVELS] = { { .volume = NULL } };
    bool allocated = true;
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS && allocated; level++)
        if (levels >> level & 1) {
            changed[level] = calloc(nook_brick_total(&before->volumes[level]->info), 1);
            kept[level] = (nook_surfel_before){ before->volumes[level], changed[level] };
            allocated = changed[level] != NULL;
        }
    if (!allocated || nook_edit_find(&(nook_edit_soup){ before->triangles, before->alphas },
                                     &(nook_edit_soup){ triangles, desc->alphas }, frame, changed) != NOOK_OK)
        allocated = false;
    nook_result result = allocated
                             ? make_levels(triangles, desc, frame, levels, kept, out_volumes)
                             : nook_fail(NOOK_E_MEMORY, "voxelize: no memory to tell %zu triangles from those before",
                                         triangles->index_count / 3);
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
        out_bricks[level] = 0;
        for (size_t i = 0; changed[level] && i < nook_brick_total(&kept[level].volume->info); i++)
            out_bricks[level] += changed[level][i];
        free(changed[level]);
    }
    return result;
}

/* Of surfels. @param desc  of level 0 @param out_bricks  NOOK_VOXELIZE_LEVELS of them; filled on NOOK_OK */
static nook_result make_again(const nook_triangles *triangles, const nook_voxelize_desc *desc, uint32_t levels,
                              const older *before, const nook_grid_frame *frame, nook_volume *out_volumes,
                              size_t *out_bricks)
{
    if (is_same_grid(before, desc, frame))
        return make_changed(triangles, desc, levels, before, frame, out_volumes, out_bricks);
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++)
        out_bricks[level] = before->volumes[level] ? nook_brick_total(&before->volumes[level]->info) : 0;
    return make_levels(triangles, desc, frame, levels, NULL, out_volumes);
}

nook_result nook_voxelize_levels_again(const nook_triangles *triangles, const nook_voxelize_desc *desc, uint32_t levels,
                                       const nook_voxelize_before *before, nook_volume *out_volumes, size_t *out_bricks)
{
    size_t bricks[NOOK_VOXELIZE_LEVELS];
    nook_grid_frame frame;
    nook_voxelize_desc finest = *desc;
    older was = { before->triangles, before->alphas, { NULL } };
    finest.level = 0;
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++)
        was.volumes[level] = levels >> level & 1 ? &before->volume[level] : NULL;
    nook_result result = check_levels(desc, levels);
    if (result == NOOK_OK)
        result = nook_grid_place(triangles, &finest, &frame);
    if (result == NOOK_OK)
        result = check_before(desc, &was);
    if (result == NOOK_OK)
        result = make_again(triangles, &finest, levels, &was, &frame, out_volumes, bricks);
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS && result == NOOK_OK && out_bricks; level++)
        if (levels >> level & 1)
            out_bricks[level] = bricks[level];
    return result;
}

nook_result nook_voxelize_again(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                                const nook_voxelize_before *before, nook_volume *out_volume, size_t *out_bricks)
{
    size_t bricks[NOOK_VOXELIZE_LEVELS] = { 0 };
    nook_volume volumes[NOOK_VOXELIZE_LEVELS];
    nook_grid_frame frame;
    nook_voxelize_desc finest = *desc;
    older was = { before->triangles, before->alphas, { NULL } };
    nook_result result = nook_grid_place(triangles, desc, &frame); /* checks the level, too */
    if (result != NOOK_OK)
        return result;
    finest.level = 0;
    was.volumes[desc->level] = before->volume;
    result = check_before(desc, &was);
    if (result == NOOK_OK && desc->kind == NOOK_VOLUME_SURFEL) {
        result = make_again(triangles, &finest, 1u << desc->level, &was, &frame, volumes, bricks);
    } else if (result == NOOK_OK) {
        result = make(triangles, desc, &frame, &volumes[0]); /* not nook_voxelize, which would warn once more */
        bricks[0] = nook_brick_total(&before->volume->info);
    }
    if (result != NOOK_OK)
        return result;
    *out_volume = volumes[desc->level];
    if (out_bricks)
        *out_bricks = bricks[desc->level];
    return NOOK_OK;
}
