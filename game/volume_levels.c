#include "game/volume_levels.h"
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { NUMBERS_MAX = NOOK_VOXELIZE_LEVELS };

/* @return how many numbers there are, 0 when it is no list of them */
static uint32_t read_numbers(const char *text, uint32_t out[NUMBERS_MAX])
{
    for (uint32_t count = 0; count < NUMBERS_MAX; count++) {
        char *end;
        if (!isdigit((unsigned char)*text))
            return 0;
        unsigned long number = strtoul(text, &end, 10);
        if (number < 1 || number > NOOK_VOXELIZE_RESOLUTION_MAX)
            return 0;
        out[count] = (uint32_t)number;
        if (*end == '\0')
            return count + 1;
        if (*end != ',')
            return 0;
        text = end + 1;
    }
    return 0;
}

bool nook_resolutions_read(const char *text, nook_resolutions *out)
{
    uint32_t numbers[NUMBERS_MAX], count = read_numbers(text, numbers);
    nook_resolutions levels = { .resolution = 0 };
    for (uint32_t i = 0; i < count; i++)
        levels.resolution = numbers[i] > levels.resolution ? numbers[i] : levels.resolution;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t level = 0;
        while (level < NOOK_VOXELIZE_LEVELS &&
               (levels.levels >> level & 1 || nook_voxelize_level_resolution(levels.resolution, level) != numbers[i]))
            level++;
        if (level == NOOK_VOXELIZE_LEVELS)
            return false;
        levels.levels |= 1u << level;
    }
    if (count == 0)
        return false;
    *out = levels;
    return true;
}

nook_result nook_scene_volume_bake_levels(const nook_scene_volume *volume, nook_volume_kind kind,
                                          const nook_volumes_desc *desc, uint32_t levels, nook_bake *out)
{
    nook_bake bakes[NOOK_VOXELIZE_LEVELS] = { { .bytes = NULL } };
    bool warned = false;
    nook_triangles triangles;
    nook_alphas alphas;
    nook_volumes_select(volume, kind, &triangles, &alphas);
    for (uint32_t level = 1; level < NOOK_VOXELIZE_LEVELS; level++)
        if (nook_voxelize_level_resolution(volume->resolution, level) < NOOK_VOLUMES_BODY_RESOLUTION_MIN)
            levels &= ~(1u << level);
    if (triangles.index_count > 0 && volume->resolution > 0 && levels) {
        const nook_voxelize_desc how = {
            .resolution = volume->resolution, .threads = desc->threads, .kind = kind, .alphas = &alphas
        };
        nook_result result = nook_bake_cached_levels(desc->cache_dir, volume->name, &triangles, &how, levels, bakes);
        for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS && result == NOOK_OK; level++)
            result = nook_volumes_check_kept(desc, &bakes[level], &warned);
        if (result != NOOK_OK) {
            for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++)
                nook_bake_free(&bakes[level]);
            return result;
        }
    }
    memcpy(out, bakes, sizeof bakes);
    return NOOK_OK;
}
