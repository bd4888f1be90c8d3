#include "modules/bake/volume_file.h"
#include "engine/core/log.h"
#include "modules/bake/little_endian.h"
#include "modules/bake/volume_payload.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>
#include <zstd.h>

/* Where things stand in the file: docs/volume_format.md. */
enum {
    AT_VERSION = 4,
    AT_KIND = 8,
    AT_WIDTH = 12,
    AT_HEIGHT = 16,
    AT_DEPTH = 20,
    AT_VOXEL_SIZE = 24,
    AT_ORIGIN = 32,
    AT_CONTENT_HASH = 56,
    AT_OCCUPIED = 64,
    AT_RAW_SIZE = 72,
    AT_COMPRESSED_SIZE = 80,
    AT_CHECKSUM = 88,
    HEADER_SIZE = 96,
};
static const uint8_t magic[4] = { 'N', 'K', 'V', 0x1A };
static const int compression_level = 9; /* 4 ms for 3.7 million voxels; 19 takes 60 for a sixth less */

/* ---- Checks shared by both directions --------------------------------------------------------------------------- */

static bool side_ok(uint32_t side)
{
    return side >= 1 && side <= NOOK_VOLUME_SIDE_MAX;
}

/* What is wrong with `info`, or NULL. After it, voxel counts are below 2^28. */
static const char *find_fault(const nook_volume_info *info)
{
    if (!nook_volume_kind_name(info->kind))
        return "of a kind that this build does not know";
    if (!side_ok(info->width) || !side_ok(info->height) || !side_ok(info->depth))
        return "a side is outside 1 to 514 voxels";
    if (!isfinite(info->voxel_size) || !(info->voxel_size > 0.0))
        return "the voxel size is not a positive number";
    if (!isfinite(info->origin[0]) || !isfinite(info->origin[1]) || !isfinite(info->origin[2]))
        return "the origin is not finite";
    if (info->occupied > (uint64_t)info->width * info->height * info->depth)
        return "more voxels occupied than there are";
    return NULL;
}

static uint64_t checksum_of(const uint8_t *file, size_t size)
{
    uint8_t head[HEADER_SIZE];
    memcpy(head, file, AT_CHECKSUM);
    put_u64(head + AT_CHECKSUM, XXH64(file + HEADER_SIZE, size - HEADER_SIZE, 0));
    return XXH64(head, sizeof head, 0);
}

/* ---- Decoding --------------------------------------------------------------------------------------------------- */

static nook_volume_info get_info(const uint8_t *file)
{
    nook_volume_info info = { .kind = (nook_volume_kind)get_u32(file + AT_KIND),
                              .width = get_u32(file + AT_WIDTH),
                              .height = get_u32(file + AT_HEIGHT),
                              .depth = get_u32(file + AT_DEPTH),
                              .voxel_size = get_f64(file + AT_VOXEL_SIZE),
                              .content_hash = get_u64(file + AT_CONTENT_HASH),
                              .occupied = get_u64(file + AT_OCCUPIED) };
    for (int axis = 0; axis < 3; axis++)
        info.origin[axis] = get_f64(file + AT_ORIGIN + 8 * axis);
    return info;
}

nook_result nook_volume_decode_info(const char *name, const void *bytes, size_t size, nook_volume_info *out_info)
{
    const uint8_t *file = bytes;
    if (size < HEADER_SIZE)
        return nook_fail(NOOK_E_FORMAT, "%s: %zu bytes, shorter than a volume's header of %d", name, size, HEADER_SIZE);
    if (memcmp(file, magic, sizeof magic) != 0)
        return nook_fail(NOOK_E_FORMAT, "%s: not a volume file", name);
    uint32_t version = get_u32(file + AT_VERSION);
    if (version != NOOK_VOLUME_VERSION)
        return nook_fail(NOOK_E_VERSION, "%s: version %u, this build reads %u; bake it again", name, version,
                         NOOK_VOLUME_VERSION);
    if (get_u64(file + AT_COMPRESSED_SIZE) != size - HEADER_SIZE)
        return nook_fail(NOOK_E_FORMAT, "%s: %zu bytes, its header promises %llu more than its own %d", name, size,
                         (unsigned long long)get_u64(file + AT_COMPRESSED_SIZE), HEADER_SIZE);
    if (get_u64(file + AT_CHECKSUM) != checksum_of(file, size))
        return nook_fail(NOOK_E_FORMAT, "%s: damaged: its checksum is wrong; bake it again", name);

    /* A checksum tells damage, not malice: everything is still checked. */
    if (get_u32(file + AT_KIND) >= NOOK_VOLUME_KINDS)
        return nook_fail(NOOK_E_FORMAT, "%s: kind %u, this build reads " NOOK_VOLUME_KINDS_TEXT, name,
                         get_u32(file + AT_KIND));
    nook_volume_info info = get_info(file);
    const char *fault = find_fault(&info);
    if (fault)
        return nook_fail(NOOK_E_FORMAT, "%s: %s", name, fault);
    if (get_u64(file + AT_RAW_SIZE) != nook_payload_size(&info))
        return nook_fail(NOOK_E_FORMAT, "%s: %llu bytes of voxels, its sides need %zu", name,
                         (unsigned long long)get_u64(file + AT_RAW_SIZE), nook_payload_size(&info));
    *out_info = info;
    return NOOK_OK;
}

