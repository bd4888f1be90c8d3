/* ao.refine: pixels of the picture that no pixel of the trace stands for. */
#include "modules/ao/refine_internal.h"
#include "tests/support/ao_view.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 64, HEIGHT = 48, PIXELS = WIDTH * HEIGHT };

static const double facing[3] = { 0, 0, 1 }, sideways[3] = { 0.96, 0, 0.28 };
static const char *const upscales[] = { "stepped", "bilinear" }, *const scales[] = { "half", "quarter" };

static int setup(void **state)
{
    *state = ao_view_create(WIDTH, HEIGHT);
    return 0;
}

static nook_fixture_view *start(void **state, const char *scale, const char *upscale, const char *refine)
{
    nook_fixture_view *view = *state;
    nook_ao_reset_params(view->ao);
    view->clip_from_view = nook_matrix_perspective_reversed(0.4, (double)WIDTH / HEIGHT, 0.1);
    nook_fixture_view_clear(view);
    view->part = (nook_rectangle){ 0 };
    ao_view_probe(view)->paint = NULL;
    ao_view_param(view, "ao.scale", scale);
    ao_view_param(view, "ao.upscale", upscale);
    ao_view_param(view, "ao.refine", refine);
    return view;
}

static nook_ao_statistics statistics_of(const nook_fixture_view *view)
{
    nook_ao_statistics statistics;
    nook_ao_get_statistics(view->ao, &statistics);
    return statistics;
}

/* ---- From samples farther away */

static float paint_strip(const ao_probe *probe, uint32_t x, uint32_t y)
{
    return probe->depth[y * probe->width + x] > 5.2f ? 0.2f : 0.9f;
}

/** A wall with a strip one pixel wide, deeper and with another normal: the middles of blocks meet it below row 24 and miss it above. */
static void draw_strip(nook_fixture_view *view)
{
    for (uint32_t i = 0; i < PIXELS; i++) {
        uint32_t x = i % WIDTH, y = i / WIDTH;
        int strip = x == (y < 24 ? 22u : 23u);
        nook_fixture_view_set_pixel(view, x, y, strip ? 5.5 : 5.0, strip ? sideways : facing);
    }
    ao_view_param(view, "ao.filter", "none");
    ao_view_probe(view)->paint = paint_strip;
}

static void test_around_takes_what_the_trace_has_met_of_a_strip_farther_along(void **state)
{
    for (uint32_t u = 0; u < 2; u++) {
        nook_fixture_view *view = start(state, "quarter", upscales[u], "off");
        const uint32_t unmet = 27 * WIDTH + 23, wall = 27 * WIDTH + 26;
        draw_strip(view);
        ao_view_record(view, "probe");
        if (u == 1) /* the other has looked at 5x5 before, by the plane alone */
            assert_true(view->visibility[unmet] > 0.85f);
        ao_view_param(view, "ao.refine", "around");
        ao_view_record(view, "probe");
        assert_true(fabsf(view->visibility[unmet] - 0.2f) < 0.05f);
        assert_true(view->visibility[wall] == 0.9f);
    }
}

static void test_around_leaves_what_no_strip_crosses_as_it_is(void **state)
{
    for (uint32_t u = 0; u < 2; u++) {
        nook_fixture_view *view = start(state, "quarter", upscales[u], "off");
        float *before = malloc(PIXELS * sizeof *before);
        uint32_t changed = 0;
        assert_non_null(before);
        draw_strip(view);
        ao_view_record(view, "probe");
        memcpy(before, view->visibility, PIXELS * sizeof *before);
        ao_view_param(view, "ao.refine", "around");
        ao_view_record(view, "probe");
        for (uint32_t i = 0; i < PIXELS; i++) {
            int strip = i % WIDTH == (i / WIDTH < 24 ? 22u : 23u);
            changed += before[i] != view->visibility[i];
            if (!strip && before[i] != view->visibility[i])
                fail_msg("%s, pixel %u, %u: %.9g became %.9g", upscales[u], i % WIDTH, i / WIDTH, before[i],
                         view->visibility[i]);
        }
        assert_true(changed > 3);
        free(before);
    }
}

