/**
 * silhouettes.h - which pixels stand beside a silhouette, and on which side: where halos and leaks are looked for.
 *
 * A silhouette runs between two neighbouring pixels (left and right, or above each other) when one shows nothing or when no
 * surface may reach from one to the other (engine/core/surface.h). The nearer of the two is inside of it, the other outside.
 * Edges and corners of one surface and slanted ones are none, nor is the border of the picture.
 */
#pragma once
#include "modules/measure/instability.h"
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How far a silhouette reaches: pixels between centres. It is what the filter reaches at its initial radius. */
#define NOOK_SILHOUETTE_PIXELS 4

enum {
    NOOK_SILHOUETTE_EMPTY = 0,  /**< Shows nothing. */
    NOOK_SILHOUETTE_AWAY = 1,   /**< No silhouette within reach. */
    NOOK_SILHOUETTE_INSIDE = 2, /**< On the near side of the nearest silhouette. */
    NOOK_SILHOUETTE_OUTSIDE = 3 /**< On its far side; also where both are as near. */
};

/**
 * Marks each pixel as one of the above.
 * @param seen       its view_from_world turns the normals only: the camera may stand anywhere
 * @param out_marks  width * height
 * @return NOOK_E_MEMORY; untouched then
 */
nook_result nook_silhouettes_mark(const nook_seen *seen, uint8_t *out_marks);

/**
 * One side as a mask for nook_errors_measure and its like: 1 where `marks` is `side`, else 0.
 * @param side  NOOK_SILHOUETTE_*
 */
void nook_silhouettes_mask(const uint8_t *marks, size_t pixels, uint8_t side, uint8_t *out_mask);

#ifdef __cplusplus
}
#endif
