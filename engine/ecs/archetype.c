#include "engine/ecs/internal.h"
#include <stdlib.h>
#include <string.h>

/* Every set of components seen so far has one table, found by its mask in a hash table. That is needed only the first
 * time a component is added to or removed from a set: tables remember where each step leads. */

static uint32_t hash_mask(const nook_mask *mask)
{
    uint64_t hash = 0;
    for (int i = 0; i < NOOK_MASK_BITS / 64; i++) {
        hash = (hash ^ mask->words[i]) * 0x9E3779B97F4A7C15u; /* 2^64 / golden ratio, Knuth 6.4 */
        hash ^= hash >> 32;
    }
    return (uint32_t)hash;
}

/* The slot that holds this set, or the free one where it belongs. */
static uint32_t find_slot(const nook_world *world, const nook_mask *mask)
{
    uint32_t slot = hash_mask(mask) & (world->slot_count - 1);
    for (;;) {
        uint32_t table = world->table_slots[slot];
        if (table == NOOK_INDEX_NONE || memcmp(&world->tables[table]->mask, mask, sizeof *mask) == 0)
            return slot;
        slot = (slot + 1) & (world->slot_count - 1);
    }
}

static bool reserve_slot(nook_world *world)
{
    if ((world->table_count + 1) * 2 <= world->slot_count)
        return true;
    uint32_t slot_count = world->slot_count ? world->slot_count * 2 : 2 * NOOK_FIRST_CAPACITY;
    uint32_t *slots = malloc(slot_count * sizeof *slots);
    if (!slots)
        return false;
    memset(slots, 0xFF, slot_count * sizeof *slots); /* NOOK_INDEX_NONE */
    free(world->table_slots);
    world->table_slots = slots;
    world->slot_count = slot_count;
    for (uint32_t i = 0; i < world->table_count; i++)
        slots[find_slot(world, &world->tables[i]->mask)] = i;
    return true;
}

static nook_table *add_table(nook_world *world, const nook_mask *mask)
{
    nook_table **tables =
        nook_ecs_grow(world->tables, &world->table_capacity, (uint64_t)world->table_count + 1, sizeof(nook_table *));
    if (!tables)
        return NULL;
    world->tables = tables;
    if (!reserve_slot(world) || !nook_query_reserve_match(world))
        return NULL;
    nook_table *table = nook_table_create(world->types, mask);
    if (!table)
        return NULL;
    table->index = world->table_count;
    world->table_slots[find_slot(world, mask)] = table->index;
    world->tables[world->table_count++] = table;
    nook_query_table_added(world, table);
    return table;
}

nook_table *nook_archetype_find(nook_world *world, const nook_mask *mask)
{
    if (world->slot_count > 0) {
        uint32_t table = world->table_slots[find_slot(world, mask)];
        if (table != NOOK_INDEX_NONE)
            return world->tables[table];
    }
    return add_table(world, mask);
}

nook_table *nook_archetype_with(nook_world *world, nook_table *table, uint32_t component)
{
    assert(component > 0 && component < world->type_count && "not a component of this world");
    if (table->add_to[component] != NOOK_INDEX_NONE)
        return world->tables[table->add_to[component]];
    nook_mask mask = table->mask;
    nook_mask_set(&mask, component);
    nook_table *to = nook_archetype_find(world, &mask);
    if (!to)
        return NULL;
    table->add_to[component] = to->index;
    if (to != table)
        to->remove_to[component] = table->index;
    return to;
}

nook_table *nook_archetype_without(nook_world *world, nook_table *table, uint32_t component)
{
    assert(component > 0 && component < world->type_count && "not a component of this world");
    if (table->remove_to[component] != NOOK_INDEX_NONE)
        return world->tables[table->remove_to[component]];
    nook_mask mask = table->mask;
    nook_mask_clear(&mask, component);
    nook_table *to = nook_archetype_find(world, &mask);
    if (!to)
        return NULL;
    table->remove_to[component] = to->index;
    if (to != table)
        to->add_to[component] = table->index;
    return to;
}
