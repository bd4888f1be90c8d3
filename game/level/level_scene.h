#pragma once
#include "engine/asset/scene.h"
#include "game/level/level.h"

/**
 * Loads the glTF files of a level and joins them to one scene: all nodes of its scenes, and a node for each entity that comes
 * from a library, with the entity's name. Nodes that an entity places stand there. Bodies, movers and spinners are moving
 * nodes, all others that entities speak of are not.
 * @param options  NULL for the defaults
 * @return why a file cannot be loaded; NOOK_E_NOT_FOUND a node that no file has (level:line, with what is near);
 *         NOOK_E_FORMAT a node that draws nothing or has others below it; NOOK_E_MEMORY; *out_scene is NULL then
 */
nook_result nook_level_scene_load(const nook_level *level, const nook_scene_options *options, nook_scene **out_scene);
