/**
 * voxel_grid.h - one bit per voxel, set from any number of threads; inside modules/bake only.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_voxel_grid nook_voxel_grid;

/** An empty grid. @return NULL when there is no memory */
nook_voxel_grid *nook_voxel_grid_create(const uint32_t size[3]);
void nook_voxel_grid_destroy(nook_voxel_grid *grid); /**< NULL is allowed. */

/** Sets one voxel. The order in which threads set voxels does not show in the result. */
void nook_voxel_grid_set(nook_voxel_grid *grid, const int32_t voxel[3]);
/** Whether this voxel or one of the six that share a face with it is set. `voxel` must not touch the grid's border. */
bool nook_voxel_grid_has_near(const nook_voxel_grid *grid, const int32_t voxel[3]);

/** One byte per voxel of a | b (same size): 255 or 0, x fastest. @return the number of voxels that are 255 */
uint64_t nook_voxel_grid_expand(const nook_voxel_grid *a, const nook_voxel_grid *b, uint8_t *out_voxels);

#ifdef __cplusplus
}
#endif
