/* Filter and upscaling alone: a technique that paints takes the place of one that computes. */
#include "engine/core/log.h"
#include "game/extremes/groups.h"
#include "game/extremes/random_transform.h"
#include "modules/fixture/painter.h"
#include "modules/fixture/view.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double radii[] = { 4.0, 0.5, 16.0 };                                     /* trace pixels */
static const double widths[][2] = { { 2.0, 32.0 }, { 0.1, 1024.0 }, { 100.0, 0.0 } }; /* filter_depth, filter_normal */
enum { WAYS = NOOK_FIXTURE_SCALES * NOOK_FIXTURE_FILTERS };

/* Nothing of a sample counts below exp(-x^2) = 1e-3: shaders/ao/filter.comp.glsl. */
static const double reach_of_weight = 2.6283;

/* ---- What is painted -------------------------------------------------------------------------------------------- */

typedef struct canvas canvas;
struct canvas {
    nook_fixture_view *view;
    nook_extreme_found *found;
    float (*paint)(const canvas *c, uint32_t x, uint32_t y, float depth); /* of a trace pixel and its distance */
    float value;
    uint32_t width, pixels; /* of the trace */
    nook_random random;     /* for clutter */
};

static float paint_pixel(const nook_fixture_painter *painter, uint32_t x, uint32_t y, float depth,
                         const float normal[2])
{
    canvas *c = painter->user;
    (void)normal;
    c->width = painter->width, c->pixels = painter->width * painter->height;
    return c->paint(c, x, y, depth);
}

static nook_result with_canvas(const nook_extremes *extremes, nook_extreme_found *out_found,
                               nook_result (*run)(const nook_extremes *extremes, canvas *c))
{
    static const nook_ao_technique *const techniques[] = { &nook_fixture_painter_technique };
    canvas c = { .found = out_found, .random = { 5 } };
    nook_fixture_painter painter = { .paint = paint_pixel, .user = &c };
    const nook_fixture_view_desc desc = { .gpu = extremes->gpu,
                                          .width = 37,
                                          .height = 23,
                                          .techniques = techniques,
                                          .technique_count = 1,
                                          .progress_user = &painter };
    nook_result result = nook_fixture_view_create(&desc, &c.view);
    if (result == NOOK_OK)
        result = run(extremes, &c);
    nook_fixture_view_destroy(c.view);
    return result;
}

/* An empty picture in which a pixel is about 1/100 of its distance wide, as in common pictures of more pixels. */
static nook_result start(canvas *c, uint32_t width, uint32_t height)
{
    nook_result result = NOOK_OK;
    if (width != c->view->width || height != c->view->height)
        result = nook_fixture_view_resize(c->view, width, height);
    if (result != NOOK_OK)
        return result;
    c->view->clip_from_view = nook_matrix_perspective_reversed(height / 115.0, (double)width / height, 0.1);
    nook_fixture_view_clear(c->view);
    return NOOK_OK;
}

/* @param way scale and filter */
static nook_result choose(canvas *c, size_t way, double radius, const double width[2])
{
    nook_result result = nook_ao_parse_param(c->view->ao, "ao.scale", nook_fixture_scales[way / 3]);
    if (result == NOOK_OK)
        result = nook_ao_parse_param(c->view->ao, "ao.filter", nook_fixture_filters[way % 3]);
    if (result == NOOK_OK)
        result = nook_ao_set_param(c->view->ao, "ao.filter_radius", radius);
    if (result == NOOK_OK)
        result = nook_ao_set_param(c->view->ao, "ao.filter_depth", width[0]);
    return result == NOOK_OK ? nook_ao_set_param(c->view->ao, "ao.filter_normal", width[1]) : result;
}

static nook_result record(canvas *c, const char *what)
{
    nook_result result = nook_fixture_view_record(c->view, "painter");
    if (result == NOOK_OK)
        nook_extreme_check_view(c->found, c->view, "%s", what);
    return result;
}

/* Depths over four decades and normals of any direction; about a fifth of the pixels see nothing. */
static void draw_clutter(canvas *c)
{
    for (uint32_t i = 0; i < c->view->width * c->view->height; i++) {
        double distance = 0.1 * pow(10.0, nook_random_between(&c->random, 0.0, 4.0)), n[3], length = 0.0;
        for (int axis = 0; axis < 3; axis++) {
            n[axis] = nook_random_between(&c->random, -0.5, 0.5);
            length += n[axis] * n[axis];
        }
        for (int axis = 0; axis < 3; axis++)
            n[axis] /= sqrt(length);
        if (nook_random_between(&c->random, 0.0, 1.0) > 0.2)
            nook_fixture_view_set_pixel(c->view, i % c->view->width, i / c->view->width, distance, n);
    }
}

