/* The reference with sees = screen: rays against the surfaces that the depth buffer shows, and nothing else. */
#include "engine/core/angle.h"
#include "modules/fixture/closed_form.h"
#include "modules/fixture/receiver.h"
#include "tests/support/ao_view.h"
#include <math.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 96 };
static const double angle = 1.0;

static int setup(void **state)
{
    *state = ao_view_create(SIDE, SIDE);
    return 0;
}

/** Nothing drawn yet, and a camera. */
static nook_fixture_view *look(void **state, const double eye[3], const double target[3], const char *r_max)
{
    nook_fixture_view *view = *state;
    double along[3] = { target[0] - eye[0], target[1] - eye[1], target[2] - eye[2] };
    double up[3] = { 0, 0, 0 };
    ao_view_param(view, "ao.falloff", "hard");
    ao_view_param(view, "ao.r_max", r_max);
    ao_view_param(view, "reference.rays", "256");
    ao_view_param(view, "reference.sees", "screen");
    up[fabs(along[2]) > 2.0 * fabs(along[1]) ? 1 : 2] = 1.0;
    view->view_from_world = nook_matrix_look_at(eye, target, up);
    view->clip_from_view = nook_matrix_perspective_reversed(angle, 1.0, 0.05);
    nook_fixture_view_drop_occluders(view);
    nook_fixture_view_clear(view);
    return view;
}

/** Draws it, and with in_scene gives it to the reference as an occluder too. */
static void show(nook_fixture_view *view, nook_fixture_mesh *mesh, bool in_scene)
{
    ao_view_draw(view, mesh);
    if (in_scene)
        ao_view_add(view, mesh, 0);
    nook_fixture_mesh_free(mesh);
}

static nook_fixture_occlusion measure(nook_fixture_view *view)
{
    ao_view_record(view, "reference");
    return nook_fixture_summarize(view, 0, 0, view->width, view->height);
}

static double measure_centre(nook_fixture_view *view)
{
    ao_view_record(view, "reference");
    return nook_fixture_summarize(view, SIDE / 2 - 1, SIDE / 2 - 1, SIDE / 2 + 1, SIDE / 2 + 1).mean;
}

/** No pixel loses more than one of its 256 rays. */
static void expect_open(nook_fixture_view *view, const char *what, size_t which)
{
    nook_fixture_occlusion a = measure(view);
    if (a.highest > 1.0 / 256 || a.mean > 1e-5)
        fail_msg("%s %zu: A = %.6f on the mean, %.4f at most", what, which, a.mean, a.highest);
}

static void add_floor(nook_fixture_mesh *mesh)
{
    nook_fixture_add_quad(mesh, (double[]){ -500, -500, 0 }, (double[]){ 1000, 0, 0 }, (double[]){ 0, 1000, 0 });
}

static void test_an_open_floor_is_unoccluded_at_any_slant(void **state)
{
    static const double eyes[][3] = { { 0, 0.001, 3 },  { 0, -2, 2 },    { 1, -4, 1.5 },
                                      { 0.3, -6, 0.5 }, { 0, -8, 0.05 }, { 0, 0.001, 3000 } };
    for (size_t i = 0; i < NOOK_COUNT(eyes); i++) {
        nook_fixture_view *view = look(state, eyes[i], (double[]){ 0, 0, 0 }, "1000");
        nook_fixture_mesh mesh = { 0 };
        add_floor(&mesh);
        show(view, &mesh, false);
        expect_open(view, "eye", i);
    }
}

