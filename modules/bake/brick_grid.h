/**
 * brick_grid.h - voxels in bricks of 4 x 4 x 4: how they are numbered, and what follows from their masks.
 */
#pragma once
#include "modules/bake/volume_file.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { NOOK_BRICK_SIDE = 4 };

/** Bricks along x, y, z: the last ones may stand out of the volume. Brick (x, y, z) is (z * out[1] + y) * out[0] + x. */
void nook_brick_counts(const nook_volume_info *info, uint32_t out_counts[3]);
size_t nook_brick_total(const nook_volume_info *info);

/** Bit of a voxel in its brick's mask, in Morton order: a byte of the mask is a block of 2 x 2 x 2. */
uint32_t nook_brick_bit(uint32_t x, uint32_t y, uint32_t z);

/** How many voxels are set in a brick's mask. */
uint32_t nook_brick_count(const nook_brick *brick);
/** Of those, how many come before this bit: which of the brick's surfels is that of the bit. */
uint32_t nook_brick_count_below(const nook_brick *brick, uint32_t bit);

/** Fills in first_surfel and skip from the masks. @return how many voxels are set */
uint64_t nook_bricks_number(nook_brick *bricks, const uint32_t counts[3]);

#ifdef __cplusplus
}
#endif
