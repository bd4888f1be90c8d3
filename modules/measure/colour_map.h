/**
 * colour_map.h - signed errors as colours.
 *
 * Diverging and symmetric: near white at 0, blue where visibility is too high (missed occlusion), red where it is too low
 * (darkened without cause). Made in OKLab (Ottosson 2020) so that equal steps of error look like equal steps of colour, and
 * so that equal errors of either sign have equal lightness.
 */
#pragma once
#include "modules/measure/picture.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Errors of this size and more get the strongest colour, when nothing else is asked for. */
#define NOOK_ERROR_RANGE_DEFAULT 0.25f

/** @param error  visibility - reference @param range  > 0; errors beyond +-range are clamped. NaN gives magenta */
nook_rgb nook_error_colour(float error, float range);

/**
 * Amounts (counts, costs) as colours: from near black over violet and orange to near white, lightness rising evenly, in OKLab.
 * @param share  of the strongest; clamped to [0, 1]. NaN gives green
 */
nook_rgb nook_amount_colour(float share);

/** What stands where there is no geometry: a grey that the map never gives. */
nook_rgb nook_error_no_geometry(void);

/**
 * The signed error of each pixel as a picture. All arrays are width * height, bottom row first.
 * @param mask  not 0 = geometry; NULL = everywhere
 * @return like nook_picture_create
 */
nook_result nook_error_picture(const float *visibility, const float *reference, const uint8_t *mask, uint32_t width,
                               uint32_t height, float range, nook_picture *out_picture);

/** Draws the scale as a horizontal bar: -range at the left, +range at the right, with a thin frame. */
void nook_error_scale_draw(nook_picture *picture, int x, int y, int width, int height, nook_rgb frame);

#ifdef __cplusplus
}
#endif
