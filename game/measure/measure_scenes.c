#include "game/measure/measure_scenes.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include <dirent.h>
#include <errno.h>
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

static int is_visible(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

static bool is_scene(const char *path)
{
    const char *extension = nook_path_extension(path);
    return (strcasecmp(extension, ".glb") == 0 || strcasecmp(extension, ".gltf") == 0) && nook_file_exists(path);
}

static nook_result add_entries(nook_scene_list *list, const char *folder, bool inner)
{
    struct dirent **entries;
    int count = scandir(folder, &entries, is_visible, alphasort);
    if (count < 0)
        return nook_fail(NOOK_E_IO, "%s: cannot read: %s", folder, strerror(errno));
    nook_result result = NOOK_OK;
    for (int i = 0; i < count; i++) {
        char path[4096];
        nook_path_join(path, sizeof path, folder, entries[i]->d_name);
        if (result == NOOK_OK && is_scene(path))
            result = nook_scene_list_add(list, path);
        else if (result == NOOK_OK && inner && nook_directory_exists(path))
            result = add_entries(list, path, false);
        free(entries[i]);
    }
    free(entries);
    return result;
}

nook_result nook_scene_list_add_folder(nook_scene_list *list, const char *folder)
{
    size_t before = list->count;
    nook_result result = add_entries(list, folder, true);
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
