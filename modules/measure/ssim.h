/**
 * ssim.h - mean structural similarity of a picture of visibility and the reference.
 *
 * Wang, Bovik, Sheikh, Simoncelli: "Image quality assessment: from error visibility to structural similarity", IEEE TIP 13(4),
 * 2004: equation 13 in a Gaussian window of 11 x 11 pixels and sigma 1.5, with K1 = 0.01, K2 = 0.03 and L = 1, and its mean
 * (equation 17). Theirs leaves the border of the picture out; here a window is cut to the pixels that count (in the picture and
 * in the mask), and their weights are divided by what is left of 1. So every pixel with geometry has a window of its own, and
 * what stands behind a silhouette where there is nothing never enters.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_ssim {
    uint64_t count;      /**< Pixels with geometry: those that were compared. */
    uint64_t non_finite; /**< Of them, how many hold a NaN or an infinity in either picture. */
    bool valid;          /**< count > 0 and non_finite == 0; if false the mean is NaN. */
    double mean;         /**< 1 for equal pictures, less for all others, at least -1. */
} nook_ssim;

/**
 * Pictures are width * height, row by row; which of the two is the reference makes no difference.
 * @param mask  one byte a pixel, not 0 = compare; NULL = all
 * @return NOOK_E_MEMORY; *out_ssim untouched. Values that are not finite are no failure: see nook_ssim.valid
 */
nook_result nook_ssim_measure(const float *visibility, const float *reference, const uint8_t *mask, uint32_t width,
                              uint32_t height, nook_ssim *out_ssim);

/**
 * What a picture without any error would have against a noisy reference, told from the SSIM of the reference's two halves.
 * Where the truth is flat, noise of variance v is all structure there is: SSIM = C2 / (C2 + v). The reference has v, the difference of
 * its halves 4 v, which gives 4 s / (1 + 3 s). Where the truth has structure of its own noise costs less, and more is left of both.
 * Of a mean over windows with unlike noise it is a little high (the formula bends down).
 */
double nook_ssim_ceiling(double similarity_of_halves);

#ifdef __cplusplus
}
#endif
