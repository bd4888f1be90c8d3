#pragma once
#include "engine/ecs/system.h"
#include "engine/render/renderer.h"

/** What is drawn this frame. A world resource. */
typedef struct nook_draw_list {
    nook_draw *items; /**< capacity of them; the host's memory. */
    uint32_t count, capacity;
} nook_draw_list;

/**
 * Gives the world an empty nook_draw_list and the systems that empty and fill it in the pre-render phase, from every entity
 * with a transform and a renderable.
 * @param items  capacity of them, one for each such entity at least; borrowed until the world is destroyed
 * @return NOOK_E_VERSION, NOOK_E_MEMORY
 */
nook_result nook_draw_list_set_up(nook_world *world, nook_draw *items, uint32_t capacity);
/** Gives a world that has them the systems of this code, which was loaded anew. @return as nook_world_replace_system */
nook_result nook_draw_list_renew(nook_world *world);
