/*
 * gtao and hbao: what their papers say they compute. gtao estimates equation 1 of docs/techniques.md; hbao the same integral without
 * the cosine, the blocked part of the solid angle (erratum C18). Both only of what the camera sees.
 */
#include "engine/core/angle.h"
#include "modules/ao/falloff.h"
#include "modules/fixture/closed_form.h"
#include "tests/support/ao_screen.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 96 };

static const double origin[3] = { 0, 0, 0 };
static const char *const techniques[] = { "gtao", "hbao" };

static void set(nook_fixture_view *view, const char *name, double value)
{
    assert_int_equal(nook_ao_set_param(view->ao, name, value), NOOK_OK);
}

static int setup(void **state)
{
    *state = ao_view_create(SIDE, SIDE);
    return 0;
}

/** Enough samples that their number does not matter. */
static int converge(void **state)
{
    nook_fixture_view *view = *state;
    ao_view_resize(view, SIDE, SIDE);
    view->index = 0;
    set(view, "ao.scale", 0);
    set(view, "gtao.slices", 8), set(view, "gtao.steps", 48), set(view, "gtao.thickness", 0);
    set(view, "hbao.directions", 16), set(view, "hbao.steps", 48), set(view, "hbao.bias", 0);
    set(view, "reference.rays", 256);
    return 0;
}

static void expect_near(const char *what, double measured, double expected, double within)
{
    if (!(fabs(measured - expected) < within))
        fail_msg("%s: A = %.4f, expected %.4f within %.4f", what, measured, expected, within);
}

/** A camera on the axis above a pit of radius 1. */
static nook_fixture_view *look_into_pit(void **state, double depth, double r_max)
{
    nook_fixture_view *view = *state;
    nook_fixture_mesh mesh = { 0 };
    ao_screen_look(view, (double[]){ 0, 0, 4 }, origin, 1.0, r_max);
    ao_screen_add_pit(&mesh, 1.0, depth);
    ao_screen_show(view, &mesh);
    return view;
}

/** A camera on the bisector of a corner of this inner angle, whose edge is 0.3 m from the middle of the picture. */
static nook_fixture_view *look_into_corner(void **state, double angle, double r_max)
{
    nook_fixture_view *view = *state;
    nook_fixture_mesh mesh = { 0 };
    const double eye[3] = { 0.3 - 8 * cos(angle / 2), -4, 8 * sin(angle / 2) };
    ao_screen_look(view, eye, origin, 0.8, r_max);
    ao_screen_add_corner(&mesh, 0.3, angle);
    ao_screen_show(view, &mesh);
    return view;
}

static void test_a_pit_tells_the_cosine_from_the_solid_angle(void **state)
{
    const double depths[] = { 0.5, 1.0, 2.0 };
    for (size_t i = 0; i < NOOK_COUNT(depths); i++) {
        const double d = depths[i];
        nook_fixture_view *view = look_into_pit(state, d, 2.5);
        expect_near("reference", ao_screen_measure_centre(view, "reference"), nook_form_pit(NOOK_FORM_COSINE, 1.0, d),
                    0.01);
        expect_near("gtao", ao_screen_measure_centre(view, "gtao"), nook_form_pit(NOOK_FORM_COSINE, 1.0, d),
                    0.015); /* 0.5 for d = 1 */
        expect_near("hbao", ao_screen_measure_centre(view, "hbao"), nook_form_pit(NOOK_FORM_SOLID_ANGLE, 1.0, d),
                    0.015); /* 0.7071 */
    }
}

/* The line of sight is 37 degrees off -Z in the middle of this picture: slices around -Z would not hold the eye. */
static void test_a_pit_reads_the_same_at_the_edge_of_a_wide_picture(void **state)
{
    nook_fixture_view *view = *state;
    nook_fixture_mesh mesh = { 0 };
    ao_screen_look(view, (double[]){ 3, 0, 4 }, (double[]){ 3, 0, 0 }, 1.0, 2.5);
    view->clip_from_view.m[8] = -0.75 * view->clip_from_view.m[0];
    ao_screen_add_pit(&mesh, 1.0, 1.0);
    ao_screen_show(view, &mesh);
    expect_near("gtao", ao_screen_measure_centre(view, "gtao"), 0.5, 0.02);
    expect_near("hbao", ao_screen_measure_centre(view, "hbao"), sqrt(0.5), 0.02);
}

