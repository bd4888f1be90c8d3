/* Surfel volumes that come and go (residency.h), and the room that they share. */
#include "engine/core/log.h"
#include "modules/ao/brick_pool_internal.h"
#include "modules/bake/brick_grid.h"
#include <assert.h>
#include <stdlib.h>

/* ---- Volumes that come ------------------------------------------------------------------------------------------- */

static pool_entry *find_incoming(const brick_pool *pool, uint32_t id)
{
    for (uint32_t i = 0; i < pool->incoming.count; i++)
        if (pool->incoming.items[i].id == id)
            return &pool->incoming.items[i];
    return NULL;
}

bool brick_pool_is_placed(const brick_pool *pool, uint32_t id)
{
    return find_incoming(pool, id) != NULL;
}

bool brick_pool_place(brick_pool *pool, uint32_t id, const nook_volume_info *info)
{
    assert(!find_incoming(pool, id));
    pool_entry entry = { .id = id, .info = *info, .streamed = true };
    entry.bricks.count = (uint32_t)nook_brick_total(info);
    entry.surfels.count = (uint32_t)info->occupied;
    if (!brick_pool_reserve(pool) || !brick_pool_take(pool, &entry, false))
        return false;
    pool->incoming.items[pool->incoming.count++] = entry;
    return true;
}

void brick_pool_unplace(brick_pool *pool, uint32_t id)
{
    pool_entry *entry = find_incoming(pool, id);
    if (!entry)
        return;
    brick_pool_give(pool, entry);
    *entry = pool->incoming.items[--pool->incoming.count];
    brick_pool_release_when_empty(pool);
}

/* Of `size` bytes, those from `from` on that are still to be written. @return how many were */
static size_t write_part(nook_gpu *gpu, nook_buffer buffer, size_t first, const void *bytes, size_t size, size_t from,
                         size_t most)
{
    size_t count = size - from < most ? size - from : most;
    if (count > 0)
        nook_buffer_update(gpu, buffer, first + from, (const uint8_t *)bytes + from, count);
    return count;
}

size_t brick_pool_write(brick_pool *pool, uint32_t id, nook_volume *volume, size_t most, bool *out_whole)
{
    pool_entry *entry = find_incoming(pool, id);
    assert(entry);
    size_t bricks = entry->bricks.count * sizeof(nook_brick), surfels = entry->surfels.count * sizeof(nook_surfel);
    size_t written = 0;
    if (entry->written == 0 && most > 0) /* once: after it something is written */
        for (uint32_t i = 0; i < entry->bricks.count; i++)
            volume->bricks[i].first_surfel += entry->surfels.first;
    if (entry->written < bricks)
        written = write_part(pool->gpu, pool->bricks.buffer, entry->bricks.first * sizeof(nook_brick), volume->bricks,
                             bricks, entry->written, most);
    entry->written += written;
    if (entry->written >= bricks) {
        size_t more = write_part(pool->gpu, pool->surfels.buffer, entry->surfels.first * sizeof(nook_surfel),
                                 volume->surfels, surfels, entry->written - bricks, most - written);
        entry->written += more;
        written += more;
    }
    *out_whole = entry->written == bricks + surfels;
    if (*out_whole) {
        brick_pool_put(pool, entry); /* seen from now on, instead of what the volume was before */
        *entry = pool->incoming.items[--pool->incoming.count];
    }
    return written;
}

/* ---- Volumes that stay ------------------------------------------------------------------------------------------- */

uint64_t brick_pool_kept_bytes(const brick_pool *pool)
{
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < pool->seen.count; i++)
        if (!pool->seen.items[i].streamed)
            bytes += pool->seen.items[i].bricks.count * sizeof(nook_brick) +
                     pool->seen.items[i].surfels.count * sizeof(nook_surfel);
    return bytes;
}

uint32_t brick_pool_list_kept(const brick_pool *pool, nook_volume_info *out, uint32_t capacity)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < pool->seen.count; i++) {
        if (pool->seen.items[i].streamed)
            continue;
        if (count < capacity)
            out[count] = pool->seen.items[i].info;
        count++;
    }
    return count;
}

/* ---- Another room -------------------------------------------------------------------------------------------------- */

/* A place for each, those first that are not streamed. @return false: one of those has none. What is streamed and has none gets a
   place at UINT32_MAX */
