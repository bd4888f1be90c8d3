/* Filter and upscaling alone: a technique that writes what the test paints. */
#include "tests/support/ao_view.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

/* How the trace comes to full size. */
static const struct way {
    const char *scale, *upscale;
    uint32_t factor;
} ways[] = {
    { "full", "direct", 1 },    { "half", "direct", 2 },     { "half", "stepped", 2 },     { "half", "bilinear", 2 },
    { "quarter", "direct", 4 }, { "quarter", "stepped", 4 }, { "quarter", "bilinear", 4 },
};
enum { WAYS = NOOK_COUNT(ways) };
static const char *const filters[] = { "none", "disc", "tile" };
static const double facing[3] = { 0, 0, 1 };

static int setup(void **state)
{
    *state = ao_view_create(37, 23);
    return 0;
}

static nook_fixture_view *start(void **state, uint32_t width, uint32_t height)
{
    nook_fixture_view *view = *state;
    if (width != view->width || height != view->height)
        ao_view_resize(view, width, height);
    /* Narrow: a pixel is 1/100 of its distance wide, as in a common picture of more pixels. */
    view->clip_from_view = nook_matrix_perspective_reversed(0.2, (double)width / height, 0.1);
    ao_view_probe(view)->paint = NULL;
    nook_fixture_view_clear(view);
    return view;
}

static void set_way(nook_fixture_view *view, const struct way *way, const char *filter)
{
    ao_view_param(view, "ao.scale", way->scale);
    ao_view_param(view, "ao.upscale", way->upscale);
    ao_view_param(view, "ao.filter", filter);
}

