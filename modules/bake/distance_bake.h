/**
 * distance_bake.h - triangles, and what their textures leave of them, to distances of voxel centres: docs/volume_kinds.md; inside modules/bake only. nook_voxelize calls it.
 */
#pragma once
#include "modules/bake/triangle_grid.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Raise it when the distances of the same triangles change: cached ones of older versions are then baked again. */
#define NOOK_DISTANCE_BAKE_VERSION 1u

/**
 * @param alphas  NULL: all is opaque
 * @param frame  of the checked soup
 * @param out_volume  its voxels and info.occupied are made, all else of it is zero; untouched on failure
 * @return NOOK_E_MEMORY
 */
nook_result nook_distance_bake(const nook_triangles *triangles, const nook_alphas *alphas, unsigned threads,
                               const nook_grid_frame *frame, nook_volume *out_volume);

#ifdef __cplusplus
}
#endif
