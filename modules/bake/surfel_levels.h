/**
 * surfel_levels.h - levels of a volume of surfels from one pass over its triangles: docs/surfel_bricks.md; inside modules/bake only.
 */
#pragma once
#include "modules/bake/triangle_grid.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Raise it when the levels of the same triangles change, and those of level 0 do not: cached ones are then baked again. */
#define NOOK_SURFEL_LEVELS_VERSION 1u

/** A level of the soup before it was edited, and a byte for each of its bricks: 0 where the edited one's is the same. */
typedef struct nook_surfel_before {
    const nook_volume *volume;
    const uint8_t *changed; /**< At least the bricks in the boxes of triangles that changed, before and after. */
} nook_surfel_before;

/**
 * @param desc  checked: threads, memory and alphas @param frame  of level 0, of the checked soup
 * @param levels  bits 1 << level, at least one
 * @param before  NOOK_VOXELIZE_LEVELS of them, those of the levels filled, in the grids of these: what need not be made anew; NULL: all is
 * @param out_volumes  of each of the levels bricks, surfels and info.occupied are made, all else of it is zero; untouched on failure
 * @return NOOK_E_MEMORY
 */
nook_result nook_surfel_bake_levels(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                                    const nook_grid_frame *frame, uint32_t levels, const nook_surfel_before *before,
                                    nook_volume *out_volumes);

#ifdef __cplusplus
}
#endif
