#include "engine/core/angle.h"
#include "engine/core/rotation.h"
#include "engine/core/vector.h"
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static void assert_near(double actual, double expected, double tolerance)
{
    if (!(fabs(actual - expected) <= tolerance))
        fail_msg("%.17g is not within %g of %.17g", actual, tolerance, expected);
}

static void assert_turns_to(const double rotation[4], const double from[3], double x, double y, double z)
{
    nook_matrix m = nook_rotation_matrix(rotation);
    double out[3];
    nook_matrix_apply_vector(&m, from, out);
    assert_near(out[0], x, 4 * DBL_EPSILON);
    assert_near(out[1], y, 4 * DBL_EPSILON);
    assert_near(out[2], z, 4 * DBL_EPSILON);
}

static void test_advance_turns_right_handed_about_the_velocity(void **state)
{
    (void)state;
    const double x[3] = { 1, 0, 0 }, y[3] = { 0, 1, 0 }, about_z[3] = { 0, 0, NOOK_PI };
    double rotation[4] = { 0, 0, 0, 1 };
    nook_rotation_advance(rotation, about_z, 0.5); /* a quarter turn: pi radians per second, half a second */
    assert_turns_to(rotation, x, 0, 1, 0);
    assert_turns_to(rotation, y, -1, 0, 0);
}

static void test_advance_turns_about_axes_of_the_world_after_what_was_turned(void **state)
{
    (void)state;
    const double about_z[3] = { 0, 0, NOOK_PI / 2 }, about_x[3] = { NOOK_PI / 2, 0, 0 }, x[3] = { 1, 0, 0 },
                 z[3] = { 0, 0, 1 };
    double rotation[4] = { 0, 0, 0, 1 };
    nook_rotation_advance(rotation, about_z, 1.0);
    nook_rotation_advance(rotation, about_x, 1.0);
    assert_turns_to(rotation, x, 0, 0, 1); /* x to y, y to z; about the body's own x it would have stayed at y */
    assert_turns_to(rotation, z, 0, -1, 0);
}

static void test_advance_is_exact_for_any_step(void **state)
{
    (void)state;
    const double x[3] = { 1, 0, 0 }, velocity[3] = { 0, 0, 1 };
    const double angles[] = { 0.0, -0.0, 1e-320, 1e-160, 1e-9, 1e-3, 1.0, 3.0, 6.0, -2.0 };
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        double rotation[4] = { 0, 0, 0, 1 };
        nook_rotation_advance(rotation, velocity, angles[i]);
        assert_turns_to(rotation, x, cos(angles[i]), sin(angles[i]), 0);
    }
}

static void test_advance_brings_a_quaternion_back_to_unit_length(void **state)
{
    (void)state;
    const double velocity[3] = { 0.3, -0.2, 0.9 };
    double rotation[4] = { 1e-3, 0, 0, 1.0 };
    nook_rotation_advance(rotation, velocity, 0.01);
    assert_near(nook_vector_dot(rotation, rotation) + rotation[3] * rotation[3], 1.0, 2 * DBL_EPSILON);
}

static void test_ten_thousand_steps_end_where_one_ends(void **state)
{
    (void)state;
    enum { STEPS = 10000 };
    const double velocity[3] = { 0.3, -1.2, 0.4 }; /* 1.3 radians per second */
    double small[4] = { 0.1, 0.7, 0.1, 0.7 }, large[4] = { 0.1, 0.7, 0.1, 0.7 };
    for (int i = 0; i < STEPS; i++)
        nook_rotation_advance(small, velocity, 1.0 / STEPS);
    nook_rotation_advance(large, velocity, 1.0);
    for (int i = 0; i < 4; i++) /* the angle's error, halved in a quaternion */
        assert_near(small[i], large[i], STEPS * 2 * DBL_EPSILON);
}

static void test_matrix_is_orthonormal_and_not_mirrored(void **state)
{
    (void)state;
    const double velocity[3] = { 1.0, 2.0, -3.0 };
    double rotation[4] = { 0, 0, 0, 1 };
    for (int i = 0; i < 1000; i++) {
        nook_rotation_advance(rotation, velocity, 0.37);
        nook_matrix m = nook_rotation_matrix(rotation);
        for (int a = 0; a < 3; a++)
            for (int b = a; b < 3; b++)
                assert_near(nook_vector_dot(m.m + 4 * a, m.m + 4 * b), a == b, 8 * DBL_EPSILON);
        assert_true(nook_matrix_determinant3(&m) > 0.0);
    }
}

/* The obvious formulation: a matrix of floats that is multiplied by the same small rotation every frame. */
static void multiply_floats(const float a[9], const float b[9], float out[9])
{
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            out[column * 3 + row] =
                a[row] * b[column * 3] + a[3 + row] * b[column * 3 + 1] + a[6 + row] * b[column * 3 + 2];
}

