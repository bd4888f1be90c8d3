/* ssao and hsao on an exact G-buffer: what they get right, and what a depth buffer cannot know. */
#include "tests/support/ao_view.h"
#include <math.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 96 };

static const double pi = 3.14159265358979323846;
static const char *const screen_space[] = { "ssao", "hsao" };

static int setup(void **state)
{
    *state = ao_view_create(SIDE, SIDE);
    return 0;
}

static int teardown(void **state)
{
    ao_view_destroy(*state);
    return 0;
}

/** Nothing drawn yet; a camera; enough samples that noise does not matter. */
static nook_fixture_view *look(void **state, const double eye[3], const double target[3], double angle,
                               const char *r_max)
{
    static const char *const settings[][2] = { { "ao.filter", "none" },    { "ao.falloff", "hard" },
                                               { "ssao.samples", "256" },  { "hsao.directions", "32" },
                                               { "hsao.steps", "64" },     { "hsao.rays", "4" },
                                               { "hsao.ray_steps", "32" }, { "reference.rays", "256" } };
    nook_fixture_view *view = *state;
    for (size_t i = 0; i < NOOK_COUNT(settings); i++)
        ao_view_param(view, settings[i][0], settings[i][1]);
    ao_view_param(view, "ao.r_max", r_max);
    double along[3] = { target[0] - eye[0], target[1] - eye[1], target[2] - eye[2] };
    double up[3] = { 0, 0, 0 };
    up[fabs(along[2]) > fabs(along[1]) ? 1 : 2] = 1.0;
    view->view_from_world = nook_matrix_look_at(eye, target, up);
    view->clip_from_view = nook_matrix_perspective_reversed(angle, 1.0, 0.05);
    nook_fixture_view_drop_occluders(view);
    nook_fixture_view_clear(view);
    return view;
}

/** Mean A over the pixels with geometry of columns [left, right) and rows [bottom, top). */
static double mean_of(const nook_fixture_view *view, uint32_t left, uint32_t bottom, uint32_t right, uint32_t top)
{
    double sum = 0.0, count = 0.0;
    for (uint32_t y = bottom; y < top; y++) {
        for (uint32_t x = left; x < right; x++) {
            if (view->device_depth[y * SIDE + x] > 0.0f)
                sum += 1.0 - view->visibility[y * SIDE + x], count += 1.0;
        }
    }
    assert_true(count > 0.0);
    return sum / count;
}

static double mean_of_centre(const nook_fixture_view *view)
{
    return mean_of(view, SIDE / 2 - 2, SIDE / 2 - 2, SIDE / 2 + 2, SIDE / 2 + 2);
}

static double measure(nook_fixture_view *view, const char *technique)
{
    ao_view_record(view, technique);
    return mean_of_centre(view);
}

static void draw_floor(nook_fixture_view *view)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ -50, -50, 0 }, (double[]){ 100, 0, 0 }, (double[]){ 0, 100, 0 });
    ao_view_draw(view, &mesh);
    nook_fixture_mesh_free(&mesh);
}

static void test_screen_space_sees_nothing_above_an_open_floor_at_any_tilt(void **state)
{
    static const double eyes[][3] = { { 0, 0.001, 3 }, { 0, -2, 2 }, { 1, -4, 1.5 } };
    for (size_t i = 0; i < NOOK_COUNT(eyes); i++) {
        nook_fixture_view *view = look(state, eyes[i], (double[]){ 0, 0, 0 }, 0.8, "0.5");
        draw_floor(view);
        for (size_t k = 0; k < NOOK_COUNT(screen_space); k++) {
            ao_view_record(view, screen_space[k]);
            double mean = mean_of(view, 0, 0, SIDE, SIDE);
            /* Towards the horizon one pixel covers more depth than ssao's bias hides. */
            if (mean >= (i == 2 && k == 0 ? 0.03 : 0.01))
                fail_msg("%s, eye %zu: A = %.4f", screen_space[k], i, mean);
        }
    }
}

