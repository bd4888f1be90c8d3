#include "modules/bake/brick_grid.h"
#include <stdbool.h>

void nook_brick_counts(const nook_volume_info *info, uint32_t out_counts[3])
{
    const uint32_t size[3] = { info->width, info->height, info->depth };
    for (int axis = 0; axis < 3; axis++)
        out_counts[axis] = (size[axis] + NOOK_BRICK_SIDE - 1) / NOOK_BRICK_SIDE;
}

size_t nook_brick_total(const nook_volume_info *info)
{
    uint32_t counts[3];
    nook_brick_counts(info, counts);
    return (size_t)counts[0] * counts[1] * counts[2];
}

uint32_t nook_brick_bit(uint32_t x, uint32_t y, uint32_t z)
{
    return (x & 1) | (y & 1) << 1 | (z & 1) << 2 | (x & 2) << 2 | (y & 2) << 3 | (z & 2) << 4;
}

static uint32_t count_bits(uint32_t word)
{
    word -= word >> 1 & 0x55555555u;
    word = (word & 0x33333333u) + (word >> 2 & 0x33333333u);
    return ((word + (word >> 4)) & 0x0f0f0f0fu) * 0x01010101u >> 24;
}

uint32_t nook_brick_count(const nook_brick *brick)
{
    return count_bits(brick->mask[0]) + count_bits(brick->mask[1]);
}

uint32_t nook_brick_count_below(const nook_brick *brick, uint32_t bit)
{
    uint32_t below = count_bits(brick->mask[bit >> 5] & ((1u << (bit & 31)) - 1));
    return bit < 32 ? below : below + count_bits(brick->mask[0]);
}

enum { NEIGHBOURS = 13 }; /* the half of 26 that comes before the middle */

/* One more than the least of the neighbours of a brick, but no more than it has. @param offset  to them */
static uint32_t least_of(const nook_brick *brick, const ptrdiff_t *offset, int count)
{
    uint32_t least = brick->skip;
    for (int i = 0; i < count; i++)
        least = brick[offset[i]].skip + 1 < least ? brick[offset[i]].skip + 1 : least;
    return least;
}

/* Those of the neighbours before a brick (way 1) or behind it (way -1) that are in the grid. @return how many */
static int find_neighbours(const uint32_t counts[3], const uint32_t at[3], int way, ptrdiff_t *out)
{
    int found = 0;
    for (int neighbour = 0; neighbour < NEIGHBOURS; neighbour++) {
        const int step[3] = { neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1 };
        ptrdiff_t offset = 0;
        bool inside = true;
        for (int axis = 2; axis >= 0; axis--) {
            int64_t place = (int64_t)at[axis] + way * step[axis];
            inside = inside && place >= 0 && place < counts[axis];
            offset = offset * (ptrdiff_t)counts[axis] + way * step[axis];
        }
        if (inside)
            out[found++] = offset;
    }
    return found;
}

/* One row along x. Within it, but for its ends, all bricks have the same neighbours. */
static void relax_row(nook_brick *row, const uint32_t counts[3], uint32_t y, uint32_t z, int way)
{
    const uint32_t last = counts[0] - 1, middle[3] = { 1, y, z };
    ptrdiff_t inner[NEIGHBOURS], end[NEIGHBOURS];
    int inner_count = last > 1 ? find_neighbours(counts, middle, way, inner) : 0;
    for (uint32_t i = 0; i <= last; i++) {
        const uint32_t x = way > 0 ? i : last - i, at[3] = { x, y, z };
        if (row[x].skip == 0)
            continue;
        if (x > 0 && x < last)
            row[x].skip = least_of(&row[x], inner, inner_count);
        else
            row[x].skip = least_of(&row[x], end, find_neighbours(counts, at, way, end));
    }
}

/* Chebyshev distances in two passes over the 26 neighbours, which is exact (Rosenfeld, Pfaltz 1968). */
static void find_skips(nook_brick *bricks, const uint32_t counts[3])
{
    const uint32_t rows = counts[1] * counts[2];
    for (uint32_t i = 0; i < 2 * rows; i++) {
        const uint32_t row = i < rows ? i : 2 * rows - 1 - i;
        relax_row(bricks + (size_t)row * counts[0], counts, row % counts[1], row / counts[1], i < rows ? 1 : -1);
    }
}

uint64_t nook_bricks_number(nook_brick *bricks, const uint32_t counts[3])
{
    size_t total = (size_t)counts[0] * counts[1] * counts[2];
    /* As far as the grid is long there is nothing at all, and no brick lies farther. */
    uint32_t farthest = counts[0] > counts[1] ? counts[0] : counts[1], surfels = 0;
    farthest = counts[2] > farthest ? counts[2] : farthest;
    for (size_t i = 0; i < total; i++) {
        nook_brick *brick = &bricks[i];
        uint32_t occupied = nook_brick_count(brick);
        brick->first_surfel = surfels;
        brick->skip = occupied ? 0 : farthest;
        surfels += occupied;
    }
    find_skips(bricks, counts);
    return surfels;
}
