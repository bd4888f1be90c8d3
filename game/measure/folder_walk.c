#include "game/measure/folder_walk.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

static int is_visible(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

nook_result nook_folder_walk(const char *folder, int depth, const nook_folder_visitor *visitor)
{
    struct dirent **entries;
    int count = scandir(folder, &entries, is_visible, alphasort);
    if (count < 0)
        return nook_fail(NOOK_E_IO, "%s: cannot read: %s", folder, strerror(errno));
    nook_result result = NOOK_OK;
    for (int i = 0; i < count; i++) {
        char path[4096];
        nook_path_join(path, sizeof path, folder, entries[i]->d_name);
        if (result == NOOK_OK && visitor->wants(path))
            result = visitor->take(visitor->user, path);
        else if (result == NOOK_OK && depth > 0 && nook_directory_exists(path))
            result = nook_folder_walk(path, depth - 1, visitor);
        free(entries[i]);
    }
    free(entries);
    return result;
}