static void test_an_open_plane_is_open_at_every_tilt(void **state)
{
    static const double eyes[][3] = { { 0, 0.001, 3 }, { 0, -2, 2 }, { 1, -4, 1.5 }, { 0, -6, 0.5 }, { 2, -4, 0.15 } };
    const double highest[] = { 1e-5, 1e-3 }; /* a horizon off by a small e costs gtao e^2, hbao e */
    nook_fixture_view *view = *state;
    for (size_t i = 0; i < NOOK_COUNT(eyes); i++) {
        nook_fixture_mesh mesh = { 0 };
        ao_screen_look(view, eyes[i], origin, 0.8, 0.5);
        ao_screen_add_floor(&mesh);
        ao_screen_show(view, &mesh);
        for (size_t k = 0; k < NOOK_COUNT(techniques); k++) {
            ao_view_record(view, techniques[k]);
            for (uint32_t pixel = 0; pixel < SIDE * SIDE; pixel++)
                expect_near(techniques[k], 1.0 - view->visibility[pixel], 0.0, highest[k]);
        }
    }
}

/** The blocked part of the solid angle above a point with normal +z, each direction by its falloff: what hbao estimates. */
static double blocked_solid_angle(const nook_fixture_mesh *mesh, const double point[3], double r_max)
{
    enum { RAYS = 4096 };
    double sum = 0.0;
    for (int i = 0; i < RAYS; i++) { /* Fibonacci points: heights and so solid angles are even */
        double z = (i + 0.5) / RAYS, r = sqrt(1 - z * z), azimuth = i * NOOK_PI * (3 - sqrt(5.0));
        nook_fixture_hit hit = { .distance = INFINITY };
        nook_fixture_cast(mesh, point, (double[]){ r * cos(azimuth), r * sin(azimuth), z }, &hit);
        sum += nook_falloff_evaluate(NOOK_FALLOFF_HARD, hit.distance, r_max, 0.0);
    }
    return sum / RAYS;
}

static void test_corners_of_any_angle_read_as_truth_and_as_solid_angle(void **state)
{
    for (int degrees = 60; degrees <= 150; degrees += 30) {
        const double angle = degrees * NOOK_PI / 180;
        nook_fixture_view *view = look_into_corner(state, angle, 2.0);
        nook_fixture_mesh mesh = { 0 };
        ao_screen_add_corner(&mesh, 0.3, angle);
        double solid = blocked_solid_angle(&mesh, (double[]){ 0, 0, 1e-9 }, 2.0);
        nook_fixture_mesh_free(&mesh);
        double truth = ao_screen_measure_centre(view, "reference");
        expect_near("gtao", ao_screen_measure_centre(view, "gtao"), truth, 0.02);
        expect_near("hbao", ao_screen_measure_centre(view, "hbao"), solid, 0.03);
        assert_true(degrees <= 90 || solid > truth + 0.05); /* the two can be told apart */
    }
}

/* A wall at k = 0.3 r_max; the closed forms of docs/techniques.md, fixture 5. */
static void test_gtao_follows_the_falloff_in_a_corner(void **state)
{
    const double k = 0.3;
    nook_fixture_view *view = look_into_corner(state, NOOK_PI / 2, 1.0);
    expect_near("hard", ao_screen_measure_centre(view, "gtao"), nook_form_wall(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, k),
                0.02);
    ao_view_param(view, "ao.falloff", "linear");
    expect_near("linear", ao_screen_measure_centre(view, "gtao"),
                nook_form_wall(NOOK_FORM_COSINE, NOOK_FALLOFF_LINEAR, k), 0.025);
}

/* Walls 1 m off and 1 m high, reach 2.5 m: what one sample meets is at least 1 m away, where rho is 0.6, and counts the mean of its rho
   and of the receiver's own, 1: the exception that docs/techniques.md states. Closed form: 0.53 of what hard falloff counts. */
static void test_gtao_of_one_step_counts_a_wall_between_its_own_falloff_and_the_mean_with_one(void **state)
{
    nook_fixture_view *view = look_into_pit(state, 1.0, 2.5);
    ao_view_param(view, "gtao.steps", "1");
    ao_view_param(view, "ao.falloff", "hard");
    double hard = ao_screen_measure_centre(view, "gtao");
    ao_view_param(view, "ao.falloff", "linear");
    double part = ao_screen_measure_centre(view, "gtao") / hard;
    ao_view_param(view, "ao.falloff", "hard");
    ao_view_param(view, "gtao.steps", "8");
    assert_true(hard > 0.01);
    if (part < 0.6 || part > (1 + 0.6) / 2 + 1e-3)
        fail_msg("linear falloff counts %.4f of what hard does", part);
}

