/* ao.support: pixels of the trace that the filter finds few like them for. */
#include "modules/ao/ao_internal.h"
#include "tests/support/ao_view.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 64, HEIGHT = 48, PIXELS = WIDTH * HEIGHT };

static int setup(void **state)
{
    *state = ao_view_create(WIDTH, HEIGHT);
    return 0;
}

static nook_fixture_view *start(void **state, const char *scale, const char *upscale)
{
    nook_fixture_view *view = *state;
    nook_ao_reset_params(view->ao);
    view->clip_from_view = nook_matrix_perspective_reversed(0.4, (double)WIDTH / HEIGHT, 0.1);
    view->view_from_world = nook_matrix_identity();
    nook_fixture_view_clear(view);
    view->part = (nook_rectangle){ 0 };
    view->occluder_count = 0;
    ao_view_param(view, "ao.scale", scale);
    ao_view_param(view, "ao.upscale", upscale);
    ao_view_param(view, "ao.r_max", "1");
    return view;
}

/** A wall and, when there are `posts`, posts before it that one or two columns of a trace at quarter resolution meet. */
static void build_wall(nook_fixture_view *view, uint32_t posts)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (const double[]){ -2, -2, -4 }, (const double[]){ 4, 0, 0 },
                          (const double[]){ 0, 4, 0 });
    for (uint32_t i = 0; i < posts; i++) {
        double x = -0.9 + 0.3 * i;
        nook_fixture_add_box(&mesh, (const double[]){ x, -1.2, -3.8 }, (const double[]){ x + 0.1, 1.2, -3.5 }, 63);
    }
    ao_view_draw(view, &mesh);
    assert_true(ao_view_add(view, &mesh, 64) > 0.0);
    nook_fixture_mesh_free(&mesh);
}

static void record(nook_fixture_view *view, const char *rays, const char *support, float *out)
{
    ao_view_param(view, "volume.rays", rays);
    ao_view_param(view, "ao.support", support);
    ao_view_record(view, "volume");
    memcpy(out, view->visibility, PIXELS * sizeof *out);
}

/** Surfaces between wall and posts that face another way from one pixel of the trace to the next, so that none is like another of its window. */
static void draw_clutter(nook_fixture_view *view, uint32_t scale)
{
    const double tilt = 60.0 * 3.14159265358979 / 180.0;
    for (uint32_t i = 0; i < PIXELS; i++) {
        uint32_t way = i % WIDTH / scale % 3 + i / WIDTH / scale % 3 * 3;
        double around = 0.25 * 3.14159265358979 * way, out = way == 8 ? 0.0 : sin(tilt);
        const double normal[3] = { out * cos(around), out * sin(around), way == 8 ? 1.0 : cos(tilt) };
        nook_fixture_view_set_pixel(view, i % WIDTH, i / WIDTH, 3.7, normal);
    }
}

static void test_pixels_that_nothing_is_like_come_closer_to_many_rays_with_every_kind_and_path(void **state)
{
    static const char *const kinds[] = { "binary", "density", "surfel", "distance" }, *const paths[] = { "compute",
                                                                                                         "raster" };
    for (uint32_t k = 0; k < 8; k++) {
        float many[PIXELS], few[PIXELS], supported[PIXELS];
        nook_fixture_view *view = start(state, "quarter", k & 1 ? "stepped" : "bilinear");
        build_wall(view, 7);
        nook_fixture_view_clear(view);
        draw_clutter(view, 4);
        ao_view_param(view, "volume.kind", kinds[k % 4]);
        ao_view_param(view, "volume.path", paths[k / 4]);
        record(view, "128", "1", many);
        record(view, "2", "1", few);
        record(view, "2", "4", supported);
        double before = ao_view_rmse(few, many, PIXELS), after = ao_view_rmse(supported, many, PIXELS);
        if (!(before > 0.1 && after < 0.6 * before))
            fail_msg("%s, %s: off by %.4f, by %.4f without", kinds[k % 4], paths[k / 4], after, before);
    }
}

/* At a corner of the picture 2.5 x 2.5 pixels are in the filter's window. */
static void test_pixels_with_enough_like_them_stay_bit_for_bit(void **state)
{
    float off[PIXELS], on[PIXELS];
    nook_fixture_view *view = start(state, "quarter", "bilinear");
    build_wall(view, 7);
    view->occluder_count = 1;
    nook_fixture_view_clear(view);
    for (uint32_t i = 0; i < PIXELS; i++)
        nook_fixture_view_set_pixel(view, i % WIDTH, i / WIDTH, 3.9, (const double[]){ 0, 0, 1 });
    record(view, "2", "1", off);
    assert_true(ao_view_rmse(off, (const float[PIXELS]){ 0 }, PIXELS) < 0.99); /* something occludes */
    record(view, "2", "6", on);
    assert_memory_equal(off, on, sizeof off);
    record(view, "2", "9", on);
    assert_memory_not_equal(off, on, sizeof off);
}

static void test_only_the_tile_filter_of_a_smaller_trace_has_support(void **state)
{
    static const char *const ways[][3] = { { "full", "bilinear", "tile" },
                                           { "quarter", "direct", "tile" },
                                           { "quarter", "bilinear", "none" },
                                           { "quarter", "stepped", "disc" } };
    for (uint32_t k = 0; k < NOOK_COUNT(ways); k++) {
        float off[PIXELS], on[PIXELS];
        nook_fixture_view *view = start(state, ways[k][0], ways[k][1]);
        build_wall(view, 7);
        ao_view_param(view, "ao.filter", ways[k][2]);
        record(view, "2", "1", off);
        record(view, "2", "16", on);
        assert_memory_equal(off, on, sizeof off);
    }
}

