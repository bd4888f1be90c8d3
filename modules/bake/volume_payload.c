#include "modules/bake/volume_payload.h"
#include "engine/core/log.h"
#include "modules/bake/brick_grid.h"
#include "modules/bake/little_endian.h"
#include "modules/bake/surfel_word.h"
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { MASK_BYTES = 8, SURFEL_BYTES = 8 };

static size_t count_voxels(const nook_volume_info *info)
{
    return (size_t)info->width * info->height * info->depth;
}

size_t nook_payload_size(const nook_volume_info *info)
{
    if (info->kind == NOOK_VOLUME_SURFEL)
        return nook_brick_total(info) * MASK_BYTES + (size_t)info->occupied * SURFEL_BYTES;
    return info->kind == NOOK_VOLUME_BINARY ? (count_voxels(info) + 7) / 8 : count_voxels(info);
}

static nook_result wrong_count(const char *name, uint64_t occupied, const nook_volume_info *info)
{
    return nook_fail(NOOK_E_FORMAT, "%s: %llu voxels occupied, its header promises %llu", name,
                     (unsigned long long)occupied, (unsigned long long)info->occupied);
}

/* ---- Binary ----------------------------------------------------------------------------------------------------- */

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

static bool is_empty(const uint8_t *voxels, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (voxels[i])
            return false;
    return true;
}

/* Marching relies on it: the filtered volume must fade out before it ends (shaders/ao/occluders.glsl). */
static bool outermost_layer_is_empty(const nook_volume_info *info, const uint8_t *voxels)
{
    for (uint32_t z = 0; z < info->depth; z++) {
        for (uint32_t y = 0; y < info->height; y++) {
            const uint8_t *row = voxels + ((size_t)z * info->height + y) * info->width;
            bool whole = z == 0 || y == 0 || z == info->depth - 1 || y == info->height - 1;
            if (row[0] || row[info->width - 1] || (whole && !is_empty(row, info->width)))
                return false;
        }
    }
    return true;
}

static nook_result read_voxels(const char *name, const uint8_t *bits, nook_volume *volume)
{
    const nook_volume_info *info = &volume->info;
    size_t voxel_count = count_voxels(info);
    if (voxel_count % 8 != 0 && bits[nook_payload_size(info) - 1] >> (voxel_count % 8) != 0)
        return nook_fail(NOOK_E_FORMAT, "%s: bits are set behind the last voxel", name);
    volume->voxels = malloc(voxel_count);
    if (!volume->voxels)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu voxels", name, voxel_count);
    uint64_t occupied = unpack_bits(bits, voxel_count, volume->voxels);
    if (occupied != info->occupied)
        return wrong_count(name, occupied, info);
    if (!outermost_layer_is_empty(info, volume->voxels))
        return nook_fail(NOOK_E_FORMAT, "%s: voxels are set in its outermost layer; bake it again", name);
    return NOOK_OK;
}

/* @return false when a voxel is neither 0 nor 255, or the count of occupied ones is not what info says */
static bool pack_bits(const nook_volume *volume, uint8_t *out_bits)
{
    uint64_t occupied = 0;
    size_t voxel_count = count_voxels(&volume->info);
    memset(out_bits, 0, nook_payload_size(&volume->info));
    for (size_t i = 0; i < voxel_count; i++) {
        if (volume->voxels[i] != 0 && volume->voxels[i] != 255)
            return false;
        uint8_t bit = volume->voxels[i] & 1;
        out_bits[i / 8] |= (uint8_t)(bit << (i % 8));
        occupied += bit;
    }
    return occupied == volume->info.occupied;
}

/* ---- Densities and distances: a byte a voxel --------------------------------------------------------------------- */

/* Two voxels apart by one along an axis: their distances cannot differ by more than that, and rounding. */
static bool may_be_neighbours(uint8_t a, uint8_t b)
{
    return abs((int)a - (int)b) <= NOOK_DISTANCES_PER_VOXEL + 1;
}

