/**
 * sample.h - many views of a scene that nobody chose: for measuring what one picture cannot tell.
 */
#pragma once
#include "engine/render/renderer.h"

struct nook_stage;

/**
 * Deterministic views. Where the scene has cameras the views are around these (moved within a few percent of the diagonal, turned
 * about the vertical), else inside a room or around the outside, as game/compare/auto_camera.h tells them apart. A view counts only when
 * it shows a scene and not a wall before its nose: enough pixels with geometry, at distances worth looking at; that is looked up
 * in small pictures drawn by the stage, whose size and frame are as before afterwards.
 * The sequence is fixed: the first n of a longer call are the n of a shorter one, and any run of k consecutive views is spread over
 * the scene like any other (low discrepancy), so that some can stand for the others.
 * @param stage  filled
 * @param first  views to skip: first 0, count 8 and first 8, count 8 share none
 * @param out_cameras  count of them
 * @return NOOK_E_NOT_FOUND no such views (the line says why)
 */
nook_result nook_cameras_sample(struct nook_stage *stage, uint32_t first, uint32_t count, nook_camera *out_cameras);
