#include "engine/core/log.h"
#include "engine/ecs/internal.h"
#include <stdlib.h>
#include <string.h>

/* @return its place in the order of adding, or NOOK_INDEX_NONE */
static uint32_t find_system(const nook_world *world, const char *name)
{
    for (uint32_t i = 0; i < world->system_count; i++) {
        if (strcmp(world->systems[i]->system.name, name) == 0)
            return i;
    }
    return NOOK_INDEX_NONE;
}

/* ---- what a system declares ---- */

static nook_mask mask_of(const nook_component *components, uint32_t count)
{
    nook_mask mask = { { 0 } };
    for (uint32_t i = 0; i < count; i++)
        nook_mask_set(&mask, components[i].id);
    return mask;
}

static nook_result declare_components(nook_world *world, nook_system_entry *entry)
{
    const nook_system *system = &entry->system;
    nook_component with[NOOK_QUERY_TERMS_MAX], without[NOOK_MAX_ACCESS];
    uint32_t read_count = 0, write_count = 0, without_count = 0, change_count = 0;
    nook_result result = nook_world_components(world, system->reads, NOOK_MAX_ACCESS, with, &read_count);
    if (result == NOOK_OK)
        result = nook_world_components(world, system->writes, NOOK_MAX_ACCESS, with + read_count, &write_count);
    if (result == NOOK_OK)
        result = nook_world_components(world, system->without, NOOK_MAX_ACCESS, without, &without_count);
    if (result == NOOK_OK)
        result = nook_world_components(world, system->changes, NOOK_MAX_ACCESS, entry->change_ids, &change_count);
    if (result != NOOK_OK)
        return result;
    assert((system->structural || change_count == 0) && "a system that changes component sets is structural");
    entry->read_count = read_count;
    entry->reads = mask_of(with, read_count);
    entry->writes = mask_of(with + read_count, write_count);
    entry->changes = mask_of(entry->change_ids, change_count);
    if (read_count + write_count == 0) {
        assert(without_count == 0 && "a system that visits nobody passes nobody over");
        return NOOK_OK;
    }
    return nook_query_make(world, with, read_count + write_count, without, without_count, &entry->query);
}

/* Adds to entry->resources from `count` on. */
static nook_result declare_resources(nook_world *world, nook_system_entry *entry, const nook_type *types,
                                     uint32_t *count, uint64_t *out_bits)
{
    for (uint32_t i = 0; i < NOOK_MAX_ACCESS && types[i].name; i++) {
        uint32_t index = nook_world_resource_index(world, types[i].name);
        if (index == NOOK_INDEX_NONE)
            return nook_fail(NOOK_E_NOT_FOUND, "system %s: the world has no resource %s; set it first",
                             entry->system.name, types[i].name);
        const nook_resource *resource = &world->resources[index];
        if (resource->type.size != types[i].size || resource->type.align != types[i].align)
            return nook_fail(NOOK_E_VERSION,
                             "system %s: resource %s of %u bytes, this world knows %u; rebuild all modules",
                             entry->system.name, types[i].name, types[i].size, resource->type.size);
        uint64_t bit = (uint64_t)1 << index;
        assert(!((entry->resources_read | entry->resources_written) & bit) && "the same resource twice");
        *out_bits |= bit;
        entry->resources[(*count)++] = resource->data;
    }
    return NOOK_OK;
}

static nook_result declare(nook_world *world, nook_system_entry *entry)
{
    uint32_t count = 0;
    nook_result result = declare_resources(world, entry, entry->system.resources, &count, &entry->resources_written);
    if (result == NOOK_OK)
        result = declare_resources(world, entry, entry->system.resources_read, &count, &entry->resources_read);
    return result == NOOK_OK ? declare_components(world, entry) : result;
}

/* ---- who may run together ---- */

static bool touches(const nook_system_entry *writer, const nook_system_entry *other)
{
    return nook_mask_overlaps(&writer->writes, &other->reads) || nook_mask_overlaps(&writer->writes, &other->writes) ||
           (writer->resources_written & (other->resources_read | other->resources_written)) != 0;
}

static bool conflicts(const nook_system_entry *a, const nook_system_entry *b)
{
    return a->system.structural || b->system.structural || touches(a, b) || touches(b, a);
}

/* The first batch behind everything earlier that it conflicts with. Systems of one batch never conflict: of two that do,
 * the later one was put behind. So any order within batches gives what the order of adding gives. */
static uint32_t choose_batch(const nook_world *world, const nook_system_entry *entry, uint32_t place)
{
    uint32_t batch = 0;
    for (uint32_t i = 0; i < place; i++) {
        const nook_system_entry *earlier = world->systems[i];
        if (earlier->system.phase == entry->system.phase && earlier->batch >= batch && conflicts(earlier, entry))
            batch = earlier->batch + 1;
    }
    return batch;
}

/* @return why not; *out_entry is untouched then */
static nook_result make_entry(nook_world *world, const nook_system *system, nook_system_entry **out_entry)
{
    assert(world->locks == 0 && system->name && system->run && system->phase < NOOK_PHASE_COUNT);
    nook_system_entry *entry = calloc(1, sizeof *entry);
    if (!entry)
        return nook_fail(NOOK_E_MEMORY, "system %s: no memory for one more", system->name);
    entry->system = *system;
    nook_result result = declare(world, entry);
    if (result == NOOK_OK)
        *out_entry = entry;
    else
        free(entry);
    return result;
}

/* ---- public ---- */

nook_result nook_world_add_system(nook_world *world, const nook_system *system)
{
    assert(find_system(world, system->name) == NOOK_INDEX_NONE && "a system of this name was added before");
    nook_system_entry **systems = nook_ecs_grow(world->systems, &world->system_capacity,
                                                (uint64_t)world->system_count + 1, sizeof(nook_system_entry *));
    if (!systems)
        return nook_fail(NOOK_E_MEMORY, "system %s: no memory for one more", system->name);
    world->systems = systems;
    nook_system_entry *entry;
    nook_result result = make_entry(world, system, &entry);
    if (result != NOOK_OK)
        return result;
    entry->batch = choose_batch(world, entry, world->system_count);
    world->systems[world->system_count++] = entry;
    return NOOK_OK;
}

nook_result nook_world_replace_system(nook_world *world, const nook_system *system)
{
    uint32_t place = find_system(world, system->name);
    if (place == NOOK_INDEX_NONE)
        return nook_fail(NOOK_E_NOT_FOUND, "system %s: was not added to this world", system->name);
    nook_system_entry *old = world->systems[place], *entry;
    if (old->system.phase != system->phase)
        return nook_fail(NOOK_E_VERSION, "system %s: is of another phase than before; start the program again",
                         system->name);
    nook_result result = make_entry(world, system, &entry);
    if (result != NOOK_OK)
        return result;
    world->systems[place] = entry;
    nook_query_remove(world, old->query);
    free(old);
    for (uint32_t i = place; i < world->system_count; i++) /* those behind it may touch what it touches now */
        world->systems[i]->batch = choose_batch(world, world->systems[i], i);
    return NOOK_OK;
}

nook_result nook_world_system_batch(const nook_world *world, const char *name, uint32_t *out_batch)
{
    uint32_t place = find_system(world, name);
    if (place == NOOK_INDEX_NONE)
        return nook_fail(NOOK_E_NOT_FOUND, "system %s: was not added to this world", name);
    *out_batch = world->systems[place]->batch;
    return NOOK_OK;
}
