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

void brick_pool_release_row(nook_gpu *gpu, pool_row *row)
{
    range_list_release(&row->places);
    if (gpu) {
        nook_texture_destroy(gpu, &row->texture);
        nook_buffer_destroy(gpu, &row->buffer);
    }
}

void brick_pool_release(brick_pool *pool)
{
    for (uint32_t i = 0; i < pool->seen.count; i++)
        nook_volume_free(&pool->seen.items[i].pending);
    free(pool->seen.items);
    free(pool->incoming.items);
    brick_pool_release_row(pool->gpu, &pool->bricks);
    brick_pool_release_row(pool->gpu, &pool->surfels);
    *pool = (brick_pool){ 0 };
}

/* The place of an id, or where it belongs. */
static uint32_t place_of(const brick_pool *pool, uint32_t id)
{
    uint32_t first = 0, end = pool->seen.count;
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        if (pool->seen.items[middle].id < id)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

const pool_entry *brick_pool_find(const brick_pool *pool, uint32_t id)
{
    uint32_t i = place_of(pool, id);
    return i < pool->seen.count && pool->seen.items[i].id == id ? &pool->seen.items[i] : NULL;
}

static bool reserve(pool_entries *entries, uint32_t count)
{
    uint32_t capacity = entries->capacity ? entries->capacity : 16;
    while (capacity < count)
        capacity *= 2;
    if (capacity == entries->capacity)
        return true;
    pool_entry *grown = realloc(entries->items, capacity * sizeof *grown);
    if (!grown)
        return false;
    entries->items = grown;
    entries->capacity = capacity;
    return true;
}

bool brick_pool_reserve(brick_pool *pool)
{
    uint32_t more = pool->incoming.count + 1;
    return reserve(&pool->incoming, more) && reserve(&pool->seen, pool->seen.count + more);
}

static uint32_t most_of(const brick_pool *pool, const pool_row *row, bool grows)
{
    return row->room > 0 && !grows ? row->room : pool->gpu->max_texture_buffer_size;
}

bool brick_pool_take(brick_pool *pool, pool_entry *entry, bool grows)
{
    entry->bricks.first =
        range_list_take(&pool->bricks.places, entry->bricks.count, most_of(pool, &pool->bricks, grows));
    if (entry->bricks.first == UINT32_MAX)
        return false;
    entry->surfels.first =
        range_list_take(&pool->surfels.places, entry->surfels.count, most_of(pool, &pool->surfels, grows));
    if (entry->surfels.first != UINT32_MAX)
        return true;
    range_list_give(&pool->bricks.places, entry->bricks);
    return false;
}

void brick_pool_give(brick_pool *pool, const pool_entry *entry)
{
    range_list_give(&pool->bricks.places, entry->bricks);
    range_list_give(&pool->surfels.places, entry->surfels);
}

void brick_pool_put(brick_pool *pool, const pool_entry *entry)
{
    uint32_t i = place_of(pool, entry->id);
    if (i < pool->seen.count && pool->seen.items[i].id == entry->id) {
        brick_pool_give(pool, &pool->seen.items[i]);
        nook_volume_free(&pool->seen.items[i].pending);
    } else {
        assert(pool->seen.count < pool->seen.capacity);
        memmove(pool->seen.items + i + 1, pool->seen.items + i, (pool->seen.count++ - i) * sizeof *pool->seen.items);
    }
    pool->seen.items[i] = *entry;
}

nook_result brick_pool_add(brick_pool *pool, uint32_t id, nook_volume *volume)
{
    assert(!brick_pool_find(pool, id));
    pool_entry entry = { .id = id, .info = volume->info, .pending = *volume };
    entry.bricks.count = (uint32_t)nook_brick_total(&volume->info);
    entry.surfels.count = (uint32_t)volume->info.occupied;
    if (!brick_pool_reserve(pool))
        return nook_fail(NOOK_E_MEMORY, "no memory for another volume");
    if (!brick_pool_take(pool, &entry, true))
        return nook_fail(NOOK_E_MEMORY,
                         "a volume of %u bricks and %u surfels does not fit any more into texture buffers of %u: "
                         "bake at a lower resolution",
                         entry.bricks.count, entry.surfels.count, pool->gpu->max_texture_buffer_size);
    brick_pool_put(pool, &entry);
    *volume = (nook_volume){ 0 };
    return NOOK_OK;
}

/** Once nothing is left (a level is over), all of it goes, and its memory with it. */
void brick_pool_release_when_empty(brick_pool *pool)
{
    if (pool->seen.count > 0 || pool->incoming.count > 0 || pool->bricks.room > 0)
        return;
    brick_pool_release_row(pool->gpu, &pool->bricks);
    brick_pool_release_row(pool->gpu, &pool->surfels);
}

void brick_pool_remove(brick_pool *pool, uint32_t id)
{
    uint32_t i = place_of(pool, id);
    if (i == pool->seen.count || pool->seen.items[i].id != id)
        return;
    pool_entry *entry = &pool->seen.items[i];
    brick_pool_give(pool, entry);
    nook_volume_free(&entry->pending);
    memmove(entry, entry + 1, (--pool->seen.count - i) * sizeof *entry);
    brick_pool_release_when_empty(pool);
}

nook_result brick_pool_make_row(nook_gpu *gpu, uint32_t format, size_t record_size, size_t records, pool_row *out_row)
{
    nook_buffer buffer;
    nook_texture texture;
    nook_result result = nook_buffer_create(gpu, NULL, records * record_size, &buffer);
    if (result != NOOK_OK)
        return result;
    result = nook_texture_create_buffer(gpu, format, buffer, &texture);
    if (result != NOOK_OK) {
        nook_buffer_destroy(gpu, &buffer);
        return result;
    }
    out_row->buffer = buffer;
    out_row->texture = texture;
    return NOOK_OK;
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
    nook_result result = brick_pool_make_row(gpu, format, record_size, records, &grown);
    if (result != NOOK_OK)
        return result;
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
    if (pool->seen.count == 0 && pool->incoming.count == 0)
        return NOOK_OK;
    nook_result result = grow_row(pool->gpu, &pool->bricks, GL_RGBA32UI, sizeof(nook_brick));
    if (result == NOOK_OK)
        result = grow_row(pool->gpu, &pool->surfels, GL_RG32UI, sizeof(nook_surfel));
    for (uint32_t i = 0; result == NOOK_OK && i < pool->seen.count; i++)
        if (pool->seen.items[i].pending.bricks)
            upload(pool, &pool->seen.items[i]);
    return result;
}

static uint64_t records_of(const pool_row *row)
{
    return row->places.end > row->room ? row->places.end : row->room;
}

uint64_t brick_pool_bytes(const brick_pool *pool)
{
    return records_of(&pool->bricks) * sizeof(nook_brick) + records_of(&pool->surfels) * sizeof(nook_surfel);
}
