#include "engine/core/file.h"
#include "game/commands/commands.h"
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/** Cuts the last part off a path. @return false when there is none */
static bool cut_name(char *path)
{
    char *slash = strrchr(path, '/');
    if (!slash || slash == path)
        return false;
    *slash = '\0';
    return true;
}

static bool has_shaders(const char *root)
{
    char shaders[PATH_MAX + 16];
    return nook_directory_exists(nook_path_join(shaders, sizeof shaders, root, "shaders"));
}

/** NOOK_ROOT, else the folder of the binary, of a bundle, else <root>/build/<kind>/bin/nook, four parts up. */
static bool find_root(char *out, size_t capacity)
{
    const char *given = getenv("NOOK_ROOT");
    if (given && *given) {
        int length = snprintf(out, capacity, "%s", given);
        return length > 0 && (size_t)length < capacity;
    }
    ssize_t length = readlink("/proc/self/exe", out, capacity - 1);
    if (length <= 0)
        return false;
    out[length] = '\0';
    for (int part = 0; part < 4; part++) {
        if (!cut_name(out))
            return false;
        if (part == 0 && has_shaders(out))
            return true;
    }
    return true;
}

int main(int argc, char **argv)
{
    char root[PATH_MAX];
    if (!find_root(root, sizeof root) || !has_shaders(root)) {
        fprintf(stderr, "nook: no shaders/ found; set NOOK_ROOT to the folder of Nook's sources\n");
        return NOOK_EXIT_FAILED;
    }
    size_t count;
    const nook_command *table = nook_command_table(&count);
    const nook_app app = { .root = root };
    return nook_command_dispatch(&app, table, count, argc, argv);
}
