/** image.h - PNG and JPEG files in memory to pixels, through stb_image. */
#pragma once
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Larger images are refused before anything is allocated for them. */
enum { NOOK_IMAGE_SIDE_MAX = 16384, NOOK_IMAGE_BYTES_MAX = 256 << 20 };

typedef enum nook_image_type { NOOK_IMAGE_UNKNOWN, NOOK_IMAGE_PNG, NOOK_IMAGE_JPEG } nook_image_type;

/** What the first bytes say it is. */
nook_image_type nook_image_detect(const uint8_t *bytes, size_t size);

/**
 * Decodes to 8-bit RGBA, top row first.
 * @param out_pixels  release with nook_image_free
 * @return NULL on success; else why it failed, a constant text; outputs are untouched then. Nothing is logged.
 */
const char *nook_image_decode(const uint8_t *bytes, size_t size, uint8_t **out_pixels, uint32_t *out_width,
                              uint32_t *out_height);
void nook_image_free(uint8_t *pixels); /**< NULL is allowed. */

#ifdef __cplusplus
}
#endif