static float paint_constant(const ao_probe *probe, uint32_t x, uint32_t y)
{
    (void)x, (void)y;
    return probe->painted;
}

/** Depths and normals as wild as they come. */
static void draw_clutter(nook_fixture_view *view, uint32_t seed)
{
    for (uint32_t i = 0; i < PIXELS; i++) {
        double n[3], length = 0.0;
        for (int axis = 0; axis < 3; axis++) {
            seed = seed * 1664525u + 1013904223u;
            n[axis] = (double)(seed >> 8) / 16777216.0 - 0.5;
            length += n[axis] * n[axis];
        }
        for (int axis = 0; axis < 3; axis++)
            n[axis] /= sqrt(length);
        nook_fixture_view_set_pixel(view, i % WIDTH, i / WIDTH, 0.1 * pow(1e4, (double)(seed >> 8) / 16777216.0), n);
    }
}

static void test_around_gives_a_constant_back_bit_for_bit(void **state)
{
    for (uint32_t k = 0; k < 24; k++) {
        nook_fixture_view *view = start(state, scales[k & 1], upscales[k >> 1 & 1], "around");
        ao_view_param(view, "ao.refine_reach", k % 3 == 0 ? "1" : k % 3 == 1 ? "2" : "3");
        draw_clutter(view, k);
        ao_view_probe(view)->paint = paint_constant;
        ao_view_probe(view)->painted = 0.7123456f;
        ao_view_record(view, "probe");
        for (uint32_t i = 0; i < PIXELS; i++)
            if (view->visibility[i] != 0.7123456f)
                fail_msg("case %u, pixel %u: %.9g", k, i, view->visibility[i]);
    }
}

static void test_around_of_a_part_is_bit_for_bit_that_of_the_whole_picture(void **state)
{
    for (uint32_t k = 0; k < 4; k++) {
        nook_fixture_view *view = start(state, scales[k & 1], upscales[k >> 1], "around");
        float whole[PIXELS];
        ao_view_param(view, "ao.refine_reach", "3");
        draw_strip(view);
        ao_view_record(view, "probe");
        memcpy(whole, view->visibility, sizeof whole);
        view->part = (nook_rectangle){ 19, 25, 9, 11 };
        ao_view_record(view, "probe");
        for (uint32_t y = view->part.y; y < view->part.y + view->part.height; y++)
            for (uint32_t x = view->part.x; x < view->part.x + view->part.width; x++)
                assert_memory_equal(&view->visibility[y * WIDTH + x], &whole[y * WIDTH + x], sizeof *whole);
    }
}

/* ---- Traced by themselves */

/** Posts thinner than a pixel of the trace before a wall, in the way of its sky; and the volume of all of it. */
static void build_posts(nook_fixture_view *view, uint32_t resolution)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (const double[]){ -2, -2, -4 }, (const double[]){ 4, 0, 0 },
                          (const double[]){ 0, 4, 0 });
    for (int i = 0; i < 7; i++) {
        double x = -0.9 + 0.3 * i;
        nook_fixture_add_box(&mesh, (const double[]){ x, -1.2, -3.8 }, (const double[]){ x + 0.05, 1.2, -3.5 }, 63);
    }
    ao_view_draw(view, &mesh);
    view->occluder_count = 0;
    assert_true(ao_view_add(view, &mesh, resolution) > 0.0);
    nook_fixture_mesh_free(&mesh);
}

static double rmse(const float *a, const float *b)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < PIXELS; i++)
        sum += ((double)a[i] - b[i]) * ((double)a[i] - b[i]);
    return sqrt(sum / PIXELS);
}

/** By `volume`, 64 rays of r_max 1 m. */
static void record_posts(nook_fixture_view *view, const char *kind, const char *path, float *out)
{
    ao_view_param(view, "ao.r_max", "1");
    ao_view_param(view, "volume.rays", "64");
    ao_view_param(view, "volume.kind", kind);
    ao_view_param(view, "volume.path", path);
    ao_view_record(view, "volume");
    memcpy(out, view->visibility, PIXELS * sizeof *out);
}

