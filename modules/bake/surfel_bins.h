/**
 * surfel_bins.h - what lies in the voxels of a slab, summed up by direction and place; inside modules/bake only.
 *
 * Pieces of surface that face alike (48 directions) and lie at about the same depth of a voxel (quarters of one) are one bin. Sums are
 * integers, so that they do not depend on the order of pieces, and memory follows bins and not triangles.
 */
#pragma once
#include "engine/core/result.h"
#include "modules/bake/polygon.h"
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** 48 directions x 8 depths; and what a bin takes at the most: the entry, its part of a half empty table, its place when sorted. */
enum { NOOK_SURFEL_BINS_PER_VOXEL = 384, NOOK_SURFEL_BIN_BYTES = 112 + 16 + 8 };

/** Sums over the pieces of one bin, about the voxel's centre, in voxels. */
typedef struct nook_surfel_bin {
    double area;
    double normal[3]; /**< Sum of area times unit normal; its sign is of no meaning. */
    double first[3];  /**< nook_polygon_moments. */
    double second[6];
} nook_surfel_bin;

typedef struct nook_surfel_bins nook_surfel_bins;

/** @param most  bins that it takes at the most @return NULL when there is no memory */
nook_surfel_bins *nook_surfel_bins_create(uint32_t most);
void nook_surfel_bins_destroy(nook_surfel_bins *bins); /**< NULL is allowed. */
void nook_surfel_bins_clear(nook_surfel_bins *bins);   /**< Keeps its memory for the next slab. */

/**
 * Adds a piece of surface. What is too small to count (2^-37 voxel areas) is left out.
 * @param voxel    below NOOK_SURFEL_VOXELS, of the caller's numbering
 * @param normal   of unit length @param moments  about the voxel's centre
 * @return NOOK_E_RANGE one bin too many; NOOK_E_MEMORY; neither is logged
 */
nook_result nook_surfel_bins_add(nook_surfel_bins *bins, uint32_t voxel, const double normal[3],
                                 const nook_polygon_moments *moments);
#define NOOK_SURFEL_VOXELS (1u << 23)

/** How many bins it takes at the most from now on: no fewer than it has. */
void nook_surfel_bins_limit(nook_surfel_bins *bins, uint32_t most);

/** Sorts by voxel, and in it by direction and depth. @return how many bins there are; NOOK_E_MEMORY as SIZE_MAX */
size_t nook_surfel_bins_sort(nook_surfel_bins *bins);
/** Of the sorted ones. */
uint32_t nook_surfel_bins_voxel(const nook_surfel_bins *bins, size_t index);
nook_surfel_bin nook_surfel_bins_get(const nook_surfel_bins *bins, size_t index);

/**
 * Adds a sorted bin to those of a grid whose voxels are twice as large. It stays in its direction; its depth is that of its mean. Its sums are
 * rounded, each by less than 2^-35, so that those of `to` do not depend on the order of what is added, as long as each bin is whole.
 * @param voxel  of `to` @param side  along each axis: -1 in the lower half of that voxel, 1 in the upper
 * @return as nook_surfel_bins_add
 */
nook_result nook_surfel_bins_merge(const nook_surfel_bins *from, size_t index, const int side[3], nook_surfel_bins *to,
                                   uint32_t voxel);

#ifdef __cplusplus
}
#endif
