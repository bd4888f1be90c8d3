#include "modules/bake/surfel_bins.h"
#include "engine/core/vector.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    CELLS = 4, /* directions on a face of the cube, along each side */
    DEPTHS = 8,
    BIN_BITS = 9,
    SUMS = 13,
    TABLE_FIRST = 1 << 12,
};
_Static_assert(3 * CELLS * CELLS * DEPTHS == NOOK_SURFEL_BINS_PER_VOXEL && NOOK_SURFEL_BINS_PER_VOXEL < 1 << BIN_BITS,
               "a key holds the bin");
static const double depth_lowest = -1.0, depth_step = 0.25; /* voxels; all depths are within half a diagonal, 0.87 */
/* Of one voxel area. Sums hold 2^27 of them: more than 77 million triangles, each as large as fits into a voxel. */
static const double unit = 68719476736.0; /* 2^36 */

typedef struct entry {
    uint32_t key;
    int64_t sum[SUMS]; /* area, normal, first, second */
} entry;

struct nook_surfel_bins {
    entry *entries;
    uint32_t count, capacity, most;
    uint32_t *table;     /* index + 1 into entries; 0: free */
    uint32_t table_size; /* a power of two, at least twice the entries */
    uint64_t *order;     /* key << 32 | index, sorted */
    uint32_t order_capacity;
};

nook_surfel_bins *nook_surfel_bins_create(uint32_t most)
{
    nook_surfel_bins *bins = calloc(1, sizeof *bins);
    if (!bins)
        return NULL;
    bins->table = calloc(TABLE_FIRST, sizeof *bins->table);
    bins->table_size = TABLE_FIRST;
    bins->most = most;
    if (!bins->table) {
        free(bins);
        return NULL;
    }
    return bins;
}

void nook_surfel_bins_destroy(nook_surfel_bins *bins)
{
    if (!bins)
        return;
    free(bins->entries);
    free(bins->table);
    free(bins->order);
    free(bins);
}

void nook_surfel_bins_limit(nook_surfel_bins *bins, uint32_t most)
{
    bins->most = most > bins->count ? most : bins->count;
}

void nook_surfel_bins_clear(nook_surfel_bins *bins)
{
    memset(bins->table, 0, bins->table_size * sizeof *bins->table);
    bins->count = 0;
}

/* ---- Finding a bin ---------------------------------------------------------------------------------------------- */

static uint32_t slot_of(const nook_surfel_bins *bins, uint32_t key)
{
    uint32_t slot = key * 2654435761u;
    slot ^= slot >> 15;
    return slot & (bins->table_size - 1);
}

static uint32_t *find(nook_surfel_bins *bins, uint32_t key)
{
    uint32_t slot = slot_of(bins, key);
    while (bins->table[slot] && bins->entries[bins->table[slot] - 1].key != key)
        slot = (slot + 1) & (bins->table_size - 1);
    return &bins->table[slot];
}

static int grow_table(nook_surfel_bins *bins)
{
    uint32_t *table = calloc((size_t)bins->table_size * 2, sizeof *table);
    if (!table)
        return 0;
    free(bins->table);
    bins->table = table;
    bins->table_size *= 2;
    for (uint32_t i = 0; i < bins->count; i++)
        *find(bins, bins->entries[i].key) = i + 1;
    return 1;
}

static int grow_entries(nook_surfel_bins *bins)
{
    uint32_t capacity = bins->capacity ? bins->capacity + bins->capacity / 2 : 1024;
    capacity = capacity < bins->most ? capacity : bins->most;
    entry *entries = realloc(bins->entries, capacity * sizeof *entries);
    if (!entries)
        return 0;
    bins->entries = entries;
    bins->capacity = capacity;
    return 1;
}

/* @return as nook_surfel_bins_add */
static nook_result find_entry(nook_surfel_bins *bins, uint32_t key, entry **out)
{
    uint32_t *place = find(bins, key);
    if (*place) {
        *out = &bins->entries[*place - 1];
        return NOOK_OK;
    }
    if (bins->count == bins->most)
        return NOOK_E_RANGE;
    if (bins->count == bins->capacity && !grow_entries(bins))
        return NOOK_E_MEMORY;
    if (bins->count >= bins->table_size / 2) {
        if (!grow_table(bins))
            return NOOK_E_MEMORY;
        place = find(bins, key);
    }
    *place = bins->count + 1;
    entry *added = &bins->entries[bins->count++];
    *added = (entry){ .key = key };
    *out = added;
    return NOOK_OK;
}

/* ---- Adding ----------------------------------------------------------------------------------------------------- */

static int largest_axis(const double v[3])
{
    int axis = fabs(v[1]) > fabs(v[0]) ? 1 : 0;
    return fabs(v[2]) > fabs(v[axis]) ? 2 : axis;
}

static uint32_t clamp(double value, uint32_t highest)
{
    return value > 0.0 ? (value < highest ? (uint32_t)value : highest) : 0u;
}

/* Cells of a cube's three faces: a plane's normal and its opposite are one direction. `normal[face]` is above 0. */
static uint32_t direction_of(const double normal[3], int face)
{
    double u = normal[(face + 1) % 3] / normal[face], v = normal[(face + 2) % 3] / normal[face];
    uint32_t column = clamp((u + 1.0) * 0.5 * CELLS, CELLS - 1), row = clamp((v + 1.0) * 0.5 * CELLS, CELLS - 1);
    return ((uint32_t)face * CELLS + row) * CELLS + column;
}