static const uint32_t sizes[][2] = { { 37, 23 }, { 1, 1 }, { 1, 17 }, { 19, 1 }, { 2, 2 }, { 3, 5 }, { 64, 16 } };

/* ---- Constants -------------------------------------------------------------------------------------------------- */

/* Everywhere; without upscaling the technique's own image may be the result, and techniques write 1 where they see nothing. */
static float paint_value(const canvas *c, uint32_t x, uint32_t y, float depth)
{
    (void)x, (void)y;
    return depth > 0.0f || c->pixels < c->view->width * c->view->height ? c->value : 1.0f;
}

/* Devices may take numbers below FLT_MIN for 0. */
static bool is_same(float out, float in)
{
    return memcmp(&out, &in, sizeof in) == 0 || (in < FLT_MIN && out == 0.0f);
}

static nook_result check_constants(canvas *c, const char *what)
{
    static const float values[] = { 0.0f, 1e-42f, FLT_MIN, 1e-7f, 0.1f, 0.7123456f, 1.0f - 0.5f * FLT_EPSILON, 1.0f };
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < NOOK_COUNT(values) && result == NOOK_OK; i++) {
        uint32_t different = 0;
        c->value = values[i];
        result = record(c, what);
        for (uint32_t k = 0; k < c->view->width * c->view->height; k++)
            different += !is_same(c->view->visibility[k], c->view->device_depth[k] > 0.0f ? values[i] : 1.0f);
        nook_extreme_worst(c->found, different, "%.9g in, %s", values[i], what);
    }
    return result;
}

static nook_result look_at_constants(const nook_extremes *extremes, canvas *c)
{
    nook_result result = NOOK_OK;
    size_t variants = NOOK_COUNT(radii) * NOOK_COUNT(widths), step = extremes->quick ? 4 : 1, turn = 0;
    c->paint = paint_value;
    for (size_t k = 0; k < NOOK_COUNT(sizes) * WAYS && result == NOOK_OK; k++) {
        for (size_t variant = turn++ % step; variant < variants && result == NOOK_OK; variant += step) {
            const uint32_t *size = sizes[k / WAYS];
            char what[128];
            snprintf(what, sizeof what, "%ux%u, %s, %s, radius %g, depth %g", size[0], size[1],
                     nook_fixture_scales[k % WAYS / 3], nook_fixture_filters[k % 3], radii[variant % 3],
                     widths[variant / 3][0]);
            result = start(c, size[0], size[1]);
            if (result == NOOK_OK)
                result = choose(c, k % WAYS, radii[variant % 3], widths[variant / 3]);
            if (result != NOOK_OK)
                break;
            draw_clutter(c);
            result = check_constants(c, what);
        }
        nook_extreme_progress(extremes, (double)k / (NOOK_COUNT(sizes) * WAYS));
    }
    return result;
}

static nook_result run_constants(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return with_canvas(extremes, out_found, look_at_constants);
}

/* ---- Steps of depth --------------------------------------------------------------------------------------------- */

static const double facing[3] = { 0, 0, 1 };

static float paint_near_black(const canvas *c, uint32_t x, uint32_t y, float depth)
{
    (void)x, (void)y;
    return depth <= c->value ? 0.0f : 1.0f;
}

/*
 * Two planes that face the camera, the nearer one at 1 m. The step is a hundredth more than what a sample's weight reaches from the
 * farther one, whose pixels are larger. 0: there is no such step.
 */
static double least_step(const canvas *c, size_t way, double filter_depth)
{
    double footprint = 2.0 / (c->view->clip_from_view.m[5] * c->view->height);
    double reach = 1.01 * reach_of_weight * filter_depth * (1 << way / 3) * footprint;
    return reach < 0.9 ? reach / (1.0 - reach) : 0.0;
}

static nook_result check_step(canvas *c, double step, uint32_t edge, const char *what)
{
    const uint32_t width = c->view->width, height = c->view->height;
    for (uint32_t i = 0; i < width * height; i++)
        nook_fixture_view_set_pixel(c->view, i % width, i / width, i % width < edge ? 1.0 : 1.0 + step, facing);
    c->value = (float)(1.0 + 0.5 * step);
    nook_result result = record(c, what);
    for (uint32_t i = 0; i < width * height && result == NOOK_OK; i++) {
        double expected = i % width < edge ? 0.0 : 1.0;
        nook_extreme_worst(c->found, fabs(c->view->visibility[i] - expected), "step of %.3f, column %u, edge at %u, %s",
                           step, i % width, edge, what);
    }
    return result;
}