static uint32_t random_bits(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

static double random_unit(uint32_t *state)
{
    return random_bits(state) / 16777216.0;
}

/** Depths and normals as wild as they come; about a fifth of the pixels see nothing. */
static void draw_clutter(nook_fixture_view *view, uint32_t seed)
{
    for (uint32_t i = 0; i < view->width * view->height; i++) {
        double distance = 0.1 * pow(1e4, random_unit(&seed)), n[3];
        for (int axis = 0; axis < 3; axis++)
            n[axis] = random_unit(&seed) - 0.5;
        double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        n[0] /= length, n[1] /= length, n[2] /= length;
        if (random_bits(&seed) % 5)
            nook_fixture_view_set_pixel(view, i % view->width, i / view->width, distance, n);
    }
}

/** Without a filter the technique's own image is the result, and techniques write 1 where they see nothing. */
static float paint_constant(const ao_probe *probe, uint32_t x, uint32_t y)
{
    int background = probe->depth[y * probe->width + x] == 0.0f;
    return background && probe->width == probe->view->width ? 1.0f : probe->painted;
}

/** Whether all that bilinear upscaling looks at, the four trace pixels around one of the picture, sees nothing. */
static bool four_see_nothing(const nook_fixture_view *view, const struct way *way, uint32_t pixel)
{
    const int scale = (int)way->factor, size[2] = { (int)view->width, (int)view->height };
    const int p[2] = { (int)(pixel % view->width), (int)(pixel / view->width) };
    bool nothing = strcmp(way->upscale, "bilinear") == 0;
    for (int i = 0; i < 4; i++) {
        int at[2];
        for (int axis = 0; axis < 2; axis++) {
            int trace = (size[axis] + scale - 1) / scale, half = scale / 2;
            int q = (int)floor((p[axis] - half) / (double)scale) + (i >> axis & 1);
            q = q < 0 ? 0 : q < trace ? q : trace - 1;
            at[axis] = q * scale + half < size[axis] ? q * scale + half : size[axis] - 1;
        }
        nothing = nothing && view->device_depth[at[1] * size[0] + at[0]] == 0.0f;
    }
    return nothing;
}

static void test_filter_gives_a_constant_back_bit_for_bit_and_background_as_one(void **state)
{
    static const uint32_t sizes[][2] = { { 37, 23 }, { 1, 1 }, { 5, 40 }, { 64, 16 } };
    for (size_t k = 0; k < NOOK_COUNT(sizes) * WAYS * 3; k++) {
        const uint32_t *size = sizes[k / (WAYS * 3)];
        const struct way *way = &ways[k / 3 % WAYS];
        nook_fixture_view *view = start(state, size[0], size[1]);
        set_way(view, way, filters[k % 3]);
        draw_clutter(view, (uint32_t)k);
        ao_view_probe(view)->paint = paint_constant;
        for (int step = 0; step < 3; step++) {
            ao_view_probe(view)->painted = step == 0 ? 0.0f : step == 1 ? 0.1f : 0.7123456f;
            ao_view_record(view, "probe");
            for (uint32_t i = 0; i < view->width * view->height; i++) {
                bool open = view->device_depth[i] == 0.0f || four_see_nothing(view, way, i);
                if (view->visibility[i] != (open ? 1.0f : ao_view_probe(view)->painted))
                    fail_msg("%ux%u, %s, %s, %s, pixel %u: %.9g", view->width, view->height, way->scale, way->upscale,
                             filters[k % 3], i, view->visibility[i]);
            }
        }
    }
}

/** 0 on the nearer surface, 1 behind. */
static float paint_by_depth(const ao_probe *probe, uint32_t x, uint32_t y)
{
    return probe->depth[y * probe->width + x] < 2.0f ? 0.0f : 1.0f;
}

static void test_filter_leaks_nothing_across_a_step_of_depth(void **state)
{
    for (size_t k = 0; k < WAYS * 3; k++) {
        for (uint32_t edge = 15; edge < 20; edge++) {
            nook_fixture_view *view = start(state, 37, 23);
            set_way(view, &ways[k / 3], filters[k % 3]);
            for (uint32_t i = 0; i < 37 * 23; i++)
                nook_fixture_view_set_pixel(view, i % 37, i / 37, i % 37 < edge ? 1.0 : 5.0, facing);
            ao_view_probe(view)->paint = paint_by_depth;
            view->without_normals = edge % 2; /* rebuilt ones of a step face the camera too */
            ao_view_record(view, "probe");
            view->without_normals = false;
            for (uint32_t i = 0; i < 37 * 23; i++) {
                if (view->visibility[i] != (i % 37 < edge ? 0.0f : 1.0f))
                    fail_msg("%s, %s, %s, edge %u, pixel (%u, %u): %g", ways[k / 3].scale, ways[k / 3].upscale,
                             filters[k % 3], edge, i % 37, i / 37, view->visibility[i]);
            }
        }
    }
}

/** 0 where the normal points to the left, 1 where it points to the right. */
static float paint_by_normal(const ao_probe *probe, uint32_t x, uint32_t y)
{
    double n[3];
    nook_fixture_decode_normal(probe->normals[y * probe->width + x], n);
    return n[0] < 0.0 ? 0.0f : 1.0f;
}

static void test_filter_leaks_nothing_across_a_right_angle(void **state)
{
    /* An edge towards the camera along the line x = 0, z = -2: two planes at 45 degrees. */
    const double half = sqrt(0.5), left[3] = { -half, 0, half }, right[3] = { half, 0, half };
    for (size_t k = 0; k < WAYS * 3; k++) {
        nook_fixture_view *view = start(state, 37, 23);
        set_way(view, &ways[k / 3], filters[k % 3]);
        for (uint32_t i = 0; i < 37 * 23; i++) {
            double ray[3];
            nook_fixture_view_position(view, i % 37, i / 37, 1.0, ray);
            const double *n = ray[0] < 0.0 ? left : right;
            nook_fixture_view_set_pixel(view, i % 37, i / 37, -2.0 * half / (n[0] * ray[0] - half), n);
        }
        ao_view_probe(view)->paint = paint_by_normal;
        ao_view_record(view, "probe");
        for (uint32_t i = 0; i < 37 * 23; i++) {
            double ray[3];
            nook_fixture_view_position(view, i % 37, i / 37, 1.0, ray);
            if (view->visibility[i] != (ray[0] < 0.0 ? 0.0f : 1.0f))
                fail_msg("%s, %s, %s, pixel (%u, %u): %g", ways[k / 3].scale, ways[k / 3].upscale, filters[k % 3],
                         i % 37, i / 37, view->visibility[i]);
        }
    }
}

static float paint_checkers(const ao_probe *probe, uint32_t x, uint32_t y)
{
    (void)probe;
    return (float)((x + y) % 2);
}

static void test_filter_averages_what_is_around_when_no_sample_is_on_the_surface(void **state)
{
    /* The trace picks column and row scale / 2 of each block: nothing it saw lies on the first columns. */
    for (uint32_t k = 2; k < WAYS * 2; k++) {
        uint32_t scale = ways[k / 2].factor;
        if (strcmp(ways[k / 2].upscale, "bilinear") == 0)
            continue; /* has the four alone */
        nook_fixture_view *view = start(state, 48, 32);
        set_way(view, &ways[k / 2], filters[1 + k % 2]);
        for (uint32_t i = 0; i < 48 * 32; i++)
            nook_fixture_view_set_pixel(view, i % 48, i / 48, i % 48 % scale ? 50.0 : 1.0, facing);
        ao_view_probe(view)->paint = paint_checkers;
        ao_view_record(view, "probe");
        for (uint32_t i = 0; i < 48 * 32; i++) {
            uint32_t x = i % 48, y = i / 48;
            if (x % scale || x < 3 * scale || x >= 48 - 3 * scale || y < 3 * scale || y >= 32 - 3 * scale)
                continue;
            if (fabsf(view->visibility[i] - 0.5f) > 0.1f)
                fail_msg("scale %u, %s, pixel (%u, %u): %g shows one sample", scale, filters[1 + k % 2], x, y,
                         view->visibility[i]);
        }
    }
}

static float paint_by_column(const ao_probe *probe, uint32_t x, uint32_t y)
{
    (void)probe, (void)y;
    return (float)(x % 2);
}

static void test_bilinear_upscaling_weighs_four_by_their_planes_when_none_is_on_the_surface(void **state)
{
    for (uint32_t k = 1; k < WAYS; k++) {
        int scale = (int)ways[k].factor;
        if (strcmp(ways[k].upscale, "bilinear") != 0)
            continue;
        nook_fixture_view *view = start(state, 48, 32);
        set_way(view, &ways[k], "none");
        for (uint32_t i = 0; i < 48 * 32; i++)
            nook_fixture_view_set_pixel(view, i % 48, i / 48, (int)i % 48 % scale ? 50.0 : 1.0, facing);
        ao_view_probe(view)->paint = paint_by_column;
        ao_view_record(view, "probe");
        for (int x = 3 * scale; x < 48 - 3 * scale;
             x += scale) { /* all four are equally far off: bilinear, between two columns */
            double centre = (x - scale / 2) / (double)scale, part = centre - floor(centre);
            double expected = (int)floor(centre) % 2 ? 1.0 - part : part;
            if (fabs((double)view->visibility[16 * 48 + x] - expected) > 1e-3)
                fail_msg("scale %d, column %d: %g, by hand %g", scale, x, view->visibility[16 * 48 + x], expected);
        }
    }
}

static float paint_ramp(const ao_probe *probe, uint32_t x, uint32_t y)
{
    (void)y;
    uint32_t scale = (probe->view->width + probe->width - 1) / probe->width;
    return (float)(x * scale + scale / 2) / (float)probe->view->width;
}

static void test_filter_of_a_ramp_stays_near_it_at_every_scale(void **state)
{
    nook_fixture_view *view = start(state, 96, 48);
    double n[3] = { 0.6, 0, 0.8 };
    for (uint32_t i = 0; i < 96 * 48; i++) {
        double ray[3];
        nook_fixture_view_position(view, i % 96, i / 96, 1.0, ray);
        nook_fixture_view_set_pixel(view, i % 96, i / 96, -2.0 * n[2] / (n[0] * ray[0] - n[2]), n);
    }
    ao_view_probe(view)->paint = paint_ramp;
    for (size_t k = 0; k < WAYS * 2; k++) {
        const struct way *way = &ways[k / 2];
        set_way(view, way, filters[1 + k % 2]);
        ao_view_record(view, "probe");
        double worst = 0.0;
        for (uint32_t i = 0; i < 96 * 48; i++) {
            uint32_t x = i % 96;
            if (x >= 24 && x < 72) /* the disc of the quarter trace reaches 16 pixels: no border in it */
                worst = fmax(worst, fabs(view->visibility[i] - x / 96.0) * 96.0);
        }
        /* Samples are whole pixels of the trace: off by half of one at the most, and a little by their uneven number. */
        if (worst > 0.6 * way->factor)
            fail_msg("%s, %s, %s: the ramp is off by %.3f pixels", way->scale, way->upscale, filters[1 + k % 2], worst);
    }
}

static float paint_random(const ao_probe *probe, uint32_t x, uint32_t y)
{
    uint32_t seed = y * probe->width + x;
    random_bits(&seed);
    return (float)random_unit(&seed);
}

static void draw_absurdities(nook_fixture_view *view)
{
    static const float depths[] = { 0.0f,  -0.0f,  1.0f,  2.0f,     1e10f,     1e30f, 1e36f,
                                    3e38f, 1e-30f, -1.0f, INFINITY, -INFINITY, NAN,   1e-40f };
    uint32_t seed = 7;
    for (uint32_t i = 0; i < view->width * view->height; i++) {
        view->device_depth[i] =
            random_bits(&seed) % 3 ? depths[random_bits(&seed) % NOOK_COUNT(depths)] : (float)random_unit(&seed);
        for (int k = 0; k < 2; k++)
            view->normals[i][k] = (float)((random_bits(&seed) & 65535u) / 65535.0);
    }
}

/* ao_view_record holds every pixel to [0, 1], which NaN is not. */
static void test_filter_never_writes_nan_whatever_the_buffers_hold(void **state)
{
    for (size_t k = 0; k < WAYS * 6; k++) {
        nook_fixture_view *view = start(state, 37, 23);
        set_way(view, &ways[k / 3 % WAYS], filters[k % 3]);
        ao_view_param(view, "ao.downsample", k % 3 == 1 ? "majority" : "centre");
        draw_absurdities(view);
        view->without_normals = k >= WAYS * 3;
        ao_view_probe(view)->paint = paint_random;
        ao_view_record(view, "probe");
        view->without_normals = 0;
    }
}

static void test_techniques_never_write_nan_whatever_the_buffers_hold(void **state)
{
    static const char *const techniques[] = { "volume", "ssao", "hsao", "hbao", "gtao", "hao", "reference" };
    nook_fixture_view *view = start(state, 37, 23);
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_box(&mesh, (double[]){ -1, -1, -3 }, (double[]){ 1, 1, -1 }, 63);
    ao_view_add(view, &mesh, 16);
    nook_fixture_mesh_free(&mesh);
    set_way(view, &ways[0], "disc");
    ao_view_param(view, "gtao.thickness", "0.5");
    for (size_t k = 0; k < NOOK_COUNT(techniques) * 3; k++) {
        nook_ao_set_param(view->ao, "ao.r_max", k % 3 == 0 ? 1e-9 : k % 3 == 1 ? 1.0 : 1e9);
        draw_absurdities(view);
        ao_view_record(view, techniques[k / 3]);
    }
    nook_fixture_view_drop_occluders(view);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_filter_gives_a_constant_back_bit_for_bit_and_background_as_one),
        cmocka_unit_test(test_filter_leaks_nothing_across_a_step_of_depth),
        cmocka_unit_test(test_filter_leaks_nothing_across_a_right_angle),
        cmocka_unit_test(test_filter_averages_what_is_around_when_no_sample_is_on_the_surface),
        cmocka_unit_test(test_bilinear_upscaling_weighs_four_by_their_planes_when_none_is_on_the_surface),
        cmocka_unit_test(test_filter_of_a_ramp_stays_near_it_at_every_scale),
        cmocka_unit_test(test_filter_never_writes_nan_whatever_the_buffers_hold),
        cmocka_unit_test(test_techniques_never_write_nan_whatever_the_buffers_hold),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
