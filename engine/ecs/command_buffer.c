#include "engine/core/log.h"
#include "engine/ecs/internal.h"
#include <stdlib.h>
#include <string.h>

typedef enum command_kind { COMMAND_CREATE, COMMAND_DESTROY, COMMAND_ADD, COMMAND_REMOVE } command_kind;

/* Stands in the buffer, followed by value_size bytes, rounded up so that the next one is aligned. */
typedef struct command {
    nook_entity entity;
    uint32_t kind;
    uint32_t component;
    uint32_t value_size; /* 0 for COMMAND_ADD: zeroes */
} command;

enum { COMMAND_ALIGN = _Alignof(command), BUFFER_FIRST_CAPACITY = 4096 };

static size_t padded(size_t size)
{
    return (size + COMMAND_ALIGN - 1) / COMMAND_ALIGN * COMMAND_ALIGN;
}

/* ---- recording ---- */

static bool reserve(nook_commands *commands, size_t extra)
{
    if (commands->out_of_memory)
        return false;
    size_t needed = commands->size + extra;
    if (needed <= commands->capacity)
        return true;
    size_t capacity = commands->capacity ? commands->capacity : BUFFER_FIRST_CAPACITY;
    while (capacity < needed)
        capacity *= 2;
    uint8_t *bytes = realloc(commands->bytes, capacity);
    if (!bytes) {
        commands->out_of_memory = true;
        return false;
    }
    commands->bytes = bytes;
    commands->capacity = capacity;
    return true;
}

static bool record(nook_commands *commands, command head, const void *value)
{
    size_t size = padded(sizeof head) + padded(head.value_size);
    if (!reserve(commands, size))
        return false;
    uint8_t *at = commands->bytes + commands->size;
    memcpy(at, &head, sizeof head);
    if (value)
        memcpy(at + padded(sizeof head), value, head.value_size);
    commands->size += size;
    return true;
}

nook_entity nook_commands_create(nook_commands *commands)
{
    nook_entity entity = nook_entity_reserve(commands->world);
    if (entity.id == 0) {
        commands->out_of_memory = true;
    } else if (!record(commands, (command){ .entity = entity, .kind = COMMAND_CREATE }, NULL)) {
        nook_entity_release(commands->world, entity);
        entity.id = 0;
    }
    return entity;
}

void nook_commands_destroy(nook_commands *commands, nook_entity entity)
{
    record(commands, (command){ .entity = entity, .kind = COMMAND_DESTROY }, NULL);
}

static void assert_allowed(const nook_commands *commands, nook_component component)
{
    assert(component.id > 0 && component.id < commands->world->type_count && "not a component of this world");
    assert(nook_mask_has(commands->allowed, component.id) && "the system does not say that it changes this type");
    (void)commands, (void)component;
}

void nook_commands_add(nook_commands *commands, nook_entity entity, nook_component component, const void *value)
{
    assert_allowed(commands, component);
    uint32_t size = value ? commands->world->types[component.id].size : 0;
    record(commands, (command){ .entity = entity, .kind = COMMAND_ADD, .component = component.id, .value_size = size },
           value);
}

void nook_commands_remove(nook_commands *commands, nook_entity entity, nook_component component)
{
    assert_allowed(commands, component);
    record(commands, (command){ .entity = entity, .kind = COMMAND_REMOVE, .component = component.id }, NULL);
}

/* ---- carrying out ---- */

static const command *command_at(const nook_commands *commands, size_t at)
{
    return (const command *)(const void *)(commands->bytes + at);
}

static size_t next_command(const nook_commands *commands, size_t at)
{
    return at + padded(sizeof(command)) + padded(command_at(commands, at)->value_size);
}

static size_t end_of_group(const nook_commands *commands, size_t first)
{
    uint64_t id = command_at(commands, first)->entity.id;
    size_t at = first;
    while (at < commands->size && command_at(commands, at)->entity.id == id)
        at = next_command(commands, at);
    return at;
}

static void destroy(nook_world *world, nook_entity entity, const nook_entity_record *place)
{
    if (place->table != NOOK_TABLE_PENDING)
        nook_entity_take_row(world, world->tables[place->table], place->row);
    nook_entity_release(world, entity);
}

/* Where the changes lead. @return false without memory */
static bool find_end(const nook_commands *commands, size_t first, size_t last, nook_table **table, bool *out_destroyed)
{
    for (size_t at = first; at < last; at = next_command(commands, at)) {
        const command *c = command_at(commands, at);
        if (c->kind == COMMAND_ADD)
            *table = nook_archetype_with(commands->world, *table, c->component);
        else if (c->kind == COMMAND_REMOVE)
            *table = nook_archetype_without(commands->world, *table, c->component);
        if (c->kind == COMMAND_DESTROY) {
            *out_destroyed = true;
            return true;
        }
        if (!*table)
            return false;
    }
    return true;
}

static void write_values(const nook_commands *commands, size_t first, size_t last, nook_table *table, uint32_t row)
{
    for (size_t at = first; at < last; at = next_command(commands, at)) {
        const command *c = command_at(commands, at);
        if (c->kind != COMMAND_ADD || table->column_of[c->component] == NOOK_TABLE_NONE)
            continue; /* added and removed again */
        const uint8_t *value = commands->bytes + at + padded(sizeof *c);
        nook_table_write(table, table->column_of[c->component], row, c->value_size ? value : NULL);
    }
}

/* All changes to one entity that stand together, with one move of its data. Every column that the entity's new table
 * has and its old one lacks comes from an add, so that write_values leaves none of them unwritten. */
static bool apply_group(nook_commands *commands, size_t first, size_t last)
{
    nook_world *world = commands->world;
    nook_entity entity = command_at(commands, first)->entity;
    const nook_entity_record *place = nook_entity_record_of(world, entity);
    if (!place)
        return true;
    bool pending = place->table == NOOK_TABLE_PENDING, destroyed = false;
    nook_table *table = world->tables[pending ? 0 : place->table];
    bool found = find_end(commands, first, last, &table, &destroyed);
    if (destroyed) {
        destroy(world, entity, place);
        return true;
    }
    if (!found || (table->index != place->table && !nook_entity_move(world, entity, table))) {
        if (pending)
            nook_entity_release(world, entity);
        return false;
    }
    write_values(commands, first, last, table, place->row);
    return true;
}

nook_result nook_commands_apply(nook_commands *commands)
{
    bool complete = !commands->out_of_memory;
    size_t last = 0;
    for (size_t first = 0; first < commands->size; first = last) {
        last = end_of_group(commands, first);
        complete = apply_group(commands, first, last) && complete;
    }
    commands->size = 0;
    commands->out_of_memory = false;
    return complete ? NOOK_OK : nook_fail(NOOK_E_MEMORY, "world: no memory for all changes that systems asked for");
}