static void test_supported_pictures_are_the_same_bit_for_bit_also_where_there_are_too_many(void **state)
{
    static const char *const shares[] = { "0.25", "0.05" };
    float first[2][PIXELS], off[PIXELS], again[PIXELS];
    nook_fixture_view *view = start(state, "half", "bilinear");
    build_wall(view, 7);
    record(view, "2", "1", off);
    for (uint32_t k = 0; k < 2; k++) {
        ao_view_param(view, "ao.refine_share", shares[k]);
        record(view, "2", "8", first[k]);
        for (uint32_t turn = 0; turn < 3; turn++) {
            record(view, "2", "8", again);
            assert_memory_equal(first[k], again, sizeof again);
        }
    }
    assert_memory_not_equal(first[0], off, sizeof off);
    assert_memory_not_equal(first[1], off, sizeof off);
    assert_memory_not_equal(first[0], first[1], sizeof off);
}

static void test_room_for_what_is_lacking_is_room_enough(void **state)
{
    float all[PIXELS], fitted[PIXELS];
    uint32_t head[5];
    char share[32];
    nook_fixture_view *view = start(state, "half", "bilinear");
    build_wall(view, 7);
    ao_view_param(view, "ao.refine", "off");
    ao_view_param(view, "ao.refine_share", "1");
    record(view, "2", "8", all);
    nook_buffer_read(view->gpu, view->ao->refine.candidates, 0, head, sizeof head);
    assert_in_range(head[4], head[3], 6 * head[3]); /* most of them do not lack all 7 */
    snprintf(share, sizeof share, "%.6f", (double)head[4] / PIXELS);
    ao_view_param(view, "ao.refine_share", share);
    record(view, "2", "8", fitted);
    assert_true(view->ao->refine.capacity < 7 * head[3]);
    assert_memory_equal(fitted, all, sizeof all);
}

static void test_support_of_a_part_is_bit_for_bit_that_of_the_whole_picture(void **state)
{
    float whole[PIXELS], part[PIXELS];
    nook_fixture_view *view = start(state, "quarter", "bilinear");
    build_wall(view, 7);
    record(view, "2", "4", whole);
    view->part = (nook_rectangle){ 19, 11, 21, 17 };
    record(view, "2", "4", part);
    for (uint32_t y = view->part.y; y < view->part.y + view->part.height; y++)
        for (uint32_t x = view->part.x; x < view->part.x + view->part.width; x++)
            assert_memory_equal(&part[y * WIDTH + x], &whole[y * WIDTH + x], sizeof *whole);
}

static void test_support_and_traced_refinement_share_their_lists(void **state)
{
    float alone[PIXELS], both[PIXELS];
    nook_ao_statistics statistics[2];
    nook_fixture_view *view = start(state, "quarter", "bilinear");
    build_wall(view, 7);
    ao_view_param(view, "ao.refine", "traced");
    record(view, "2", "1", alone);
    nook_ao_get_statistics(view->ao, &statistics[0]);
    record(view, "2", "4", both);
    nook_ao_get_statistics(view->ao, &statistics[1]);
    assert_true(statistics[0].refined > 0);
    assert_int_equal(statistics[0].refined, statistics[1].refined);
    assert_memory_not_equal(alone, both, sizeof alone);
}

static void test_supported_pixels_where_nothing_occludes_are_open(void **state)
{
    float open[PIXELS];
    nook_fixture_view *view = start(state, "quarter", "bilinear");
    build_wall(view, 7);
    view->occluder_count = 0;
    record(view, "2", "16", open);
    for (uint32_t i = 0; i < PIXELS; i++)
        assert_true(open[i] == 1.0f);
}

static void test_screen_space_has_support_too(void **state)
{
    static const char *const techniques[] = { "ssao", "hbao", "hsao", "gtao" };
    for (uint32_t t = 0; t < NOOK_COUNT(techniques); t++) {
        float off[PIXELS];
        nook_fixture_view *view = start(state, "half", "bilinear");
        build_wall(view, 7);
        ao_view_param(view, "ao.count", "1");
        ao_view_record(view, techniques[t]);
        memcpy(off, view->visibility, sizeof off);
        ao_view_param(view, "ao.support", "8");
        ao_view_record(view, techniques[t]);
        assert_int_equal(view->outside, 0);
        assert_memory_not_equal(off, view->visibility, sizeof off);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pixels_that_nothing_is_like_come_closer_to_many_rays_with_every_kind_and_path),
        cmocka_unit_test(test_pixels_with_enough_like_them_stay_bit_for_bit),
        cmocka_unit_test(test_only_the_tile_filter_of_a_smaller_trace_has_support),
        cmocka_unit_test(test_supported_pictures_are_the_same_bit_for_bit_also_where_there_are_too_many),
        cmocka_unit_test(test_room_for_what_is_lacking_is_room_enough),
        cmocka_unit_test(test_support_of_a_part_is_bit_for_bit_that_of_the_whole_picture),
        cmocka_unit_test(test_support_and_traced_refinement_share_their_lists),
        cmocka_unit_test(test_supported_pixels_where_nothing_occludes_are_open),
        cmocka_unit_test(test_screen_space_has_support_too),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
