#include "modules/bake/cache.h"
#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

enum { PATH_CAPACITY = 4096 };

void nook_bake_free(nook_bake *bake)
{
    if (!bake)
        return;
    free(bake->bytes);
    *bake = (nook_bake){ 0 };
}

/* Decodes everything, voxels too: a file that is handed on is known to be sound. */
static nook_result check_file(const char *path, const nook_file *file, uint64_t hash, nook_volume_info *out_info)
{
    nook_volume volume;
    nook_result result = nook_volume_decode(path, file->bytes, file->size, &volume);
    if (result != NOOK_OK)
        return result;
    *out_info = volume.info;
    nook_volume_free(&volume);
    if (out_info->content_hash != hash)
        return nook_fail(NOOK_E_FORMAT, "%s: holds another mesh's volume (%016" PRIx64 ")", path,
                         out_info->content_hash);
    return NOOK_OK;
}

/* False: bake. *out_bake is filled but for its time otherwise. */
static bool read_cached(const char *path, const char *name, uint64_t hash, nook_bake *out_bake)
{
    nook_file file;
    nook_volume_info info;
    if (!nook_file_exists(path))
        return false;
    nook_result result = nook_file_read(path, &file);
    if (result == NOOK_OK) {
        result = check_file(path, &file, hash, &info);
        if (result != NOOK_OK)
            nook_file_free(&file);
    }
    if (result != NOOK_OK) {
        nook_log_warning("%s: its cached volume was refused; baking it again", name);
        return false;
    }
    *out_bake = (nook_bake){ .bytes = file.bytes, .size = file.size, .info = info, .cache_hit = true };
    return true;
}

char *nook_bake_path(const char *cache_dir, uint64_t content_hash, char *out, size_t capacity)
{
    char file_name[32];
    snprintf(file_name, sizeof file_name, "%016" PRIx64 ".nkv", content_hash);
    return nook_path_join(out, capacity, cache_dir, file_name);
}

/* @return false: bake all of it */
static bool read_before(const char *cache_dir, const char *name, const nook_voxelize_desc *desc,
                        const nook_bake_before *before, nook_volume *out_volume)
{
    char path[PATH_CAPACITY];
    nook_bake cached;
    nook_voxelize_desc then = *desc;
    then.alphas = before->alphas;
    uint64_t hash = nook_voxelize_hash(before->triangles, &then);
    nook_bake_path(cache_dir, hash, path, sizeof path);
    if (!read_cached(path, name, hash, &cached))
        return false;
    bool read = nook_volume_decode(path, cached.bytes, cached.size, out_volume) == NOOK_OK;
    nook_bake_free(&cached);
    return read;
}

/* @param before  NULL: all is made */
static nook_result voxelize(const char *cache_dir, const char *name, const nook_triangles *triangles,
                            const nook_voxelize_desc *desc, const nook_bake_before *before, nook_volume *out_volume,
                            size_t *out_bricks)
{
    nook_volume volume;
    *out_bricks = 0;
    if (!before || desc->kind != NOOK_VOLUME_SURFEL || !read_before(cache_dir, name, desc, before, &volume))
        return nook_voxelize(triangles, desc, out_volume);
    const nook_voxelize_before older = { before->triangles, before->alphas, &volume };
    nook_result result = nook_voxelize_again(triangles, desc, &older, out_volume, out_bricks);
    nook_volume_free(&volume);
    return result;
}

static nook_result encode(const nook_volume *volume, nook_bake *out_bake)
{
    void *bytes;
    size_t size;
    nook_result result = nook_volume_encode(volume, &bytes, &size);
    if (result == NOOK_OK)
        *out_bake = (nook_bake){ .bytes = bytes, .size = size, .info = volume->info };
    return result;
}

static nook_result bake_now(const char *cache_dir, const char *name, const nook_triangles *triangles,
                            const nook_voxelize_desc *desc, const nook_bake_before *before, nook_bake *out_bake)
{
    nook_volume volume;
    size_t bricks;
    nook_result result = voxelize(cache_dir, name, triangles, desc, cache_dir ? before : NULL, &volume, &bricks);
    if (result != NOOK_OK)
        return result;
    result = encode(&volume, out_bake);
    if (result == NOOK_OK)
        out_bake->bricks = bricks;
    nook_volume_free(&volume);
    return result;
}

