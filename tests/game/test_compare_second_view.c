#include "engine/core/angle.h"
#include "game/compare/camera.h"
#include "game/compare/second_view.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static nook_camera make_camera(void)
{
    const double eye[3] = { 3.0, 7.0, -2.0 }, target[3] = { -1.0, 2.5, 4.0 };
    nook_camera camera;
    assert_int_equal(nook_camera_look(eye, target, 0.9, 0.01, &camera), NOOK_OK);
    return camera;
}

static void assert_near(double value, double truth)
{
    if (!(fabs(value - truth) <= 1e-9))
        fail_msg("%.17g is not %.17g", value, truth);
}

/* A point of the first camera's view space as the second has it. */
static void carry_over(const nook_camera *first, const nook_camera *second, double point[3])
{
    nook_matrix world_from_first;
    assert_true(nook_matrix_inverse_affine(&first->view_from_world, &world_from_first));
    nook_matrix_apply_point(&world_from_first, point, point);
    nook_matrix_apply_point(&second->view_from_world, point, point);
}

static void test_turned_camera_has_the_same_point_in_the_middle(void **state)
{
    (void)state;
    nook_camera first = make_camera(), second = nook_camera_turn(&first, 5.5, 20.0);
    double middle[3] = { 0.0, 0.0, -5.5 }, above[3] = { 0.0, 1.0, -5.5 };
    carry_over(&first, &second, middle);
    carry_over(&first, &second, above);
    for (int i = 0; i < 3; i++) {
        assert_near(middle[i], i == 2 ? -5.5 : 0.0);
        assert_near(above[i], i == 2 ? -5.5 : i == 1 ? 1.0 : 0.0); /* upright stays upright */
    }
    assert_true(second.fov_y_radians == first.fov_y_radians && second.z_near == first.z_near);
}

static void test_positive_turn_goes_to_the_right(void **state)
{
    (void)state;
    nook_camera first = make_camera(), second = nook_camera_turn(&first, 5.5, 20.0);
    double eye[3] = { 0.0, 0.0, 0.0 };
    carry_over(&second, &first, eye);
    assert_near(eye[0], 5.5 * sin(20.0 * NOOK_DEGREE));
    assert_near(eye[1], 0.0);
    assert_near(eye[2], 5.5 * (cos(20.0 * NOOK_DEGREE) - 1.0));
    second = nook_camera_turn(&first, 5.5, -20.0);
    for (int i = 0; i < 3; i++)
        eye[i] = 0.0;
    carry_over(&second, &first, eye);
    assert_near(eye[0], -5.5 * sin(20.0 * NOOK_DEGREE));
}

static void test_distance_is_the_median_of_what_the_middle_shows(void **state)
{
    (void)state;
    enum { SIDE = 9 };
    float distances[SIDE * SIDE];
    double distance = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++)
        distances[i] = 1000.0f;
    for (int i = 0; i < 9; i++) /* the middle 3 x 3: 6, 7, 8 and 1 to 5, shuffled, and a hole */
        distances[(3 + i / 3) * SIDE + 3 + i % 3] = (float)((i * 4 + 6) % 9);
    assert_int_equal(nook_middle_distance(distances, SIDE, SIDE, &distance), NOOK_OK);
    assert_true(distance == 5.0);
}

static void test_distance_is_that_of_the_whole_picture_when_nothing_is_in_the_middle(void **state)
{
    (void)state;
    float distances[9 * 4] = { 0 };
    double distance = 0.0;
    distances[0] = 3.0f;
    distances[8] = 2.0f;
    distances[35] = 4.0f;
    assert_int_equal(nook_middle_distance(distances, 9, 4, &distance), NOOK_OK);
    assert_true(distance == 3.0);
}

static void test_no_distance_where_nothing_is_seen(void **state)
{
    (void)state;
    const float nothing[4] = { 0 };
    double distance = -1.0;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_middle_distance(nothing, 2, 2, &distance), NOOK_E_NOT_FOUND);
    nook_log_capture_end();
    assert_true(distance == -1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_turned_camera_has_the_same_point_in_the_middle),
        cmocka_unit_test(test_positive_turn_goes_to_the_right),
        cmocka_unit_test(test_distance_is_the_median_of_what_the_middle_shows),
        cmocka_unit_test(test_distance_is_that_of_the_whole_picture_when_nothing_is_in_the_middle),
        cmocka_unit_test(test_no_distance_where_nothing_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
