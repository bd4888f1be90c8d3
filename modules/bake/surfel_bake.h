/**
 * surfel_bake.h - triangles to bricks and surfels: docs/surfel_bricks.md; inside modules/bake only. nook_voxelize calls it.
 */
#pragma once
#include "modules/bake/triangle_grid.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Raise it when the surfels of the same triangles change: cached ones of older versions are then baked again. */
#define NOOK_SURFEL_BAKE_VERSION 2u

/**
 * @param desc  checked: threads, memory and alphas @param frame  of the checked soup
 * @param out_volume  its bricks, surfels and info.occupied are made, all else of it is zero; untouched on failure
 * @return NOOK_E_MEMORY
 */
nook_result nook_surfel_bake(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                             const nook_grid_frame *frame, nook_volume *out_volume);

#ifdef __cplusplus
}
#endif