/** A round pit of radius 1 and depth 1; its bottom at the origin, ground around it. */
static void make_pit(nook_fixture_mesh *mesh)
{
    enum { SIDES = 64 };
    nook_fixture_add_disc(mesh, (double[]){ 0, 0, 0 }, 1.0, SIDES);
    nook_fixture_add_tube(mesh, 1.0, 0.0, 1.0, SIDES);
    for (int i = 0; i < SIDES; i++) {
        double a = 2 * pi * i / SIDES, b = 2 * pi * (i + 1) / SIDES, inner[2][3], outer[2][3];
        for (int side = 0; side < 2; side++) {
            double angle = side ? b : a;
            inner[side][0] = cos(angle), inner[side][1] = sin(angle), inner[side][2] = 1.0;
            outer[side][0] = 6 * cos(angle), outer[side][1] = 6 * sin(angle), outer[side][2] = 1.0;
        }
        nook_fixture_add_triangle(mesh, inner[0], outer[0], outer[1]);
        nook_fixture_add_triangle(mesh, inner[0], outer[1], inner[1]);
    }
}

static void test_hsao_weights_by_the_cosine_at_the_bottom_of_a_pit(void **state)
{
    nook_fixture_view *view = look(state, (double[]){ 0, 0, 4 }, (double[]){ 0, 0, 0 }, 1.0, "2");
    nook_fixture_mesh mesh = { 0 };
    make_pit(&mesh);
    ao_view_draw(view, &mesh);
    ao_view_add(view, &mesh, 0);
    nook_fixture_mesh_free(&mesh);
    /* Equation 1: D^2 / (R^2 + D^2). Without the cosine, as classic HBAO integrates, it would be 0.7071: erratum C18. */
    double truth = measure(view, "reference"), hsao = measure(view, "hsao");
    assert_true(fabs(truth - 0.5) < 0.01);
    if (fabs(hsao - 0.5) >= 0.04)
        fail_msg("A = %.4f, truth 0.5", hsao);
}

static void test_hsao_is_near_the_truth_in_a_corner_that_the_camera_sees(void **state)
{
    const double k = 0.3, truth = (acos(k) - k * sqrt(1 - k * k)) / pi; /* a wall at 0.3 r_max */
    nook_fixture_view *view = look(state, (double[]){ -2, 0, 3 }, (double[]){ 0, 0, 0 }, 0.6, "1");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ -20, -20, 0 }, (double[]){ 20 + k, 0, 0 }, (double[]){ 0, 40, 0 });
    nook_fixture_add_quad(&mesh, (double[]){ k, -20, 0 }, (double[]){ 0, 40, 0 }, (double[]){ 0, 0, 10 });
    ao_view_draw(view, &mesh);
    ao_view_add(view, &mesh, 0);
    nook_fixture_mesh_free(&mesh);
    double reference = measure(view, "reference"), hsao = measure(view, "hsao"), ssao = measure(view, "ssao");
    assert_true(fabs(reference - truth) < 0.01);
    if (fabs(hsao - truth) >= 0.04)
        fail_msg("hsao: A = %.4f, truth %.4f", hsao, truth);
    /* ssao is no estimate of equation 1, but it must darken a corner, and not more than all of its points can. */
    if (ssao < 0.1 || ssao > 0.6)
        fail_msg("ssao: A = %.4f, truth %.4f", ssao, truth);
}

static void test_screen_space_cannot_see_a_ceiling_behind_the_camera(void **state)
{
    nook_fixture_view *view = look(state, (double[]){ 0, 0, 0.9 }, (double[]){ 0, 0, 0 }, 0.6, "2.5");
    draw_floor(view);
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ -50, -50, 1 }, (double[]){ 100, 0, 0 }, (double[]){ 0, 100, 0 });
    ao_view_add(view, &mesh, 0);
    nook_fixture_mesh_free(&mesh);
    assert_true(fabs(measure(view, "reference") - 0.84) < 0.01); /* 1 - 0.4^2 */
    for (size_t k = 0; k < NOOK_COUNT(screen_space); k++)
        assert_true(measure(view, screen_space[k]) < 0.01);
}

