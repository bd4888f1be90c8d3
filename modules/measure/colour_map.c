#include "modules/measure/colour_map.h"
#include <cglm/cglm.h>
#include <math.h>
#include <stddef.h>

static uint8_t encode_srgb(float linear)
{
    float x = glm_clamp_zo(linear);
    float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1.0f / 2.4f) - 0.055f;
    return (uint8_t)lrintf(encoded * 255.0f);
}

/* Ottosson, "A perceptual color space for image processing", 2020. */
static nook_rgb from_oklab(float lightness, float a, float b)
{
    mat3 cones_from_lab = { { 1.0f, 1.0f, 1.0f },
                            { 0.3963377774f, -0.1055613458f, -0.0894841775f },
                            { 0.2158037573f, -0.0638541728f, -1.2914855480f } };
    mat3 rgb_from_cones = { { 4.0767416621f, -1.2684380046f, -0.0041960863f },
                            { -3.3077115913f, 2.6097574011f, -0.7034186147f },
                            { 0.2309699292f, -0.3413193965f, 1.7076147010f } };
    vec3 lab = { lightness, a, b }, root, cones, rgb;
    glm_mat3_mulv(cones_from_lab, lab, root);
    glm_vec3_mul(root, root, cones);
    glm_vec3_mul(cones, root, cones);
    glm_mat3_mulv(rgb_from_cones, cones, rgb);
    return (nook_rgb){ encode_srgb(rgb[0]), encode_srgb(rgb[1]), encode_srgb(rgb[2]) };
}

nook_rgb nook_error_colour(float error, float range)
{
    /* Lightness falls linearly; chroma rises fast at first, so that small errors already show their sign. All of it stays
       within sRGB. */
    static const float lightness_zero = 0.97f, lightness_full = 0.40f, chroma_full = 0.155f;
    static const float hue_red = 0.47f, hue_blue = 4.50f; /* radians in OKLab */
    if (isnan(error))
        return (nook_rgb){ 255, 0, 255 };
    float t = fminf(fabsf(error) / range, 1.0f);
    float chroma = chroma_full * (1.0f - (1.0f - t) * (1.0f - t));
    float hue = error < 0.0f ? hue_red : hue_blue;
    return from_oklab(lightness_zero + (lightness_full - lightness_zero) * t, chroma * cosf(hue), chroma * sinf(hue));
}

nook_rgb nook_amount_colour(float share)
{
    /* The hue turns from blue through red to yellow while lightness rises; chroma is largest in the middle, within sRGB. */
    static const float lightness_low = 0.15f, lightness_high = 0.97f, chroma_middle = 0.15f;
    static const float hue_low = -1.40f, hue_high = 1.75f; /* radians in OKLab */
    if (isnan(share))
        return (nook_rgb){ 0, 255, 0 };
    float t = glm_clamp_zo(share);
    float chroma = chroma_middle * 4.0f * t * (1.0f - t) + 0.02f, hue = hue_low + (hue_high - hue_low) * t;
    return from_oklab(lightness_low + (lightness_high - lightness_low) * t, chroma * cosf(hue), chroma * sinf(hue));
}

nook_rgb nook_error_no_geometry(void)
{
    return (nook_rgb){ 200, 200, 200 };
}

nook_result nook_error_picture(const float *visibility, const float *reference, const uint8_t *mask, uint32_t width,
                               uint32_t height, float range, nook_picture *out_picture)
{
    nook_picture picture;
    nook_result result = nook_picture_create(width, height, &picture);
    if (result != NOOK_OK)
        return result;
    for (uint32_t y = 0; y < height; y++) {
        size_t from = (size_t)(height - 1 - y) * width;
        nook_rgb *to = picture.pixels + (size_t)y * width;
        for (uint32_t x = 0; x < width; x++) {
            size_t i = from + x;
            to[x] =
                mask && !mask[i] ? nook_error_no_geometry() : nook_error_colour(visibility[i] - reference[i], range);
        }
    }
    *out_picture = picture;
    return NOOK_OK;
}

void nook_error_scale_draw(nook_picture *picture, int x, int y, int width, int height, nook_rgb frame)
{
    nook_picture_fill(picture, x - 1, y - 1, width + 2, height + 2, frame);
    for (int i = 0; i < width; i++) {
        float error = 2.0f * ((float)i + 0.5f) / (float)width - 1.0f;
        nook_picture_fill(picture, x + i, y, 1, height, nook_error_colour(error, 1.0f));
    }
}