static bool are_distances(const nook_volume_info *info, const uint8_t *voxels)
{
    size_t row = info->width, slice = row * info->height, i = 0;
    for (uint32_t z = 0; z < info->depth; z++)
        for (uint32_t y = 0; y < info->height; y++)
            for (uint32_t x = 0; x < info->width; x++, i++)
                if ((x > 0 && !may_be_neighbours(voxels[i], voxels[i - 1])) ||
                    (y > 0 && !may_be_neighbours(voxels[i], voxels[i - row])) ||
                    (z > 0 && !may_be_neighbours(voxels[i], voxels[i - slice])))
                    return false;
    return true;
}

/* What is wrong with the bytes, or NULL; how many they say are occupied. */
static const char *find_byte_fault(const nook_volume_info *info, const uint8_t *voxels, uint64_t *out_occupied)
{
    bool distances = info->kind == NOOK_VOLUME_DISTANCE;
    size_t count = count_voxels(info);
    *out_occupied = 0;
    for (size_t i = 0; i < count; i++)
        *out_occupied += distances ? voxels[i] < NOOK_DISTANCE_OCCUPIED : voxels[i] > 0;
    if (distances)
        return are_distances(info, voxels) ? NULL : "neighbours that no distances are";
    return outermost_layer_is_empty(info, voxels) ? NULL : "voxels that are set in its outermost layer";
}

static nook_result read_bytes(const char *name, const uint8_t *raw, nook_volume *volume)
{
    size_t count = count_voxels(&volume->info);
    uint64_t occupied;
    const char *fault = find_byte_fault(&volume->info, raw, &occupied);
    if (occupied != volume->info.occupied)
        return wrong_count(name, occupied, &volume->info);
    if (fault)
        return nook_fail(NOOK_E_FORMAT, "%s: %s; bake it again", name, fault);
    volume->voxels = malloc(count);
    if (!volume->voxels)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu voxels", name, count);
    memcpy(volume->voxels, raw, count);
    return NOOK_OK;
}

static bool write_bytes(const nook_volume *volume, uint8_t *out)
{
    uint64_t occupied;
    if (find_byte_fault(&volume->info, volume->voxels, &occupied) || occupied != volume->info.occupied)
        return false;
    memcpy(out, volume->voxels, count_voxels(&volume->info));
    return true;
}

/* ---- Surfels ---------------------------------------------------------------------------------------------------- */

/* The voxels of the brick that begins at `first` which the volume has. */
static void bits_inside(const uint32_t first[3], const nook_volume_info *info, uint32_t out_mask[2])
{
    const uint32_t size[3] = { info->width, info->height, info->depth };
    out_mask[0] = out_mask[1] = 0;
    for (uint32_t i = 0; i < NOOK_BRICK_SIDE * NOOK_BRICK_SIDE * NOOK_BRICK_SIDE; i++) {
        uint32_t x = i % 4, y = i / 4 % 4, z = i / 16, bit = nook_brick_bit(x, y, z);
        if (first[0] + x < size[0] && first[1] + y < size[1] && first[2] + z < size[2])
            out_mask[bit >> 5] |= 1u << (bit & 31);
    }
}

/* Only the last bricks along an axis can stand out. */
static bool masks_are_inside(const nook_volume *volume)
{
    uint32_t counts[3];
    nook_brick_counts(&volume->info, counts);
    for (uint32_t z = 0; z < counts[2]; z++) {
        for (uint32_t y = 0; y < counts[1]; y++) {
            bool whole = z + 1 == counts[2] || y + 1 == counts[1];
            for (uint32_t x = whole ? 0 : counts[0] - 1; x < counts[0]; x++) {
                const nook_brick *brick = &volume->bricks[((size_t)z * counts[1] + y) * counts[0] + x];
                const uint32_t first[3] = { x * NOOK_BRICK_SIDE, y * NOOK_BRICK_SIDE, z * NOOK_BRICK_SIDE };
                uint32_t inside[2];
                bits_inside(first, &volume->info, inside);
                if (brick->mask[0] & ~inside[0] || brick->mask[1] & ~inside[1])
                    return false;
            }
        }
    }
    return true;
}

static bool surfels_are_sound(const nook_volume *volume)
{
    for (uint64_t i = 0; i < volume->info.occupied; i++)
        if (!nook_surfel_is_sound(volume->surfels[i].plane[0], volume->surfels[i].plane[1]))
            return false;
    return true;
}