/* @return 0, or the errno that says why not */
static int write_cached(const char *cache_dir, const char *path, const nook_bake *bake)
{
    int reason = nook_directory_try_make(cache_dir);
    return reason ? reason : nook_file_try_write(path, bake->bytes, bake->size);
}

static nook_result check_arguments(const nook_triangles *triangles)
{
    /* The hash reads what indices and positions promise, before nook_voxelize checks them. */
    bool sound = (triangles->positions || triangles->vertex_count == 0) &&
                 (triangles->indices || triangles->index_count == 0) &&
                 (triangles->stride == 0 || triangles->stride >= 3 * sizeof(float));
    return sound ? NOOK_OK
                 : nook_fail(NOOK_E_ARG, "bake: positions or indices are missing, or stride %u is below 12",
                             triangles->stride);
}

nook_result nook_bake_cached(const char *cache_dir, const char *name, const nook_triangles *triangles,
                             const nook_voxelize_desc *desc, nook_bake *out_bake)
{
    return nook_bake_cached_again(cache_dir, name, triangles, desc, NULL, out_bake);
}

nook_result nook_bake_cached_again(const char *cache_dir, const char *name, const nook_triangles *triangles,
                                   const nook_voxelize_desc *desc, const nook_bake_before *before, nook_bake *out_bake)
{
    nook_result result = check_arguments(triangles);
    if (result != NOOK_OK)
        return result;
    double start = nook_clock_ms();
    uint64_t hash = nook_voxelize_hash(triangles, desc);
    char path[PATH_CAPACITY] = "";
    if (cache_dir)
        nook_bake_path(cache_dir, hash, path, sizeof path);
    nook_bake bake;
    if (!cache_dir || !read_cached(path, name, hash, &bake)) {
        result = bake_now(cache_dir, name, triangles, desc, before, &bake);
        if (result != NOOK_OK)
            return result;
        bake.ms = nook_clock_ms() - start;
        if (cache_dir)
            bake.keep_error = write_cached(cache_dir, path, &bake);
    } else {
        bake.ms = nook_clock_ms() - start;
    }
    *out_bake = bake;
    return NOOK_OK;
}

/* ---- Levels ----------------------------------------------------------------------------------------------------- */

static nook_voxelize_desc level_of(const nook_voxelize_desc *desc, uint32_t level)
{
    nook_voxelize_desc of_level = *desc;
    bool merges = desc->kind == NOOK_VOLUME_SURFEL;
    of_level.level = merges ? level : 0;
    of_level.resolution = merges ? desc->resolution : nook_voxelize_level_resolution(desc->resolution, level);
    return of_level;
}

/* Encodes and keeps what was made since `start`, and frees it. @return what is made in out_bakes also when it fails */
static nook_result keep_levels(const char *cache_dir, uint32_t levels, double start, nook_volume *volumes,
                               nook_bake *out_bakes)
{
    nook_result result = NOOK_OK;
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
        char path[PATH_CAPACITY];
        nook_bake *bake = &out_bakes[level];
        if (!(levels >> level & 1))
            continue;
        if (result == NOOK_OK)
            result = encode(&volumes[level], bake);
        nook_volume_free(&volumes[level]);
        if (result != NOOK_OK)
            continue;
        bake->ms = nook_clock_ms() - start; /* the first one's with the pass */
        if (cache_dir) {
            nook_bake_path(cache_dir, bake->info.content_hash, path, sizeof path);
            bake->keep_error = write_cached(cache_dir, path, bake);
        }
        start = nook_clock_ms();
    }
    return result;
}

/* Makes levels of surfels and keeps them. @return as keep_levels */
static nook_result make_levels(const char *cache_dir, const nook_triangles *triangles, const nook_voxelize_desc *desc,
                               uint32_t levels, nook_bake *out_bakes)
{
    nook_volume volumes[NOOK_VOXELIZE_LEVELS];
    double start = nook_clock_ms();
    nook_result result = nook_voxelize_levels(triangles, desc, levels, volumes);
    return result == NOOK_OK ? keep_levels(cache_dir, levels, start, volumes, out_bakes) : result;
}