static void test_screen_space_ignores_what_is_beyond_reach_in_front(void **state)
{
    nook_fixture_view *view = look(state, (double[]){ 0, -10, 0 }, (double[]){ 0, 0, 0 }, 0.8, "1");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ -20, 0, -20 }, (double[]){ 40, 0, 0 }, (double[]){ 0, 0, 40 });
    nook_fixture_add_quad(&mesh, (double[]){ -20, -8, -20 }, (double[]){ 20, 0, 0 },
                          (double[]){ 0, 0, 40 }); /* left half */
    ao_view_draw(view, &mesh);
    nook_fixture_mesh_free(&mesh);
    for (size_t k = 0; k < NOOK_COUNT(screen_space); k++) {
        ao_view_record(view, screen_space[k]);
        for (uint32_t side = 0; side < 2; side++) {
            double mean = mean_of(view, side ? SIDE / 2 : 0, 0, side ? SIDE : SIDE / 2, SIDE);
            if (mean >= 0.01)
                fail_msg("%s: A = %.4f %s", screen_space[k], mean, side ? "on the wall behind" : "in front");
        }
    }
}

/** Mean A of hsao over a small image of a corner, with this many azimuths of 1 + 64 + 16 * 65 turns each. */
static double measure_corner(nook_fixture_view *view, const char *directions)
{
    enum { SMALL = 16 };
    double sum = 0.0;
    ao_view_param(view, "hsao.directions", directions);
    ao_view_record(view, "hsao");
    for (uint32_t i = 0; i < SMALL * SMALL; i++)
        sum += (1.0 - view->visibility[i]) / (SMALL * SMALL);
    return sum;
}

static void test_hsao_means_the_same_with_more_samples_than_one_dispatch_holds(void **state)
{
    ao_view_resize(*state, 16, 16);
    nook_fixture_view *view = look(state, (double[]){ -2, 0, 3 }, (double[]){ 0, 0, 0 }, 0.6, "1");
    ao_view_param(view, "hsao.rays", "16");
    ao_view_param(view, "hsao.ray_steps", "64");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ -20, -20, 0 }, (double[]){ 20.3, 0, 0 }, (double[]){ 0, 40, 0 });
    nook_fixture_add_quad(&mesh, (double[]){ 0.3, -20, 0 }, (double[]){ 0, 40, 0 }, (double[]){ 0, 0, 10 });
    ao_view_draw(view, &mesh);
    nook_fixture_mesh_free(&mesh);
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
        nook_fixture_view *view = look(state, (double[]){ -2, 0, 3 }, (double[]){ 0, 0, 0 }, 0.6, "1");
        view->without_normals = 1;
        view->clip_from_view.m[5] *= flipped ? -1.0 : 1.0;
        nook_fixture_view_clear(view);
        nook_fixture_mesh mesh = { 0 };
        nook_fixture_add_quad(&mesh, (double[]){ -20, -20, 0 }, (double[]){ 20.3, 0, 0 }, (double[]){ 0, 40, 0 });
        nook_fixture_add_quad(&mesh, (double[]){ 0.3, -20, 0 }, (double[]){ 0, 40, 0 }, (double[]){ 0, 0, 10 });
        ao_view_draw(view, &mesh);
        nook_fixture_mesh_free(&mesh);
        ao_view_record(view, "hsao");
        view->without_normals = 0;
        means[flipped] = mean_of(view, 0, 0, SIDE, SIDE);
    }
    assert_true(means[0] > 0.02);
    if (fabs(means[0] - means[1]) >= 0.002)
        fail_msg("A = %.4f, flipped %.4f", means[0], means[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_screen_space_sees_nothing_above_an_open_floor_at_any_tilt),
        cmocka_unit_test(test_hsao_weights_by_the_cosine_at_the_bottom_of_a_pit),
        cmocka_unit_test(test_hsao_is_near_the_truth_in_a_corner_that_the_camera_sees),
        cmocka_unit_test(test_screen_space_cannot_see_a_ceiling_behind_the_camera),
        cmocka_unit_test(test_screen_space_ignores_what_is_beyond_reach_in_front),
        cmocka_unit_test(test_hsao_means_the_same_with_more_samples_than_one_dispatch_holds),
        cmocka_unit_test(test_hsao_is_the_same_in_a_flipped_projection),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
