#pragma once
#include "engine/ecs/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Structural changes that a system asks for while it runs; done in the order given right after it, before the next
 * system. A change to an entity that is gone by then is dropped: two reasons to destroy one thing are ordinary.
 * Running out of memory is remembered, and nook_world_run_phase returns it.
 */
typedef struct nook_commands nook_commands;

/** @return a handle that may be given to the calls below and stored now; alive after the system. id 0 out of memory */
nook_entity nook_commands_create(nook_commands *commands);
void nook_commands_destroy(nook_commands *commands, nook_entity entity);
/** As nook_entity_add. @param component  of rows->changes; @param value  copied now; NULL for zeroes */
void nook_commands_add(nook_commands *commands, nook_entity entity, nook_component component, const void *value);
/** As nook_entity_remove. @param component  of rows->changes */
void nook_commands_remove(nook_commands *commands, nook_entity entity, nook_component component);

#ifdef __cplusplus
}
#endif
