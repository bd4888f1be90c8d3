#pragma once
#include "engine/asset/scene.h"
#include "game/level/level.h"

/**
 * Loads the glTF files of a level and joins them to one scene: all nodes of its scenes, and a node for each entity that is
 * placed or comes from a library, with the entity's name. Bodies, movers and spinners are moving nodes, all others are not.
 * @return why a file cannot be loaded; NOOK_E_NOT_FOUND a node that no file has (level:line, with what is near); NOOK_E_MEMORY;
 *         *out_scene is NULL then
 */
nook_result nook_level_scene_load(const nook_level *level, nook_scene **out_scene);
