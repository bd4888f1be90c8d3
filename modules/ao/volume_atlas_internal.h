/**
 * volume_atlas_internal.h - all volumes in one R8 3D texture, so that one dispatch can march any of them.
 *
 * Volumes are kept in memory until the next flush, which grows the texture once and uploads what is new.
 */
#pragma once
#include "engine/gpu/gpu.h"
#include "modules/bake/volume_file.h"

/** A box of voxels in the atlas. */
typedef struct atlas_box {
    uint32_t origin[3], size[3];
} atlas_box;

typedef struct atlas_entry {
    uint32_t id; /**< The volume's. */
    nook_volume_info info;
    atlas_box box;
    uint8_t *pending; /**< Voxels that are not on the GPU yet; NULL once they are. Owned. */
} atlas_entry;

typedef struct volume_atlas {
    nook_gpu *gpu;
    nook_texture texture; /**< id 0 before the first flush. */
    uint32_t size[3];     /**< That the boxes need; the texture follows at the next flush. */
    atlas_entry *entries; /**< In the order of their ids. */
    uint32_t entry_count, entry_capacity;
    atlas_box *free_boxes;
    uint32_t free_count, free_capacity;
    uint32_t version; /**< Another one when the texture, or what it holds, is another. */
} volume_atlas;

void volume_atlas_init(volume_atlas *atlas, nook_gpu *gpu);
void volume_atlas_release(volume_atlas *atlas);

/**
 * Takes the voxels of `volume` on success (it becomes zero).
 * @param id  not in the atlas @return NOOK_E_MEMORY: larger than the device can hold
 */
nook_result volume_atlas_add(volume_atlas *atlas, uint32_t id, nook_volume *volume);
void volume_atlas_remove(volume_atlas *atlas, uint32_t id); /**< An id that is not there is allowed. */
/** @return NULL for a stale id */
const atlas_entry *volume_atlas_find(const volume_atlas *atlas, uint32_t id);
/** Says what lies in a volume's box now; no larger than the box. Ids that are stale are passed over. */
void volume_atlas_set_info(volume_atlas *atlas, uint32_t id, const nook_volume_info *info);
/** Brings the texture up to date. @return NOOK_E_MEMORY, NOOK_E_DEVICE */
nook_result volume_atlas_flush(volume_atlas *atlas);
/** Bytes of the texture. */
uint64_t volume_atlas_bytes(const volume_atlas *atlas);