/** A ball as smooth as normals of 16 bits are. */
static void draw_ball(nook_fixture_view *view, const double centre[3], double radius)
{
    for (uint32_t y = 0; y < view->height; y++) {
        for (uint32_t x = 0; x < view->width; x++) {
            double ray[3], normal[3], along = 0.0, square = 0.0, rest = -radius * radius;
            nook_fixture_view_position(view, x, y, 1.0, ray);
            for (int axis = 0; axis < 3; axis++)
                along += ray[axis] * centre[axis], square += ray[axis] * ray[axis], rest += centre[axis] * centre[axis];
            double root = along * along - square * rest;
            if (root <= 0.0)
                continue;
            double distance = (along - sqrt(root)) / square;
            for (int axis = 0; axis < 3; axis++)
                normal[axis] = (ray[axis] * distance - centre[axis]) / radius;
            nook_fixture_view_set_pixel(view, x, y, distance, normal);
        }
    }
}

static void test_a_smooth_ball_is_unoccluded_up_to_its_limb(void **state)
{
    static const double centres[][3] = {
        { 0, 0, -3 }, { 0.5, -0.3, -4 }, { 2.4, 1, -6 }, { 0, 0, -30 }, { 0.1, 0.4, -1.5 }
    };
    for (size_t i = 0; i < NOOK_COUNT(centres); i++) {
        nook_fixture_view *view = look(state, (double[]){ 0, 0, 1 }, (double[]){ 0, 0, 0 }, "1000");
        view->view_from_world = nook_matrix_identity();
        draw_ball(view, centres[i], 1.0);
        expect_open(view, "ball", i);
    }
}

static void test_a_convex_body_is_unoccluded(void **state)
{
    static const double eyes[][3] = { { 2, -3, 2 }, { 0.4, -3, 1.1 }, { 1, 1.1, 9 } };
    for (size_t i = 0; i < NOOK_COUNT(eyes); i++) {
        nook_fixture_view *view = look(state, eyes[i], (double[]){ 0, 0, 0 }, "1000");
        nook_fixture_mesh mesh = { 0 };
        nook_fixture_add_box(&mesh, (double[]){ -1, -1, -1 }, (double[]){ 1, 1, 1 }, 63);
        show(view, &mesh, false);
        expect_open(view, "box", i);
        view = look(state, eyes[i], (double[]){ 0, 0, 0 }, "1000");
        nook_fixture_add_sphere(&mesh, (double[]){ 0, 0, 0 }, 1.0, 24);
        show(view, &mesh, false);
        expect_open(view, "facets", i);
    }
}

/** A round pit of radius 1 and depth 1; its bottom at the origin, ground around it. */
static void make_pit(nook_fixture_mesh *mesh)
{
    enum { SIDES = 64 };
    nook_fixture_add_disc(mesh, (double[]){ 0, 0, 0 }, 1.0, SIDES);
    nook_fixture_add_tube(mesh, 1.0, 0.0, 1.0, SIDES);
    for (int i = 0; i < SIDES; i++) {
        double inner[2][3], outer[2][3];
        for (int side = 0; side < 2; side++) {
            double turn = 2 * NOOK_PI * (i + side) / SIDES;
            inner[side][0] = cos(turn), inner[side][1] = sin(turn), inner[side][2] = 1.0;
            outer[side][0] = 6 * cos(turn), outer[side][1] = 6 * sin(turn), outer[side][2] = 1.0;
        }
        nook_fixture_add_triangle(mesh, inner[0], outer[0], outer[1]);
        nook_fixture_add_triangle(mesh, inner[0], outer[1], inner[1]);
    }
}

/**
 * D^2 / (R^2 + D^2) from the middle of the bottom. The rim is the first pixel of the ground, so the pit reads up to one pixel
 * wider than it is.
 */
static void test_a_pit_from_above_matches_its_closed_form_within_a_pixel(void **state)
{
    for (double height = 3.0; height < 7.0; height *= 1.4) {
        nook_fixture_view *view = look(state, (double[]){ 0, 0, height }, (double[]){ 0, 0, 0 }, "100");
        nook_fixture_mesh mesh = { 0 };
        make_pit(&mesh);
        show(view, &mesh, false);
        double pixel = 2.0 * tan(angle / 2) / SIDE * (height - 1.0), got = measure_centre(view);
        double narrow = 0.5, wide = 1.0 / (1.0 + (1.0 + pixel) * (1.0 + pixel));
        if (got > narrow + 0.003 || got < wide - 0.003)
            fail_msg("from %.2f m: A = %.4f, truth 0.5, a pixel wider %.4f", height, got, wide);
    }
}