static void test_a_million_frames_keep_what_a_matrix_of_floats_loses(void **state)
{
    (void)state;
    enum { FRAMES = 1000000, FRAMES_PER_TURN = 1000 };
    const double velocity[3] = { 0.48 * 2 * NOOK_PI, -0.6 * 2 * NOOK_PI, 0.64 * 2 * NOOK_PI };
    double rotation[4] = { 0, 0, 0, 1 }, step[4] = { 0, 0, 0, 1 };
    nook_rotation_advance(step, velocity, 1.0 / FRAMES_PER_TURN);
    nook_matrix step_matrix = nook_rotation_matrix(step);
    float naive[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, step_floats[9];
    for (int i = 0; i < 9; i++)
        step_floats[i] = (float)step_matrix.m[i / 3 * 4 + i % 3];
    for (int frame = 0; frame < FRAMES; frame++) {
        float turned[9];
        multiply_floats(step_floats, naive, turned);
        for (int i = 0; i < 9; i++)
            naive[i] = turned[i];
        nook_rotation_advance(rotation, velocity, 1.0 / FRAMES_PER_TURN);
    }
    nook_matrix m = nook_rotation_matrix(rotation); /* a thousand whole turns */
    double worst = 0.0, naive_worst = 0.0;
    for (int i = 0; i < 9; i++) {
        double expected = i % 4 == 0 ? 1.0 : 0.0;
        worst = fmax(worst, fabs(m.m[i / 3 * 4 + i % 3] - expected));
        naive_worst = fmax(naive_worst, fabs(naive[i] - expected));
    }
    print_message("off by %.2g, a matrix of floats by %.2g\n", worst, naive_worst);
    assert_true(worst <= FRAMES * 4 * DBL_EPSILON);
    assert_true(naive_worst > 1e-3); /* if not, docs/measuring.md says something that is wrong */
}

static void test_apply_is_what_the_matrix_does(void **state)
{
    (void)state;
    const double degrees[3] = { 20, -70, 130 }, v[3] = { 1, 2, -3 };
    double q[4], out[3];
    nook_rotation_from_degrees(degrees, q);
    nook_rotation_apply(q, v, out);
    nook_matrix m = nook_rotation_matrix(q);
    double expected[3];
    nook_matrix_apply_vector(&m, v, expected);
    for (int i = 0; i < 3; i++)
        assert_near(out[i], expected[i], 16 * DBL_EPSILON);
}

static void test_degrees_turn_about_x_first_then_y_then_z(void **state)
{
    (void)state;
    const double quarter[3] = { 90, 90, 0 }, y[3] = { 0, 1, 0 }, all[3] = { 90, 90, 90 };
    double q[4];
    nook_rotation_from_degrees(quarter, q);
    assert_turns_to(q, y, 1, 0, 0); /* about x to z, about y to x */
    nook_rotation_from_degrees(all, q);
    assert_turns_to(q, y, 0, 1, 0); /* and about z to y */
}

static void test_multiply_and_inverse_undo_each_other(void **state)
{
    (void)state;
    const double degrees[3] = { 12, 34, 56 };
    double q[4], back[4];
    nook_rotation_from_degrees(degrees, q);
    nook_rotation_inverse(q, back);
    nook_rotation_multiply(back, q, q);
    for (int i = 0; i < 4; i++)
        assert_near(q[i], i == 3, 4 * DBL_EPSILON);
}

static void test_a_matrix_is_taken_apart_into_what_it_was_made_of(void **state)
{
    (void)state;
    static const double turns[][3] = { { 0, 0, 0 },   { 179, 0, 0 }, { 0, 180, 0 },    { 0, 0, 181 },
                                       { 90, 90, 0 }, { 5, -7, 11 }, { -120, 40, 77 }, { 33, 200, -150 } };
    for (size_t i = 0; i < sizeof turns / sizeof *turns; i++) {
        const double at[3] = { 4, 5, 6 }, scale[3] = { i % 2 ? -2.0 : 2.0, 0.5, 3.0 };
        double q[4], found[4], found_scale[3];
        nook_rotation_from_degrees(turns[i], q);
        nook_matrix m = nook_matrix_compose(at, q, scale);
        assert_true(nook_rotation_from_matrix(&m, found, found_scale));
        nook_matrix again = nook_matrix_compose(at, found, found_scale);
        for (int k = 0; k < 16; k++)
            assert_near(again.m[k], m.m[k], 32 * DBL_EPSILON);
    }
}

static void test_a_flat_matrix_has_no_rotation(void **state)
{
    (void)state;
    double q[4] = { 7, 7, 7, 7 }, scale[3] = { 7, 7, 7 };
    for (int axis = 0; axis < 3; axis++) {
        nook_matrix m = nook_matrix_scale(axis != 0, axis != 1, axis != 2);
        assert_false(nook_rotation_from_matrix(&m, q, scale));
    }
    assert_true(q[0] == 7 && scale[2] == 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_advance_turns_right_handed_about_the_velocity),
        cmocka_unit_test(test_advance_turns_about_axes_of_the_world_after_what_was_turned),
        cmocka_unit_test(test_advance_is_exact_for_any_step),
        cmocka_unit_test(test_advance_brings_a_quaternion_back_to_unit_length),
        cmocka_unit_test(test_ten_thousand_steps_end_where_one_ends),
        cmocka_unit_test(test_matrix_is_orthonormal_and_not_mirrored),
        cmocka_unit_test(test_a_million_frames_keep_what_a_matrix_of_floats_loses),
        cmocka_unit_test(test_apply_is_what_the_matrix_does),
        cmocka_unit_test(test_degrees_turn_about_x_first_then_y_then_z),
        cmocka_unit_test(test_multiply_and_inverse_undo_each_other),
        cmocka_unit_test(test_a_matrix_is_taken_apart_into_what_it_was_made_of),
        cmocka_unit_test(test_a_flat_matrix_has_no_rotation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
