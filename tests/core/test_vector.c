#include "engine/core/vector.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static void assert_vector(const double actual[3], double x, double y, double z)
{
    const double expected[3] = { x, y, z };
    for (int i = 0; i < 3; i++) {
        if (!(fabs(actual[i] - expected[i]) <= 1e-15 * fabs(expected[i])))
            fail_msg("component %d is %.17g instead of %.17g", i, actual[i], expected[i]);
    }
}

static void test_cross_turns_x_over_y_to_z(void **state)
{
    (void)state;
    const double a[3] = { 2, 0, 0 }, b[3] = { 5, 3, 0 };
    double out[3];
    nook_vector_cross(a, b, out);
    assert_vector(out, 0, 0, 6);
    nook_vector_cross(b, a, out);
    assert_vector(out, 0, 0, -6);
}

static void test_results_may_replace_their_inputs(void **state)
{
    (void)state;
    double a[3] = { 1, 2, 3 }, b[3] = { -4, 5, 7 };
    nook_vector_cross(a, b, a);
    assert_vector(a, -1, -19, 13);
    nook_vector_add_scaled(a, 2.0, b, b);
    assert_vector(b, -9, -9, 27);
    double c[3] = { 0, -3, 4 };
    assert_true(nook_vector_normalize(c, c));
    assert_vector(c, 0, -0.6, 0.8);
}

static void test_normalize_gives_length_one_at_any_finite_length(void **state)
{
    (void)state;
    const double lengths[] = { 5e-324, 1e-310, 1e-170, 1e-20, 1.0, 1e20, 1e170, 1e307 };
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        const double v[3] = { 2.0 * lengths[i], -2.0 * lengths[i], lengths[i] };
        double out[3] = { 0.0, 0.0, 0.0 };
        assert_true(nook_vector_normalize(v, out));
        assert_vector(out, 2.0 / 3.0, -2.0 / 3.0, 1.0 / 3.0);
    }
}

static void test_normalize_refuses_what_has_no_direction_and_leaves_the_output(void **state)
{
    (void)state;
    const double bad[][3] = { { 0, 0, 0 },   { -0.0, 0, 0 },       { INFINITY, 0, 0 }, { 1, -INFINITY, 1 },
                              { NAN, 1, 1 }, { 1, NAN, INFINITY }, { 0, NAN, 0 } };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        double out[3] = { 7, 8, 9 };
        assert_false(nook_vector_normalize(bad[i], out));
        assert_vector(out, 7, 8, 9);
    }
}

static void test_between_keeps_edges_that_float_would_round_away(void **state)
{
    (void)state;
    const float a[3] = { 1.0f, 1e-9f, 0.0f }, b[3] = { 1e-9f, 1.0f, 0.0f };
    double out[3];
    nook_vector_between(a, b, out);
    assert_true(out[0] > -1.0 && out[1] < 1.0);
    assert_vector(out, (double)1e-9f - 1.0, 1.0 - (double)1e-9f, 0.0);
}

static void test_length_and_dot_agree(void **state)
{
    (void)state;
    const double v[3] = { 2, -3, 6 };
    assert_true(nook_vector_dot(v, v) == 49.0);
    assert_true(nook_vector_length(v) == 7.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cross_turns_x_over_y_to_z),
        cmocka_unit_test(test_results_may_replace_their_inputs),
        cmocka_unit_test(test_normalize_gives_length_one_at_any_finite_length),
        cmocka_unit_test(test_normalize_refuses_what_has_no_direction_and_leaves_the_output),
        cmocka_unit_test(test_between_keeps_edges_that_float_would_round_away),
        cmocka_unit_test(test_length_and_dot_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
