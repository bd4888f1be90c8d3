#include "engine/core/log.h"
#include "modules/ao/brick_pool_internal.h"
#include "modules/bake/brick_grid.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(sizeof(nook_brick) == 16 && sizeof(nook_surfel) == 8, "texels of RGBA32UI and RG32UI");

void brick_pool_init(brick_pool *pool, nook_gpu *gpu)
{
    *pool = (brick_pool){ .gpu = gpu };
}

static void release_row(brick_pool *pool, pool_row *row)
{
    range_list_release(&row->places);
    if (pool->gpu) {
        nook_texture_destroy(pool->gpu, &row->texture);
        nook_buffer_destroy(pool->gpu, &row->buffer);
    }
}

void brick_pool_release(brick_pool *pool)
{
    for (uint32_t i = 0; i < pool->entry_count; i++)
        nook_volume_free(&pool->entries[i].pending);
    free(pool->entries);
    release_row(pool, &pool->bricks);
    release_row(pool, &pool->surfels);
    *pool = (brick_pool){ 0 };
}

/* The place of an id, or where it belongs. */
static uint32_t place_of(const brick_pool *pool, uint32_t id)
{
    uint32_t first = 0, end = pool->entry_count;
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        if (pool->entries[middle].id < id)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

const pool_entry *brick_pool_find(const brick_pool *pool, uint32_t id)
{
    uint32_t i = place_of(pool, id);
    return i < pool->entry_count && pool->entries[i].id == id ? &pool->entries[i] : NULL;
}

static int reserve_entry(brick_pool *pool)
{
    if (pool->entry_count < pool->entry_capacity)
        return 1;
    uint32_t capacity = pool->entry_capacity ? pool->entry_capacity * 2 : 16;
    pool_entry *grown = realloc(pool->entries, capacity * sizeof *grown);
    if (!grown)
        return 0;
    pool->entries = grown;
    pool->entry_capacity = capacity;
    return 1;
}

/* @return 0 when the device has no room for it, or there is no memory */
static int take_places(brick_pool *pool, pool_entry *entry)
{
    uint32_t most = pool->gpu->max_texture_buffer_size;
    entry->bricks.first = range_list_take(&pool->bricks.places, entry->bricks.count, most);
    if (entry->bricks.first == UINT32_MAX)
        return 0;
    entry->surfels.first = range_list_take(&pool->surfels.places, entry->surfels.count, most);
    if (entry->surfels.first != UINT32_MAX)
        return 1;
    range_list_give(&pool->bricks.places, entry->bricks);
    return 0;
}

nook_result brick_pool_add(brick_pool *pool, uint32_t id, nook_volume *volume)
{
    assert(!brick_pool_find(pool, id));
    pool_entry entry = { .id = id, .info = volume->info, .pending = *volume };
    entry.bricks.count = (uint32_t)nook_brick_total(&volume->info);
    entry.surfels.count = (uint32_t)volume->info.occupied;
    if (!reserve_entry(pool))
        return nook_fail(NOOK_E_MEMORY, "no memory for another volume");
    if (!take_places(pool, &entry))
        return nook_fail(NOOK_E_MEMORY,
                         "a volume of %u bricks and %u surfels does not fit any more into texture buffers of %u: "
                         "bake at a lower resolution",
                         entry.bricks.count, entry.surfels.count, pool->gpu->max_texture_buffer_size);
    uint32_t i = place_of(pool, id);
    memmove(pool->entries + i + 1, pool->entries + i, (pool->entry_count - i) * sizeof *pool->entries);
    pool->entries[i] = entry;
    pool->entry_count++;
    *volume = (nook_volume){ 0 };
    return NOOK_OK;
}

/** Once nothing is left (a level is over), all of it goes, and its memory with it. */
static void release_when_empty(brick_pool *pool)
{
    if (pool->entry_count > 0)
        return;
    release_row(pool, &pool->bricks);
    release_row(pool, &pool->surfels);
}

void brick_pool_remove(brick_pool *pool, uint32_t id)
{
    uint32_t i = place_of(pool, id);
    if (i == pool->entry_count || pool->entries[i].id != id)
        return;
    pool_entry *entry = &pool->entries[i];
    range_list_give(&pool->bricks.places, entry->bricks);
    range_list_give(&pool->surfels.places, entry->surfels);
    nook_volume_free(&entry->pending);
    memmove(entry, entry + 1, (--pool->entry_count - i) * sizeof *entry);
    release_when_empty(pool);
}

/** Replaces a row's buffer by a larger one and copies what was there. */
static nook_result grow_row(nook_gpu *gpu, pool_row *row, uint32_t format, size_t record_size)
{
    size_t needed = row->places.end ? row->places.end : 1; /* a buffer holds at least something */
    if (row->buffer.size >= needed * record_size)
        return NOOK_OK;
    size_t records = needed + needed / 4; /* a few more volumes will come */
    if (records > gpu->max_texture_buffer_size)
        records = gpu->max_texture_buffer_size;
    pool_row grown = { 0 };
    nook_result result = nook_buffer_create(gpu, NULL, records * record_size, &grown.buffer);
    if (result == NOOK_OK)
        result = nook_texture_create_buffer(gpu, format, grown.buffer, &grown.texture);
    if (result != NOOK_OK) {
        nook_buffer_destroy(gpu, &grown.buffer);
        return result;
    }
    if (row->buffer.id)
        gpu->gl->CopyNamedBufferSubData(row->buffer.id, grown.buffer.id, 0, 0, (GLsizeiptr)row->buffer.size);
    nook_texture_destroy(gpu, &row->texture);
    nook_buffer_destroy(gpu, &row->buffer);
    row->buffer = grown.buffer;
    row->texture = grown.texture;
    return NOOK_OK;
}

static void upload(brick_pool *pool, pool_entry *entry)
{
    nook_volume *volume = &entry->pending;
    for (uint32_t i = 0; i < entry->bricks.count; i++)
        volume->bricks[i].first_surfel += entry->surfels.first;
    nook_buffer_update(pool->gpu, pool->bricks.buffer, entry->bricks.first * sizeof(nook_brick), volume->bricks,
                       entry->bricks.count * sizeof(nook_brick));
    if (entry->surfels.count)
        nook_buffer_update(pool->gpu, pool->surfels.buffer, entry->surfels.first * sizeof(nook_surfel), volume->surfels,
                           entry->surfels.count * sizeof(nook_surfel));
    nook_volume_free(volume);
}

nook_result brick_pool_flush(brick_pool *pool)
{
    if (pool->entry_count == 0)
        return NOOK_OK;
    nook_result result = grow_row(pool->gpu, &pool->bricks, GL_RGBA32UI, sizeof(nook_brick));
    if (result == NOOK_OK)
        result = grow_row(pool->gpu, &pool->surfels, GL_RG32UI, sizeof(nook_surfel));
    for (uint32_t i = 0; result == NOOK_OK && i < pool->entry_count; i++)
        if (pool->entries[i].pending.bricks)
            upload(pool, &pool->entries[i]);
    return result;
}

uint64_t brick_pool_bytes(const brick_pool *pool)
{
    return pool->bricks.places.end * sizeof(nook_brick) + pool->surfels.places.end * sizeof(nook_surfel);
}
