#include "modules/bake/volume_file.h"
#include "engine/core/log.h"
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

/* ---- Little-endian numbers -------------------------------------------------------------------------------------- */

static void put_u32(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> (8 * i));
}

static void put_u64(uint8_t *at, uint64_t value)
{
    put_u32(at, (uint32_t)value);
    put_u32(at + 4, (uint32_t)(value >> 32));
}

static void put_f64(uint8_t *at, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_u64(at, bits);
}

static uint32_t get_u32(const uint8_t *at)
{
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static uint64_t get_u64(const uint8_t *at)
{
    return get_u32(at) | (uint64_t)get_u32(at + 4) << 32;
}

static double get_f64(const uint8_t *at)
{
    uint64_t bits = get_u64(at);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* ---- Checks shared by both directions --------------------------------------------------------------------------- */

static bool side_ok(uint32_t side)
{
    return side >= 1 && side <= NOOK_VOLUME_SIDE_MAX;
}

/* What is wrong with `info`, or NULL. After it, voxel counts are below 2^28. */
static const char *find_fault(const nook_volume_info *info)
{
    if (info->kind != NOOK_VOLUME_BINARY)
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

static size_t count_voxels(const nook_volume_info *info)
{
    return (size_t)info->width * info->height * info->depth;
}

static size_t raw_size_of(const nook_volume_info *info)
{
    return (count_voxels(info) + 7) / 8;
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
    nook_volume_info info = { .width = get_u32(file + AT_WIDTH),
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
    if (get_u32(file + AT_KIND) != NOOK_VOLUME_BINARY)
        return nook_fail(NOOK_E_FORMAT, "%s: kind %u, this build reads 0 (binary)", name, get_u32(file + AT_KIND));
    nook_volume_info info = get_info(file);
    const char *fault = find_fault(&info);
    if (fault)
        return nook_fail(NOOK_E_FORMAT, "%s: %s", name, fault);
    if (get_u64(file + AT_RAW_SIZE) != raw_size_of(&info))
        return nook_fail(NOOK_E_FORMAT, "%s: %llu bytes of voxels, its sides need %zu", name,
                         (unsigned long long)get_u64(file + AT_RAW_SIZE), raw_size_of(&info));
    *out_info = info;
    return NOOK_OK;
}

/* One bit per voxel to one byte per voxel. @return how many are set */
static uint64_t unpack_bits(const uint8_t *bits, size_t voxel_count, uint8_t *out_voxels)
{
    uint64_t occupied = 0;
    for (size_t i = 0; i < voxel_count; i++) {
        uint8_t bit = bits[i / 8] >> (i % 8) & 1;
        out_voxels[i] = bit ? 255 : 0;
        occupied += bit;
    }
    return occupied;
}

/* Marching relies on it: the filtered volume must fade out before it ends (shaders/ao/occluders.glsl). */
static bool outermost_layer_is_empty(const nook_volume_info *info, const uint8_t *voxels)
{
    for (uint32_t z = 0; z < info->depth; z++) {
        for (uint32_t y = 0; y < info->height; y++) {
            const uint8_t *row = voxels + ((size_t)z * info->height + y) * info->width;
            bool whole = z == 0 || y == 0 || z == info->depth - 1 || y == info->height - 1;
            if (row[0] || row[info->width - 1] || (whole && memchr(row, 255, info->width)))
                return false;
        }
    }
    return true;
}

static nook_result decode_voxels(const char *name, const uint8_t *file, size_t size, const nook_volume_info *info,
                                 uint8_t *bits, uint8_t *voxels)
{
    size_t raw_size = raw_size_of(info), voxel_count = count_voxels(info);
    size_t got = ZSTD_decompress(bits, raw_size, file + HEADER_SIZE, size - HEADER_SIZE);
    if (ZSTD_isError(got) || got != raw_size)
        return nook_fail(NOOK_E_FORMAT, "%s: its voxels do not decompress: %s", name,
                         ZSTD_isError(got) ? ZSTD_getErrorName(got) : "too few");
    if (voxel_count % 8 != 0 && bits[raw_size - 1] >> (voxel_count % 8) != 0)
        return nook_fail(NOOK_E_FORMAT, "%s: bits are set behind the last voxel", name);
    uint64_t occupied = unpack_bits(bits, voxel_count, voxels);
    if (occupied != info->occupied)
        return nook_fail(NOOK_E_FORMAT, "%s: %llu voxels occupied, its header promises %llu", name,
                         (unsigned long long)occupied, (unsigned long long)info->occupied);
    if (!outermost_layer_is_empty(info, voxels))
        return nook_fail(NOOK_E_FORMAT, "%s: voxels are set in its outermost layer; bake it again", name);
    return NOOK_OK;
}

nook_result nook_volume_decode(const char *name, const void *bytes, size_t size, nook_volume *out_volume)
{
    nook_volume_info info;
    nook_result result = nook_volume_decode_info(name, bytes, size, &info);
    if (result != NOOK_OK)
        return result;
    uint8_t *bits = malloc(raw_size_of(&info)), *voxels = malloc(count_voxels(&info));
    if (bits && voxels)
        result = decode_voxels(name, bytes, size, &info, bits, voxels);
    else
        result = nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu voxels", name, count_voxels(&info));
    free(bits);
    if (result != NOOK_OK) {
        free(voxels);
        return result;
    }
    *out_volume = (nook_volume){ info, voxels };
    return NOOK_OK;
}

void nook_volume_free(nook_volume *volume)
{
    if (!volume)
        return;
    free(volume->voxels);
    *volume = (nook_volume){ 0 };
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
    put_u64(file + AT_RAW_SIZE, raw_size_of(info));
    put_u64(file + AT_COMPRESSED_SIZE, compressed_size);
    put_u64(file + AT_CHECKSUM, checksum_of(file, HEADER_SIZE + compressed_size));
}

/* @return false when a voxel is neither 0 nor 255, or the count of occupied ones is not what info says */
static bool pack_bits(const nook_volume *volume, uint8_t *out_bits)
{
    uint64_t occupied = 0;
    size_t voxel_count = count_voxels(&volume->info);
    memset(out_bits, 0, raw_size_of(&volume->info));
    for (size_t i = 0; i < voxel_count; i++) {
        if (volume->voxels[i] != 0 && volume->voxels[i] != 255)
            return false;
        uint8_t bit = volume->voxels[i] & 1;
        out_bits[i / 8] |= (uint8_t)(bit << (i % 8));
        occupied += bit;
    }
    return occupied == volume->info.occupied;
}

static nook_result encode_bits(const nook_volume *volume, uint8_t *bits, void **out_bytes, size_t *out_size)
{
    if (!pack_bits(volume, bits))
        return nook_fail(NOOK_E_ARG, "volume: voxels other than 0 and 255, or not as many occupied as it says");
    size_t raw_size = raw_size_of(&volume->info), capacity = ZSTD_compressBound(raw_size);
    uint8_t *file = malloc(HEADER_SIZE + capacity);
    if (!file)
        return nook_fail(NOOK_E_MEMORY, "volume: no memory to compress %zu bytes", raw_size);
    size_t compressed = ZSTD_compress(file + HEADER_SIZE, capacity, bits, raw_size, compression_level);
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
    uint8_t *bits = malloc(raw_size_of(&volume->info));
    if (!bits)
        return nook_fail(NOOK_E_MEMORY, "volume: no memory for %zu bytes", raw_size_of(&volume->info));
    nook_result result = encode_bits(volume, bits, out_bytes, out_size);
    free(bits);
    return result;
}
