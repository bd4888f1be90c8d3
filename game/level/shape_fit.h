#pragma once
#include "engine/asset/scene.h"
#include "engine/physics/physics.h"
#include "game/level/level.h"

/**
 * A simple shape around a mesh, in the space of a body that has the node's rotation but not its scale. Its ends are those of the
 * mesh, so that what stands in the picture stands in the physics; where a round shape lies on its side, it goes through the mean
 * of a polygon's corners and edges.
 * @param scale   of the node, along the mesh's axes; negative ones mirror
 * @param wanted  BOX, CYLINDER (about the axis around which the mesh is roundest) and SPHERE are taken as they are; all others,
 *                AUTO for one: a sphere when the mesh fills one, else a cylinder when it is round about an axis, else a box
 * @param out     no thinner than 2 mm; at the origin for a mesh that draws nothing
 */
void nook_level_shape_fit(const nook_scene *scene, uint32_t mesh, const double scale[3], nook_level_shape wanted,
                          nook_shape *out);
