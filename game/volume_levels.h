/**
 * volume_levels.h - several levels of a scene's volumes, for those who need them finer and coarser.
 */
#pragma once
#include "game/volumes.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The finest resolution, and which of its levels: bits 1 << level. */
typedef struct nook_resolutions {
    uint32_t resolution, levels;
} nook_resolutions;

/**
 * Reads "256", or several of which each is the largest halved once, twice or three times, rounded up, in any order: "512,256,64".
 * @return false: it is neither, or one is not in [1, NOOK_VOXELIZE_RESOLUTION_MAX]; *out is untouched then
 */
bool nook_resolutions_read(const char *text, nook_resolutions *out);

/**
 * Levels of a volume that was collected, of which level 0 has its resolution, from the cache or in one call of nook_bake_cached_levels. Coarser ones
 * with fewer voxels along its longest side than NOOK_VOLUMES_BODY_RESOLUTION_MIN are left out, and a kind of which it has no triangles.
 * @param desc  its cache_dir, threads and must_keep @param levels  bits 1 << level
 * @param out  NOOK_VOXELIZE_LEVELS of them; what is not made has no bytes; release each with nook_bake_free
 * @return as nook_bake_cached_levels; NOOK_E_IO must_keep, and they cannot be kept; *out is untouched on failure
 */
nook_result nook_scene_volume_bake_levels(const nook_scene_volume *volume, nook_volume_kind kind,
                                          const nook_volumes_desc *desc, uint32_t levels, nook_bake *out);

#ifdef __cplusplus
}
#endif
