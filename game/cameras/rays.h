/**
 * rays.h - many rays through a scene as it stands in its file: for finding places to look from.
 */
#pragma once
#include "game/compare/auto_camera.h"

typedef struct nook_rays nook_rays;

/**
 * Takes all triangles of the scene's nodes, in the world, but blended ones. @return NOOK_E_MEMORY, NOOK_E_DEVICE; *out_rays is NULL then
 */
nook_result nook_rays_create(const nook_scene *scene, nook_rays **out_rays);
void nook_rays_destroy(nook_rays *rays); /**< NULL is allowed. */

/** As nook_scene_cast, with a tree; double-sided surfaces have only fronts. @param origin, direction  world, metres */
nook_view_hit nook_rays_cast(const nook_rays *rays, const double origin[3], const double direction[3]);

/** Whether nothing stands between two points. */
bool nook_rays_see(const nook_rays *rays, const double from[3], const double to[3]);
