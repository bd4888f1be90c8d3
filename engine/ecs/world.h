/**
 * world.h - entities, their components, and resources. docs/ecs.md tells how it works and what it costs.
 *
 * Entities with the same set of component types share a table of parallel arrays; adding or removing a component moves
 * the entity to another table. Components are plain data: moved with memcpy, never constructed or destroyed.
 *
 * Threads  one world is used by one thread at a time; systems (system.h) may be run on several by the world itself.
 * Pointers to components hold until the next structural change: create, destroy, add, remove, running a phase.
 * Structural changes while a query is being walked or a system runs are our error and asserted; see commands.h.
 */
#pragma once
#include "engine/core/result.h"
#include "engine/ecs/type.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_world nook_world;

/** A handle: index in the low 32 bits, generation above them. id 0 is none. An id never comes back. */
typedef struct nook_entity {
    uint64_t id;
} nook_entity;

/** A component type of one world; id 0 is none. */
typedef struct nook_component {
    uint32_t id;
} nook_component;

enum {
    NOOK_COMPONENTS_MAX = 255, /**< Component types in a world. */
    NOOK_RESOURCES_MAX = 64    /**< Resource types in a world. */
};

typedef struct nook_world_desc {
    unsigned threads;  /**< For running systems. 0 = all cores, 1 = none but the caller's. */
    bool check_access; /**< Asserts after every system that what it declared as read is unchanged. Slow; for tests. */
} nook_world_desc;

/** @param desc  NULL for the defaults. @return NOOK_E_MEMORY; *out_world is NULL then */
nook_result nook_world_create(const nook_world_desc *desc, nook_world **out_world);
void nook_world_destroy(
    nook_world *world); /**< NULL is allowed. Frees components and resources; runs no code of theirs. */

/**
 * Finds a component type, or registers it at first sight.
 * @return NOOK_E_VERSION known with another size or alignment; NOOK_E_MEMORY, also beyond NOOK_COMPONENTS_MAX
 */
nook_result nook_world_component(nook_world *world, const nook_type *type, nook_component *out_component);

/**
 * Gives the world its one resource of a type, or overwrites it. The address stays the same for the world's life.
 * @param value  copied; NULL for zeroes
 * @return NOOK_E_VERSION, NOOK_E_MEMORY, as nook_world_component
 */
nook_result nook_world_set_resource(nook_world *world, const nook_type *type, const void *value);
/** @return the resource, or NULL when there is none of that type */
void *nook_world_resource(nook_world *world, const nook_type *type);

uint32_t nook_world_entity_count(const nook_world *world); /**< Alive now. */
uint32_t nook_world_table_count(const nook_world *world);  /**< Component sets seen so far, the empty one included. */

/**
 * Makes entities that have `components`, all zero.
 * @param components       no type twice; NULL when component_count is 0
 * @param out_entities     count of them, untouched on failure; NULL when nobody asks
 * @return NOOK_E_MEMORY; nothing was made then
 */
nook_result nook_entity_create(nook_world *world, const nook_component *components, uint32_t component_count,
                               uint32_t count, nook_entity *out_entities);

/** @return NOOK_E_NOT_FOUND a stale handle */
nook_result nook_entity_destroy(nook_world *world, nook_entity entity);
bool nook_entity_alive(const nook_world *world, nook_entity entity);

/**
 * Gives an entity a component, or overwrites the one it has.
 * @param value  copied; NULL for zeroes; must not point into the world's own components
 * @return NOOK_E_NOT_FOUND a stale handle; NOOK_E_MEMORY; nothing changed then
 */
nook_result nook_entity_add(nook_world *world, nook_entity entity, nook_component component, const void *value);

/** Does nothing when the entity lacks it. @return NOOK_E_NOT_FOUND a stale handle; NOOK_E_MEMORY */
nook_result nook_entity_remove(nook_world *world, nook_entity entity, nook_component component);

/** @return the entity's component, or NULL when it has none or the handle is stale */
void *nook_entity_find(nook_world *world, nook_entity entity, nook_component component);
bool nook_entity_has(const nook_world *world, nook_entity entity, nook_component component);

#ifdef __cplusplus
}
#endif
