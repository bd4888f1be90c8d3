#include "modules/measure/picture.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include <cglm/cglm.h>
#include <math.h>
#include <stb/stb_image_resize.h>
#include <stb/stb_image_write.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

nook_result nook_picture_create(uint32_t width, uint32_t height, nook_picture *out_picture)
{
    if (width == 0 || height == 0 || width > NOOK_PICTURE_SIDE_MAX || height > NOOK_PICTURE_SIDE_MAX)
        return nook_fail(NOOK_E_RANGE, "a picture of %u x %u pixels: sides go from 1 to %u", width, height,
                         NOOK_PICTURE_SIDE_MAX);
    nook_rgb *pixels = calloc((size_t)width * height, sizeof *pixels);
    if (!pixels)
        return nook_fail(NOOK_E_MEMORY, "no memory for a picture of %u x %u pixels", width, height);
    *out_picture = (nook_picture){ pixels, width, height };
    return NOOK_OK;
}

void nook_picture_free(nook_picture *picture)
{
    if (!picture)
        return;
    free(picture->pixels);
    *picture = (nook_picture){ 0 };
}

static nook_rgb grey_colour(float value)
{
    if (isnan(value))
        return (nook_rgb){ 255, 0, 255 };
    uint8_t grey = (uint8_t)lrintf(glm_clamp_zo(value) * 255.0f);
    return (nook_rgb){ grey, grey, grey };
}

nook_result nook_picture_from_grey(const float *values, uint32_t width, uint32_t height, nook_picture *out_picture)
{
    nook_picture picture;
    nook_result result = nook_picture_create(width, height, &picture);
    if (result != NOOK_OK)
        return result;
    for (uint32_t y = 0; y < height; y++) {
        const float *from = values + (size_t)(height - 1 - y) * width;
        for (uint32_t x = 0; x < width; x++)
            picture.pixels[(size_t)y * width + x] = grey_colour(from[x]);
    }
    *out_picture = picture;
    return NOOK_OK;
}

/* The part of [start, start + size) that lies in [0, limit). */
static int clip_first(int start)
{
    return start > 0 ? start : 0;
}

static int clip_end(int start, int size, uint32_t limit)
{
    int64_t end = (int64_t)start + size;
    return end < (int64_t)limit ? (int)end : (int)limit;
}

void nook_picture_fill(nook_picture *picture, int x, int y, int width, int height, nook_rgb colour)
{
    int x_end = clip_end(x, width, picture->width);
    int y_end = clip_end(y, height, picture->height);
    for (int row = clip_first(y); row < y_end; row++) {
        nook_rgb *pixels = picture->pixels + (size_t)row * picture->width;
        for (int column = clip_first(x); column < x_end; column++)
            pixels[column] = colour;
    }
}

void nook_picture_blit(nook_picture *picture, const nook_picture *source, int x, int y)
{
    int x_first = clip_first(x);
    int x_end = clip_end(x, (int)source->width, picture->width);
    int y_end = clip_end(y, (int)source->height, picture->height);
    if (x_first >= x_end)
        return;
    for (int row = clip_first(y); row < y_end; row++)
        memcpy(picture->pixels + (size_t)row * picture->width + x_first,
               source->pixels + (size_t)(row - y) * source->width + (x_first - x),
               (size_t)(x_end - x_first) * sizeof(nook_rgb));
}

static uint8_t mix(uint8_t below, uint8_t above, uint8_t coverage)
{
    return (uint8_t)((below * (255 - coverage) + above * coverage + 127) / 255);
}

void nook_picture_blend(nook_picture *picture, int x, int y, nook_rgb colour, uint8_t coverage)
{
    if (x < 0 || y < 0 || (uint32_t)x >= picture->width || (uint32_t)y >= picture->height)
        return;
    nook_rgb *pixel = picture->pixels + (size_t)y * picture->width + (size_t)x;
    pixel->r = mix(pixel->r, colour.r, coverage);
    pixel->g = mix(pixel->g, colour.g, coverage);
    pixel->b = mix(pixel->b, colour.b, coverage);
}

nook_result nook_picture_resize(const nook_picture *picture, uint32_t width, uint32_t height, nook_picture *out_picture)
{
    nook_picture resized;
    nook_result result = nook_picture_create(width, height, &resized);
    if (result != NOOK_OK)
        return result;
    if (!stbir_resize_uint8_srgb(&picture->pixels->r, (int)picture->width, (int)picture->height, 0, &resized.pixels->r,
                                 (int)width, (int)height, 0, 3, STBIR_ALPHA_CHANNEL_NONE, 0)) {
        nook_picture_free(&resized);
        return nook_fail(NOOK_E_MEMORY, "no memory to resize a picture to %u x %u pixels", width, height);
    }
    *out_picture = resized;
    return NOOK_OK;
}

typedef struct byte_buffer {
    uint8_t *bytes;
    size_t size, capacity;
    bool failed;
} byte_buffer;

static void append_bytes(void *context, void *data, int count)
{
    byte_buffer *buffer = context;
    size_t size = (size_t)count;
    if (buffer->failed)
        return;
    if (buffer->capacity - buffer->size < size) {
        size_t capacity = buffer->capacity * 2 > buffer->size + size ? buffer->capacity * 2 : buffer->size + size;
        uint8_t *grown = realloc(buffer->bytes, capacity);
        if (!grown) {
            buffer->failed = true;
            return;
        }
        buffer->bytes = grown;
        buffer->capacity = capacity;
    }
    memcpy(buffer->bytes + buffer->size, data, size);
    buffer->size += size;
}

nook_result nook_picture_write_png(const nook_picture *picture, const char *path)
{
    byte_buffer buffer = { 0 };
    int encoded = stbi_write_png_to_func(append_bytes, &buffer, (int)picture->width, (int)picture->height, 3,
                                         picture->pixels, (int)(picture->width * sizeof(nook_rgb)));
    nook_result result = encoded && !buffer.failed ? nook_file_write(path, buffer.bytes, buffer.size)
                                                   : nook_fail(NOOK_E_MEMORY, "%s: no memory to encode %u x %u pixels",
                                                               path, picture->width, picture->height);
    free(buffer.bytes);
    return result;
}
