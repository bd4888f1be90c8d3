/**
 * picture.h - 8-bit pictures for people to look at: made, filled, copied, resized, written as PNG.
 */
#pragma once
#include "engine/core/result.h"
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_PICTURE_SIDE_MAX 32768u

typedef struct nook_rgb {
    uint8_t r, g, b; /**< sRGB encoded. */
} nook_rgb;

/** Opaque RGB, sRGB encoded, top row first, tightly packed. */
typedef struct nook_picture {
    nook_rgb *pixels; /**< width * height; owned, release with nook_picture_free. */
    uint32_t width, height;
} nook_picture;

/** Black. @return NOOK_E_RANGE a side is 0 or over NOOK_PICTURE_SIDE_MAX; NOOK_E_MEMORY; *out_picture untouched then */
nook_result nook_picture_create(uint32_t width, uint32_t height, nook_picture *out_picture);
void nook_picture_free(nook_picture *picture); /**< NULL and zeroed pictures are allowed. */

/**
 * From floats in [0, 1], bottom row first, as they are: grey = round(255 value), without gamma, so that a pixel can be read
 * back. Values outside are clamped; NaN becomes pure magenta.
 */
nook_result nook_picture_from_grey(const float *values, uint32_t width, uint32_t height, nook_picture *out_picture);

/** Parts outside the picture are left out by all of these. */
void nook_picture_fill(nook_picture *picture, int x, int y, int width, int height, nook_rgb colour);
void nook_picture_blit(nook_picture *picture, const nook_picture *source, int x, int y);
/** Mixes `colour` over one pixel. @param coverage  0 leaves it, 255 replaces it */
void nook_picture_blend(nook_picture *picture, int x, int y, nook_rgb colour, uint8_t coverage);

/** A copy at another size, filtered in linear light. @return like nook_picture_create */
nook_result nook_picture_resize(const nook_picture *picture, uint32_t width, uint32_t height,
                                nook_picture *out_picture);

/** @return NOOK_E_IO, NOOK_E_MEMORY; an existing file is as it was then */
nook_result nook_picture_write_png(const nook_picture *picture, const char *path);

#ifdef __cplusplus
}
#endif
