/* ao.downsample: which surface of its block a pixel of the trace stands for. */
#include "tests/support/ao_view.h"
#include <math.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 50, HEIGHT = 34 }; /* blocks at the border are not whole */

static const double facing[3] = { 0, 0, 1 }, sideways[3] = { 0.8, 0, 0.6 };

static int setup(void **state)
{
    *state = ao_view_create(WIDTH, HEIGHT);
    return 0;
}

/** A picture of nothing, at half or quarter resolution. @return pixels of the picture per pixel of the trace */
static uint32_t start(nook_fixture_view *view, uint32_t k, const char *downsample)
{
    view->clip_from_view = nook_matrix_perspective_reversed(0.4, (double)WIDTH / HEIGHT, 0.1);
    nook_fixture_view_clear(view);
    ao_view_param(view, "ao.scale", k == 0 ? "half" : "quarter");
    ao_view_param(view, "ao.downsample", downsample);
    return 2u << k;
}

/** Where the plane through (0, 0, -depth) with normal n is seen through a pixel. */
static double distance_to_plane(const nook_fixture_view *view, uint32_t x, uint32_t y, const double n[3], double depth)
{
    double ray[3];
    nook_fixture_view_position(view, x, y, 1.0, ray);
    return -depth * n[2] / (n[0] * ray[0] + n[1] * ray[1] + n[2] * ray[2]);
}

/** Holds the trace to a plane; `cut`: also where a block reaches over the border, and one row of the picture votes alone. */
static void expect_plane(const nook_fixture_view *view, uint32_t scale, const double n[3], double depth, bool cut)
{
    const ao_probe *probe = ao_view_probe(view);
    assert_int_equal(probe->width * probe->height, ((WIDTH + scale - 1) / scale) * ((HEIGHT + scale - 1) / scale));
    for (uint32_t i = 0; i < probe->width * probe->height; i++) {
        uint32_t x = i % probe->width * scale + scale / 2, y = i / probe->width * scale + scale / 2;
        if (!cut && (x + scale - scale / 2 > WIDTH || y + scale - scale / 2 > HEIGHT))
            continue;
        x = x < WIDTH ? x : WIDTH - 1, y = y < HEIGHT ? y : HEIGHT - 1;
        double truth = distance_to_plane(view, x, y, n, depth), normal[3];
        nook_fixture_decode_normal(probe->normals[i], normal);
        double cosine = normal[0] * n[0] + normal[1] * n[1] + normal[2] * n[2];
        if (!(fabs(probe->depth[i] - truth) < 1e-5 * truth && cosine > 1.0 - 1e-6))
            fail_msg("scale %u, pixel (%u, %u): distance %.9g, of the plane %.9g; cosine %.9g", scale, x, y,
                     probe->depth[i], truth, cosine);
    }
}

static void test_majority_stands_on_the_plane_itself_through_the_middle_of_the_block(void **state)
{
    nook_fixture_view *view = *state;
    for (uint32_t k = 0; k < 2; k++) {
        uint32_t scale = start(view, k, "majority");
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
            nook_fixture_view_set_pixel(view, i % WIDTH, i / WIDTH,
                                        distance_to_plane(view, i % WIDTH, i / WIDTH, sideways, 5.0), sideways);
        ao_view_record(view, "probe");
        expect_plane(view, scale, sideways, 5.0, true);
    }
}

/** A wall with a joint one pixel wide, deeper and with another normal, in every fourth row and column from `phase` on. */
static void draw_joints(nook_fixture_view *view, uint32_t phase)
{
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        uint32_t x = i % WIDTH, y = i / WIDTH;
        int joint = (x + y / 4 * 4) % 12 == phase || y % 12 == phase;
        nook_fixture_view_set_pixel(view, x, y, joint ? 5.5 : 5.0, joint ? sideways : facing);
    }
}

static void test_majority_leaves_joints_of_a_pixel_to_the_upscaling_wherever_they_lie(void **state)
{
    nook_fixture_view *view = *state;
    for (uint32_t phase = 0; phase < 12; phase++) {
        uint32_t scale = start(view, 1, "majority");
        draw_joints(view, phase);
        ao_view_record(view, "probe");
        expect_plane(view, scale, facing, 5.0, false);
    }
    start(view, 1, "centre"); /* which meets those that lie in the middle of blocks */
    draw_joints(view, 2);
    ao_view_record(view, "probe");
    uint32_t met = 0;
    for (uint32_t i = 0; i < ao_view_probe(view)->width * ao_view_probe(view)->height; i++)
        met += ao_view_probe(view)->depth[i] > 5.1f;
    assert_true(met > ao_view_probe(view)->width);
}