/* The same for those levels of which the cache has what they were. @param in_out_levels  those that are made are taken out */
static nook_result make_levels_again(const char *cache_dir, const char *name, const nook_triangles *triangles,
                                     const nook_voxelize_desc *desc, const nook_bake_before *before,
                                     uint32_t *in_out_levels, nook_bake *out_bakes)
{
    nook_volume was[NOOK_VOXELIZE_LEVELS] = { { .bricks = NULL } }, volumes[NOOK_VOXELIZE_LEVELS];
    size_t bricks[NOOK_VOXELIZE_LEVELS];
    double start = nook_clock_ms();
    uint32_t known = 0;
    nook_result result = NOOK_OK;
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
        const nook_voxelize_desc of_level = level_of(desc, level);
        if (*in_out_levels >> level & 1 && read_before(cache_dir, name, &of_level, before, &was[level]))
            known |= 1u << level;
    }
    if (known) {
        const nook_voxelize_before older = { before->triangles, before->alphas, was };
        result = nook_voxelize_levels_again(triangles, desc, known, &older, volumes, bricks);
        if (result == NOOK_OK)
            result = keep_levels(cache_dir, known, start, volumes, out_bakes);
    }
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
        if (result == NOOK_OK && known >> level & 1)
            out_bakes[level].bricks = bricks[level];
        nook_volume_free(&was[level]);
    }
    *in_out_levels &= ~known;
    return result;
}

/* What the cache has of levels of surfels. @return bits of those that it lacks */
static uint32_t read_levels(const char *cache_dir, const char *name, const nook_triangles *triangles,
                            const nook_voxelize_desc *desc, uint32_t levels, nook_bake *out_bakes)
{
    uint32_t missing = levels;
    for (uint32_t level = 0; cache_dir && level < NOOK_VOXELIZE_LEVELS; level++) {
        char path[PATH_CAPACITY];
        double start = nook_clock_ms();
        const nook_voxelize_desc of_level = level_of(desc, level);
        if (!(levels >> level & 1))
            continue;
        uint64_t hash = nook_voxelize_hash(triangles, &of_level);
        nook_bake_path(cache_dir, hash, path, sizeof path);
        if (read_cached(path, name, hash, &out_bakes[level])) {
            out_bakes[level].ms = nook_clock_ms() - start;
            missing &= ~(1u << level);
        }
    }
    return missing;
}

nook_result nook_bake_cached_levels(const char *cache_dir, const char *name, const nook_triangles *triangles,
                                    const nook_voxelize_desc *desc, uint32_t levels, nook_bake *out_bakes)
{
    return nook_bake_cached_levels_again(cache_dir, name, triangles, desc, levels, NULL, out_bakes);
}

nook_result nook_bake_cached_levels_again(const char *cache_dir, const char *name, const nook_triangles *triangles,
                                          const nook_voxelize_desc *desc, uint32_t levels,
                                          const nook_bake_before *before, nook_bake *out_bakes)
{
    nook_bake bakes[NOOK_VOXELIZE_LEVELS] = { { .bytes = NULL } };
    nook_result result = check_arguments(triangles);
    if (result == NOOK_OK && (levels == 0 || levels >> NOOK_VOXELIZE_LEVELS))
        result =
            nook_fail(NOOK_E_RANGE, "bake: levels %#x; there are 0 to %d, as bits", levels, NOOK_VOXELIZE_LEVELS - 1);
    if (result == NOOK_OK && desc->kind == NOOK_VOLUME_SURFEL) {
        uint32_t missing = read_levels(cache_dir, name, triangles, desc, levels, bakes);
        if (missing && before && cache_dir)
            result = make_levels_again(cache_dir, name, triangles, desc, before, &missing, bakes);
        if (result == NOOK_OK && missing)
            result = make_levels(cache_dir, triangles, desc, missing, bakes);
    } else {
        for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS && result == NOOK_OK; level++) {
            const nook_voxelize_desc of_level = level_of(desc, level);
            if (levels >> level & 1)
                result = nook_bake_cached(cache_dir, name, triangles, &of_level, &bakes[level]);
        }
    }
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
        if (result == NOOK_OK && (levels >> level & 1))
            out_bakes[level] = bakes[level];
        else
            nook_bake_free(&bakes[level]);
    }
    return result;
}