/* Indices and distances follow from the masks, so that a file cannot have wrong ones. */
static nook_result read_surfels(const char *name, const uint8_t *raw, nook_volume *volume)
{
    const nook_volume_info *info = &volume->info;
    size_t brick_count = nook_brick_total(info), surfel_count = (size_t)info->occupied;
    uint32_t counts[3];
    nook_brick_counts(info, counts);
    volume->bricks = malloc(brick_count * sizeof *volume->bricks);
    volume->surfels = malloc((surfel_count + 1) * sizeof *volume->surfels);
    if (!volume->bricks || !volume->surfels)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu bricks and %zu surfels", name, brick_count,
                         surfel_count);
    for (size_t i = 0; i < brick_count; i++)
        for (size_t k = 0; k < 2; k++)
            volume->bricks[i].mask[k] = get_u32(raw + i * MASK_BYTES + 4 * k);
    raw += brick_count * MASK_BYTES;
    for (size_t i = 0; i < surfel_count; i++)
        for (size_t k = 0; k < 2; k++)
            volume->surfels[i].plane[k] = get_u32(raw + i * SURFEL_BYTES + 4 * k);
    uint64_t occupied = nook_bricks_number(volume->bricks, counts);
    if (occupied != info->occupied)
        return wrong_count(name, occupied, info);
    if (!masks_are_inside(volume))
        return nook_fail(NOOK_E_FORMAT, "%s: voxels are set outside of its sides", name);
    if (!surfels_are_sound(volume))
        return nook_fail(NOOK_E_FORMAT, "%s: a surfel holds what no plane is; bake it again", name);
    return NOOK_OK;
}

static bool write_surfels(const nook_volume *volume, uint8_t *out)
{
    size_t brick_count = nook_brick_total(&volume->info);
    uint64_t set = 0;
    for (size_t i = 0; i < brick_count; i++, out += MASK_BYTES) {
        for (size_t k = 0; k < 2; k++) {
            put_u32(out + 4 * k, volume->bricks[i].mask[k]);
            for (uint32_t mask = volume->bricks[i].mask[k]; mask; mask &= mask - 1)
                set++;
        }
    }
    if (set != volume->info.occupied || !masks_are_inside(volume) || !surfels_are_sound(volume))
        return false;
    for (uint64_t i = 0; i < volume->info.occupied; i++, out += SURFEL_BYTES)
        for (size_t k = 0; k < 2; k++)
            put_u32(out + 4 * k, volume->surfels[i].plane[k]);
    return true;
}

/* ---- Any of them ------------------------------------------------------------------------------------------------- */

nook_result nook_payload_write(const nook_volume *volume, uint8_t *out)
{
    switch (volume->info.kind) {
    case NOOK_VOLUME_BINARY:
        return pack_bits(volume, out) ? NOOK_OK
                                      : nook_fail(NOOK_E_ARG, "volume: voxels other than 0 and 255, or not as many "
                                                              "occupied as it says");
    case NOOK_VOLUME_SURFEL:
        return write_surfels(volume, out)
                   ? NOOK_OK
                   : nook_fail(NOOK_E_ARG, "volume: surfels that are no planes, outside, or not as many as it says");
    case NOOK_VOLUME_DENSITY:
    case NOOK_VOLUME_DISTANCE:
        break;
    }
    return write_bytes(volume, out) ? NOOK_OK
                                    : nook_fail(NOOK_E_ARG,
                                                "volume: %s: voxels that no file may hold, or not as many "
                                                "occupied as it says",
                                                nook_volume_kind_name(volume->info.kind));
}

static nook_result read_kind(const char *name, const uint8_t *raw, nook_volume *volume)
{
    switch (volume->info.kind) {
    case NOOK_VOLUME_BINARY:
        return read_voxels(name, raw, volume);
    case NOOK_VOLUME_SURFEL:
        return read_surfels(name, raw, volume);
    case NOOK_VOLUME_DENSITY:
    case NOOK_VOLUME_DISTANCE:
        break;
    }
    return read_bytes(name, raw, volume);
}

nook_result nook_payload_read(const char *name, const uint8_t *raw, nook_volume *volume)
{
    nook_result result = read_kind(name, raw, volume);
    if (result != NOOK_OK) {
        nook_volume_info info = volume->info;
        nook_volume_free(volume);
        volume->info = info;
    }
    return result;
}
