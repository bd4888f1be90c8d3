/* The volumes of a scene's bodies, baked or from the cache, and where their levels lie for those who stream them. */
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/plan/plan_apply.h"
#include "game/volumes.h"
#include "modules/bake/medium_bake.h"
#include "modules/plan/plan.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

nook_result nook_volumes_check_kept(const nook_volumes_desc *desc, const nook_bake *bake, bool *warned)
{
    if (bake->keep_error == 0 || *warned)
        return NOOK_OK;
    const char *reason = strerror(bake->keep_error);
    if (desc->must_keep)
        return nook_fail(NOOK_E_IO, "%s: cannot keep volumes there: %s; give another --cache", desc->cache_dir, reason);
    nook_log_warning("%s: cannot keep volumes there: %s; they are baked each time", desc->cache_dir, reason);
    *warned = true;
    return NOOK_OK;
}

/* How many of the blended indices, or of their vertices, are in volumes of a kind: the clear ones among them come last. */
static size_t held(nook_volume_kind kind, size_t blended, size_t clear)
{
    if (kind == NOOK_VOLUME_BINARY)
        return 0;
    return kind == NOOK_VOLUME_DISTANCE ? blended - clear : blended;
}

size_t nook_scene_volume_indices_of(const nook_scene_volume *volume, nook_volume_kind kind)
{
    return volume->index_count + held(kind, volume->blended_index_count, volume->clear_index_count);
}

void nook_volumes_select(const nook_scene_volume *volume, nook_volume_kind kind, nook_triangles *out_triangles,
                         nook_alphas *out_alphas)
{
    *out_triangles = (nook_triangles){ .positions = volume->positions,
                                       .vertex_count = volume->vertex_count,
                                       .indices = volume->indices,
                                       .index_count = nook_scene_volume_indices_of(volume, kind) };
    out_triangles->vertex_count += (uint32_t)held(kind, volume->blended_vertex_count, volume->clear_vertex_count);
    *out_alphas = (nook_alphas){ volume->parts, volume->part_count, volume->uvs };
    while (out_alphas->part_count > 0 &&
           volume->parts[out_alphas->part_count - 1].first_index >= out_triangles->index_count)
        out_alphas->part_count--; /* those that the kind does not hold */
}

/* The volume of that name in the same place of the scene as it was. @return NULL: there was none */
static const nook_scene_volume *find_before(const nook_volumes_desc *desc, const nook_scene_volume *volume,
                                            uint32_t place)
{
    const nook_scene_volumes *before = desc->before;
    if (!before || place >= before->volume_count || strcmp(before->volumes[place].name, volume->name) != 0)
        return NULL;
    return before->volumes[place].resolution == volume->resolution ? &before->volumes[place] : NULL;
}

/* Where a bake that is in the cache lies. Without memory it is not streamed. */
static void add_level(const nook_volumes_desc *desc, double r_max, const nook_bake *bake, nook_scene_volume *volume)
{
    char path[4096];
    nook_volume_level *levels = realloc(volume->levels, (volume->level_count + (size_t)1) * sizeof *levels);
    if (!levels)
        return;
    volume->levels = levels;
    nook_volume_level *level = &levels[volume->level_count];
    *level = (nook_volume_level){ strdup(nook_bake_path(desc->cache_dir, bake->info.content_hash, path, sizeof path)),
                                  bake->info, nook_plan_level_error(r_max / (bake->info.voxel_size * volume->scale)) };
    if (level->path)
        volume->level_count++;
}

/* Those that are streamed, the finest among them; else that alone. @return bits 1 << level */
static uint32_t levels_of(const nook_volumes_desc *desc, const nook_scene_volume *volume)
{
    uint32_t levels = 1;
    for (uint32_t level = 1; desc->streams && desc->cache_dir && level < NOOK_VOLUMES_LEVELS_MAX; level++)
        if (nook_voxelize_level_resolution(volume->resolution, level) >= NOOK_VOLUMES_BODY_RESOLUTION_MIN)
            levels |= 1u << level;
    return levels;
}

/* Keeps the finest, and where all of them lie if they are streamed. */
static void take_levels(const nook_volumes_desc *desc, double r_max, nook_volume_kind kind, nook_bake *bakes,
                        nook_scene_volume *volume)
{
    volume->bakes[kind] = bakes[0];
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
        if (desc->streams && desc->cache_dir && bakes[0].keep_error == 0 && bakes[level].bytes &&
            bakes[level].keep_error == 0)
            add_level(desc, r_max, &bakes[level], volume);
        if (level > 0)
            nook_bake_free(&bakes[level]);
    }
}

