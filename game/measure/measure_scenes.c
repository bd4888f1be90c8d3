#include "game/measure/measure_scenes.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/measure/folder_walk.h"
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

nook_result nook_scene_list_add(nook_scene_list *list, const char *path)
{
    char **grown = realloc(list->paths, (list->count + 1) * sizeof *grown), *copy = strdup(path);
    if (grown)
        list->paths = grown;
    if (!grown || !copy) {
        free(copy);
        return nook_fail(NOOK_E_MEMORY, "no memory for a list of scenes");
    }
    list->paths[list->count++] = copy;
    return NOOK_OK;
}

static bool is_scene(const char *path)
{
    const char *extension = nook_path_extension(path);
    return (strcasecmp(extension, ".glb") == 0 || strcasecmp(extension, ".gltf") == 0) && nook_file_exists(path);
}

static nook_result take_scene(void *list, const char *path)
{
    return nook_scene_list_add(list, path);
}

nook_result nook_scene_list_add_folder(nook_scene_list *list, const char *folder)
{
    size_t before = list->count;
    const nook_folder_visitor visitor = { is_scene, take_scene, list };
    nook_result result = nook_folder_walk(folder, 1, &visitor);
    if (result == NOOK_OK && list->count == before)
        return nook_fail(NOOK_E_NOT_FOUND, "%s: no .glb or .gltf in it or in its folders", folder);
    return result;
}

void nook_scene_list_free(nook_scene_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        free(list->paths[i]);
    free(list->paths);
    *list = (nook_scene_list){ 0 };
}
