#include "engine/core/log.h"
#include "engine/ecs/internal.h"
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- ids ---- */

static nook_entity make_id(uint32_t index, uint32_t generation)
{
    return (nook_entity){ (uint64_t)generation << 32 | index };
}

uint32_t nook_entity_index(nook_entity entity)
{
    return (uint32_t)entity.id;
}

nook_entity_record *nook_entity_record_of(const nook_world *world, nook_entity entity)
{
    uint32_t index = nook_entity_index(entity);
    if (index >= world->record_count)
        return NULL;
    nook_entity_record *record = &world->records[index];
    /* The table is asked too: a made-up handle may carry the generation that a free record will have next. */
    return record->generation == entity.id >> 32 && record->table != NOOK_INDEX_NONE ? record : NULL;
}

/* The record of an entity that is in a table. */
static const nook_entity_record *find_placed(const nook_world *world, nook_entity entity)
{
    const nook_entity_record *record = nook_entity_record_of(world, entity);
    return record && record->table != NOOK_TABLE_PENDING ? record : NULL;
}

static bool reserve_records(nook_world *world, uint64_t extra)
{
    nook_entity_record *records =
        nook_ecs_grow(world->records, &world->record_capacity, world->record_count + extra, sizeof *records);
    if (records)
        world->records = records;
    return records != NULL;
}

/* After reserve_records. Freed indices first, the latest first: their records are likely in the cache. */
static nook_entity take_id(nook_world *world)
{
    uint32_t index = world->first_free;
    if (index != NOOK_INDEX_NONE) {
        world->first_free = world->records[index].row;
    } else {
        index = world->record_count++;
        world->records[index].generation = 1;
    }
    world->records[index].table = NOOK_TABLE_PENDING;
    return make_id(index, world->records[index].generation);
}

nook_entity nook_entity_reserve(nook_world *world)
{
    if (world->first_free == NOOK_INDEX_NONE && !reserve_records(world, 1))
        return (nook_entity){ 0 };
    return take_id(world);
}

void nook_entity_release(nook_world *world, nook_entity entity)
{
    uint32_t index = nook_entity_index(entity);
    nook_entity_record *record = &world->records[index];
    record->table = NOOK_INDEX_NONE;
    record->generation++;
    if (record->generation == 0)
        return; /* all generations are used up: the index retires, so that no id ever comes back */
    record->row = world->first_free;
    world->first_free = index;
}

/* ---- rows ---- */

void nook_entity_take_row(nook_world *world, nook_table *table, uint32_t row)
{
    nook_entity moved = nook_table_remove_row(table, row);
    if (moved.id != 0)
        world->records[nook_entity_index(moved)].row = row;
    world->alive_count--;
}

bool nook_entity_move(nook_world *world, nook_entity entity, nook_table *to)
{
    nook_entity_record *record = nook_entity_record_of(world, entity);
    assert(record && to->index != record->table);
    if (!nook_table_reserve(to, (uint64_t)to->count + 1))
        return false;
    uint32_t row = to->count++;
    to->entities[row] = entity;
    world->alive_count++;
    if (record->table != NOOK_TABLE_PENDING) {
        nook_table *from = world->tables[record->table];
        nook_table_copy_row(to, row, from, record->row);
        nook_entity_take_row(world, from, record->row);
    }
    record->table = to->index;
    record->row = row;
    return true;
}

static void assert_unlocked(const nook_world *world)
{
    assert(world->locks == 0 && "structure changed during a walk or from a system: use nook_commands");
    (void)world;
}

/* ---- creating and destroying ---- */

static nook_table *find_table_of(nook_world *world, const nook_component *components, uint32_t component_count)
{
    nook_table *table = world->tables[0];
    for (uint32_t i = 0; i < component_count && table; i++) {
        assert(!nook_mask_has(&table->mask, components[i].id) && "the same component twice");
        table = nook_archetype_with(world, table, components[i].id);
    }
    return table;
}

