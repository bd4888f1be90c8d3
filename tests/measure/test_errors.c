#include "modules/measure/errors.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum { PIXELS = 1000 };

static void assert_near(double value, double truth, double tolerance)
{
    if (!(fabs(value - truth) <= tolerance))
        fail_msg("%.17g is not within %g of %.17g", value, tolerance, truth);
}

static nook_errors measure(const float *visibility, const float *reference, const uint8_t *mask, size_t pixels)
{
    nook_errors errors;
    assert_int_equal(nook_errors_measure(visibility, reference, mask, pixels, &errors), NOOK_OK);
    return errors;
}

static void test_equal_pictures_have_no_error(void **state)
{
    (void)state;
    float picture[PIXELS];
    for (int i = 0; i < PIXELS; i++)
        picture[i] = (float)i / PIXELS;
    nook_errors e = measure(picture, picture, NULL, PIXELS);
    assert_true(e.valid);
    assert_int_equal(e.count, PIXELS);
    assert_true(e.rmse == 0.0 && e.mae == 0.0 && e.bias == 0.0 && e.p99 == 0.0 && e.max == 0.0);
}

static void test_constant_difference_is_every_error_at_once(void **state)
{
    (void)state;
    float bright[PIXELS], dark[PIXELS];
    for (int i = 0; i < PIXELS; i++) {
        bright[i] = 0.75f;
        dark[i] = 0.5f;
    }
    nook_errors e = measure(bright, dark, NULL, PIXELS);
    assert_true(e.rmse == 0.25 && e.mae == 0.25 && e.bias == 0.25 && e.p99 == 0.25 && e.max == 0.25);
    e = measure(dark, bright, NULL, PIXELS);
    assert_true(e.bias == -0.25); /* too dark is negative */
    assert_true(e.mae == 0.25 && e.max == 0.25);
}

static void test_ramp_has_the_errors_of_its_closed_form(void **state)
{
    (void)state;
    float ramp[PIXELS], zero[PIXELS] = { 0 };
    for (int i = 0; i < PIXELS; i++) /* shuffled: 7 and 1000 have no common factor */
        ramp[i * 7 % PIXELS] = (float)(i + 1) / PIXELS;
    nook_errors e = measure(ramp, zero, NULL, PIXELS);
    double n = PIXELS;
    assert_near(e.mae, (n + 1) / (2 * n), 1e-7);
    assert_near(e.rmse, sqrt((n + 1) * (2 * n + 1) / (6 * n * n)), 1e-7);
    assert_true((float)e.p99 == 0.99f); /* the 990th of 1000 */
    assert_true(e.max == 1.0);
}

static void test_opposite_errors_cancel_in_the_bias_only(void **state)
{
    (void)state;
    const float visibility[] = { 0.5f, 0.0f }, reference[] = { 0.25f, 0.25f };
    nook_errors e = measure(visibility, reference, NULL, 2);
    assert_true(e.bias == 0.0 && e.mae == 0.25 && e.rmse == 0.25);
}

static void test_masked_pixels_do_not_count(void **state)
{
    (void)state;
    const float visibility[] = { 0.5f, NAN, 0.0f, 9.0f }, reference[] = { 0.25f, 0.0f, 0.0f, 0.0f };
    const uint8_t mask[] = { 1, 0, 255, 0 };
    nook_errors e = measure(visibility, reference, mask, 4);
    assert_true(e.valid);
    assert_int_equal(e.count, 2);
    assert_int_equal(e.non_finite, 0);
    assert_true(e.max == 0.25 && e.mae == 0.125 && e.p99 == 0.25);
}

static void test_values_that_are_not_finite_make_the_result_invalid(void **state)
{
    (void)state;
    const float visibility[] = { 0.5f, NAN, 1.0f, 1.0f }, reference[] = { 0.5f, 0.5f, INFINITY, 1.0f };
    nook_errors e = measure(visibility, reference, NULL, 4);
    assert_false(e.valid);
    assert_int_equal(e.count, 4);
    assert_int_equal(e.non_finite, 2);
    assert_true(isnan(e.rmse) && isnan(e.mae) && isnan(e.bias) && isnan(e.p99) && isnan(e.max));
}

static void test_nothing_to_compare_is_invalid(void **state)
{
    (void)state;
    const float value = 0.5f;
    const uint8_t masked = 0;
    nook_errors e = measure(&value, &value, &masked, 1);
    assert_false(e.valid);
    assert_int_equal(e.count, 0);
    assert_true(isnan(e.rmse));
}

static void test_small_errors_survive_beside_large_ones(void **state)
{
    (void)state;
    enum { MANY = 1 << 20 };
    float *visibility = malloc(MANY * sizeof *visibility), *reference = calloc(MANY, sizeof *reference);
    assert_non_null(visibility);
    assert_non_null(reference);
    for (int i = 0; i < MANY; i++) /* sum = 1 exactly, behind 2^24 times larger values that cancel */
        visibility[i] = i % 4 == 0 ? 0x1p24f : i % 4 == 2 ? -0x1p24f : 0x1p-19f;
    nook_errors e = measure(visibility, reference, NULL, MANY);
    assert_true(e.bias * MANY == 1.0);
    free(visibility);
    free(reference);
}

static int compare_floats(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static void test_percentile_is_that_of_a_full_sort(void **state)
{
    (void)state;
    unsigned seed = 20100712u;
    for (size_t n = 1; n <= 300; n += 13) {
        float visibility[300], zero[300] = { 0 }, sorted[300] = { 0 };
        for (size_t i = 0; i < n; i++) {
            seed = seed * 1664525u + 1013904223u;
            visibility[i] = ldexpf((float)(seed >> 8), -(int)(seed % 40)) * (seed & 64 ? 1.0f : -1.0f);
            sorted[i] = fabsf(visibility[i]);
        }
        qsort(sorted, n, sizeof *sorted, compare_floats);
        size_t rank = (size_t)ceil(0.99 * (double)n);
        assert_true(measure(visibility, zero, NULL, n).p99 == (double)sorted[rank - 1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equal_pictures_have_no_error),
        cmocka_unit_test(test_constant_difference_is_every_error_at_once),
        cmocka_unit_test(test_ramp_has_the_errors_of_its_closed_form),
        cmocka_unit_test(test_opposite_errors_cancel_in_the_bias_only),
        cmocka_unit_test(test_masked_pixels_do_not_count),
        cmocka_unit_test(test_values_that_are_not_finite_make_the_result_invalid),
        cmocka_unit_test(test_nothing_to_compare_is_invalid),
        cmocka_unit_test(test_small_errors_survive_beside_large_ones),
        cmocka_unit_test(test_percentile_is_that_of_a_full_sort),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