static nook_result bake_kind(const nook_volumes_desc *desc, double r_max, nook_scene_volume *volume, uint32_t place,
                             nook_volume_kind kind, bool *warned)
{
    nook_triangles triangles, triangles_before;
    nook_alphas alphas, alphas_before;
    const nook_scene_volume *before = find_before(desc, volume, place);
    nook_volumes_select(volume, kind, &triangles, &alphas);
    nook_volumes_select(before ? before : volume, kind, &triangles_before, &alphas_before);
    if (triangles.index_count == 0)
        return NOOK_OK;
    const nook_voxelize_desc how = {
        .resolution = volume->resolution, .threads = desc->threads, .kind = kind, .alphas = &alphas
    };
    const nook_bake_before older = { &triangles_before, &alphas_before };
    const nook_bake_before *edited = before && triangles_before.index_count ? &older : NULL;
    nook_bake bakes[NOOK_VOXELIZE_LEVELS] = { { .bytes = NULL } };
    const uint32_t levels = levels_of(desc, volume);
    nook_result result =
        levels == 1
            ? nook_bake_cached_again(desc->cache_dir, volume->name, &triangles, &how, edited, &bakes[0])
            : nook_bake_cached_levels_again(desc->cache_dir, volume->name, &triangles, &how, levels, edited, bakes);
    if (result != NOOK_OK)
        return result;
    take_levels(desc, r_max, kind, bakes, volume);
    return nook_volumes_check_kept(desc, &volume->bakes[kind], warned);
}

static void set_scales(nook_scene_volumes *volumes)
{
    for (uint32_t i = 0; i < volumes->occluder_count; i++) {
        nook_scene_volume *volume = &volumes->volumes[volumes->occluders[i].volume];
        volume->scale = fmax(volume->scale, nook_matrix_longest_axis(&volumes->occluders[i].world_from_mesh));
    }
}

static nook_result bake_all(const nook_volumes_desc *desc, nook_scene_volumes *volumes)
{
    bool warned = false;
    set_scales(volumes);
    for (uint32_t i = 0; i < volumes->volume_count; i++) {
        nook_scene_volume *volume = &volumes->volumes[i];
        nook_result result = NOOK_OK;
        for (int kind = 0; kind < NOOK_VOLUME_KINDS && volume->resolution > 0 && result == NOOK_OK; kind++)
            if (volumes->kinds & NOOK_VOLUME_BIT(kind))
                result = bake_kind(desc, volumes->r_max, volume, i, (nook_volume_kind)kind, &warned);
        if (result != NOOK_OK)
            return result;
        if (desc->progress)
            desc->progress(desc->user, volume, i, volumes->volume_count);
    }
    return NOOK_OK;
}

nook_result nook_volumes_add_densities(const nook_scene *scene, uint32_t resolution, nook_scene_volumes *volumes)
{
    nook_result result = nook_volumes_reserve(volumes, scene->density_count);
    for (uint32_t i = 0; i < scene->density_count && result == NOOK_OK; i++) {
        const nook_scene_density *density = &scene->densities[i];
        nook_scene_volume volume = { .name = strdup(density->name), .medium = &density->medium, .instances = 1 };
        if (!volume.name)
            return nook_fail(NOOK_E_MEMORY, "%s: no memory for a density", scene->path);
        volume.resolution =
            nook_medium_resolution(&density->medium, resolution ? resolution : NOOK_VOLUMES_RESOLUTION_DEFAULT);
        for (int axis = 0; axis < 3; axis++)
            volume.longest = fmax(volume.longest, density->medium.spacing[axis] * density->medium.size[axis]);
        volumes->occluders[volumes->occluder_count++] =
            (nook_scene_occluder){ volumes->volume_count, NOOK_NONE, density->world_from_local, false };
        volumes->volumes[volumes->volume_count++] = volume;
    }
    return result;
}

nook_result nook_volumes_bake(const nook_scene *scene, const nook_volumes_desc *desc, nook_scene_volumes *out)
{
    nook_scene_volumes volumes;
    if (desc->must_keep && nook_directory_make(desc->cache_dir) != NOOK_OK)
        return NOOK_E_IO; /* before the work */
    nook_result result = nook_volumes_collect(scene, desc, &volumes);
    if (result != NOOK_OK)
        return result;
    result = nook_plan_apply_to(scene, &volumes);
    if (result == NOOK_OK)
        result = bake_all(desc, &volumes);
    if (result == NOOK_OK)
        result = nook_volumes_add_densities(scene, desc->resolution, &volumes);
    if (result != NOOK_OK) {
        nook_volumes_free(&volumes);
        return result;
    }
    *out = volumes;
    return NOOK_OK;
}

const nook_bake *nook_scene_volume_bake(const nook_scene_volume *volume)
{
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        if (volume->bakes[kind].bytes)
            return &volume->bakes[kind];
    return NULL;
}

const nook_volume_level *nook_scene_volume_levels(const nook_scene_volume *volume, nook_volume_kind kind,
                                                  uint32_t *out_count)
{
    const nook_volume_level *first = NULL;
    *out_count = 0;
    for (uint32_t i = 0; i < volume->level_count; i++) {
        if (volume->levels[i].info.kind != kind)
            continue;
        first = first ? first : &volume->levels[i];
        ++*out_count;
    }
    return first;
}