static void test_both_follow_the_falloff_in_a_pit(void **state)
{
    nook_fixture_view *view = look_into_pit(state, 1.0, 4.0);
    set(view, "gtao.steps", 96), set(view, "hbao.steps", 192); /* hbao: the error is of first order in the step */
    ao_view_param(view, "ao.falloff", "linear");
    expect_near("gtao, linear", ao_screen_measure_centre(view, "gtao"), 0.5 - 0.5 * (1 - sqrt(0.5)), 0.03);
    expect_near("hbao, linear", ao_screen_measure_centre(view, "hbao"), sqrt(0.5) - NOOK_PI / 16, 0.03);
    ao_view_param(view, "ao.falloff", "quadratic");
    expect_near("gtao, quadratic", ao_screen_measure_centre(view, "gtao"), 0.5 + 0.125 * log(sqrt(0.5)), 0.03);
}

/* Width 1.2, depth 1: fixture 9, and two wedges of solid angle. */
static void test_a_trench_that_the_camera_sees_whole(void **state)
{
    nook_fixture_view *view = *state;
    nook_fixture_mesh mesh = { 0 };
    ao_screen_look(view, (double[]){ 0, 0, 6 }, origin, 1.0, 3.0);
    ao_screen_add_trench(&mesh, 1.2, 1.0);
    ao_screen_show(view, &mesh);
    expect_near("reference", ao_screen_measure_centre(view, "reference"), nook_form_trench(NOOK_FORM_COSINE, 1.2, 1.0),
                0.015);
    expect_near("gtao", ao_screen_measure_centre(view, "gtao"), nook_form_trench(NOOK_FORM_COSINE, 1.2, 1.0), 0.03);
    expect_near("hbao", ao_screen_measure_centre(view, "hbao"), nook_form_trench(NOOK_FORM_SOLID_ANGLE, 1.2, 1.0),
                0.06);
}

/** RMS difference between an image and the view's. */
static double distance_from(const float *image, const nook_fixture_view *view)
{
    size_t pixels = (size_t)view->width * view->height;
    double sum = 0.0;
    for (size_t i = 0; i < pixels; i++)
        sum += (image[i] - view->visibility[i]) * (image[i] - view->visibility[i]);
    return sqrt(sum / (double)pixels);
}

static void test_more_slices_and_steps_come_nearer_to_the_limit(void **state)
{
    static const double counts[][2] = { { 1, 2 }, { 2, 4 }, { 4, 12 }, { 12, 40 }, { 32, 128 } };
    static const char *const names[][2] = { { "gtao.slices", "gtao.steps" }, { "hbao.directions", "hbao.steps" } };
    float limit[SIDE * SIDE / 4];
    ao_view_resize(*state, SIDE / 2, SIDE / 2);
    nook_fixture_view *view = look_into_pit(state, 1.0, 2.5);
    for (size_t k = 0; k < NOOK_COUNT(techniques); k++) {
        double before = INFINITY;
        for (size_t i = NOOK_COUNT(counts); i-- > 0;) {
            set(view, names[k][0], counts[i][0] * (double)(k + 1)), set(view, names[k][1], counts[i][1]);
            ao_view_record(view, techniques[k]);
            if (i == NOOK_COUNT(counts) - 1) {
                memcpy(limit, view->visibility, sizeof limit);
                continue;
            }
            double error = distance_from(limit, view);
            if (before == INFINITY && error > 0.02)
                fail_msg("%s: %.4f from the limit with a quarter of its samples", techniques[k], error);
            if (before < INFINITY && error < 1.3 * before)
                fail_msg("%s, step %zu: %.4f from the limit, %.4f with more samples", techniques[k], i, error, before);
            before = error;
        }
    }
}

/* Scaling by a power of two changes no mantissa: not a bit may differ. */
static void test_the_scale_of_the_world_changes_nothing(void **state)
{
    static const int exponents[] = { 0, -20, 20 };
    float first[SIDE * SIDE];
    for (size_t k = 0; k < NOOK_COUNT(techniques); k++) {
        for (size_t i = 0; i < NOOK_COUNT(exponents); i++) {
            const double scale = ldexp(1.0, exponents[i]);
            nook_fixture_view *view = *state;
            nook_fixture_mesh mesh = { 0 };
            ao_screen_look(view, (double[]){ 0.5 * scale, 0, 4 * scale }, origin, 1.0, 2.5 * scale);
            view->clip_from_view.m[14] *= scale; /* the near plane */
            ao_screen_add_pit(&mesh, 1.0, 1.0);
            for (uint32_t v = 0; v < 3 * mesh.vertex_count; v++)
                mesh.positions[v] *= (float)scale;
            ao_screen_show(view, &mesh);
            ao_view_record(view, techniques[k]);
            if (i == 0)
                memcpy(first, view->visibility, sizeof first);
            assert_memory_equal(first, view->visibility, sizeof first);
        }
    }
}

