/**
 * scene_join.h - several scenes as one: for a level that stands in one file and takes its things from others.
 */
#pragma once
#include "engine/asset/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A scene that goes into another. */
typedef struct nook_scene_part {
    nook_scene *scene; /**< Stays the caller's, but the pixels of its images move to the joined one. */
    bool nodes; /**< Its nodes, cameras and lights come as they stand. false: only what they draw, for instances. */
} nook_scene_part;

/** A node more than the parts have: draws what one of their nodes draws, elsewhere. A root. */
typedef struct nook_scene_instance {
    const char *name;
    uint32_t part, node; /**< Whose mesh; a node with a mesh. */
    nook_matrix world_from_local;
    bool moving;
} nook_scene_instance;

/**
 * Joins scenes: arrays follow one another in the order of the parts, nodes of instances come last, with mass and hung of the
 * nodes that they repeat. Warnings stay with the parts.
 * @param path            of the result, for messages
 * @param part_count      at least 1
 * @param instances       NULL for none
 * @return NOOK_E_MEMORY; NOOK_E_RANGE more vertices or indices than 32 bits count; NOOK_E_FORMAT too large;
 *         *out_scene is NULL then, and the parts are to be destroyed
 */
nook_result nook_scene_join(const char *path, const nook_scene_part *parts, uint32_t part_count,
                            const nook_scene_instance *instances, uint32_t instance_count, nook_scene **out_scene);

#ifdef __cplusplus
}
#endif
