#include "engine/physics/pose.h"
#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <cmocka.h>

static nook_pose pose_about(const double axis[3], double radians, double x, double y, double z)
{
    nook_pose pose = { .position = { x, y, z }, .rotation = { 0, 0, 0, cos(radians / 2) } };
    for (int i = 0; i < 3; i++)
        pose.rotation[i] = axis[i] * sin(radians / 2);
    return pose;
}

static void assert_same(const nook_pose *a, const nook_pose *b, double tolerance)
{
    for (int i = 0; i < 3; i++)
        physics_assert_near(a->position[i], b->position[i], tolerance);
    for (int i = 0; i < 4; i++)
        physics_assert_near(a->rotation[i], b->rotation[i], tolerance);
}

static void test_pose_times_its_inverse_is_the_identity(void **state)
{
    (void)state;
    const double axis[3] = { 0.48, 0.6, 0.64 };
    nook_pose pose = pose_about(axis, 1.3, 4, -5, 6), inverse = nook_pose_inverse(&pose);
    nook_pose product = nook_pose_multiply(&pose, &inverse), identity = nook_pose_identity();
    assert_same(&product, &identity, 1e-14);
}

static void test_multiply_applies_the_right_one_first(void **state)
{
    (void)state;
    const double y[3] = { 0, 1, 0 };
    nook_pose turn = pose_about(y, 1.57079632679489661923, 0, 0, 0), move = pose_about(y, 0, 1, 0, 0);
    nook_pose both = nook_pose_multiply(&turn, &move);
    double at[3] = { 0, 0, 0 };
    nook_pose_apply_point(&both, at, at);
    physics_assert_near(at[0], 0, 1e-15);
    physics_assert_near(at[2], -1, 1e-15);
}

static void test_between_takes_the_shortest_turn_and_stays_unit(void **state)
{
    (void)state;
    const double y[3] = { 0, 1, 0 };
    nook_pose from = pose_about(y, 0.2, 0, 0, 0), to = pose_about(y, 0.6, 2, 0, 0);
    nook_pose far_side = to;
    for (int i = 0; i < 4; i++)
        far_side.rotation[i] = -to.rotation[i]; /* the same rotation */
    nook_pose a = nook_pose_between(&from, &to, 0.5), b = nook_pose_between(&from, &far_side, 0.5);
    nook_pose expected = pose_about(y, 0.4, 1, 0, 0);
    assert_same(&a, &expected, 1e-12);
    assert_same(&b, &expected, 1e-12);
    nook_pose start = nook_pose_between(&from, &to, 0.0), end = nook_pose_between(&from, &to, 1.0);
    assert_memory_equal(&start, &from, sizeof from);
    assert_memory_equal(&end, &to, sizeof to);
}

static void test_turn_rate_is_the_angle_over_the_time(void **state)
{
    (void)state;
    const double axis[3] = { 0.48, 0.6, 0.64 }, angles[] = { 0, 1e-9, 0.3, 2, 3.1, -1 };
    nook_pose start = pose_about((double[3]){ 1, 0, 0 }, 0.7, 0, 0, 0);
    for (int i = 0; i < 6; i++) {
        nook_pose turn = pose_about(axis, angles[i], 0, 0, 0), end = nook_pose_multiply(&turn, &start);
        double rate[3];
        nook_pose_turn_rate(start.rotation, end.rotation, 0.5, rate);
        for (int k = 0; k < 3; k++)
            physics_assert_near(rate[k], 2 * angles[i] * axis[k], 1e-12);
    }
}

static void test_valid_tells_broken_poses(void **state)
{
    (void)state;
    nook_pose pose = nook_pose_identity();
    assert_true(nook_pose_valid(&pose));
    pose.rotation[3] = NAN;
    assert_false(nook_pose_valid(&pose));
    pose = nook_pose_identity();
    pose.position[2] = INFINITY;
    assert_false(nook_pose_valid(&pose));
    pose = (nook_pose){ 0 };
    assert_false(nook_pose_valid(&pose));
}

static void test_matrix_does_what_the_pose_does(void **state)
{
    (void)state;
    const double axis[3] = { 0.48, 0.6, 0.64 };
    nook_pose pose = pose_about(axis, 1.3, 4, -5, 6);
    nook_matrix matrix = nook_pose_matrix(&pose);
    double a[3] = { 1, 2, 3 }, b[3] = { 1, 2, 3 };
    nook_pose_apply_point(&pose, a, a);
    nook_matrix_apply_point(&matrix, b, b);
    for (int i = 0; i < 3; i++)
        physics_assert_near(a[i], b[i], 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pose_times_its_inverse_is_the_identity),
        cmocka_unit_test(test_multiply_applies_the_right_one_first),
        cmocka_unit_test(test_between_takes_the_shortest_turn_and_stays_unit),
        cmocka_unit_test(test_turn_rate_is_the_angle_over_the_time),
        cmocka_unit_test(test_valid_tells_broken_poses),
        cmocka_unit_test(test_matrix_does_what_the_pose_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