/** A wall at 0.3 r_max: the corner is cut off by at most a pixel. */
static void test_a_corner_in_view_matches_its_closed_form(void **state)
{
    const double k = 0.3, truth = nook_form_wall(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, k);
    nook_fixture_view *view = look(state, (double[]){ -2, 0, 3 }, (double[]){ 0, 0, 0 }, "1");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ -20, -20, 0 }, (double[]){ 20 + k, 0, 0 }, (double[]){ 0, 40, 0 });
    nook_fixture_add_quad(&mesh, (double[]){ k, -20, 0 }, (double[]){ 0, 40, 0 }, (double[]){ 0, 0, 10 });
    show(view, &mesh, false);
    double got = measure_centre(view);
    if (fabs(got - truth) > 0.01)
        fail_msg("A = %.4f, truth %.4f", got, truth);
}

/** A plate 1 m above the floor, r_max 0.9 m: only a mesh that hangs down from its silhouette could darken the floor. */
static void test_nothing_hangs_down_from_a_silhouette(void **state)
{
    nook_fixture_view *view = look(state, (double[]){ 0.3, 0.2, 6 }, (double[]){ 0.3, 0.2, 0 }, "0.9");
    nook_fixture_mesh mesh = { 0 };
    add_floor(&mesh);
    nook_fixture_add_quad(&mesh, (double[]){ -0.5, -0.5, 1 }, (double[]){ 1, 0.3, 0 }, (double[]){ -0.3, 1, 0 });
    show(view, &mesh, false);
    expect_open(view, "plate", 0);
}

/** ... and with r_max beyond its height the plate's underside darkens the floor: the depth buffer shows that it is there. */
static void test_what_floats_in_view_occludes_what_is_beneath(void **state)
{
    nook_fixture_view *view = look(state, (double[]){ 0, 0, 6 }, (double[]){ 0, 0, 0 }, "100");
    nook_fixture_mesh mesh = { 0 };
    add_floor(&mesh);
    nook_fixture_add_quad(&mesh, (double[]){ 0.1, -50, 1 }, (double[]){ 50, 0, 0 }, (double[]){ 0, 100, 0 });
    show(view, &mesh, false);
    ao_view_record(view, "reference");
    /* Seen: from the edge to the border of the picture, both ways. An overhang less what lies beyond the border. */
    double pixel = 2.0 * tan(angle / 2) / SIDE, border = 5.0 * tan(angle / 2), x = -(20 + 0.5) * pixel * 6.0;
    double near_angle = atan2(1.0, 0.1 - x), far_angle = atan2(1.0, border - x);
    double endless = 0.5 * (cos(far_angle) - cos(near_angle));
    double got = nook_fixture_summarize(view, SIDE / 2 - 21, SIDE / 2 - 1, SIDE / 2 - 20, SIDE / 2 + 1).mean;
    if (!(got > 0.7 * endless && got < endless + 0.01))
        fail_msg("A = %.4f, %.4f under a strip without ends", got, endless);
}

static void test_what_is_out_of_view_has_no_influence_and_comes_back_with_the_scene(void **state)
{
    nook_fixture_view *view = look(state, (double[]){ 0, 0, 0.9 }, (double[]){ 0, 0, 0 }, "2.5");
    nook_fixture_mesh mesh = { 0 };
    add_floor(&mesh);
    show(view, &mesh, true);
    nook_fixture_add_quad(&mesh, (double[]){ -50, -50, 1 }, (double[]){ 100, 0, 0 }, (double[]){ 0, 100, 0 });
    nook_fixture_add_quad(&mesh, (double[]){ 2, -50, 0 }, (double[]){ 0, 100, 0 }, (double[]){ 0, 0, 1 });
    ao_view_add(view, &mesh, 0); /* a ceiling behind the camera, and a wall outside of the picture */
    nook_fixture_mesh_free(&mesh);
    expect_open(view, "unseen", 0);
    ao_view_param(view, "reference.sees", "scene");
    assert_true(measure_centre(view) > 0.84); /* the ceiling alone: 1 - 0.4^2 */
    ao_view_param(view, "reference.sees", "screen");
    expect_open(view, "unseen again", 0);
}

