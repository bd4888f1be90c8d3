/** plan_surface.h - all surfaces that a scene draws, in pieces: boxes of a few decimetres that the planner holds bodies against. */
#pragma once
#include "engine/asset/scene.h"
#include "modules/plan/plan.h"

/**
 * @param occluder_of_node  of each node, whose surface its opaque triangles are; blended ones are nobody's
 * @param r_max             metres, > 0: pieces are no larger than a quarter of it, or a 128th of the scene's diagonal
 * @param out_receivers     the caller's to free
 * @return NOOK_E_MEMORY; untouched then
 */
nook_result nook_plan_surface(const nook_scene *scene, const uint32_t *occluder_of_node, double r_max,
                              nook_plan_receiver **out_receivers, uint32_t *out_count);
