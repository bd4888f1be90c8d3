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

typedef struct pool_entry {
    uint32_t id; /**< The volume's. */
    nook_volume_info info;
    range bricks, surfels; /**< Its places. */
    nook_volume pending;   /**< What is not on the GPU yet; zero once it is. Owned. */
} pool_entry;

/** A row of records on the GPU, as a texture. */
typedef struct pool_row {
    range_list places;
    nook_buffer buffer;   /**< id 0 before the first flush. */
    nook_texture texture; /**< Shows the buffer. */
} pool_row;

typedef struct brick_pool {
    nook_gpu *gpu;
    pool_row bricks;     /**< RGBA32UI: nook_brick, its first_surfel counted from the start of `surfels`. */
    pool_row surfels;    /**< RG32UI: nook_surfel. */
    pool_entry *entries; /**< In the order of their ids. */
    uint32_t entry_count, entry_capacity;
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
/** Bytes of the buffers that volumes take. */
uint64_t brick_pool_bytes(const brick_pool *pool);
