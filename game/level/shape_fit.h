#pragma once
#include "engine/asset/scene.h"
#include "engine/physics/physics.h"
#include "game/level/level.h"

/**
 * A simple shape around a mesh, in the space of a body that has the node's rotation but not its scale.
 * @param scale   of the node, along the mesh's axes
 * @param wanted  AUTO: the simplest that fits
 */
void nook_level_shape_fit(const nook_scene *scene, uint32_t mesh, const double scale[3], nook_level_shape wanted,
                          nook_shape *out);
