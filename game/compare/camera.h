#pragma once
#include "engine/asset/scene.h"
#include "engine/render/renderer.h"

/**
 * The camera that a person asked for.
 * @param text       a camera's name, or "px,py,pz,tx,ty,tz,fov" (eye, target, vertical degrees); NULL: the scene's first,
 *                   else from inside a room, else from outside (game/compare/auto_camera.h)
 * @param aspect     width / height
 * @param out_label  what to call it in reports
 * @return NOOK_E_NOT_FOUND no camera of that name (the line lists them); NOOK_E_RANGE numbers that are no view
 */
nook_result nook_camera_choose(const nook_scene *scene, const char *text, double aspect, nook_camera *out_camera,
                               char *out_label, size_t label_capacity);

/** Checks what of `text` needs no scene: seven numbers, when it is numbers. @return NOOK_E_RANGE numbers that are no view */
nook_result nook_camera_check(const char *text);

/** The index-th camera of the scene that the renderer can use (perspective), or NULL. */
const nook_scene_camera *nook_camera_at(const nook_scene *scene, uint32_t index);

/** Metres; of the box of all that is drawn, 1 for an empty one. */
double nook_scene_diagonal(const nook_scene *scene);

/** Looks from eye to target, Y up where that is possible. @return NOOK_E_RANGE when eye and target are one point */
nook_result nook_camera_look(const double eye[3], const double target[3], double fov_y_radians, double z_near,
                             nook_camera *out_camera);