static void test_the_order_of_the_rows_changes_nothing(void **state)
{
    for (size_t k = 0; k < NOOK_COUNT(techniques); k++) {
        double means[2];
        for (int flipped = 0; flipped < 2; flipped++) {
            nook_fixture_view *view = *state;
            nook_fixture_mesh mesh = { 0 };
            ao_screen_look(view, (double[]){ -2, 1, 3 }, origin, 0.6, 1.0);
            view->clip_from_view.m[5] *= flipped ? -1.0 : 1.0;
            ao_screen_add_corner(&mesh, 0.3, NOOK_PI / 2);
            ao_screen_show(view, &mesh);
            means[flipped] = ao_screen_measure(view, techniques[k]);
        }
        assert_true(means[0] > 0.05);
        expect_near(techniques[k], means[1], means[0], 0.001);
    }
}

/* A coarser trace loses what is nearer than its texel. */
static void test_half_and_quarter_resolution_mean_the_same(void **state)
{
    nook_fixture_view *view = look_into_corner(state, NOOK_PI / 2, 1.0);
    for (size_t k = 0; k < NOOK_COUNT(techniques); k++) {
        set(view, "ao.scale", 0);
        double full = ao_screen_measure(view, techniques[k]);
        assert_true(full > 0.01);
        for (int scale = 1; scale <= 2; scale++) {
            set(view, "ao.scale", scale);
            expect_near(techniques[k], ao_screen_measure(view, techniques[k]), full, (scale == 1 ? 0.05 : 0.2) * full);
        }
    }
}

static void test_frames_repeat_by_their_index_and_differ_between_indices(void **state)
{
    float first[SIDE * SIDE];
    nook_fixture_view *view = look_into_pit(state, 1.0, 2.5);
    set(view, "gtao.slices", 1), set(view, "gtao.steps", 4), set(view, "hbao.directions", 2),
        set(view, "hbao.steps", 4);
    for (size_t k = 0; k < NOOK_COUNT(techniques); k++) {
        view->index = 7;
        ao_view_record(view, techniques[k]);
        memcpy(first, view->visibility, sizeof first);
        view->index = 8;
        ao_view_record(view, techniques[k]);
        assert_true(distance_from(first, view) > 0.01);
        view->index = 7;
        ao_view_record(view, techniques[k]);
        assert_memory_equal(first, view->visibility, sizeof first);
    }
}

/* A bar over the floor, from above: the depth buffer does not know that there is room under it. */
static nook_fixture_view *look_at_bar(void **state)
{
    nook_fixture_view *view = *state;
    nook_fixture_mesh mesh = { 0 };
    ao_screen_look(view, (double[]){ 0, 0, 6 }, origin, 0.8, 2.0);
    ao_screen_add_floor(&mesh);
    nook_fixture_add_box(&mesh, (double[]){ 0.4, -2, 0.5 }, (double[]){ 0.6, 2, 0.7 }, 63);
    ao_screen_show(view, &mesh);
    return view;
}

static void test_thickness_opens_what_floats_and_keeps_to_the_range(void **state)
{
    double before = INFINITY;
    nook_fixture_view *view = look_at_bar(state);
    for (int i = 0; i <= 4; i++) {
        set(view, "gtao.thickness", i / 4.0);
        double now = ao_screen_measure(view, "gtao");
        if (!(now < before) || now <= 0.0)
            fail_msg("thickness %g: A = %.5f, with less %.5f", i / 4.0, now, before);
        before = now;
    }
}

/*
 * A funnel around the receiver, cut out of the cone of 45 degrees whose apex is there, over an open floor: whatever of it a slice meets
 * raises the horizon to 45 degrees. It ends half-way to where the camera at 4 m sees r_max end, so that of two samples the second one
 * meets the floor.
 */
static nook_fixture_view *look_into_funnel(void **state, double r_max)
{
    enum { WIDTH = 320, SIDES = 128 };
    const double reach = r_max / sqrt(1 - r_max * r_max / 16), seen = 0.5 * reach, far = 4 * seen / (4 + seen),
                 near = 0.3 * far;
    nook_fixture_view *view = *state;
    nook_fixture_mesh mesh = { 0 };
    ao_view_resize(view, WIDTH, WIDTH);
    ao_screen_look(view, (double[]){ 0, 0, 4 }, origin, 0.8, r_max);
    ao_screen_add_floor(&mesh);
    for (int i = 0; i < SIDES; i++) {
        const double a = 2 * NOOK_PI * i / SIDES, b = 2 * NOOK_PI * (i + 1) / SIDES;
        const double p[3] = { near * cos(a), near * sin(a), near }, q[3] = { near * cos(b), near * sin(b), near };
        const double r[3] = { far * cos(a), far * sin(a), far }, t[3] = { far * cos(b), far * sin(b), far };
        nook_fixture_add_triangle(&mesh, p, r, t);
        nook_fixture_add_triangle(&mesh, p, t, q);
    }
    ao_screen_show(view, &mesh);
    return view;
}

