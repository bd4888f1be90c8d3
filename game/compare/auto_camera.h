#pragma once
#include "engine/asset/scene.h"
#include "engine/render/renderer.h"

/** Where a ray first meets the scene. */
typedef struct nook_view_hit {
    double distance; /**< In lengths of `direction`; infinite when nothing is met. */
    bool front;      /**< The side that the triangle shows; false from behind. */
} nook_view_hit;

/** Asks every triangle: for the few rays that choosing a view takes. @param origin, direction  world, metres */
nook_view_hit nook_scene_cast(const nook_scene *scene, const double origin[3], const double direction[3]);

/** Of the picture's surfaces, the part that shows its back: what a room shows to those outside. */
double nook_view_back_fraction(const nook_scene *scene, const nook_camera *view, double aspect);

/**
 * The whole scene from outside: from three quarters, or from where least of it turns its back. In pictures with sides beyond
 * 4 : 1 it takes a good part of the long side, and the short one shows a strip of it.
 */
nook_camera nook_camera_outside(const nook_scene *scene, double aspect);

/**
 * A view from inside, for scenes that are rooms: walls around their middle, and hidden from `outside`.
 * @param outside  the view from outside that would be taken otherwise
 * @return false when the scene is no room; *out_camera is untouched then
 */
bool nook_camera_inside(const nook_scene *scene, const nook_camera *outside, nook_camera *out_camera);
