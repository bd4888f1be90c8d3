/**
 * brick_pool_internal.h - all surfel volumes in two texture buffers, so that one dispatch can walk any of them.
 *
 * Texture buffers and not storage buffers: loads from these take twice as long on software GL. Volumes are kept in memory until
 * the next flush, which grows the buffers once and uploads what is new.
 */
#pragma once
#include "engine/gpu/gpu.h"
#include "modules/ao/range_list_internal.h"
#include "modules/bake/volume_file.h"
#include <stdbool.h>

typedef struct pool_entry {
    uint32_t id; /**< The volume's. */
    nook_volume_info info;
    range bricks, surfels; /**< Its places. */
    nook_volume pending;   /**< What is not on the GPU yet; zero once it is. Owned. */
    size_t written;        /**< Of one that comes: bytes that are on the GPU, bricks first. */
    bool streamed;
} pool_entry;

/** Entries in an array that grows. */
typedef struct pool_entries {
    pool_entry *items;
    uint32_t count, capacity;
} pool_entries;

/** A row of records on the GPU, as a texture. */
typedef struct pool_row {
    range_list places;
    uint32_t room;        /**< Records that it has; 0: it grows. */
    nook_buffer buffer;   /**< id 0 before the first flush. */
    nook_texture texture; /**< Shows the buffer. */
} pool_row;

typedef struct brick_pool {
    nook_gpu *gpu;
    pool_row bricks;       /**< RGBA32UI: nook_brick, its first_surfel counted from the start of `surfels`. */
    pool_row surfels;      /**< RG32UI: nook_surfel. */
    pool_entries seen;     /**< In the order of their ids. */
    pool_entries incoming; /**< That take places and are not whole yet, in no order (residency.h). */
} brick_pool;

void brick_pool_init(brick_pool *pool, nook_gpu *gpu);
void brick_pool_release(brick_pool *pool);

/**
 * Takes the contents of `volume` on success (it becomes zero).
 * @param id  not in the pool
 * @return NOOK_E_MEMORY: more than the device's texture buffers hold
 */
nook_result brick_pool_add(brick_pool *pool, uint32_t id, nook_volume *volume);
void brick_pool_remove(brick_pool *pool, uint32_t id); /**< An id that is not there is allowed. */
/** @return NULL for one that is not there */
const pool_entry *brick_pool_find(const brick_pool *pool, uint32_t id);
/** Brings the buffers up to date. @return NOOK_E_MEMORY, NOOK_E_DEVICE */
nook_result brick_pool_flush(brick_pool *pool);
/** Bytes of the buffers that volumes take; with a room, of the whole of it. */
uint64_t brick_pool_bytes(const brick_pool *pool);

/* ---- Of brick_pool_room.c: what residency.h says of surfels ---- */

bool brick_pool_place(brick_pool *pool, uint32_t id, const nook_volume_info *info);
bool brick_pool_is_placed(const brick_pool *pool, uint32_t id);
/** @param volume  its bricks are changed @return bytes that it wrote; the volume is whole when *out_whole is set */
size_t brick_pool_write(brick_pool *pool, uint32_t id, nook_volume *volume, size_t most, bool *out_whole);
void brick_pool_unplace(brick_pool *pool, uint32_t id); /**< Only what comes. */
/** @return NOOK_E_MEMORY, NOOK_E_RANGE: what is not streamed does not fit, or the device has no room; all is as it was */
nook_result brick_pool_set_room(brick_pool *pool, uint32_t bricks, uint32_t surfels);

uint64_t brick_pool_kept_bytes(const brick_pool *pool);
uint32_t brick_pool_list_kept(const brick_pool *pool, nook_volume_info *out, uint32_t capacity);

/* ---- Between the two files ---- */

void brick_pool_release_when_empty(brick_pool *pool); /**< Its memory, but for a room. */
/** Places for bricks and surfels, counted already. @param grows  beyond a room, too @return false: none, or no memory */
bool brick_pool_take(brick_pool *pool, pool_entry *entry, bool grows);
void brick_pool_give(brick_pool *pool, const pool_entry *entry);
/** For one entry more, now or once all that comes is whole. @return false: no memory */
bool brick_pool_reserve(brick_pool *pool);
/** Puts an entry among those that are seen, into the place of the one of its id if there is one. Else there must be room for it. */
void brick_pool_put(brick_pool *pool, const pool_entry *entry);
void brick_pool_release_row(nook_gpu *gpu, pool_row *row);
nook_result brick_pool_make_row(nook_gpu *gpu, uint32_t format, size_t record_size, size_t records, pool_row *out_row);