/* The entry of a bin by direction and depth. @return as nook_surfel_bins_add */
static nook_result find_bin(nook_surfel_bins *bins, uint32_t voxel, uint32_t direction, double depth, entry **out)
{
    uint32_t bin = direction * DEPTHS + clamp((depth - depth_lowest) / depth_step, DEPTHS - 1);
    return find_entry(bins, voxel << BIN_BITS | bin, out);
}

/* llround, without the call: the fraction is exact. */
static int64_t to_units(double value)
{
    double scaled = value * unit;
    int64_t whole = (int64_t)scaled;
    double rest = scaled - (double)whole;
    return whole + (rest >= 0.5) - (rest <= -0.5);
}

nook_result nook_surfel_bins_add(nook_surfel_bins *bins, uint32_t voxel, const double normal[3],
                                 const nook_polygon_moments *moments)
{
    int64_t area = to_units(moments->area);
    if (area <= 0)
        return NOOK_OK;
    int face = largest_axis(normal);
    double sign = normal[face] < 0.0 ? -1.0 : 1.0;
    const double upright[3] = { sign * normal[0], sign * normal[1], sign * normal[2] };
    double depth = nook_vector_dot(upright, moments->first) / moments->area;
    entry *e;
    nook_result result = find_bin(bins, voxel, direction_of(upright, face), depth, &e);
    if (result != NOOK_OK)
        return result;
    e->sum[0] += area;
    for (int i = 0; i < 3; i++) {
        e->sum[1 + i] += to_units(upright[i] * moments->area);
        e->sum[4 + i] += to_units(moments->first[i]);
    }
    for (int i = 0; i < 6; i++)
        e->sum[7 + i] += to_units(moments->second[i]);
    return NOOK_OK;
}

/*
 * With s = +-1 for the half that the small voxel is in, a point x of it is (x + s / 2) / 2 in the large one. Divided from the right, so that
 * nothing is larger than a sum; what is cut off is less than two units.
 */
static void move_sums(const int64_t from[SUMS], const int side[3], int64_t to[SUMS])
{
    static const int pair[6][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 1, 2 }, { 2, 0 } };
    to[0] = from[0] / 4;
    for (int i = 0; i < 3; i++) {
        to[1 + i] = from[1 + i] / 4;
        to[4 + i] = (from[4 + i] + side[i] * (from[0] / 2)) / 8;
    }
    for (int i = 0; i < 6; i++) {
        int x = pair[i][0], y = pair[i][1];
        to[7 + i] =
            (from[7 + i] + (side[x] * from[4 + y] + side[y] * from[4 + x]) / 2 + side[x] * side[y] * (from[0] / 4)) /
            16;
    }
}

nook_result nook_surfel_bins_merge(const nook_surfel_bins *from, size_t index, const int side[3], nook_surfel_bins *to,
                                   uint32_t voxel)
{
    const uint32_t bin = (uint32_t)(from->order[index] >> 32) & ((1u << BIN_BITS) - 1);
    int64_t sum[SUMS];
    move_sums(from->entries[(uint32_t)from->order[index]].sum, side, sum);
    const double normal[3] = { (double)sum[1], (double)sum[2], (double)sum[3] };
    const double first[3] = { (double)sum[4], (double)sum[5], (double)sum[6] };
    double upright[3];
    entry *e;
    if (sum[0] <= 0 || !nook_vector_normalize(normal, upright))
        return NOOK_OK;
    nook_result result = find_bin(to, voxel, bin / DEPTHS, nook_vector_dot(upright, first) / (double)sum[0], &e);
    for (int i = 0; i < SUMS && result == NOOK_OK; i++)
        e->sum[i] += sum[i];
    return result;
}

/* ---- Reading ---------------------------------------------------------------------------------------------------- */

static int compare_u64(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

size_t nook_surfel_bins_sort(nook_surfel_bins *bins)
{
    if (bins->count > bins->order_capacity) {
        uint64_t *order = realloc(bins->order, bins->count * sizeof *order);
        if (!order)
            return SIZE_MAX;
        bins->order = order;
        bins->order_capacity = bins->count;
    }
    for (uint32_t i = 0; i < bins->count; i++)
        bins->order[i] = (uint64_t)bins->entries[i].key << 32 | i;
    if (bins->count)
        qsort(bins->order, bins->count, sizeof *bins->order, compare_u64);
    return bins->count;
}

uint32_t nook_surfel_bins_voxel(const nook_surfel_bins *bins, size_t index)
{
    return (uint32_t)(bins->order[index] >> (32 + BIN_BITS));
}

nook_surfel_bin nook_surfel_bins_get(const nook_surfel_bins *bins, size_t index)
{
    const int64_t *sum = bins->entries[(uint32_t)bins->order[index]].sum;
    nook_surfel_bin bin = { .area = (double)sum[0] / unit };
    for (int i = 0; i < 3; i++) {
        bin.normal[i] = (double)sum[1 + i] / unit;
        bin.first[i] = (double)sum[4 + i] / unit;
    }
    for (int i = 0; i < 6; i++)
        bin.second[i] = (double)sum[7 + i] / unit;
    return bin;
}
