#include "modules/bake/brick_grid.h"

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

/* The least of a brick's own distance and one more than those of its neighbours before it (way 1) or behind it (way -1). */
static void relax(nook_brick *bricks, const uint32_t counts[3], size_t index, const uint32_t at[3], int way)
{
    uint32_t least = bricks[index].skip;
    for (int neighbour = 0; neighbour < 13; neighbour++) { /* the half of 27 that comes before the middle */
        int step[3] = { neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1 };
        size_t other = 0;
        int inside = 1;
        for (int axis = 2; axis >= 0; axis--) {
            int64_t place = (int64_t)at[axis] + way * step[axis];
            inside = inside && place >= 0 && place < counts[axis];
            other = other * counts[axis] + (size_t)(inside ? place : 0);
        }
        if (inside && bricks[other].skip + 1 < least)
            least = bricks[other].skip + 1;
    }
    bricks[index].skip = least;
}

/* Chebyshev distances in two passes over the 26 neighbours, which is exact (Rosenfeld, Pfaltz 1968). */
static void find_skips(nook_brick *bricks, const uint32_t counts[3])
{
    size_t total = (size_t)counts[0] * counts[1] * counts[2];
    for (size_t pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < total; i++) {
            size_t index = pass ? total - 1 - i : i;
            if (bricks[index].skip == 0)
                continue;
            const uint32_t at[3] = { (uint32_t)(index % counts[0]), (uint32_t)(index / counts[0] % counts[1]),
                                     (uint32_t)(index / counts[0] / counts[1]) };
            relax(bricks, counts, index, at, pass ? -1 : 1);
        }
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
        uint32_t occupied = count_bits(brick->mask[0]) + count_bits(brick->mask[1]);
        brick->first_surfel = surfels;
        brick->skip = occupied ? 0 : farthest;
        surfels += occupied;
    }
    find_skips(bricks, counts);
    return surfels;
}