static void test_traced_pixels_come_to_the_full_resolution_with_every_kind_and_path(void **state)
{
    static const char *const kinds[] = { "binary", "density", "surfel", "distance" }, *const paths[] = { "compute",
                                                                                                         "raster" };
    for (uint32_t k = 0; k < 8; k++) {
        float full[PIXELS], off[PIXELS], traced[PIXELS];
        nook_fixture_view *view = start(state, "full", "stepped", "off");
        build_posts(view, 64);
        record_posts(view, kinds[k % 4], paths[k / 4], full);
        ao_view_param(view, "ao.scale", "quarter");
        record_posts(view, kinds[k % 4], paths[k / 4], off);
        assert_int_equal(statistics_of(view).refined, 0);
        ao_view_param(view, "ao.refine", "traced");
        record_posts(view, kinds[k % 4], paths[k / 4], traced);
        assert_true(statistics_of(view).refined > 0);
        if (!(rmse(traced, full) < 0.7 * rmse(off, full)))
            fail_msg("%s, %s: %u pixels traced, off by %.4f of the full resolution; without that by %.4f", kinds[k % 4],
                     paths[k / 4], statistics_of(view).refined, rmse(traced, full), rmse(off, full));
    }
}

static void test_traced_pictures_are_the_same_bit_for_bit_also_where_there_are_too_many(void **state)
{
    static const char *const shares[] = { "0.25", "0.05" };
    uint32_t refined[2] = { 0 };
    for (uint32_t k = 0; k < 2; k++) {
        float first[PIXELS], again[PIXELS];
        nook_fixture_view *view = start(state, "quarter", "stepped", "traced");
        ao_view_param(view, "ao.refine_share", shares[k]);
        build_posts(view, 64);
        record_posts(view, "surfel", "compute", first);
        for (uint32_t turn = 0; turn < 5; turn++) {
            record_posts(view, "surfel", "compute", again);
            assert_memory_equal(first, again, sizeof first);
        }
        refined[k] = statistics_of(view).refined;
    }
    assert_true(refined[1] > 0 && refined[1] < refined[0]);
    assert_true(refined[1] <= (uint32_t)(0.05 * PIXELS) + 64);
}

/** By two rays a pixel. */
static void record_few(nook_fixture_view *view, const char *scale, const char *filter, const char *refine, float *out)
{
    ao_view_param(view, "volume.rays", "2");
    ao_view_param(view, "ao.scale", scale);
    ao_view_param(view, "ao.filter", filter);
    ao_view_param(view, "ao.refine", refine);
    ao_view_record(view, "volume");
    memcpy(out, view->visibility, PIXELS * sizeof *out);
}

static void test_traced_pixels_are_averaged_over_their_like(void **state)
{
    float many[PIXELS], few[PIXELS], around[PIXELS], traced[PIXELS];
    double error = 0.0, unfiltered = 0.0;
    uint32_t refined = 0;
    nook_fixture_view *view = start(state, "full", "stepped", "off");
    build_posts(view, 64);
    record_posts(view, "binary", "compute", many);
    record_few(view, "full", "none", "off", few);
    record_few(view, "quarter", "tile", "around", around);
    record_few(view, "quarter", "tile", "traced", traced);
    for (uint32_t i = 0; i < PIXELS; i++) {
        if (traced[i] == around[i])
            continue;
        error += pow((double)traced[i] - (double)many[i], 2.0);
        unfiltered += pow((double)few[i] - (double)many[i], 2.0);
        refined++;
    }
    assert_true(refined > 100);
    if (!(sqrt(error) < 0.75 * sqrt(unfiltered)))
        fail_msg("off by %.4f over %u pixels, where the rays themselves are by %.4f", sqrt(error / refined), refined,
                 sqrt(unfiltered / refined));
}

static void test_traced_pixels_where_nothing_occludes_are_open(void **state)
{
    nook_fixture_view *view = start(state, "quarter", "bilinear", "traced");
    float open[PIXELS];
    build_posts(view, 64);
    view->occluder_count = 0;
    record_posts(view, "binary", "compute", open);
    assert_true(statistics_of(view).refined > 0);
    for (uint32_t i = 0; i < PIXELS; i++)
        assert_true(open[i] == 1.0f);
}

