/* Screen-space techniques on an exact G-buffer: what they get right, and what a depth buffer cannot know. */
#include "engine/core/angle.h"
#include "modules/fixture/closed_form.h"
#include "tests/support/ao_screen.h"
#include <math.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 96 };

static const char *const screen_space[] = { "ssao", "hsao", "hbao", "gtao" };

static int setup(void **state)
{
    *state = ao_view_create(SIDE, SIDE);
    return 0;
}

/** Nothing drawn yet; a camera; enough samples that noise does not matter. */
static nook_fixture_view *look(void **state, const double eye[3], const double target[3], double angle, double r_max)
{
    static const char *const settings[][2] = {
        { "ssao.samples", "256" },  { "hsao.directions", "32" }, { "hsao.steps", "64" }, { "hsao.rays", "4" },
        { "hsao.ray_steps", "32" }, { "hbao.directions", "16" }, { "hbao.steps", "48" }, { "gtao.slices", "8" },
        { "gtao.steps", "48" },     { "reference.rays", "256" },
    };
    nook_fixture_view *view = *state;
    for (size_t i = 0; i < NOOK_COUNT(settings); i++)
        ao_view_param(view, settings[i][0], settings[i][1]);
    ao_screen_look(view, eye, target, angle, r_max);
    return view;
}

static void test_screen_space_sees_nothing_above_an_open_floor_at_any_tilt(void **state)
{
    static const double eyes[][3] = { { 0, 0.001, 3 }, { 0, -2, 2 }, { 1, -4, 1.5 } };
    for (size_t i = 0; i < NOOK_COUNT(eyes); i++) {
        nook_fixture_view *view = look(state, eyes[i], (double[]){ 0, 0, 0 }, 0.8, 0.5);
        nook_fixture_mesh mesh = { 0 };
        ao_screen_add_floor(&mesh);
        ao_screen_show(view, &mesh);
        for (size_t k = 0; k < NOOK_COUNT(screen_space); k++) {
            double mean = ao_screen_measure(view, screen_space[k]);
            if (mean >= (k == 1 ? 0.01 : 1e-3)) /* hsao's tangent is a texel's */
                fail_msg("%s, eye %zu: A = %.4f", screen_space[k], i, mean);
        }
    }
}

/** Reaches from far below a texel, where all points fall into the receiver's own, to several of them. */
static void test_ssao_leaves_an_open_floor_open_at_any_reach(void **state)
{
    for (double r_max = 1e-4; r_max < 0.5; r_max *= 4.0) {
        nook_fixture_view *view = look(state, (double[]){ 1, -4, 1.5 }, (double[]){ 0, 0, 0 }, 0.8, r_max);
        nook_fixture_mesh mesh = { 0 };
        ao_screen_add_floor(&mesh);
        ao_screen_show(view, &mesh);
        double mean = ao_screen_measure(view, "ssao");
        if (mean >= 1e-4)
            fail_msg("r_max %g: A = %.4f", r_max, mean);
    }
}

static void test_hsao_weights_by_the_cosine_at_the_bottom_of_a_pit(void **state)
{
    nook_fixture_view *view = look(state, (double[]){ 0, 0, 4 }, (double[]){ 0, 0, 0 }, 1.0, 2);
    nook_fixture_mesh mesh = { 0 };
    ao_screen_add_pit(&mesh, 1.0, 1.0);
    ao_screen_show(view, &mesh);
    /* Equation 1: D^2 / (R^2 + D^2). Without the cosine, as classic HBAO integrates, it would be 0.7071: erratum C18. */
    double truth = ao_screen_measure_centre(view, "reference"), hsao = ao_screen_measure_centre(view, "hsao");
    assert_true(fabs(truth - 0.5) < 0.01);
    if (fabs(hsao - 0.5) >= 0.04)
        fail_msg("A = %.4f, truth 0.5", hsao);
}

static void test_hsao_is_near_the_truth_in_a_corner_that_the_camera_sees(void **state)
{
    const double k = 0.3, truth = nook_form_wall(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, k); /* a wall at 0.3 r_max */
    nook_fixture_view *view = look(state, (double[]){ -2, 0, 3 }, (double[]){ 0, 0, 0 }, 0.6, 1);
    nook_fixture_mesh mesh = { 0 };
    ao_screen_add_corner(&mesh, k, NOOK_PI / 2);
    ao_screen_show(view, &mesh);
    double reference = ao_screen_measure_centre(view, "reference"), hsao = ao_screen_measure_centre(view, "hsao"),
           ssao = ao_screen_measure_centre(view, "ssao");
    assert_true(fabs(reference - truth) < 0.01);
    if (fabs(hsao - truth) >= 0.04)
        fail_msg("hsao: A = %.4f, truth %.4f", hsao, truth);
    /* ssao is no estimate of equation 1, but it must darken a corner, and not more than all of its points can. */
    if (ssao < 0.1 || ssao > 0.6)
        fail_msg("ssao: A = %.4f, truth %.4f", ssao, truth);
}

