/**
 * surfel_cut.h - triangles cut into the voxels of a slab, and summed into bins; inside modules/bake only. A slab is one layer of bricks.
 */
#pragma once
#include "modules/bake/alpha_area.h"
#include "modules/bake/surfel_bins.h"
#include "modules/bake/triangle_grid.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is cut, and into which grid. Borrows all of it. */
typedef struct nook_surfel_source {
    const nook_triangles *triangles;
    const nook_alphas *alphas;     /**< NULL: all is opaque. */
    const nook_alpha_areas *areas; /**< Of the alphas. */
    const nook_grid_frame *frame;
    uint32_t counts[3]; /**< Bricks. */
} nook_surfel_source;

/** First and last slab that a triangle lies in. @return false: it has no area, or a corner that is not finite */
bool nook_surfel_reach(const nook_surfel_source *source, size_t triangle, int32_t out_slabs[2]);

/** First and last slab of every triangle; a first above the last: it lies in none. @param out  of each triangle */
void nook_surfel_find_reach(const nook_surfel_source *source, uint32_t threads, uint8_t (*out)[2]);

/** Some bricks of a slab, by their numbers in it: x fastest, then y. Zero but for the first three: bricks of the grid itself. */
typedef struct nook_surfel_part {
    int32_t slab;
    uint32_t first, end;     /**< These, but for */
    const uint8_t *wanted;   /**< those that are 0 here, a byte for each brick from 0 to end. NULL: all are wanted. */
    uint32_t level;          /**< All three are of bricks of a slab of this level: docs/surfel_bricks.md, "Levels". */
    int32_t lowest, highest; /**< Of the slab's layers of voxels only these are wanted; highest 0: all. */
} nook_surfel_part;

/**
 * Adds what of a triangle lies in a part; which part is asked for changes no bit of what a voxel gets. A voxel's number in the bins is that
 * of its brick times 64, and nook_brick_bit.
 * @return as nook_surfel_bins_add
 */
nook_result nook_surfel_cut(const nook_surfel_source *source, size_t triangle, const nook_surfel_part *part,
                            nook_surfel_bins *bins);

/** Sets the bytes of all bricks of a level that a triangle may lie in: those of the box around it. @param bricks  of the level's whole grid */
void nook_surfel_mark(const nook_surfel_source *source, size_t triangle, uint32_t level, uint8_t *bricks);

#ifdef __cplusplus
}
#endif