static void test_majority_is_of_what_is_seen_and_nothing_only_where_all_see_nothing(void **state)
{
    nook_fixture_view *view = *state;
    for (uint32_t k = 0; k < 2; k++) {
        uint32_t scale = start(view, k, "majority");
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) /* blocks of one seen row of all, and those of none, in turns */
            if (i / WIDTH % scale == 1 && i % WIDTH / scale % 2 == 0)
                nook_fixture_view_set_pixel(view, i % WIDTH, i / WIDTH, 3.0, facing);
        ao_view_record(view, "probe");
        const ao_probe *probe = ao_view_probe(view);
        for (uint32_t i = 0; i + probe->width < probe->width * probe->height; i++) { /* the last row is cut */
            double got = probe->depth[i], truth = i % probe->width % 2 ? 0.0 : 3.0;
            if (i % probe->width + 1 < probe->width && fabs(got - truth) > 1e-5)
                fail_msg("scale %u, pixel %u of the trace: distance %g, not %g", scale, i, got, truth);
        }
    }
}

static void test_majority_of_a_plane_seen_from_its_edge_stays_near_what_was_seen(void **state)
{
    const double edge[3] = { 1.0, 0.0, 1e-4 };
    nook_fixture_view *view = *state;
    for (uint32_t k = 0; k < 2; k++) {
        uint32_t scale = start(view, k, "majority");
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
            nook_fixture_view_set_pixel(view, i % WIDTH, i / WIDTH, 4.0, edge);
        ao_view_record(view, "probe");
        double block = 4.0 * 2.0 * tan(0.2) / HEIGHT * scale;
        for (uint32_t i = 0; i < ao_view_probe(view)->width * ao_view_probe(view)->height; i++)
            assert_true(fabs((double)ao_view_probe(view)->depth[i] - 4.0) <= 4.0 * block * 1.0001);
    }
}

static void test_majority_starts_on_what_the_middle_of_the_block_sees_where_its_plane_goes_on_behind_that(void **state)
{
    nook_fixture_view *view = *state;
    for (uint32_t near = 0; near < 2;
         near++) { /* what is nearer by more than four blocks is another thing, and the plane's place stays */
        double before = near ? 3.0 : 4.98;
        uint32_t scale = start(view, 1, "majority");
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
            uint32_t x = i % WIDTH, y = i / WIDTH;
            bool middle = x % scale == scale / 2 && y % scale == scale / 2;
            nook_fixture_view_set_pixel(view, x, y, middle ? before : 5.0, facing);
        }
        ao_view_record(view, "probe");
        expect_plane(view, scale, facing, near ? 5.0 : before, false);
    }
}

static void test_another_downsample_counts_for_a_view_that_stayed_the_same(void **state)
{
    nook_fixture_view *view = *state;
    start(view, 1, "centre");
    draw_joints(view, 2);
    ao_view_record(view, "probe");
    float with_joints = ao_view_probe(view)->depth[0];
    view->same_view = true;
    ao_view_param(view, "ao.downsample", "majority");
    ao_view_record(view, "probe");
    view->same_view = false;
    assert_true(fabsf(with_joints - 5.5f) < 1e-3f);
    expect_plane(view, 4, facing, 5.0, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_majority_stands_on_the_plane_itself_through_the_middle_of_the_block),
        cmocka_unit_test(test_majority_leaves_joints_of_a_pixel_to_the_upscaling_wherever_they_lie),
        cmocka_unit_test(test_majority_is_of_what_is_seen_and_nothing_only_where_all_see_nothing),
        cmocka_unit_test(test_majority_of_a_plane_seen_from_its_edge_stays_near_what_was_seen),
        cmocka_unit_test(test_majority_starts_on_what_the_middle_of_the_block_sees_where_its_plane_goes_on_behind_that),
        cmocka_unit_test(test_another_downsample_counts_for_a_view_that_stayed_the_same),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
