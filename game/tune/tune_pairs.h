/**
 * tune_pairs.h - splits views into two sets that see the scene alike.
 */
#pragma once
#include "engine/render/renderer.h"

/**
 * Pairs each view, in their order, with the nearest one that is left, and gives each set one of every pair, turn about. So the first n of
 * one set differ less from the first n of the other than two runs of views would, without having a view in common.
 * @param count  even @param diagonal  of the scene, metres
 * @param out_first, out_second  count / 2 of them each
 */
void nook_tune_pair_views(const nook_camera *views, uint32_t count, double diagonal, nook_camera *out_first,
                          nook_camera *out_second);