/* The largest step that leaks, in footprints of a pixel by ao.filter_depth: at full scale, with the disc, by halving. */
static nook_result find_bridge(canvas *c, double *out_bridge)
{
    enum { EDGE = 15, HALVINGS = 12 };
    static const double width[] = { 2.0, 32.0 };
    const double footprint = 2.0 / (c->view->clip_from_view.m[5] * c->view->height);
    double least = 1.0, most = 4.0;
    nook_result result = choose(c, 1, 4.0, width);
    for (int i = 0; i < HALVINGS && result == NOOK_OK; i++) {
        double middle = 0.5 * (least + most), reach = middle * width[0] * footprint;
        nook_extreme_found leak = { 0 }, *kept = c->found;
        c->found = &leak;
        result = check_step(c, reach / (1.0 - reach), EDGE, "a bridge");
        c->found = kept;
        *(leak.measured > 0.0 ? &least : &most) = middle;
    }
    *out_bridge = 0.5 * (least + most);
    return result;
}

static nook_result look_at_steps(const nook_extremes *extremes, canvas *c)
{
    static const double depths[][2] = { { 2.0, 32.0 }, { 0.1, 32.0 }, { 8.0, 0.0 } };
    nook_result result = start(c, 37, 23);
    c->paint = paint_near_black;
    for (size_t k = 0; k < WAYS * 9 && result == NOOK_OK; k++) {
        const size_t way = k % WAYS;
        const double *width = depths[k / WAYS % 3], radius = radii[k / WAYS / 3];
        double step = least_step(c, way, width[0]);
        char what[128];
        snprintf(what, sizeof what, "%s, %s, radius %g, depth %g", nook_fixture_scales[way / 3],
                 nook_fixture_filters[way % 3], radius, width[0]);
        result = choose(c, way, radius, width);
        for (uint32_t edge = 15; edge < (extremes->quick ? 17 : 20) && step > 0.0 && result == NOOK_OK; edge++)
            result = check_step(c, step, edge, what);
    }
    double bridge = NAN;
    if (result == NOOK_OK)
        result = find_bridge(c, &bridge);
    nook_extreme_state(c->found, 2.63, 0.01, bridge, "the largest step that leaks, ao.filter_depth footprints");
    return result;
}

static nook_result run_steps(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return with_canvas(extremes, out_found, look_at_steps);
}

/* ---- Nothing around --------------------------------------------------------------------------------------------- */

/* The pixel that the trace takes of a block of scale x scale: shaders/ao/frame.glsl, full_pixel. */
static bool is_traced(const canvas *c, uint32_t x, uint32_t y, uint32_t scale)
{
    uint32_t last_x = c->view->width - 1, last_y = c->view->height - 1;
    uint32_t picked_x = x / scale * scale + scale / 2, picked_y = y / scale * scale + scale / 2;
    return (picked_x < last_x ? picked_x : last_x) == x && (picked_y < last_y ? picked_y : last_y) == y;
}

static float paint_seen(const canvas *c, uint32_t x, uint32_t y, float depth)
{
    (void)x, (void)y;
    return depth > 0.0f ? c->value : 1.0f;
}

static nook_result look_at_islands(const nook_extremes *extremes, canvas *c)
{
    nook_result result = NOOK_OK;
    c->paint = paint_seen;
    c->value = 0.3f;
    for (size_t k = 0; k < NOOK_COUNT(sizes) * WAYS && result == NOOK_OK; k++) {
        const uint32_t *size = sizes[k / WAYS], pixels = size[0] * size[1], scale = 1u << k % WAYS / 3;
        uint32_t stride = extremes->quick ? pixels / 16 + 1 : pixels / 64 + 1;
        result = start(c, size[0], size[1]);
        if (result == NOOK_OK)
            result = choose(c, k % WAYS, 4.0, widths[0]);
        for (uint32_t i = 0; i < pixels && result == NOOK_OK; i += stride) {
            nook_fixture_view_clear(c->view);
            nook_fixture_view_set_pixel(c->view, i % size[0], i / size[0], 2.0, facing);
            result = record(c, "one pixel");
            float expected = is_traced(c, i % size[0], i / size[0], scale) ? c->value : 1.0f;
            nook_extreme_worst(c->found, fabsf(c->view->visibility[i] - expected), "pixel %u of %ux%u, %s, %s", i,
                               size[0], size[1], nook_fixture_scales[k % WAYS / 3], nook_fixture_filters[k % 3]);
        }
    }
    return result;
}

static nook_result run_islands(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return with_canvas(extremes, out_found, look_at_islands);
}

static float paint_random(const canvas *c, uint32_t x, uint32_t y, float depth)
{
    (void)c, (void)depth;
    nook_random random = { y * 131u + x + 1u };
    return (float)nook_random_between(&random, 0.25, 0.75);
}

