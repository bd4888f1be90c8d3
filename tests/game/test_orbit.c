#include "game/view/orbit.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const double centre[3] = { 0.0, 1.0, 0.0 };

static void assert_near(double value, double truth)
{
    if (!(fabs(value - truth) <= 1e-9))
        fail_msg("%.17g is not %.17g", value, truth);
}

static nook_camera look(double ex, double ey, double ez, double tx, double ty, double tz)
{
    const double eye[3] = { ex, ey, ez }, target[3] = { tx, ty, tz }, up[3] = { 0.0, 1.0, 0.0 };
    return (nook_camera){ nook_matrix_look_at(eye, target, up), 0.8, 0.01 };
}

static void see(const nook_camera *camera, const double world[3], double view[3])
{
    nook_matrix_apply_point(&camera->view_from_world, world, view);
}

static void test_an_orbit_sees_what_its_camera_saw(void **state)
{
    (void)state;
    const double views[][6] = {
        { 4, 3, 5, 0, 1, 0 }, { -4, 0, -1, 9, 7, 2 }, { 1, 2, 3, 1, 2, -5 }, { 0, 1, 0, -1, 1, 0 }
    };
    for (size_t i = 0; i < NOOK_COUNT(views); i++) {
        const double *v = views[i];
        nook_camera camera = look(v[0], v[1], v[2], v[3], v[4], v[5]);
        nook_orbit orbit = nook_orbit_from_camera(&camera, centre, 1.0, 40.0);
        nook_camera again = nook_orbit_camera(&orbit);
        for (int j = 0; j < 16; j++)
            assert_near(again.view_from_world.m[j], camera.view_from_world.m[j]);
        assert_true(again.fov_y_radians == camera.fov_y_radians && again.z_near == camera.z_near);
    }
}

static void test_turning_keeps_the_target_in_the_middle_at_its_distance(void **state)
{
    (void)state;
    nook_camera camera = look(4, 3, 5, 0, 1, 0);
    nook_orbit orbit = nook_orbit_from_camera(&camera, centre, 1.0, 40.0);
    double distance = orbit.distance, view[3];
    for (int i = 0; i < 50; i++) {
        nook_orbit_turn(&orbit, 0.7, 0.3);
        camera = nook_orbit_camera(&orbit);
        see(&camera, orbit.target, view);
        assert_near(view[0], 0.0);
        assert_near(view[1], 0.0);
        assert_near(view[2], -distance);
    }
    assert_true(orbit.pitch < 1.5708); /* never over the top */
}

static void test_panning_moves_the_picture_by_what_was_asked(void **state)
{
    (void)state;
    nook_camera camera = look(4, 3, 5, 0, 1, 0);
    nook_orbit orbit = nook_orbit_from_camera(&camera, centre, 1.0, 40.0);
    const double mark[3] = { orbit.target[0], orbit.target[1], orbit.target[2] };
    double view[3];
    nook_orbit_pan(&orbit, 0.25, -0.5);
    camera = nook_orbit_camera(&orbit);
    see(&camera, mark, view);
    assert_near(view[0], -0.25);
    assert_near(view[1], 0.5);
    assert_near(view[2], -orbit.distance);
}

static void test_zooming_in_and_out_again_changes_nothing(void **state)
{
    (void)state;
    nook_camera camera = look(4, 3, 5, 0, 1, 0);
    nook_orbit orbit = nook_orbit_from_camera(&camera, centre, 1.0, 40.0);
    double distance = orbit.distance;
    nook_orbit_zoom(&orbit, 3.0);
    assert_near(orbit.distance, distance * 0.9 * 0.9 * 0.9);
    nook_orbit_zoom(&orbit, -3.0);
    assert_near(orbit.distance, distance);
    nook_orbit_zoom(&orbit, 1e6);
    assert_true(orbit.distance > 0.0);
}

static void test_flying_forward_moves_the_eye_ahead(void **state)
{
    (void)state;
    nook_camera camera = look(0, 1, 5, 0, 1, 0);
    nook_orbit orbit = nook_orbit_from_camera(&camera, centre, 1.0, 40.0);
    nook_orbit_fly(&orbit, 2.0, 1.0, 0.5);
    camera = nook_orbit_camera(&orbit);
    const double eye[3] = { 1.0, 1.5, 3.0 };
    double view[3];
    see(&camera, eye, view);
    for (int i = 0; i < 3; i++)
        assert_near(view[i], 0.0);
}

static void test_a_camera_that_turns_its_back_still_orbits_something_ahead(void **state)
{
    (void)state;
    nook_camera camera = look(4, 1, 0, 9, 1, 0); /* away from the centre */
    nook_orbit orbit = nook_orbit_from_camera(&camera, centre, 1.0, 40.0);
    assert_near(orbit.distance, 1.0);
    assert_near(orbit.target[0], 5.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_orbit_sees_what_its_camera_saw),
        cmocka_unit_test(test_turning_keeps_the_target_in_the_middle_at_its_distance),
        cmocka_unit_test(test_panning_moves_the_picture_by_what_was_asked),
        cmocka_unit_test(test_zooming_in_and_out_again_changes_nothing),
        cmocka_unit_test(test_flying_forward_moves_the_eye_ahead),
        cmocka_unit_test(test_a_camera_that_turns_its_back_still_orbits_something_ahead),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
