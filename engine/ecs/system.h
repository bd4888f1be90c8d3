#pragma once
#include "engine/ecs/commands.h"
#include "engine/ecs/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Entities that share a component set, as parallel arrays of `count`. All that a system may touch. */
typedef struct nook_rows {
    uint32_t count;                          /**< 0 only for systems that declare no components. */
    const nook_entity *entities;             /**< count of them. */
    void *columns[NOOK_QUERY_TERMS_MAX];     /**< Reads, then writes, as declared. Reads must not be written. */
    void *resources[2 * NOOK_MAX_ACCESS];    /**< resources, then resources_read, as declared. */
    nook_commands *commands;                 /**< Of structural systems, else NULL. */
    nook_component changes[NOOK_MAX_ACCESS]; /**< As declared. */
} nook_rows;

typedef enum nook_phase { NOOK_PHASE_UPDATE, NOOK_PHASE_PRE_RENDER, NOOK_PHASE_RENDER, NOOK_PHASE_COUNT } nook_phase;

/**
 * A function and what it touches. Lists end at the first empty entry; no type stands in two of them.
 *
 * Systems of a phase take effect in the order they were added. Two of them run at the same time only when neither writes
 * what the other touches, which nobody can tell from running them in order.
 *
 * `run` is called for each table with matching entities, or for several ranges of its rows, at the same time when the
 * system writes no resource; so it may depend on its rows only. Without reads and writes it is called once.
 */
typedef struct nook_system {
    const char *name; /**< "area.verb_noun"; unique in the world. Not copied. */
    nook_phase phase;
    nook_type reads[NOOK_MAX_ACCESS]; /**< Entities that have all of reads and writes are visited. */
    nook_type writes[NOOK_MAX_ACCESS];
    nook_type without[NOOK_MAX_ACCESS];        /**< Entities that have one of these are passed over. */
    nook_type resources[NOOK_MAX_ACCESS];      /**< World-wide, one of each; counted as written. */
    nook_type resources_read[NOOK_MAX_ACCESS]; /**< The same, only read. */
    nook_type changes[NOOK_MAX_ACCESS];        /**< Structural: the component types it adds or removes. */
    bool structural; /**< Creates, destroys or changes entities through rows->commands. Runs alone. */
    void (*run)(const nook_rows *rows);
} nook_system;

/**
 * Adds a system behind those of its phase. The struct is copied.
 * @return NOOK_E_NOT_FOUND a resource that the world has not been given; NOOK_E_VERSION a type of another size;
 *         NOOK_E_MEMORY; nothing was added then
 */
nook_result nook_world_add_system(nook_world *world, const nook_system *system);

/**
 * Puts a system into the place of the one of its name, for code that was loaded anew: the old one's function, name and types
 * are not used any more. It may touch other types than the old one.
 * @return NOOK_E_NOT_FOUND no system of that name, or a resource that the world has not been given; NOOK_E_VERSION a type of another size,
 *         or another phase; NOOK_E_MEMORY; the old one stays then
 */
nook_result nook_world_replace_system(nook_world *world, const nook_system *system);

/** Runs all systems of a phase. @return NOOK_E_MEMORY not all changes that systems asked for could be made */
nook_result nook_world_run_phase(nook_world *world, nook_phase phase);

/**
 * Which systems may share their time: systems of a phase with the same number do.
 * @return NOOK_E_NOT_FOUND no system of that name
 */
nook_result nook_world_system_batch(const nook_world *world, const char *name, uint32_t *out_batch);

#ifdef __cplusplus
}
#endif
