/* What ao.count = 1 counts: values out of range, and texture fetches, here by hand: a wall that faces the camera, every pixel of it on one plane, and a reach so short
   that every sample falls into the pixel it belongs to. */
#include "modules/ao/technique.h"
#include "tests/support/ao_view.h"
#include <math.h>
#include <stdio.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 24, HEIGHT = 16 };

static const double facing[3] = { 0, 0, 1 };

static nook_result record_mistakes(void *state, const void *params, const nook_ao_pass *pass)
{
    (void)state, (void)params;
    return nook_ao_pass_dispatch(pass, "tests/ao/mistaken.comp.glsl", 16, 8);
}

static const nook_ao_technique mistaken = { .version = NOOK_AO_TECHNIQUE_VERSION,
                                            .name = "mistaken",
                                            .summary = "Wrong in three columns",
                                            .record = record_mistakes };

static int setup(void **state)
{
    nook_fixture_view *view = ao_view_create(WIDTH, HEIGHT);
    assert_int_equal(nook_ao_add_technique(view->ao, &mistaken), NOOK_OK);
    *state = view;
    return 0;
}

/** Columns from `first` on show the wall. */
static nook_fixture_view *start(void **state, uint32_t first)
{
    nook_fixture_view *view = *state;
    nook_ao_reset_params(view->ao);
    ao_view_param(view, "ao.count", "1");
    ao_view_param(view, "ao.r_max", "1e-6");
    ao_view_param(view, "ao.filter", "none");
    ao_view_probe(view)->paint = NULL;
    view->without_normals = false;
    nook_fixture_view_clear(view);
    for (uint32_t y = 0; y < view->height; y++) {
        for (uint32_t x = first; x < view->width; x++)
            nook_fixture_view_set_pixel(view, x, y, 2.0, facing);
    }
    return view;
}

/** Per pixel with geometry. */
static double counted(nook_fixture_view *view, const char *technique)
{
    nook_ao_statistics statistics;
    ao_view_record(view, technique);
    nook_ao_get_statistics(view->ao, &statistics);
    return statistics.fetches_per_pixel;
}

static void expect(nook_fixture_view *view, const char *technique, double fetches)
{
    double got = counted(view, technique);
    if (fabs(got - fetches) > 1e-9 * fetches)
        fail_msg("%s: %.6f fetches a pixel, by hand %.6f", technique, got, fetches);
}

/** Trace pixels in the picture less than 2.5 of them away from the full pixels of one axis: what the tile filter looks at. */
static double tile_samples(int size, int scale)
{
    int count = 0;
    for (int pixel = 0; pixel < size; pixel++) {
        double centre = (pixel - scale / 2) / (double)scale;
        for (int sample = 0; sample < size / scale; sample++)
            count += fabs(sample - centre) < 2.5;
    }
    return count;
}

enum { PREPARE = 2, RECEIVER = 2 }; /* depth and normal each */

static void test_fetches_of_a_trace_hold_the_receiver_and_all_samples(void **state)
{
    nook_fixture_view *view = start(state, 0);
    ao_view_param(view, "ssao.samples", "5");
    expect(view, "ssao", PREPARE + RECEIVER + 5 * 2); /* a direction and a depth */
    ao_view_param(view, "hsao.directions", "3");
    ao_view_param(view, "hsao.steps", "4");
    ao_view_param(view, "hsao.rays", "2");
    ao_view_param(view, "hsao.ray_steps", "5");
    expect(view, "hsao", PREPARE + RECEIVER + 3 * (4 + 2 * 5));
    ao_view_param(view, "hbao.directions", "6");
    ao_view_param(view, "hbao.steps", "7");
    expect(view, "hbao", PREPARE + RECEIVER + 6 * 7);
    ao_view_param(view, "gtao.slices", "3");
    ao_view_param(view, "gtao.steps", "5");
    expect(view, "gtao", PREPARE + RECEIVER + 3 * 2 * 5);
    expect(view, "hao", PREPARE + RECEIVER); /* without meshes no ray is followed */
    expect(view, "volume", PREPARE);         /* without occluders there is nothing to trace */
    expect(view, "probe", PREPARE);
    expect(view, "reference", 0.0); /* its work is on the CPU */
}

static void test_fetches_of_work_in_parts_hold_the_receiver_once_a_part(void **state)
{
    nook_fixture_view *view = start(state, 0);
    ao_view_param(view, "hbao.directions", "256");
    ao_view_param(view, "hbao.steps", "256"); /* NOOK_AO_TURNS_PER_DISPATCH is enough for 233 azimuths of 257 turns */
    expect(view, "hbao", PREPARE + 2 * RECEIVER + 256 * 256);
}

static void test_fetches_of_the_filter_and_of_upscaling_count(void **state)
{
    nook_fixture_view *view = start(state, 0);
    const double pixels = WIDTH * HEIGHT;
    ao_view_param(view, "ssao.samples", "3");
    for (int k = 0; k < 3; k++) {
        int scale = 1 << k;
        ao_view_param(view, "ao.scale", nook_fixture_scales[k]);
        /* At full size nothing is picked; the guide is a depth and a normal; upscaling finds its start among four depths and
           normals, and reads it. */
        double trace = (k > 0 ? 2.0 : 0.0) + RECEIVER + 3 * 2, guide = 2 + (k > 0 ? 4 * 2 : 0) + 1;
        double before = PREPARE + trace / (scale * scale);
        ao_view_param(view, "ao.filter", "none");
        expect(view, "ssao",
               before + (k > 0 ? guide : 0.0)); /* with neither filter nor upscaling there is no pass for them */
        ao_view_param(view, "ao.filter", "tile");
        expect(view, "ssao", before + guide + 3 * tile_samples(WIDTH, scale) * tile_samples(HEIGHT, scale) / pixels);
    }
    ao_view_param(view, "ao.scale", "full");
    ao_view_param(view, "ao.filter", "disc");
    ao_view_param(view, "ao.filter_radius", "0.5"); /* all 17 samples round to the pixel itself */
    expect(view, "ssao", PREPARE + RECEIVER + 3 * 2 + 3 + 17 * 3);
}