static bool settle(brick_pool *made, const brick_pool *pool, pool_entry *entries)
{
    for (int streamed = 0; streamed <= 1; streamed++) {
        for (uint32_t i = 0; i < pool->seen.count; i++) {
            if (entries[i].streamed != (streamed == 1) || brick_pool_take(made, &entries[i], false))
                continue;
            if (!streamed)
                return false;
            entries[i].bricks.first = UINT32_MAX;
        }
    }
    return true;
}

/* Bricks know the number of their first surfel, which is another one now: they pass through `scratch`. */
static void move(const brick_pool *pool, const pool_entry *from, const brick_pool *made, const pool_entry *to,
                 nook_brick *scratch)
{
    const nook_gl *gl = pool->gpu->gl;
    size_t size = from->bricks.count * sizeof *scratch;
    nook_buffer_read(pool->gpu, pool->bricks.buffer, from->bricks.first * sizeof *scratch, scratch, size);
    for (uint32_t i = 0; i < from->bricks.count; i++)
        scratch[i].first_surfel += to->surfels.first - from->surfels.first;
    nook_buffer_update(pool->gpu, made->bricks.buffer, to->bricks.first * sizeof *scratch, scratch, size);
    if (from->surfels.count)
        gl->CopyNamedBufferSubData(pool->surfels.buffer.id, made->surfels.buffer.id,
                                   (GLintptr)(from->surfels.first * sizeof(nook_surfel)),
                                   (GLintptr)(to->surfels.first * sizeof(nook_surfel)),
                                   (GLsizeiptr)(from->surfels.count * sizeof(nook_surfel)));
}

static void take_over(brick_pool *pool, const brick_pool *made, const pool_entry *entries, nook_brick *scratch)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < pool->seen.count; i++) {
        if (entries[i].bricks.first == UINT32_MAX)
            continue;
        if (!entries[i].pending.bricks)
            move(pool, &pool->seen.items[i], made, &entries[i], scratch);
        pool->seen.items[kept++] = entries[i];
    }
    brick_pool_release_row(pool->gpu, &pool->bricks);
    brick_pool_release_row(pool->gpu, &pool->surfels);
    pool->bricks = made->bricks;
    pool->surfels = made->surfels;
    pool->seen.count = kept;
    pool->incoming.count = 0;
}

static nook_result move_to(brick_pool *pool, uint32_t bricks, uint32_t surfels, pool_entry *entries,
                           nook_brick *scratch)
{
    brick_pool made = { .gpu = pool->gpu, .bricks.room = bricks, .surfels.room = surfels };
    for (uint32_t i = 0; i < pool->seen.count; i++)
        entries[i] = pool->seen.items[i];
    nook_result result = settle(&made, pool, entries)
                             ? brick_pool_make_row(pool->gpu, GL_RGBA32UI, sizeof(nook_brick), bricks, &made.bricks)
                             : nook_fail(NOOK_E_RANGE,
                                         "room of %u bricks and %u surfels does not hold what stays: "
                                         "give more",
                                         bricks, surfels);
    if (result == NOOK_OK)
        result = brick_pool_make_row(pool->gpu, GL_RG32UI, sizeof(nook_surfel), surfels, &made.surfels);
    if (result == NOOK_OK) {
        take_over(pool, &made, entries, scratch);
        return NOOK_OK;
    }
    brick_pool_release_row(pool->gpu, &made.bricks);
    brick_pool_release_row(pool->gpu, &made.surfels);
    return result;
}

nook_result brick_pool_set_room(brick_pool *pool, uint32_t bricks, uint32_t surfels)
{
    if (bricks == 0 || surfels == 0) {
        pool->bricks.room = pool->surfels.room = 0;
        brick_pool_release_when_empty(pool);
        return NOOK_OK;
    }
    uint32_t most = 1;
    for (uint32_t i = 0; i < pool->seen.count; i++)
        most = pool->seen.items[i].bricks.count > most ? pool->seen.items[i].bricks.count : most;
    pool_entry *entries = malloc((pool->seen.count + (size_t)1) * sizeof *entries);
    nook_brick *scratch = malloc(most * sizeof *scratch);
    nook_result result = entries && scratch ? move_to(pool, bricks, surfels, entries, scratch)
                                            : nook_fail(NOOK_E_MEMORY, "no memory for room for volumes");
    free(entries);
    free(scratch);
    return result;
}