/* After all memory is reserved. */
static void append_entities(nook_world *world, nook_table *table, uint32_t count)
{
    for (uint32_t i = 0; i < table->column_count; i++)
        memset(nook_table_at(table, i, table->count), 0, (size_t)count * table->columns[i].size);
    for (uint32_t i = 0; i < count; i++) {
        nook_entity entity = take_id(world);
        nook_entity_record *record = &world->records[nook_entity_index(entity)];
        record->table = table->index;
        record->row = table->count;
        table->entities[table->count++] = entity;
    }
    world->alive_count += count;
}

nook_result nook_entity_create(nook_world *world, const nook_component *components, uint32_t component_count,
                               uint32_t count, nook_entity *out_entities)
{
    assert_unlocked(world);
    if (count == 0)
        return NOOK_OK;
    nook_table *table = find_table_of(world, components, component_count);
    /* Room for all as if no index were free: counting the free list would cost more than the memory. */
    if (!table || !reserve_records(world, count) || !nook_table_reserve(table, (uint64_t)table->count + count))
        return nook_fail(NOOK_E_MEMORY, "world: no memory for %u more entities besides %u", count, world->alive_count);
    append_entities(world, table, count);
    if (out_entities)
        memcpy(out_entities, table->entities + (table->count - count), count * sizeof *out_entities);
    return NOOK_OK;
}

static nook_result fail_stale(nook_entity entity, const char *action)
{
    return nook_fail(NOOK_E_NOT_FOUND, "entity %" PRIu32 " of generation %" PRIu32 ": does not exist (any more); %s",
                     nook_entity_index(entity), (uint32_t)(entity.id >> 32), action);
}

nook_result nook_entity_destroy(nook_world *world, nook_entity entity)
{
    assert_unlocked(world);
    const nook_entity_record *record = find_placed(world, entity);
    if (!record)
        return fail_stale(entity, "not destroyed");
    nook_entity_take_row(world, world->tables[record->table], record->row);
    nook_entity_release(world, entity);
    return NOOK_OK;
}

bool nook_entity_alive(const nook_world *world, nook_entity entity)
{
    return find_placed(world, entity) != NULL;
}

/* ---- components of one entity ---- */

nook_result nook_entity_add(nook_world *world, nook_entity entity, nook_component component, const void *value)
{
    assert_unlocked(world);
    const nook_entity_record *record = find_placed(world, entity);
    if (!record)
        return fail_stale(entity, "no component added");
    nook_table *table = nook_archetype_with(world, world->tables[record->table], component.id);
    if (!table || (table->index != record->table && !nook_entity_move(world, entity, table)))
        return nook_fail(NOOK_E_MEMORY, "world: no memory to add %s", world->types[component.id].name);
    nook_table_write(table, table->column_of[component.id], record->row, value);
    return NOOK_OK;
}

nook_result nook_entity_remove(nook_world *world, nook_entity entity, nook_component component)
{
    assert_unlocked(world);
    const nook_entity_record *record = find_placed(world, entity);
    if (!record)
        return fail_stale(entity, "no component removed");
    nook_table *table = nook_archetype_without(world, world->tables[record->table], component.id);
    if (!table || (table->index != record->table && !nook_entity_move(world, entity, table)))
        return nook_fail(NOOK_E_MEMORY, "world: no memory to remove %s", world->types[component.id].name);
    return NOOK_OK;
}

void *nook_entity_find(nook_world *world, nook_entity entity, nook_component component)
{
    assert(component.id > 0 && component.id < world->type_count && "not a component of this world");
    const nook_entity_record *record = find_placed(world, entity);
    if (!record)
        return NULL;
    const nook_table *table = world->tables[record->table];
    uint8_t column = table->column_of[component.id];
    return column == NOOK_TABLE_NONE ? NULL : nook_table_at(table, column, record->row);
}

bool nook_entity_has(const nook_world *world, nook_entity entity, nook_component component)
{
    assert(component.id > 0 && component.id < world->type_count && "not a component of this world");
    const nook_entity_record *record = find_placed(world, entity);
    return record && nook_mask_has(&world->tables[record->table]->mask, component.id);
}
