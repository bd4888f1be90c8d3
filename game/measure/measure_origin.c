#include "game/measure/measure_origin.h"
#include "engine/core/file.h"
#include "engine/core/jobs.h"
#include "engine/gpu/gpu.h"
#include "game/measure/folder_walk.h"
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <xxhash.h>

enum { PATH_CAPACITY = 4096, DEPTH_MAX = 8 };

/* ---- Build ------------------------------------------------------------------------------------------------------ */

static nook_result add_file(void *user, const char *path)
{
    uint64_t *hash = user;
    nook_file file;
    nook_result result = nook_file_read(path, &file);
    if (result != NOOK_OK)
        return result;
    *hash = XXH3_64bits_withSeed(file.bytes, file.size, *hash);
    nook_file_free(&file);
    return NOOK_OK;
}

static bool is_compiled_at_run_time(const char *name)
{
    const char *extension = nook_path_extension(name);
    return strcmp(extension, ".glsl") == 0 || strcmp(extension, ".def") == 0;
}

nook_result nook_origin_build(const char *root, char out[NOOK_ORIGIN_BUILD_SIZE])
{
    static const char *const folders[] = { "shaders", "modules" };
    uint64_t hash = 0;
    const nook_folder_visitor visitor = { is_compiled_at_run_time, add_file, &hash };
    nook_result result = add_file(&hash, "/proc/self/exe");
    for (size_t i = 0; i < NOOK_COUNT(folders) && result == NOOK_OK; i++) {
        char path[PATH_CAPACITY];
        result = nook_folder_walk(nook_path_join(path, sizeof path, root, folders[i]), DEPTH_MAX, &visitor);
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
