#pragma once
#include "engine/render/renderer.h"
#include "modules/measure/instability.h"

struct nook_stage;
struct nook_comparison;

/** The camera that a comparison's steadiness is measured with: the first one turned around what it looks at. */
typedef struct nook_second_view {
    bool measured;      /**< false: not asked for; all else is zero then. */
    nook_camera camera; /**< The second. */
    double degrees;     /**< Of the turn; > 0: the camera went to its right. */
    double distance;    /**< Metres from the first camera to the point it was turned around, straight ahead. */
    uint64_t shared;    /**< Pixels of the first view whose points the second sees too. */
} nook_second_view;

/**
 * Turns a camera around the point `distance` metres straight ahead of it, about the vertical of its picture, so that the
 * point stays in the middle and as far away.
 * @param degrees  > 0: the camera goes to its right
 */
nook_camera nook_camera_turn(const nook_camera *camera, double distance, double degrees);

/**
 * Median of the distances in the middle ninth of a picture, or in all of it when nothing is in the middle.
 * @param distances  metres, width * height, 0 where nothing is
 * @return NOOK_E_NOT_FOUND nothing anywhere, NOOK_E_MEMORY
 */
nook_result nook_middle_distance(const float *distances, uint32_t width, uint32_t height, double *out_distance);

/**
 * Chooses the second camera: 20 degrees to the side from which more of the same points are seen; 10, then 5, where that leaves
 * less than a quarter of them. The stage's frame is another camera's afterwards.
 * @param out_match  from the first camera's pixels to the second's; owned by the caller
 * @return NOOK_E_NOT_FOUND the camera sees nothing, NOOK_E_MEMORY, or why drawing failed; both untouched then
 */
nook_result nook_second_view_choose(struct nook_stage *stage, const nook_camera *camera, nook_second_view *out_view,
                                    nook_match *out_match);

/**
 * Records every technique of a finished comparison again for a second camera and fills in `second` and each row's
 * `instability`. The stage's frame is that of the first camera again afterwards.
 * @return NOOK_E_MEMORY, or why a technique failed
 */
nook_result nook_compare_steadiness(struct nook_stage *stage, struct nook_comparison *comparison);