static void test_a_ceiling_in_view_is_what_is_seen(void **state)
{
    nook_fixture_view *view = look(state, (double[]){ 0, 0, 3 }, (double[]){ 0, 0, 0 }, "2");
    nook_fixture_mesh mesh = { 0 };
    add_floor(&mesh);
    nook_fixture_add_quad(&mesh, (double[]){ -50, -50, 1 }, (double[]){ 100, 0, 0 }, (double[]){ 0, 100, 0 });
    show(view, &mesh, true);
    expect_open(view, "ceiling", 0); /* its upper side, under an open sky */
}

static void test_pictures_without_a_square_or_without_geometry_are_open(void **state)
{
    static const uint32_t sizes[][2] = { { 1, 1 }, { 1, 9 }, { 9, 1 }, { 2, 2 } };
    for (size_t i = 0; i < NOOK_COUNT(sizes); i++) {
        ao_view_resize(*state, sizes[i][0], sizes[i][1]);
        nook_fixture_view *view = look(state, (double[]){ 0, 0, 3 }, (double[]){ 0, 0, 0 }, "2");
        expect_open(view, "empty", i);
        nook_fixture_mesh mesh = { 0 };
        add_floor(&mesh);
        show(view, &mesh, false);
        expect_open(view, "small", i);
    }
    ao_view_resize(*state, SIDE, SIDE);
}

static void test_rubbish_in_the_depth_buffer_gives_visibility_in_its_range(void **state)
{
    static const float odd[] = {
        0.0f, -0.0f, 1.0f, -1.0f, 1e-38f, 1e-20f, 1e-7f, 0.5f, 1e30f, NAN, INFINITY, -INFINITY
    };
    nook_fixture_view *view = look(state, (double[]){ 0, 0, 3 }, (double[]){ 0, 0, 0 }, "2");
    unsigned seed = 20221107u;
    ao_view_param(view, "reference.rays", "16");
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        seed = seed * 1664525u + 1013904223u;
        view->device_depth[i] = seed >> 31 ? odd[(seed >> 8) % NOOK_COUNT(odd)] : (float)(seed >> 8) / 16777216.0f;
        view->normals[i][0] = (float)(seed >> 16 & 255) / 255.0f,
        view->normals[i][1] = (float)(seed >> 8 & 255) / 255.0f;
    }
    ao_view_record(view, "reference"); /* asserts that each is in [0, 1] */
    view->without_normals = true;
    ao_view_record(view, "reference");
    view->without_normals = false;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_open_floor_is_unoccluded_at_any_slant),
        cmocka_unit_test(test_a_smooth_ball_is_unoccluded_up_to_its_limb),
        cmocka_unit_test(test_a_convex_body_is_unoccluded),
        cmocka_unit_test(test_a_pit_from_above_matches_its_closed_form_within_a_pixel),
        cmocka_unit_test(test_a_corner_in_view_matches_its_closed_form),
        cmocka_unit_test(test_nothing_hangs_down_from_a_silhouette),
        cmocka_unit_test(test_what_floats_in_view_occludes_what_is_beneath),
        cmocka_unit_test(test_what_is_out_of_view_has_no_influence_and_comes_back_with_the_scene),
        cmocka_unit_test(test_a_ceiling_in_view_is_what_is_seen),
        cmocka_unit_test(test_pictures_without_a_square_or_without_geometry_are_open),
        cmocka_unit_test(test_rubbish_in_the_depth_buffer_gives_visibility_in_its_range),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