static void test_screen_space_cannot_see_a_ceiling_behind_the_camera(void **state)
{
    nook_fixture_view *view = look(state, (double[]){ 0, 0, 0.9 }, (double[]){ 0, 0, 0 }, 0.6, 2.5);
    nook_fixture_mesh mesh = { 0 };
    ao_screen_add_floor(&mesh);
    ao_screen_show(view, &mesh);
    nook_fixture_add_quad(&mesh, (double[]){ -50, -50, 1 }, (double[]){ 100, 0, 0 }, (double[]){ 0, 100, 0 });
    ao_view_add(view, &mesh, 0);
    nook_fixture_mesh_free(&mesh);
    assert_true(fabs(ao_screen_measure_centre(view, "reference") - 0.84) < 0.01); /* 1 - 0.4^2 */
    for (size_t k = 0; k < NOOK_COUNT(screen_space); k++)
        assert_true(ao_screen_measure_centre(view, screen_space[k]) < 0.01);
}

static void test_screen_space_ignores_what_is_beyond_reach_in_front(void **state)
{
    nook_fixture_view *view = look(state, (double[]){ 0, -10, 0 }, (double[]){ 0, 0, 0 }, 0.8, 1);
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ -20, 0, -20 }, (double[]){ 40, 0, 0 }, (double[]){ 0, 0, 40 });
    nook_fixture_add_quad(&mesh, (double[]){ -20, -8, -20 }, (double[]){ 20, 0, 0 },
                          (double[]){ 0, 0, 40 }); /* left half */
    ao_view_draw(view, &mesh);
    nook_fixture_mesh_free(&mesh);
    for (size_t k = 0; k < NOOK_COUNT(screen_space); k++) {
        ao_view_record(view, screen_space[k]);
        for (uint32_t side = 0; side < 2; side++) {
            double mean = ao_screen_mean(view, side ? SIDE / 2 : 0, 0, side ? SIDE : SIDE / 2, SIDE);
            if (mean >= 0.01)
                fail_msg("%s: A = %.4f %s", screen_space[k], mean, side ? "on the wall behind" : "in front");
        }
    }
}

/** Mean A of hsao over a small image of a corner, with this many azimuths of 1 + 64 + 16 * 65 turns each. */
static double measure_corner(nook_fixture_view *view, const char *directions)
{
    ao_view_param(view, "hsao.directions", directions);
    return ao_screen_measure(view, "hsao");
}

static void test_hsao_means_the_same_with_more_samples_than_one_dispatch_holds(void **state)
{
    ao_view_resize(*state, 16, 16);
    nook_fixture_view *view = look(state, (double[]){ -2, 0, 3 }, (double[]){ 0, 0, 0 }, 0.6, 1);
    ao_view_param(view, "hsao.rays", "16");
    ao_view_param(view, "hsao.ray_steps", "64");
    nook_fixture_mesh mesh = { 0 };
    ao_screen_add_corner(&mesh, 0.3, NOOK_PI / 2);
    ao_screen_show(view, &mesh);
    double few = measure_corner(view, "32"), many = measure_corner(view, "160"); /* llvmpipe stops at 65535 turns */
    ao_view_resize(view, SIDE, SIDE);
    assert_true(few > 0.02);
    if (fabs(few - many) >= 0.003)
        fail_msg("A = %.4f with 32 azimuths, %.4f with 160", few, many);
}

static void test_hsao_is_the_same_in_a_flipped_projection(void **state)
{
    double means[2];
    for (int flipped = 0; flipped < 2; flipped++) {
        nook_fixture_view *view = look(state, (double[]){ -2, 0, 3 }, (double[]){ 0, 0, 0 }, 0.6, 1);
        view->without_normals = 1;
        view->clip_from_view.m[5] *= flipped ? -1.0 : 1.0;
        nook_fixture_view_clear(view);
        nook_fixture_mesh mesh = { 0 };
        ao_screen_add_corner(&mesh, 0.3, NOOK_PI / 2);
        ao_screen_show(view, &mesh);
        means[flipped] = ao_screen_measure(view, "hsao");
        view->without_normals = 0;
    }
    assert_true(means[0] > 0.02);
    if (fabs(means[0] - means[1]) >= 0.002)
        fail_msg("A = %.4f, flipped %.4f", means[0], means[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_screen_space_sees_nothing_above_an_open_floor_at_any_tilt),
        cmocka_unit_test(test_ssao_leaves_an_open_floor_open_at_any_reach),
        cmocka_unit_test(test_hsao_weights_by_the_cosine_at_the_bottom_of_a_pit),
        cmocka_unit_test(test_hsao_is_near_the_truth_in_a_corner_that_the_camera_sees),
        cmocka_unit_test(test_screen_space_cannot_see_a_ceiling_behind_the_camera),
        cmocka_unit_test(test_screen_space_ignores_what_is_beyond_reach_in_front),
        cmocka_unit_test(test_hsao_means_the_same_with_more_samples_than_one_dispatch_holds),
        cmocka_unit_test(test_hsao_is_the_same_in_a_flipped_projection),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