/* Of a slice that met the funnel the floor behind it lowers the horizon to mix(45, 90 degrees, thickness), and cos^2 of it stays. */
static void test_thickness_blends_the_horizon_and_keeps_the_arc_that_is_left(void **state)
{
    nook_fixture_view *view = look_into_funnel(state, 1.0);
    set(view, "gtao.steps", 2), set(view, "gtao.spacing", 1), set(view, "gtao.slices", 32);
    const double solid = ao_screen_measure_centre(view, "gtao");
    assert_true(solid > 0.2 && solid < 0.5); /* some slices have their first sample before the funnel */
    for (int i = 1; i <= 4; i++) {
        const double thickness = i / 4.0, horizon = NOOK_PI / 4 + thickness * NOOK_PI / 4;
        set(view, "gtao.thickness", thickness);
        expect_near("part that stays blocked", ao_screen_measure_centre(view, "gtao") / solid, 2 * pow(cos(horizon), 2),
                    0.01);
    }
    set(view, "gtao.spacing", 2);
}

/* 512 turns a slice: past 65535 in all llvmpipe would stop without a word. */
static void test_the_highest_numbers_of_samples_mean_the_same(void **state)
{
    nook_fixture_view *view = *state;
    ao_view_resize(view, 16, 16);
    look_into_corner(state, NOOK_PI / 2, 2.0);
    double gtao = ao_screen_measure(view, "gtao"), hbao = ao_screen_measure(view, "hbao");
    set(view, "gtao.slices", 256), set(view, "gtao.steps", 256);
    set(view, "hbao.directions", 256), set(view, "hbao.steps", 256);
    assert_true(gtao > 0.02 && hbao > 0.02);
    expect_near("gtao", ao_screen_measure(view, "gtao"), gtao, 0.01);
    expect_near("hbao", ao_screen_measure(view, "hbao"), hbao, 0.01);
}

static void test_hbao_ignores_what_is_below_its_bias(void **state)
{
    nook_fixture_view *view = look_into_corner(state, 170 * NOOK_PI / 180, 2.0);
    assert_true(ao_screen_measure_centre(view, "hbao") > 0.03);
    set(view, "hbao.bias", 15);
    assert_true(ao_screen_measure_centre(view, "hbao") < 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_a_pit_tells_the_cosine_from_the_solid_angle, converge),
        cmocka_unit_test_setup(test_a_pit_reads_the_same_at_the_edge_of_a_wide_picture, converge),
        cmocka_unit_test_setup(test_an_open_plane_is_open_at_every_tilt, converge),
        cmocka_unit_test_setup(test_corners_of_any_angle_read_as_truth_and_as_solid_angle, converge),
        cmocka_unit_test_setup(test_gtao_follows_the_falloff_in_a_corner, converge),
        cmocka_unit_test_setup(test_gtao_of_one_step_counts_a_wall_between_its_own_falloff_and_the_mean_with_one,
                               converge),
        cmocka_unit_test_setup(test_both_follow_the_falloff_in_a_pit, converge),
        cmocka_unit_test_setup(test_a_trench_that_the_camera_sees_whole, converge),
        cmocka_unit_test_setup(test_more_slices_and_steps_come_nearer_to_the_limit, converge),
        cmocka_unit_test_setup(test_the_scale_of_the_world_changes_nothing, converge),
        cmocka_unit_test_setup(test_the_order_of_the_rows_changes_nothing, converge),
        cmocka_unit_test_setup(test_half_and_quarter_resolution_mean_the_same, converge),
        cmocka_unit_test_setup(test_frames_repeat_by_their_index_and_differ_between_indices, converge),
        cmocka_unit_test_setup(test_thickness_opens_what_floats_and_keeps_to_the_range, converge),
        cmocka_unit_test_setup(test_thickness_blends_the_horizon_and_keeps_the_arc_that_is_left, converge),
        cmocka_unit_test_setup(test_the_highest_numbers_of_samples_mean_the_same, converge),
        cmocka_unit_test_setup(test_hbao_ignores_what_is_below_its_bias, converge),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
