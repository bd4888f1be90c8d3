#include "game/exposure.h"
#include "engine/core/log.h"
#include <math.h>
#include <stdlib.h>

static const double grey = 0.11; /* linear mean of the picture that is aimed at */
static const float exposure_max = 4.0f;
enum { STEPS = 3 /* tone mapping bends the way there, so it takes a few */ };

/* Linear luminance of an sRGB pixel, near enough. */
static double luminance(const uint8_t *rgb)
{
    double sum = 0.2126 * pow(rgb[0] / 255.0, 2.2) + 0.7152 * pow(rgb[1] / 255.0, 2.2);
    return sum + 0.0722 * pow(rgb[2] / 255.0, 2.2);
}

/* Of the pixels that show geometry. Rows of the depth stand the other way up. */
static double mean_luminance(const nook_stage *stage, const uint8_t *rgb, const float *depth)
{
    double sum = 0.0, count = 0.0;
    for (uint32_t y = 0; y < stage->height; y++) {
        for (uint32_t x = 0; x < stage->width; x++) {
            size_t i = (size_t)y * stage->width + x;
            if (depth[(size_t)(stage->height - 1 - y) * stage->width + x] == 0.0f)
                continue;
            sum += luminance(rgb + 3 * i);
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : grey;
}

nook_result nook_stage_expose(nook_stage *stage, const nook_camera *camera)
{
    if (stage->scene->light_count > 0)
        return NOOK_OK;
    nook_result result = nook_stage_begin(stage, camera);
    if (result != NOOK_OK)
        return result;
    size_t pixels = (size_t)stage->width * stage->height;
    uint8_t *rgb = malloc(pixels * 3);
    float *depth = malloc(pixels * sizeof *depth);
    if (!rgb || !depth) {
        free(rgb);
        free(depth);
        return nook_fail(NOOK_E_MEMORY, "no memory to read back %zu pixels", pixels);
    }
    nook_texture_read(stage->gpu, nook_renderer_gbuffer(stage->renderer).depth, GL_DEPTH_COMPONENT, GL_FLOAT, depth,
                      pixels * sizeof *depth);
    for (int i = 0; i < STEPS && result == NOOK_OK; i++) {
        result = nook_stage_finish(stage, false, NOOK_VIEW_LIT);
        nook_renderer_read(stage->renderer, rgb);
        double mean = fmax(mean_luminance(stage, rgb, depth), 1e-3);
        float exposure = stage->lights.exposure * (float)(grey / mean);
        stage->lights.exposure = fminf(fmaxf(exposure, 1.0f), exposure_max);
    }
    free(rgb);
    free(depth);
    return result;
}
