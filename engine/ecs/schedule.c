#include "engine/core/jobs.h"
#include "engine/ecs/internal.h"
#include <string.h>

enum {
    PIECE_ROWS = 4096,        /* a multiple of NOOK_COLUMN_ALIGN, so that two workers never share a cache line */
    PARALLEL_ROWS_MIN = 32768 /* below it, starting threads costs more than it gains */
};

/* ---- the declared access, asserted (nook_world_desc.check_access) ---- */

static uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
    const uint8_t *at = bytes;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ at[i]) * 0x100000001B3u; /* FNV-1a */
    return hash;
}

/* Of everything that the system said it only reads. */
static uint64_t hash_reads(const nook_world *world, const nook_system_entry *entry, const nook_rows *rows)
{
    uint64_t hash = 0xCBF29CE484222325u;
    for (uint32_t i = 0; i < entry->read_count; i++)
        hash = hash_bytes(hash, rows->columns[i], (size_t)rows->count * entry->system.reads[i].size);
    for (uint32_t i = 0; i < world->resource_count; i++) {
        if ((entry->resources_read >> i) & 1)
            hash = hash_bytes(hash, world->resources[i].data, world->resources[i].type.size);
    }
    return hash;
}

static void call(const nook_world *world, const nook_system_entry *entry, const nook_rows *rows)
{
    uint64_t before = world->desc.check_access ? hash_reads(world, entry, rows) : 0;
    entry->system.run(rows);
    if (world->desc.check_access)
        assert(before == hash_reads(world, entry, rows) && "a system wrote what it said it only reads");
    (void)before;
}

/* ---- one system ---- */

static nook_rows prepare_rows(nook_world *world, const nook_system_entry *entry)
{
    nook_rows rows = { 0 };
    if (entry->system.structural) { /* then it runs alone, and may change what the world owns */
        world->commands.allowed = &entry->changes;
        rows.commands = &world->commands;
    }
    memcpy(rows.resources, entry->resources, sizeof rows.resources);
    memcpy(rows.changes, entry->change_ids, sizeof rows.changes);
    return rows;
}

static void run_stretch(const nook_world *world, const nook_system_entry *entry, nook_rows *rows, uint32_t match_index,
                        uint32_t first, uint32_t count)
{
    const nook_query_match *match = &entry->query->matches[match_index];
    rows->count = count;
    rows->entities = match->table->entities + first;
    for (uint32_t i = 0; i < entry->query->term_count; i++)
        rows->columns[i] = nook_table_at(match->table, match->columns[i], first);
    call(world, entry, rows);
}

static void run_system(nook_world *world, const nook_system_entry *entry)
{
    nook_rows rows = prepare_rows(world, entry);
    if (!entry->query) {
        call(world, entry, &rows);
        return;
    }
    for (uint32_t i = 0; i < entry->query->match_count; i++) {
        uint32_t count = entry->query->matches[i].table->count;
        if (count > 0)
            run_stretch(world, entry, &rows, i, 0, count);
    }
}

/* ---- a batch on several threads ---- */

/* May its rows be divided between workers? */
static bool divisible(const nook_system_entry *entry)
{
    return entry->query && entry->resources_written == 0 && !entry->system.structural;
}

static bool add_item(nook_world *world, uint32_t *count, nook_work_item item)
{
    nook_work_item *items = nook_ecs_grow(world->items, &world->item_capacity, (uint64_t)*count + 1, sizeof *items);
    if (!items)
        return false;
    world->items = items;
    items[(*count)++] = item;
    return true;
}

static bool divide_rows(nook_world *world, const nook_system_entry *entry, uint32_t *count)
{
    for (uint32_t i = 0; i < entry->query->match_count; i++) {
        uint32_t rows = entry->query->matches[i].table->count;
        for (uint32_t first = 0, piece = 0; first < rows; first += piece) {
            piece = rows - first < PIECE_ROWS ? rows - first : PIECE_ROWS;
            if (!add_item(world, count, (nook_work_item){ entry, i, first, piece }))
                return false;
        }
    }
    return true;
}

static bool in_batch(const nook_system_entry *entry, nook_phase phase, uint32_t batch)
{
    return entry->system.phase == phase && entry->batch == batch;
}

/* Whole systems first: they are the longest pieces. @return false without memory; the batch can run in order then */
static bool list_work(nook_world *world, nook_phase phase, uint32_t batch, uint32_t *out_count)
{
    uint32_t count = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t i = 0; i < world->system_count; i++) {
            const nook_system_entry *entry = world->systems[i];
            if (!in_batch(entry, phase, batch) || divisible(entry) != (pass == 1))
                continue;
            if (pass == 0 ? !add_item(world, &count, (nook_work_item){ .entry = entry, .match = NOOK_INDEX_NONE })
                          : !divide_rows(world, entry, &count))
                return false;
        }
    }
    *out_count = count;
    return true;
}

static void run_items(void *user, size_t first, size_t last, unsigned worker)
{
    (void)worker;
    nook_world *world = user;
    for (size_t i = first; i < last; i++) {
        const nook_work_item *item = &world->items[i];
        if (item->match == NOOK_INDEX_NONE) {
            run_system(world, item->entry);
        } else {
            nook_rows rows = prepare_rows(world, item->entry);
            run_stretch(world, item->entry, &rows, item->match, item->first, item->count);
        }
    }
}

static bool worth_threads(const nook_world *world, nook_phase phase, uint32_t batch)
{
    uint64_t rows = 0;
    for (uint32_t i = 0; i < world->system_count && world->desc.threads > 1; i++) {
        if (in_batch(world->systems[i], phase, batch) && world->systems[i]->query)
            rows += nook_query_count(world->systems[i]->query);
    }
    return rows >= PARALLEL_ROWS_MIN;
}

static nook_result run_batch(nook_world *world, nook_phase phase, uint32_t batch)
{
    uint32_t count = 0;
    world->locks++;
    if (worth_threads(world, phase, batch) && list_work(world, phase, batch, &count)) {
        nook_parallel_for(count, world->desc.threads, run_items, world);
    } else {
        for (uint32_t i = 0; i < world->system_count; i++) {
            if (in_batch(world->systems[i], phase, batch))
                run_system(world, world->systems[i]);
        }
    }
    world->locks--;
    return nook_commands_apply(&world->commands);
}

nook_result nook_world_run_phase(nook_world *world, nook_phase phase)
{
    assert(world->locks == 0 && "a phase is run between systems and walks");
    uint32_t batch_count = 0;
    for (uint32_t i = 0; i < world->system_count; i++) {
        if (world->systems[i]->system.phase == phase && world->systems[i]->batch >= batch_count)
            batch_count = world->systems[i]->batch + 1;
    }
    nook_result result = NOOK_OK;
    for (uint32_t batch = 0; batch < batch_count; batch++) {
        nook_result batch_result = run_batch(world, phase, batch);
        if (result == NOOK_OK)
            result = batch_result;
    }
    return result;
}
