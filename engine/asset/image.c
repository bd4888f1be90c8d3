#include "engine/asset/image.h"
#include <limits.h>
#include <stb/stb_image.h>
#include <string.h>

nook_image_type nook_image_detect(const uint8_t *bytes, size_t size)
{
    static const uint8_t png[] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n' };
    static const uint8_t jpeg[] = { 0xFF, 0xD8, 0xFF };
    if (size >= sizeof png && memcmp(bytes, png, sizeof png) == 0)
        return NOOK_IMAGE_PNG;
    return size >= sizeof jpeg && memcmp(bytes, jpeg, sizeof jpeg) == 0 ? NOOK_IMAGE_JPEG : NOOK_IMAGE_UNKNOWN;
}

const char *nook_image_decode(const uint8_t *bytes, size_t size, uint8_t **out_pixels, uint32_t *out_width,
                              uint32_t *out_height)
{
    int width = 0, height = 0, channels = 0;
    /* stb_image reads many more formats; glTF has these two. */
    if (nook_image_detect(bytes, size) == NOOK_IMAGE_UNKNOWN)
        return "is neither PNG nor JPEG";
    if (size > INT_MAX)
        return "is larger than 2 GiB";
    if (!stbi_info_from_memory(bytes, (int)size, &width, &height, &channels))
        return "has a broken header";
    if (width <= 0 || height <= 0)
        return "has no pixels";
    if (width > NOOK_IMAGE_SIDE_MAX || height > NOOK_IMAGE_SIDE_MAX)
        return "is larger than 16384 pixels";
    if ((int64_t)width * height * 4 > NOOK_IMAGE_BYTES_MAX)
        return "needs more than 256 MiB";
    uint8_t *pixels = stbi_load_from_memory(bytes, (int)size, &width, &height, &channels, 4);
    if (!pixels)
        return "is broken";
    *out_pixels = pixels;
    *out_width = (uint32_t)width;
    *out_height = (uint32_t)height;
    return NULL;
}

void nook_image_free(uint8_t *pixels)
{
    stbi_image_free(pixels);
}