static void test_traced_is_around_for_a_technique_that_traces_no_list(void **state)
{
    float around[PIXELS];
    nook_fixture_view *view = start(state, "quarter", "stepped", "around");
    draw_strip(view);
    ao_view_record(view, "probe");
    memcpy(around, view->visibility, sizeof around);
    ao_view_param(view, "ao.refine", "traced");
    ao_view_record(view, "probe");
    assert_memory_equal(around, view->visibility, sizeof around);
    assert_int_equal(statistics_of(view).refined, 0);
}

/* As of 4K: what a quarter of its pixels takes has more rows of 64 than a texture of many devices. */
static void test_lists_of_large_pictures_are_cut_to_what_a_texture_holds(void **state)
{
    nook_fixture_view *view = *state;
    const uint32_t most = view->gpu->max_texture_size, width = most / 4;
    ao_refine refine = { .pixels = 0 };
    assert_int_equal(ao_refine_fit(view->gpu, &refine, width, 512, 2, 1.0), NOOK_OK);
    assert_int_equal(refine.capacity, 64 * most);
    assert_int_equal(refine.traced.height, most);
    ao_refine_release(view->gpu, &refine);
}

static int is_power_of_two(uint32_t n)
{
    return (n & (n - 1)) == 0;
}

/* Else llvmpipe compiles the program that traces both once for each of them. */
static void test_the_image_of_a_list_has_sides_that_are_powers_of_two_where_those_of_the_trace_are(void **state)
{
    static const uint32_t sizes[][2] = { { 640, 360 }, { 512, 512 }, { 512, 288 }, { 636, 256 }, { 4, 4 }, { 12, 12 } };
    nook_fixture_view *view = *state;
    for (uint32_t i = 0; i < NOOK_COUNT(sizes); i++) {
        ao_refine refine = { .pixels = 0 };
        assert_int_equal(ao_refine_fit(view->gpu, &refine, sizes[i][0], sizes[i][1], 4, 0.25), NOOK_OK);
        assert_int_equal(is_power_of_two(refine.traced.width), is_power_of_two(sizes[i][0] / 4));
        assert_int_equal(is_power_of_two(refine.traced.height), is_power_of_two(sizes[i][1] / 4));
        assert_true(refine.traced.width >= 64 && refine.traced.width * refine.traced.height >= refine.capacity);
        ao_refine_release(view->gpu, &refine);
    }
}

static void test_screen_space_traces_lists_too(void **state)
{
    static const char *const techniques[] = { "ssao", "hbao", "hsao", "gtao" };
    for (uint32_t t = 0; t < NOOK_COUNT(techniques); t++) {
        nook_fixture_view *view = start(state, "half", "bilinear", "traced");
        build_posts(view, 64);
        ao_view_param(view, "ao.r_max", "1");
        ao_view_param(view, "ao.count", "1");
        ao_view_record(view, techniques[t]);
        assert_true(statistics_of(view).refined > 0);
        assert_int_equal(view->outside, 0);
        for (uint32_t i = 0; i < PIXELS; i++)
            assert_true(view->visibility[i] >= 0.0f && view->visibility[i] <= 1.0f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_around_takes_what_the_trace_has_met_of_a_strip_farther_along),
        cmocka_unit_test(test_around_leaves_what_no_strip_crosses_as_it_is),
        cmocka_unit_test(test_around_gives_a_constant_back_bit_for_bit),
        cmocka_unit_test(test_around_of_a_part_is_bit_for_bit_that_of_the_whole_picture),
        cmocka_unit_test(test_traced_pixels_come_to_the_full_resolution_with_every_kind_and_path),
        cmocka_unit_test(test_traced_pictures_are_the_same_bit_for_bit_also_where_there_are_too_many),
        cmocka_unit_test(test_traced_pixels_are_averaged_over_their_like),
        cmocka_unit_test(test_traced_pixels_where_nothing_occludes_are_open),
        cmocka_unit_test(test_traced_is_around_for_a_technique_that_traces_no_list),
        cmocka_unit_test(test_lists_of_large_pictures_are_cut_to_what_a_texture_holds),
        cmocka_unit_test(test_the_image_of_a_list_has_sides_that_are_powers_of_two_where_those_of_the_trace_are),
        cmocka_unit_test(test_screen_space_traces_lists_too),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
