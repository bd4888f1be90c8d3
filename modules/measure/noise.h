/**
 * noise.h - what of a picture is chance: the spread between pictures of one view that differ in their seed only, and the change
 * at the same points along a path.
 */
#pragma once
#include "modules/measure/instability.h"
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_noise {
    uint64_t count;      /**< Pixels with geometry; of a path: shared points of all its pairs of frames. */
    uint64_t non_finite; /**< Of them, how many hold a NaN or an infinity in any picture. */
    bool valid;          /**< count > 0 and non_finite == 0; if false the number below is NaN. */
    double rms;          /**< Root mean square over these; of what, the function says. */
} nook_noise;

/**
 * Noise of one picture: at each pixel the variance between the pictures, unbiased (over picture_count - 1), its mean over the
 * pixels, and the root of that. The order of the pictures makes no difference beyond rounding.
 * @param pictures       picture_count of `pixels` values each
 * @param picture_count  at least 2
 * @param mask           one byte a pixel, not 0 = measure; NULL = all
 */
nook_noise nook_noise_measure(const float *const *pictures, uint32_t picture_count, const uint8_t *mask, size_t pixels);

/**
 * Noise of (first + second) / 2, two halves of one truth with as many rays and seeds of their own: RMS(first - second) / 2.
 * Each half has variance v, their difference 2 v, their mean v / 2.
 */
nook_noise nook_noise_of_mean(const float *first, const float *second, const uint8_t *mask, size_t pixels);

/**
 * Flicker along a path: the change of visibility at the same points from each frame to the next, all points of all pairs of
 * frames pooled, so that a pair counts by how much it shares.
 * @param matches      frame_count - 1; matches[i] brings frame i to frame i + 1 (nook_match_create)
 * @param pictures     frame_count, laid out as the matches have them
 * @param frame_count  at least 2
 */
nook_noise nook_flicker_measure(const nook_match *matches, const float *const *pictures, uint32_t frame_count);

#ifdef __cplusplus
}
#endif
