/** scene_stand.h - a scene in one of its poses, before it is used: what a file holds of skinned meshes is in no pose at all. */
#pragma once
#include "engine/asset/scene.h"
#include "engine/core/result.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Puts vertices, nodes, cameras, lights and boxes where a clip has them. What deforms them stays, so that the scene can be
 * stood again, or played. Nodes that nothing moves stay where they are. Nothing to do in a scene without motion.
 * @param clip     into scene->clips; NOOK_NONE: at rest
 * @param seconds  finite; inside the clip as nook_clip_time has it, without a loop
 * @return NOOK_E_MEMORY, NOOK_E_FORMAT a transform is not finite, or it becomes too large: destroy the scene then
 */
nook_result nook_scene_stand(nook_scene *scene, uint32_t clip, double seconds);

/** The same for good: the scene has no deformables, skins and clips afterwards, and is like any other. @return the same */
nook_result nook_scene_stand_still(nook_scene *scene, uint32_t clip, double seconds);

#ifdef __cplusplus
}
#endif
