/**
 * sample.h - many views of a scene that nobody chose: for measuring what one picture cannot tell.
 */
#pragma once
#include "engine/asset/scene.h"
#include "engine/render/renderer.h"

/**
 * Deterministic views. Where the scene has cameras the views are around these (moved within a few percent of the diagonal, turned
 * about the vertical; around the whole scene for a camera that stands outside of it), else inside a room or around the outside, as game/compare/auto_camera.h tells them apart. A view counts only when
 * it shows a scene and not a wall before its nose: enough of the picture shows something, at distances worth looking at, and not from
 * behind; in rooms only from where one can walk to. That is looked up with rays.
 * The sequence is fixed: the first n of a longer call are the n of a shorter one, and any run of k consecutive views is spread over
 * the scene like any other (low discrepancy), so that some can stand for the others.
 * @param aspect  width / height of the pictures
 * @param first   views to skip: first 0, count 8 and first 8, count 8 share none
 * @param out_cameras  count of them; untouched on failure
 * @return NOOK_E_NOT_FOUND not so many views (the line says why), NOOK_E_MEMORY, NOOK_E_DEVICE
 */
nook_result nook_cameras_sample(const nook_scene *scene, double aspect, uint32_t first, uint32_t count,
                                nook_camera *out_cameras);

/**
 * After how many views the sequence has been to every place once: how many cameras the scene has, 1 without any. Runs of a multiple of
 * it have as many views of each place as one another.
 */
uint32_t nook_cameras_period(const nook_scene *scene);
