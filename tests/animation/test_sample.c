/* Tracks at a time, against formulas. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "engine/animation/sample.h"
#include "engine/animation/scene_pose.h"
#include <math.h>

static const double pi = 3.14159265358979323846;

static void assert_numbers(const double *a, const double *b, int count, double allowed)
{
    for (int i = 0; i < count; i++)
        if (!(fabs(a[i] - b[i]) <= allowed))
            fail_msg("number %d is %.17g, expected %.17g", i, a[i], b[i]);
}

/* Three keys at 1, 2 and 4 seconds. */
static const float steps[] = { 1, 2, 4, /* values */ 10, 0, 0, 20, 0, 0, 40, 0, 4 };

static nook_track track_of(nook_interpolation interpolation, nook_track_path path, uint32_t keys, uint32_t width)
{
    return (nook_track){
        .path = path, .interpolation = interpolation, .key_count = keys, .width = width, .first_value = keys
    };
}

static void test_step_holds_the_key_before(void **state)
{
    (void)state;
    nook_track track = track_of(NOOK_STEP, NOOK_TRACK_TRANSLATION, 3, 3);
    static const double at[][2] = {
        { 0, 10 }, { 1, 10 }, { 1.999, 10 }, { 2, 20 }, { 3.999, 20 }, { 4, 40 }, { 9, 40 }
    };
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        double out[3];
        nook_track_sample(&track, steps, at[i][0], out);
        assert_true(out[0] == at[i][1]);
    }
}

static void test_linear_goes_straight_and_holds_at_both_ends(void **state)
{
    (void)state;
    nook_track track = track_of(NOOK_LINEAR, NOOK_TRACK_SCALE, 3, 3);
    static const double at[][3] = { { -5, 10, 0 }, { 1, 10, 0 }, { 1.25, 12.5, 0 }, { 2, 20, 0 },
                                    { 3, 30, 2 },  { 4, 40, 4 }, { 1e9, 40, 4 } };
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        double out[3], expected[3] = { at[i][1], 0, at[i][2] };
        nook_track_sample(&track, steps, at[i][0], out);
        assert_numbers(out, expected, 3, 1e-12);
    }
}

static void test_keys_at_the_same_time_jump(void **state)
{
    (void)state;
    static const float values[] = { 0, 1, 1, 2, /* */ 0, 10, 20, 30 };
    nook_track track = track_of(NOOK_LINEAR, NOOK_TRACK_WEIGHTS, 4, 1);
    double before, at, after;
    nook_track_sample(&track, values, 0.999999, &before);
    nook_track_sample(&track, values, 1.0, &at);
    nook_track_sample(&track, values, 1.5, &after);
    assert_true(before < 10.0 && before > 9.99 && at == 20.0 && after == 25.0);
}

/* Of a cubic polynomial, whose derivatives are its tangents, the spline is that polynomial. */
static double polynomial(double x)
{
    return 2.0 - 3.0 * x + 0.5 * x * x + 0.25 * x * x * x;
}

static double slope(double x)
{
    return -3.0 + x + 0.75 * x * x;
}

static void test_a_spline_through_a_cubic_is_that_cubic(void **state)
{
    (void)state;
    static const float times[3] = { 0, 1.5f, 4 };
    float values[3 + 9];
    for (int k = 0; k < 3; k++) {
        values[k] = times[k];
        values[3 + 3 * k] = values[3 + 3 * k + 2] = (float)slope((double)times[k]);
        values[3 + 3 * k + 1] = (float)polynomial((double)times[k]);
    }
    nook_track track = track_of(NOOK_CUBIC_SPLINE, NOOK_TRACK_WEIGHTS, 3, 1);
    for (double x = 0.0; x <= 4.0; x += 0.125) {
        double out, expected = polynomial(x);
        nook_track_sample(&track, values, x, &out);
        assert_numbers(&out, &expected, 1, 1e-5); /* the keys are floats */
    }
}

static void test_a_spline_leaves_and_arrives_with_different_tangents(void **state)
{
    (void)state;
    /* in, value, out of each key; from 0 to 2 seconds. At the middle: (a + b) / 2 + 2 (leaves - arrives) / 8. */
    static const float values[] = { 0, 2, /* */ 99, 1, 4, -8, 3, 99 };
    nook_track track = track_of(NOOK_CUBIC_SPLINE, NOOK_TRACK_WEIGHTS, 2, 1);
    double out, expected = 2.0 + 2.0 * (4.0 + 8.0) / 8.0;
    nook_track_sample(&track, values, 1.0, &out);
    assert_numbers(&out, &expected, 1, 1e-12);
}

