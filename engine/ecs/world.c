#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "engine/ecs/internal.h"
#include <stdlib.h>
#include <string.h>

static nook_mask no_components(void)
{
    return (nook_mask){ { 0 } };
}

nook_result nook_world_create(const nook_world_desc *desc, nook_world **out_world)
{
    *out_world = NULL;
    nook_world *world = calloc(1, sizeof *world);
    if (!world)
        return nook_fail(NOOK_E_MEMORY, "world: no memory for %zu bytes", sizeof *world);
    if (desc)
        world->desc = *desc;
    if (world->desc.threads == 0)
        world->desc.threads = nook_core_count();
    world->type_count = 1;
    world->first_free = NOOK_INDEX_NONE;
    world->commands.world = world;
    nook_mask none = no_components();
    if (!nook_archetype_find(world, &none)) { /* makes table 0 */
        nook_world_destroy(world);
        return nook_fail(NOOK_E_MEMORY, "world: no memory for its first table");
    }
    *out_world = world;
    return NOOK_OK;
}

void nook_world_destroy(nook_world *world)
{
    if (!world)
        return;
    assert(world->locks == 0 && "destroyed from inside a walk or a system");
    for (uint32_t i = 1; i < world->type_count; i++)
        free((char *)(uintptr_t)world->types[i].name);
    for (uint32_t i = 0; i < world->resource_count; i++) {
        free((char *)(uintptr_t)world->resources[i].type.name);
        free(world->resources[i].data);
    }
    for (uint32_t i = 0; i < world->table_count; i++)
        nook_table_destroy(world->tables[i]);
    for (uint32_t i = 0; i < world->query_count; i++)
        nook_query_free(world->queries[i]);
    for (uint32_t i = 0; i < world->system_count; i++)
        free(world->systems[i]);
    free(world->records);
    free(world->tables);
    free(world->table_slots);
    free(world->queries);
    free(world->systems);
    free(world->commands.bytes);
    free(world->items);
    free(world);
}

void *nook_ecs_grow(void *array, uint32_t *capacity, uint64_t needed, size_t size)
{
    assert(needed > 0);
    if (needed <= *capacity)
        return array;
    uint64_t larger = *capacity ? *capacity : NOOK_FIRST_CAPACITY;
    while (larger < needed)
        larger *= 2;
    if (larger >= NOOK_TABLE_PENDING) /* indices stay below the two special ones */
        larger = NOOK_TABLE_PENDING - 1;
    if (needed > larger)
        return NULL;
    void *grown = realloc(array, (size_t)larger * size);
    if (grown)
        *capacity = (uint32_t)larger;
    return grown;
}

/* ---- types ---- */

static void check_type(const nook_type *type)
{
    assert(type->name && type->name[0]);
    assert(type->size >= 1 && type->size <= NOOK_TYPE_SIZE_MAX);
    assert(type->align >= 1 && type->align <= NOOK_COLUMN_ALIGN && (type->align & (type->align - 1)) == 0);
    (void)type;
}

static nook_result check_same(const nook_type *known, const nook_type *type)
{
    if (known->size != type->size || known->align != type->align)
        return nook_fail(NOOK_E_VERSION,
                         "%s: %u bytes aligned to %u, this world knows %u aligned to %u; rebuild all modules",
                         type->name, type->size, type->align, known->size, known->align);
    return NOOK_OK;
}

/* With its own copy of the name: the module that named it may be unloaded. @return name NULL without memory */
static nook_type copy_type(const nook_type *type)
{
    nook_type copy = *type;
    size_t size = strlen(type->name) + 1;
    char *name = malloc(size);
    if (name)
        memcpy(name, type->name, size);
    copy.name = name;
    return copy;
}

nook_result nook_world_component(nook_world *world, const nook_type *type, nook_component *out_component)
{
    check_type(type);
    for (uint32_t i = 1; i < world->type_count; i++) {
        if (strcmp(world->types[i].name, type->name) != 0)
            continue;
        nook_result result = check_same(&world->types[i], type);
        if (result == NOOK_OK)
            out_component->id = i;
        return result;
    }
    if (world->type_count > NOOK_COMPONENTS_MAX)
        return nook_fail(NOOK_E_MEMORY, "%s: a world has at most %d component types", type->name, NOOK_COMPONENTS_MAX);
    nook_type copy = copy_type(type);
    if (!copy.name)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to register it", type->name);
    out_component->id = world->type_count;
    world->types[world->type_count++] = copy;
    return NOOK_OK;
}

nook_result nook_world_components(nook_world *world, const nook_type *types, uint32_t capacity,
                                  nook_component *out_components, uint32_t *out_count)
{
    uint32_t count = 0;
    while (count < capacity && types[count].name) {
        nook_result result = nook_world_component(world, &types[count], &out_components[count]);
        if (result != NOOK_OK)
            return result;
        count++;
    }
    if (out_count)
        *out_count = count;
    return NOOK_OK;
}

/* ---- resources ---- */

uint32_t nook_world_resource_index(const nook_world *world, const char *name)
{
    for (uint32_t i = 0; i < world->resource_count; i++) {
        if (strcmp(world->resources[i].type.name, name) == 0)
            return i;
    }
    return NOOK_INDEX_NONE;
}

static nook_result add_resource(nook_world *world, const nook_type *type, uint32_t *out_index)
{
    if (world->resource_count == NOOK_RESOURCES_MAX)
        return nook_fail(NOOK_E_MEMORY, "%s: a world has at most %d resources", type->name, NOOK_RESOURCES_MAX);
    size_t rounded = ((size_t)type->size + NOOK_COLUMN_ALIGN - 1) / NOOK_COLUMN_ALIGN * NOOK_COLUMN_ALIGN;
    nook_resource resource = { copy_type(type), aligned_alloc(NOOK_COLUMN_ALIGN, rounded) };
    if (!resource.type.name || !resource.data) {
        free((char *)(uintptr_t)resource.type.name);
        free(resource.data);
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for a resource of %u bytes", type->name, type->size);
    }
    *out_index = world->resource_count;
    world->resources[world->resource_count++] = resource;
    return NOOK_OK;
}

nook_result nook_world_set_resource(nook_world *world, const nook_type *type, const void *value)
{
    check_type(type);
    uint32_t index = nook_world_resource_index(world, type->name);
    nook_result result =
        index == NOOK_INDEX_NONE ? add_resource(world, type, &index) : check_same(&world->resources[index].type, type);
    if (result != NOOK_OK)
        return result;
    if (value)
        memcpy(world->resources[index].data, value, type->size);
    else
        memset(world->resources[index].data, 0, type->size);
    return NOOK_OK;
}

void *nook_world_resource(nook_world *world, const nook_type *type)
{
    uint32_t index = nook_world_resource_index(world, type->name);
    if (index == NOOK_INDEX_NONE)
        return NULL;
    const nook_resource *resource = &world->resources[index];
    assert(resource->type.size == type->size && resource->type.align == type->align && "built against another struct");
    return resource->data;
}

/* ---- counts ---- */

uint32_t nook_world_entity_count(const nook_world *world)
{
    return world->alive_count;
}

uint32_t nook_world_table_count(const nook_world *world)
{
    return world->table_count;
}
