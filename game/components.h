#pragma once
#include "engine/ecs/transform.h"
#include "engine/ecs/world.h"
#include "modules/ao/ecs/occluder.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum nook_motion {
    NOOK_MOTION_STATIC, /**< Never moves: walls, floors. May share a volume with its like. */
    NOOK_MOTION_DYNAMIC /**< Moves as one piece, and its volume with it. */
} nook_motion;

typedef struct nook_rigid_body {
    nook_motion motion;
} nook_rigid_body;

/** This entity is drawn. */
typedef struct nook_renderable {
    uint32_t mesh; /**< Into scene->meshes. */
    uint32_t node; /**< Into scene->nodes: where it comes from. */
} nook_renderable;

/** The ids of the game's component types in one world. */
typedef struct nook_components {
    nook_component transform;       /**< nook_transform */
    nook_component rigid_body;      /**< nook_rigid_body */
    nook_component renderable;      /**< nook_renderable */
    nook_component volume_occluder; /**< nook_volume_occluder */
} nook_components;

/** @return NOOK_E_VERSION, NOOK_E_MEMORY; *out_components is untouched then */
nook_result nook_components_register(nook_world *world, nook_components *out_components);

#ifdef __cplusplus
}
#endif
