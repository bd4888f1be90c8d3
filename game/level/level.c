#include "game/level/level.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/level/level_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static bool is_model(const char *path)
{
    const char *extension = nook_path_extension(path);
    return strcasecmp(extension, ".glb") == 0 || strcasecmp(extension, ".gltf") == 0;
}

nook_result nook_level_read(const char *path, nook_level **out_level)
{
    *out_level = NULL;
    nook_level *level = calloc(1, sizeof *level);
    if (!level)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for the level", path);
    if (strlen(path) >= sizeof level->path) {
        free(level);
        return nook_fail(NOOK_E_NOT_FOUND, "%s: the path is longer than %zu bytes", path, sizeof level->path - 1);
    }
    snprintf(level->path, sizeof level->path, "%s", path);
    nook_result result = is_model(path) ? nook_level_make_of_model(path, level) : nook_level_read_file(path, level);
    if (result != NOOK_OK) {
        nook_level_free(level);
        return result;
    }
    *out_level = level;
    return NOOK_OK;
}

void nook_level_free(nook_level *level)
{
    if (!level)
        return;
    free(level->entities);
    free(level);
}

const char *nook_level_kind_name(nook_level_kind kind)
{
    static const char *const names[] = { "body", "fixed", "mover", "spinner", "plate", "shade", "goal" };
    return names[kind];
}

bool nook_level_name_matches(const char *pattern, const char *name)
{
    size_t length = strlen(pattern);
    if (length > 0 && pattern[length - 1] == '*')
        return strncmp(pattern, name, length - 1) == 0;
    return strcmp(pattern, name) == 0;
}

const nook_level_entity *nook_level_find_node(const nook_level *level, const char *node)
{
    const nook_level_entity *found = NULL;
    for (uint32_t i = 0; i < level->entity_count; i++) {
        const nook_level_entity *entity = &level->entities[i];
        if (entity->kind == NOOK_LEVEL_GOAL)
            continue;
        if (strcmp(entity->node, node) == 0)
            return entity;
        if (!found && nook_level_name_matches(entity->node, node))
            found = entity;
    }
    return found;
}

const nook_level_entity *nook_level_find(const nook_level *level, const char *name)
{
    for (uint32_t i = 0; i < level->entity_count; i++) {
        if (strcmp(level->entities[i].name, name) == 0)
            return &level->entities[i];
    }
    return NULL;
}
