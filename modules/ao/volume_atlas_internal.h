/**
 * volume_atlas_internal.h - all volumes in one R8 3D texture, so that one dispatch can march any of them.
 *
 * Volumes are kept in memory until the next flush, which grows the texture once and uploads what is new. Those that are streamed
 * (residency.h) take a place first and are written piece by piece; nobody sees them before they are whole.
 */
#pragma once
#include "engine/gpu/gpu.h"
#include "modules/ao/box_tree_internal.h"
#include "modules/ao/technique.h"
#include "modules/bake/volume_file.h"

typedef struct atlas_entry {
    uint32_t id; /**< The volume's. */
    nook_volume_info info;
    atlas_box box;
    uint32_t place;   /**< Of the box in the tree. */
    uint32_t version; /**< Another one when its contents are made anew. */
    uint8_t *pending; /**< Voxels that are not on the GPU yet; NULL once they are. Owned. */
    uint32_t written; /**< Of one that comes: its slices that are on the GPU. */
    bool streamed;
    bool live; /**< Made anew on the GPU: nook_ao_voxelize. */
} atlas_entry;

/** Entries in an array that grows. */
typedef struct atlas_entries {
    atlas_entry *items;
    uint32_t count, capacity;
} atlas_entries;

/** Where the texture's contents have changed. */
typedef struct atlas_changes {
    nook_ao_box *boxes;       /**< Owned. */
    uint32_t count, capacity; /**< count NOOK_AO_CHANGED_ALL: anywhere. */
    bool renewed;             /**< The texture is another: these are all boxes that hold something. */
} atlas_changes;

typedef struct volume_atlas {
    nook_gpu *gpu;
    nook_texture texture;   /**< id 0 before the first flush. */
    box_tree tree;          /**< Which boxes are taken; the texture follows its size at the next flush. */
    atlas_entries seen;     /**< In the order of their ids. */
    atlas_entries incoming; /**< That take a place and are not whole yet, in no order. */
    bool has_room;          /**< The size is given: nothing that is streamed makes it grow. */
    uint32_t version;       /**< Another one when the texture, or what it holds, is another. */
    atlas_changes changes;  /**< Since the version before. */
    atlas_changes next;     /**< Since this version: with the next flush there is another one. */
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
/** Says what lies in a volume's box from now on, which is about to be written anew; no larger than the box. Ids that are stale are passed over. */
void volume_atlas_set_info(volume_atlas *atlas, uint32_t id, const nook_volume_info *info);
/** Says that a volume that is there may be made anew. */
void volume_atlas_set_live(volume_atlas *atlas, uint32_t id);
/** Brings the texture up to date. @return NOOK_E_MEMORY, NOOK_E_DEVICE */
nook_result volume_atlas_flush(volume_atlas *atlas);
/** Replaces the texture by one of the tree's size, unless it is, and copies what was there. @return NOOK_E_MEMORY, NOOK_E_RANGE */
nook_result volume_atlas_grow(volume_atlas *atlas);
/** Bytes of the texture. */
uint64_t volume_atlas_bytes(const volume_atlas *atlas);

/* ---- Of volume_atlas_room.c: what residency.h says of one kind ---- */

bool volume_atlas_place(volume_atlas *atlas, uint32_t id, const nook_volume_info *info);
bool volume_atlas_is_placed(const volume_atlas *atlas, uint32_t id);
/** @return bytes that it wrote; the volume is whole when *out_whole is set */
size_t volume_atlas_write(volume_atlas *atlas, uint32_t id, const uint8_t *voxels, size_t most, bool *out_whole);
void volume_atlas_unplace(volume_atlas *atlas, uint32_t id); /**< Only what comes. */
/** @return NOOK_E_MEMORY, NOOK_E_RANGE: what is not streamed does not fit, or the device has no room; all is as it was */
nook_result volume_atlas_set_room(volume_atlas *atlas, const uint32_t sides[3]);

uint64_t volume_atlas_kept_bytes(const volume_atlas *atlas);
uint32_t volume_atlas_list_kept(const volume_atlas *atlas, nook_volume_info *out, uint32_t capacity);

/* ---- Between the two files ---- */

void volume_atlas_release_when_empty(volume_atlas *atlas);          /**< Its memory, but for a room. */
bool atlas_entries_reserve(atlas_entries *entries, uint32_t count); /**< @return false: no memory */
/** Notes that a box's texels are others. */
void volume_atlas_note(volume_atlas *atlas, const atlas_box *box);
/** Notes that the texture is another, which holds what was in the one before. */
void volume_atlas_note_renewed(volume_atlas *atlas);
/** Puts an entry among those that are seen, into the place of the one of its id if there is one. Else there must be room for it. */
void volume_atlas_put(volume_atlas *atlas, const atlas_entry *entry);
/** For one entry more, now or once all that comes is whole. @return false: no memory */
bool volume_atlas_reserve(volume_atlas *atlas);
