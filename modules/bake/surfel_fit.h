/**
 * surfel_fit.h - the surfel of a voxel: at most two planes for what lies in it; inside modules/bake only.
 * How and why: docs/surfel_bricks.md.
 */
#pragma once
#include "modules/bake/surfel_bins.h"
#include "modules/bake/volume_file.h"
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @param bins  of one voxel, count of them, 1 to NOOK_SURFEL_BINS_PER_VOXEL
 * @param bias  how far below its faces the voxel was cut: NOOK_LAYER_BIAS in voxels
 * @return false when they cover too little to be told from nothing
 */
bool nook_surfel_fit(const nook_surfel_bin *bins, size_t count, double bias, nook_surfel *out);

#ifdef __cplusplus
}
#endif