static void about_z(double radians, double out[4])
{
    out[0] = out[1] = 0.0;
    out[2] = sin(0.5 * radians);
    out[3] = cos(0.5 * radians);
}

static void test_slerp_turns_at_constant_speed_the_short_way(void **state)
{
    (void)state;
    double a[4], b[4], out[4], expected[4];
    for (int sign = -1; sign <= 1; sign += 2) {
        about_z(0.2, a);
        about_z(0.2 + 1.6, b);
        for (int i = 0; i < 4; i++)
            b[i] *= sign; /* the same rotation, on the far side of the sphere */
        for (double t = 0.0; t <= 1.0; t += 0.125) {
            nook_rotation_slerp(a, b, t, out);
            about_z(0.2 + 1.6 * t, expected);
            if (out[3] * expected[3] + out[2] * expected[2] < 0.0)
                for (int i = 0; i < 4; i++)
                    out[i] = -out[i];
            assert_numbers(out, expected, 4, 1e-12);
        }
    }
    /* From 0.1 to -0.1 of a turn: through 0, not through half a turn. */
    about_z(0.2 * pi, a);
    about_z(1.8 * pi, b);
    nook_rotation_slerp(a, b, 0.5, out);
    assert_true(fabs(fabs(out[3]) - 1.0) < 1e-12);
}

static void test_slerp_of_nearly_equal_and_of_opposite_rotations_is_unit(void **state)
{
    (void)state;
    double a[4], b[4], out[4];
    for (double angle = 1e-12; angle < 7.0; angle *= 1.7) {
        about_z(0.0, a);
        about_z(angle, b);
        for (double t = 0.0; t <= 1.0; t += 0.25) {
            nook_rotation_slerp(a, b, t, out);
            double length = out[0] * out[0] + out[1] * out[1] + out[2] * out[2] + out[3] * out[3];
            assert_true(fabs(length - 1.0) < 1e-12);
        }
    }
}

static void test_rotations_of_splines_are_unit(void **state)
{
    (void)state;
    static const float values[] = {
        0, 1, /* */ 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0, 1, 0, 0, 0, 0, 0
    };
    nook_track track = track_of(NOOK_CUBIC_SPLINE, NOOK_TRACK_ROTATION, 2, 4);
    for (double t = -0.5; t < 1.5; t += 0.1) {
        double q[4];
        nook_track_sample(&track, values, t, q);
        assert_true(fabs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1.0) < 1e-12);
    }
}

static void test_a_clip_that_loops_comes_around_and_one_that_does_not_stays(void **state)
{
    (void)state;
    static const struct {
        double seconds, looped, held;
    } cases[] = { { 0, 0, 0 },      { 1.5, 1.5, 1.5 }, { 2, 0, 2 },   { 5.5, 1.5, 2 },
                  { -0.5, 1.5, 0 }, { -2, 0, 0 },      { 1e6, 0, 2 }, { -1e-320, 0, 0 } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_true(nook_clip_time(2.0, cases[i].seconds, true) == cases[i].looped);
        assert_true(nook_clip_time(2.0, cases[i].seconds, false) == cases[i].held);
    }
    assert_true(nook_clip_time(0.0, 3.0, true) == 0.0 && nook_clip_time(0.0, 3.0, false) == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_step_holds_the_key_before),
        cmocka_unit_test(test_linear_goes_straight_and_holds_at_both_ends),
        cmocka_unit_test(test_keys_at_the_same_time_jump),
        cmocka_unit_test(test_a_spline_through_a_cubic_is_that_cubic),
        cmocka_unit_test(test_a_spline_leaves_and_arrives_with_different_tangents),
        cmocka_unit_test(test_slerp_turns_at_constant_speed_the_short_way),
        cmocka_unit_test(test_slerp_of_nearly_equal_and_of_opposite_rotations_is_unit),
        cmocka_unit_test(test_rotations_of_splines_are_unit),
        cmocka_unit_test(test_a_clip_that_loops_comes_around_and_one_that_does_not_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
