#pragma once
#include "engine/ecs/system.h"
#include "engine/ecs/transform.h"
#include "modules/ao/nook_ao.h"

#ifdef __cplusplus
extern "C" {
#endif

/** This entity's body darkens its surroundings. Stands beside a nook_transform. */
typedef struct nook_volume_occluder {
    nook_ao_volume volume; /**< What the volume techniques march; id 0 while the bake or the load is under way. */
    nook_ao_mesh mesh;     /**< What the reference traces; id 0: it does not see this body. */
} nook_volume_occluder;

/** This frame's occluders, in the form nook_ao_submit_occluders takes. A world resource. */
typedef struct nook_occluder_list {
    nook_ao_occluder *items; /**< capacity of them; the host's memory. */
    uint32_t count, capacity;
    uint32_t dropped; /**< Did not fit this frame. */
} nook_occluder_list;

/** Empties the list. */
extern const nook_system nook_clear_occluders;
/** Fills it, in the pre-render phase. Bodies that neither a volume nor a mesh stands for are left out. */
extern const nook_system nook_collect_occluders;

/**
 * Gives the world an empty nook_occluder_list and the two systems above.
 * @param items  capacity of them, borrowed until the world is destroyed
 * @return NOOK_E_VERSION, NOOK_E_MEMORY
 */
nook_result nook_occluders_set_up(nook_world *world, nook_ao_occluder *items, uint32_t capacity);
/** Gives a world that has them the systems of this code, which was loaded anew. @return as nook_world_replace_system */
nook_result nook_occluders_renew(nook_world *world);

#ifdef __cplusplus
}
#endif