static nook_result decode_payload(const char *name, const uint8_t *file, size_t size, uint8_t *raw, nook_volume *volume)
{
    size_t raw_size = nook_payload_size(&volume->info);
    size_t got = ZSTD_decompress(raw, raw_size, file + HEADER_SIZE, size - HEADER_SIZE);
    if (ZSTD_isError(got) || got != raw_size)
        return nook_fail(NOOK_E_FORMAT, "%s: its voxels do not decompress: %s", name,
                         ZSTD_isError(got) ? ZSTD_getErrorName(got) : "too few");
    return nook_payload_read(name, raw, volume);
}

nook_result nook_volume_decode(const char *name, const void *bytes, size_t size, nook_volume *out_volume)
{
    nook_volume volume = { 0 };
    nook_result result = nook_volume_decode_info(name, bytes, size, &volume.info);
    if (result != NOOK_OK)
        return result;
    uint8_t *raw = malloc(nook_payload_size(&volume.info));
    if (raw)
        result = decode_payload(name, bytes, size, raw, &volume);
    else
        result = nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu bytes", name, nook_payload_size(&volume.info));
    free(raw);
    if (result == NOOK_OK)
        *out_volume = volume;
    return result;
}

void nook_volume_free(nook_volume *volume)
{
    if (!volume)
        return;
    free(volume->voxels);
    free(volume->bricks);
    free(volume->surfels);
    *volume = (nook_volume){ 0 };
}

const char *nook_volume_kind_name(nook_volume_kind kind)
{
    switch (kind) {
    case NOOK_VOLUME_BINARY:
        return "binary";
    case NOOK_VOLUME_DENSITY:
        return "density";
    case NOOK_VOLUME_SURFEL:
        return "surfel";
    case NOOK_VOLUME_DISTANCE:
        return "distance";
    }
    return NULL;
}

/* ---- Encoding --------------------------------------------------------------------------------------------------- */

static void put_header(uint8_t *file, const nook_volume_info *info, size_t compressed_size)
{
    memcpy(file, magic, sizeof magic);
    put_u32(file + AT_VERSION, NOOK_VOLUME_VERSION);
    put_u32(file + AT_KIND, (uint32_t)info->kind);
    put_u32(file + AT_WIDTH, info->width);
    put_u32(file + AT_HEIGHT, info->height);
    put_u32(file + AT_DEPTH, info->depth);
    put_f64(file + AT_VOXEL_SIZE, info->voxel_size);
    for (int axis = 0; axis < 3; axis++)
        put_f64(file + AT_ORIGIN + 8 * axis, info->origin[axis]);
    put_u64(file + AT_CONTENT_HASH, info->content_hash);
    put_u64(file + AT_OCCUPIED, info->occupied);
    put_u64(file + AT_RAW_SIZE, nook_payload_size(info));
    put_u64(file + AT_COMPRESSED_SIZE, compressed_size);
    put_u64(file + AT_CHECKSUM, checksum_of(file, HEADER_SIZE + compressed_size));
}

static nook_result encode_payload(const nook_volume *volume, uint8_t *raw, void **out_bytes, size_t *out_size)
{
    nook_result result = nook_payload_write(volume, raw);
    if (result != NOOK_OK)
        return result;
    size_t raw_size = nook_payload_size(&volume->info), capacity = ZSTD_compressBound(raw_size);
    uint8_t *file = malloc(HEADER_SIZE + capacity);
    if (!file)
        return nook_fail(NOOK_E_MEMORY, "volume: no memory to compress %zu bytes", raw_size);
    size_t compressed = ZSTD_compress(file + HEADER_SIZE, capacity, raw, raw_size, compression_level);
    if (ZSTD_isError(compressed)) {
        free(file);
        return nook_fail(NOOK_E_MEMORY, "volume: cannot compress: %s", ZSTD_getErrorName(compressed));
    }
    put_header(file, &volume->info, compressed);
    *out_bytes = file;
    *out_size = HEADER_SIZE + compressed;
    return NOOK_OK;
}

nook_result nook_volume_encode(const nook_volume *volume, void **out_bytes, size_t *out_size)
{
    const char *fault = find_fault(&volume->info);
    if (fault)
        return nook_fail(NOOK_E_ARG, "volume: %s", fault);
    uint8_t *raw = malloc(nook_payload_size(&volume->info));
    if (!raw)
        return nook_fail(NOOK_E_MEMORY, "volume: no memory for %zu bytes", nook_payload_size(&volume->info));
    nook_result result = encode_payload(volume, raw, out_bytes, out_size);
    free(raw);
    return result;
}
