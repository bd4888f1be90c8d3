/* The volumes of a scene's bodies, baked or from the cache, and where their levels lie for those who stream them. */
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/plan/plan_apply.h"
#include "game/volumes.h"
#include "modules/plan/plan.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One line for the whole cache: what stops one volume stops all. */
static nook_result check_kept(const nook_volumes_desc *desc, const nook_bake *bake, bool *warned)
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

bool nook_volumes_holds_blended(nook_volume_kind kind)
{
    return kind == NOOK_VOLUME_DENSITY || kind == NOOK_VOLUME_SURFEL;
}

/* What a kind is made of. @param out_triangles  of the volume; none: there is nothing to bake @param out_alphas  of them */
static void select_triangles(const nook_scene_volume *volume, nook_volume_kind kind, nook_triangles *out_triangles,
                             nook_alphas *out_alphas)
{
    *out_triangles = (nook_triangles){ .positions = volume->positions,
                                       .vertex_count = volume->vertex_count,
                                       .indices = volume->indices,
                                       .index_count = volume->index_count };
    if (nook_volumes_holds_blended(kind)) {
        out_triangles->vertex_count += volume->blended_vertex_count;
        out_triangles->index_count += volume->blended_index_count;
    }
    *out_alphas = (nook_alphas){ volume->parts, volume->part_count, volume->uvs };
    while (out_alphas->part_count > 0 &&
           volume->parts[out_alphas->part_count - 1].first_index >= out_triangles->index_count)
        out_alphas->part_count--; /* blended ones, where the kind does not hold them */
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

static nook_result bake_kind(const nook_volumes_desc *desc, nook_scene_volume *volume, uint32_t place,
                             nook_volume_kind kind, bool *warned)
{
    nook_triangles triangles, triangles_before;
    nook_alphas alphas, alphas_before;
    const nook_scene_volume *before = find_before(desc, volume, place);
    select_triangles(volume, kind, &triangles, &alphas);
    select_triangles(before ? before : volume, kind, &triangles_before, &alphas_before);
    if (triangles.index_count == 0)
        return NOOK_OK;
    const nook_voxelize_desc how = {
        .resolution = volume->resolution, .threads = desc->threads, .kind = kind, .alphas = &alphas
    };
    const nook_bake_before older = { &triangles_before, &alphas_before };
    nook_bake *bake = &volume->bakes[kind];
    nook_result result = nook_bake_cached_again(desc->cache_dir, volume->name, &triangles, &how,
                                                before && triangles_before.index_count ? &older : NULL, bake);
    return result == NOOK_OK ? check_kept(desc, bake, warned) : result;
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

/* All levels of a kind that was baked, the finest first. */
static nook_result bake_levels(const nook_volumes_desc *desc, double r_max, nook_volume_kind kind,
                               nook_scene_volume *volume)
{
    const nook_bake *finest = &volume->bakes[kind];
    nook_triangles triangles;
    nook_alphas alphas;
    nook_result result = NOOK_OK;
    if (!desc->streams || !desc->cache_dir || !finest->bytes || finest->keep_error != 0)
        return NOOK_OK;
    add_level(desc, r_max, finest, volume);
    select_triangles(volume, kind, &triangles, &alphas);
    for (int i = 1; i < NOOK_VOLUMES_LEVELS_MAX && result == NOOK_OK; i++) {
        nook_bake bake = { .bytes = NULL };
        uint32_t resolution = volume->resolution >> i;
        if (resolution < NOOK_VOLUMES_BODY_RESOLUTION_MIN)
            break;
        const nook_voxelize_desc how = {
            .resolution = resolution, .threads = desc->threads, .kind = kind, .alphas = &alphas
        };
        result = nook_bake_cached(desc->cache_dir, volume->name, &triangles, &how, &bake);
        if (result == NOOK_OK && bake.keep_error == 0)
            add_level(desc, r_max, &bake, volume);
        nook_bake_free(&bake);
    }
    return result;
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
            if (volumes->kinds & NOOK_VOLUME_BIT(kind)) {
                result = bake_kind(desc, volume, i, (nook_volume_kind)kind, &warned);
                if (result == NOOK_OK)
                    result = bake_levels(desc, volumes->r_max, (nook_volume_kind)kind, volume);
            }
        if (result != NOOK_OK)
            return result;
        if (desc->progress)
            desc->progress(desc->user, volume, i, volumes->volume_count);
    }
    return NOOK_OK;
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
