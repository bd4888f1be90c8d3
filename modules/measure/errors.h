/**
 * errors.h - how far a picture of visibility is from the reference: one definition for every table, sheet and test.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Errors of visibility (not of occlusion A = 1 - visibility, whose signs are the other way round), before any contrast. */
typedef struct nook_errors {
    uint64_t count;      /**< Pixels with geometry: those that were compared. */
    uint64_t non_finite; /**< Of them, how many hold a NaN or an infinity in either picture. */
    bool valid;          /**< count > 0 and non_finite == 0; if false all numbers below are NaN. */
    double rmse;         /**< Root of the mean squared difference. */
    double mae;          /**< Mean absolute difference. */
    double bias;         /**< Mean of visibility - reference: + too bright (missed occlusion), - too dark. */
    double p99;          /**< 99 of 100 pixels differ by at most this: nearest rank, absolute. */
    double max;          /**< Largest absolute difference. */
} nook_errors;

/**
 * Compares two pictures over the pixels that show geometry. Sums are compensated, so the size of the picture does not
 * cost digits; the result does not depend on the order of the rows beyond the last few bits of a double.
 * @param mask  one byte a pixel, not 0 = compare; NULL = all
 * @return NOOK_E_MEMORY; *out_errors untouched. Values that are not finite are no failure: see nook_errors.valid
 */
nook_result nook_errors_measure(const float *visibility, const float *reference, const uint8_t *mask, size_t pixels,
                                nook_errors *out_errors);

#ifdef __cplusplus
}
#endif
