/** medium_bake.h - densities of a medium, for the technique that marches them: docs/volume_kinds.md, "Scalar fields". */
#pragma once
#include "engine/core/medium.h"
#include "modules/bake/volume_file.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Voxels along the longest side: as many as asked for, but none smaller than the cells' shortest spacing, and at most 512. */
uint32_t nook_medium_resolution(const nook_medium *medium, uint32_t resolution);

/**
 * A voxel gets the mean extinction in its box, so that a medium takes as much as before; one empty voxel surrounds them. The content hash is 0:
 * it is made again each time, and is in no file.
 * @param resolution  voxels along the longest side, at least 1; see nook_medium_resolution
 * @param threads     0: all cores. The result does not depend on it.
 * @return NOOK_E_MEMORY; *out_volume is untouched then
 */
nook_result nook_medium_bake(const nook_medium *medium, uint32_t resolution, unsigned threads, nook_volume *out_volume);

#ifdef __cplusplus
}
#endif
