/**
 * cache.h - bakes once, reads afterwards. A folder of .nkv files named by content: docs/volume_format.md.
 */
#pragma once
#include "modules/bake/voxelize.h"
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A volume file image and how it was come by. */
typedef struct nook_bake {
    void *bytes;   /**< A .nkv file image, checked. Owned; release with nook_bake_free. */
    size_t size;   /**< Bytes. */
    double ms;     /**< Wall time of voxelising and compressing, or of reading and checking. */
    size_t bricks; /**< That were made anew in an older volume; 0: all were, or none. */
    nook_volume_info info;
    int keep_error; /**< The errno that says why it is not in the cache now; 0: it is, or there is no cache. */
    bool cache_hit; /**< Nothing was voxelised. */
} nook_bake;

void nook_bake_free(nook_bake *bake); /**< NULL and zeroed bakes are allowed. */

/** Where the volume with that content hash lies in a cache. @return out, cut to capacity */
char *nook_bake_path(const char *cache_dir, uint64_t content_hash, char *out, size_t capacity);

/**
 * The volume of a soup, from the cache when it holds a sound one. A damaged, truncated or stale file is warned about, baked
 * again and replaced. A cache that cannot be written is done without; `keep_error` tells. Any number of threads and processes
 * may bake into one folder.
 * @param cache_dir  made when it is missing; NULL: no cache
 * @param name       what is baked, used in messages only
 * @return what nook_voxelize and nook_volume_encode return; *out_bake is untouched on failure
 */
nook_result nook_bake_cached(const char *cache_dir, const char *name, const nook_triangles *triangles,
                             const nook_voxelize_desc *desc, nook_bake *out_bake);

/** What a soup was before it was edited. Borrowed. */
typedef struct nook_bake_before {
    const nook_triangles *triangles;
    const nook_alphas *alphas; /**< NULL: all was opaque. */
} nook_bake_before;

/**
 * The same, and sooner where the cache holds the volume of the soup as it was before: then nook_voxelize_again makes the new one of it.
 * @param before  NULL: nothing is known
 */
nook_result nook_bake_cached_again(const char *cache_dir, const char *name, const nook_triangles *triangles,
                                   const nook_voxelize_desc *desc, const nook_bake_before *before, nook_bake *out_bake);

/**
 * Several levels of a body, each a file of its own. Those of surfels that the cache lacks are made in one pass (nook_voxelize_levels), whose time
 * is that of the finest of them; of other kinds a level is what nook_bake_cached makes at nook_voxelize_level_resolution.
 * @param desc  its level is not looked at @param levels  which: bits 1 << level, at least one, all below NOOK_VOXELIZE_LEVELS
 * @param out_bakes  NOOK_VOXELIZE_LEVELS of them; those of the levels are filled, and all are untouched on failure
 * @return as nook_bake_cached; NOOK_E_RANGE for other levels
 */
nook_result nook_bake_cached_levels(const char *cache_dir, const char *name, const nook_triangles *triangles,
                                    const nook_voxelize_desc *desc, uint32_t levels, nook_bake *out_bakes);

/**
 * The same, and sooner where the cache holds levels of surfels of the soup as it was before: nook_voxelize_levels_again makes the new ones of them.
 * @param before  NULL: nothing is known
 */
nook_result nook_bake_cached_levels_again(const char *cache_dir, const char *name, const nook_triangles *triangles,
                                          const nook_voxelize_desc *desc, uint32_t levels,
                                          const nook_bake_before *before, nook_bake *out_bakes);

#ifdef __cplusplus
}
#endif
