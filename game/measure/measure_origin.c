#include "game/measure/measure_origin.h"
#include "engine/core/file.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "engine/gpu/gpu.h"
#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <xxhash.h>

enum { PATH_CAPACITY = 4096, DEPTH_MAX = 8 };

/* ---- Build ------------------------------------------------------------------------------------------------------ */

static nook_result add_file(const char *path, uint64_t *hash)
{
    nook_file file;
    nook_result result = nook_file_read(path, &file);
    if (result != NOOK_OK)
        return result;
    *hash = XXH3_64bits_withSeed(file.bytes, file.size, *hash);
    nook_file_free(&file);
    return NOOK_OK;
}

static int is_visible(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

static bool is_compiled_at_run_time(const char *name)
{
    const char *extension = nook_path_extension(name);
    return strcmp(extension, ".glsl") == 0 || strcmp(extension, ".def") == 0;
}

/* Every shader below a folder, in the order of their names. */
static nook_result add_folder(const char *folder, int depth, uint64_t *hash)
{
    struct dirent **entries;
    int count = scandir(folder, &entries, is_visible, alphasort);
    if (count < 0)
        return nook_fail(NOOK_E_IO, "%s: cannot read: %s", folder, strerror(errno));
    nook_result result = NOOK_OK;
    for (int i = 0; i < count; i++) {
        char path[PATH_CAPACITY];
        nook_path_join(path, sizeof path, folder, entries[i]->d_name);
        if (result == NOOK_OK && is_compiled_at_run_time(path))
            result = add_file(path, hash);
        else if (result == NOOK_OK && depth < DEPTH_MAX && nook_directory_exists(path))
            result = add_folder(path, depth + 1, hash);
        free(entries[i]);
    }
    free(entries);
    return result;
}

nook_result nook_origin_build(const char *root, char out[NOOK_ORIGIN_BUILD_SIZE])
{
    static const char *const folders[] = { "shaders", "modules" };
    uint64_t hash = 0;
    nook_result result = add_file("/proc/self/exe", &hash);
    for (size_t i = 0; i < NOOK_COUNT(folders) && result == NOOK_OK; i++) {
        char path[PATH_CAPACITY];
        result = add_folder(nook_path_join(path, sizeof path, root, folders[i]), 0, &hash);
    }
    if (result == NOOK_OK)
        snprintf(out, NOOK_ORIGIN_BUILD_SIZE, "%016" PRIx64, hash);
    return result;
}

/* ---- Machine, date ---------------------------------------------------------------------------------------------- */

/* The first processor's name as Linux tells it, else "". */
static void read_processor(char *out, size_t capacity)
{
    char line[256];
    FILE *file = fopen("/proc/cpuinfo", "r");
    out[0] = '\0';
    while (file && out[0] == '\0' && fgets(line, sizeof line, file)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || !colon)
            continue;
        snprintf(out, capacity, "%s", colon + 1 + strspn(colon + 1, " "));
        out[strcspn(out, "\n")] = '\0';
    }
    if (file)
        fclose(file);
}

const char *nook_origin_machine(const nook_gpu *gpu, char out[NOOK_ORIGIN_MACHINE_SIZE])
{
    char processor[200];
    read_processor(processor, sizeof processor);
    unsigned cores = nook_core_count();
    snprintf(out, NOOK_ORIGIN_MACHINE_SIZE, "%s%s%s, %u core%s", gpu->renderer, processor[0] ? "; " : "", processor,
             cores, cores == 1 ? "" : "s");
    return out;
}

const char *nook_origin_date(char out[NOOK_ORIGIN_DATE_SIZE])
{
    time_t now = time(NULL);
    struct tm utc;
    gmtime_r(&now, &utc);
    strftime(out, NOOK_ORIGIN_DATE_SIZE, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return out;
}