static nook_result look_at_mixtures(const nook_extremes *extremes, canvas *c)
{
    nook_result result = NOOK_OK;
    c->paint = paint_random;
    c->found->bound = FLT_EPSILON;
    for (size_t k = 0; k < NOOK_COUNT(sizes) * WAYS * (extremes->quick ? 1 : 9) && result == NOOK_OK; k++) {
        const uint32_t *size = sizes[k / WAYS % NOOK_COUNT(sizes)];
        size_t variant = k / WAYS / NOOK_COUNT(sizes);
        result = start(c, size[0], size[1]);
        if (result == NOOK_OK)
            result = choose(c, k % WAYS, radii[variant % 3], widths[variant / 3]);
        if (result != NOOK_OK)
            break;
        draw_clutter(c);
        result = record(c, "clutter");
        for (uint32_t i = 0; i < size[0] * size[1] && result == NOOK_OK; i++) {
            if (!(c->view->device_depth[i] > 0.0f))
                continue;
            double v = c->view->visibility[i], beyond = fmax(0.25 - v, v - 0.75);
            nook_extreme_worst(c->found, fmax(beyond, 0.0), "%ux%u, %s, %s", size[0], size[1],
                               nook_fixture_scales[k % WAYS / 3], nook_fixture_filters[k % 3]);
        }
    }
    return result;
}

static nook_result run_mixtures(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return with_canvas(extremes, out_found, look_at_mixtures);
}

/* ---- Scales ----------------------------------------------------------------------------------------------------- */

/* Rises by 1/96 a full pixel, from the place of the pixel that the trace takes. */
static float paint_ramp(const canvas *c, uint32_t x, uint32_t y, float depth)
{
    (void)y, (void)depth;
    uint32_t scale = (c->view->width + c->width - 1) / c->width;
    return (float)(x * scale + scale / 2) / (float)c->view->width;
}

static nook_result look_at_ramps(const nook_extremes *extremes, canvas *c)
{
    (void)extremes;
    enum { WIDTH = 96, HEIGHT = 48 };
    const double n[3] = { 0.6, 0, 0.8 };
    nook_result result = start(c, WIDTH, HEIGHT);
    c->paint = paint_ramp;
    c->found->bound = 0.6;
    for (uint32_t i = 0; i < WIDTH * HEIGHT && result == NOOK_OK; i++) {
        double ray[3];
        nook_fixture_view_position(c->view, i % WIDTH, i / WIDTH, 1.0, ray);
        nook_fixture_view_set_pixel(c->view, i % WIDTH, i / WIDTH, -2.0 * n[2] / (n[0] * ray[0] - n[2]), n);
    }
    for (size_t way = 0; way < WAYS && result == NOOK_OK; way++) {
        result = choose(c, way, 4.0, widths[0]);
        if (result == NOOK_OK)
            result = record(c, "a ramp");
        for (uint32_t i = 0; i < WIDTH * HEIGHT && result == NOOK_OK; i++) {
            uint32_t x = i % WIDTH;
            if (x < WIDTH / 4 ||
                x >= WIDTH - WIDTH / 4) /* the disc of a quarter trace reaches 16 pixels: no border in it */
                continue;
            double off = fabs(c->view->visibility[i] - x / (double)WIDTH) * WIDTH / (1 << way / 3);
            nook_extreme_worst(c->found, off, "%s, %s, column %u", nook_fixture_scales[way / 3],
                               nook_fixture_filters[way % 3], x);
        }
    }
    return result;
}

static nook_result run_ramps(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return with_canvas(extremes, out_found, look_at_ramps);
}

static const nook_extreme cases[] = {
    { .name = "a constant comes out of every filter and scale bit for bit, at any image size",
      .unit = "pixels that differ",
      .why = "a sample plus a mean of differences, which are 0; numbers below 1.2e-38 may become 0, nothing else",
      .run = run_constants },
    { .name = "nothing leaks across a step of depth that the filter does not bridge",
      .unit = "visibility leaked",
      .why = "samples of less than a thousandth of the weight have no say: exactly 0",
      .limit = "The filter bridges steps of depth below 2.63 ao.filter_depth footprints of a trace pixel, and must, to "
               "filter slopes.",
      .run = run_steps },
    { .name = "one pixel alone keeps its sample, and without any is fully visible",
      .unit = "error of visibility",
      .why = "all other weights are 0: the nearest sample is left, bit for bit, or the 1 of what sees nothing",
      .run = run_islands },
    { .name = "what is filtered lies between the lowest and the highest sample",
      .unit = "visibility beyond",
      .why = "weights are not negative; one rounding of 1.2e-7",
      .run = run_mixtures },
    { .name = "half and quarter scale keep a ramp on a leaning plane in its place",
      .unit = "trace pixels",
      .why =
          "a ramp moves by no more than half a trace pixel, as samples are whole ones, and 0.1 by their uneven number",
      .run = run_ramps },
};

const nook_extreme_group nook_extreme_filter = { "filter", cases, NOOK_COUNT(cases) };