static void test_fetches_where_nothing_is_seen_are_shared_by_the_pixels_that_see(void **state)
{
    const uint32_t hidden = 6;
    nook_fixture_view *view = start(state, hidden);
    ao_view_param(view, "ssao.samples", "5");
    double seen = (WIDTH - hidden) * HEIGHT, unseen = hidden * HEIGHT;
    expect(view, "ssao", PREPARE + RECEIVER + 5 * 2 + unseen / seen * (PREPARE + 1));
}

static void test_fetches_of_rebuilt_normals_count(void **state)
{
    nook_fixture_view *view = start(state, 0);
    view->without_normals = true;
    double neighbours = 2.0 * (WIDTH * (HEIGHT - 1) + HEIGHT * (WIDTH - 1));
    expect(view, "probe", 1 + neighbours / (WIDTH * HEIGHT));
}

static void test_fetches_are_not_counted_unless_asked_for(void **state)
{
    nook_fixture_view *view = start(state, 0);
    ao_view_param(view, "ao.count", "0");
    assert_true(counted(view, "ssao") == 0.0);
}

/** Of a record that need not be right. */
static uint32_t outside(nook_fixture_view *view, const char *technique)
{
    nook_ao_statistics statistics;
    assert_int_equal(nook_fixture_view_record(view, technique), NOOK_OK);
    nook_ao_get_statistics(view->ao, &statistics);
    assert_true(view->outside >= statistics.outside); /* and what is wrong in the picture too */
    return statistics.outside;
}

static void test_values_of_a_trace_that_are_not_visibilities_are_counted_before_the_clamp(void **state)
{
    nook_fixture_view *view = start(state, 0);
    assert_int_equal(outside(view, "mistaken"), 3 * HEIGHT);
    view = start(state, 1);
    assert_int_equal(outside(view, "mistaken"), 2 * HEIGHT); /* nothing is computed where nothing is seen */
    ao_view_param(view, "ao.count", "0");
    assert_int_equal(outside(view, "mistaken"), 0);
    assert_int_equal(view->outside, 2 * HEIGHT); /* a view counts all the same */
}

static float paint(const ao_probe *probe, uint32_t x, uint32_t y)
{
    (void)x, (void)y;
    return probe->painted;
}

static void test_values_of_the_filter_that_are_not_visibilities_are_counted_before_the_clamp(void **state)
{
    static const float wrong[] = { NAN, -INFINITY, -0.0001f, 1.0001f }, right[] = { 0.0f, 1.0f, 0.5f, 1.000001f };
    nook_fixture_view *view = start(state, 0);
    ao_view_param(view, "ao.filter", "tile");
    ao_view_probe(view)->paint = paint;
    for (size_t i = 0; i < NOOK_COUNT(wrong); i++) {
        ao_view_probe(view)->painted = wrong[i];
        assert_int_equal(outside(view, "probe"), WIDTH * HEIGHT);
        ao_view_probe(view)->painted = right[i];
        assert_int_equal(outside(view, "probe"), 0);
    }
}

/** The wall from so flat an angle that the slices of a pixel hold more, or less, than their share of the sky. */
static void test_few_slices_block_no_more_than_all_of_the_sky(void **state)
{
    static const double grazing[3] = { 0.9995, 0, 0.0316 };
    nook_fixture_view *view = start(state, 0);
    ao_view_param(view, "ao.r_max", "100");
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) /* all in a narrow ditch */
            nook_fixture_view_set_pixel(view, x, y, (x + y) % 3 ? 1.0 : 2.0, grazing);
    }
    for (int count = 1; count <= 5; count++) {
        char text[16];
        snprintf(text, sizeof text, "%d", count);
        ao_view_param(view, "gtao.slices", text);
        ao_view_param(view, "hbao.directions", text);
        assert_int_equal(outside(view, "gtao"), 0);
        assert_int_equal(outside(view, "hbao"), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fetches_of_a_trace_hold_the_receiver_and_all_samples),
        cmocka_unit_test(test_fetches_of_work_in_parts_hold_the_receiver_once_a_part),
        cmocka_unit_test(test_fetches_of_the_filter_and_of_upscaling_count),
        cmocka_unit_test(test_fetches_where_nothing_is_seen_are_shared_by_the_pixels_that_see),
        cmocka_unit_test(test_fetches_of_rebuilt_normals_count),
        cmocka_unit_test(test_fetches_are_not_counted_unless_asked_for),
        cmocka_unit_test(test_values_of_a_trace_that_are_not_visibilities_are_counted_before_the_clamp),
        cmocka_unit_test(test_values_of_the_filter_that_are_not_visibilities_are_counted_before_the_clamp),
        cmocka_unit_test(test_few_slices_block_no_more_than_all_of_the_sky),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
