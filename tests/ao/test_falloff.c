/* rho(d), in C and in GLSL. */
#include "modules/ao/falloff.h"
#include "modules/ao/frame_block_internal.h"
#include "tests/support/test_gpu.h"
#include <math.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { CHOICES = NOOK_FALLOFF_EXPONENTIAL + 1, STEPS = 1000 };

static const double tau = 3.0;

static double rho(int falloff, double distance, double r_max)
{
    return nook_falloff_evaluate((nook_falloff)falloff, distance, r_max, tau);
}

static void test_falloff_is_one_at_the_surface_and_zero_from_r_max_on(void **state)
{
    (void)state;
    for (int k = 0; k < CHOICES; k++) {
        for (double r_max = 1e-9; r_max < 1e10; r_max *= 1e3) {
            assert_true(rho(k, 0.0, r_max) == 1.0);
            assert_true(rho(k, r_max, r_max) == 0.0);
            assert_true(rho(k, 2.0 * r_max, r_max) == 0.0);
            assert_true(rho(k, INFINITY, r_max) == 0.0);
        }
    }
}

static void test_falloff_never_rises_with_distance(void **state)
{
    (void)state;
    for (int k = 0; k < CHOICES; k++) {
        for (int i = 0; i < STEPS; i++) {
            double near = rho(k, 2.0 * i / STEPS, 2.0), far = rho(k, 2.0 * (i + 1) / STEPS, 2.0);
            assert_true(near >= far && near <= 1.0 && far >= 0.0);
            if (k != NOOK_FALLOFF_HARD)
                assert_true(near > far);
        }
    }
}

static void test_falloff_of_what_is_not_a_number_is_zero(void **state)
{
    (void)state;
    for (int k = 0; k < CHOICES; k++) {
        assert_true(rho(k, NAN, 1.0) == 0.0);
        assert_true(rho(k, 0.5, NAN) == 0.0);
    }
}

static void test_falloff_has_the_values_of_its_formulas(void **state)
{
    (void)state;
    const double k = 0.25;
    assert_true(rho(NOOK_FALLOFF_HARD, 0.5, 2.0) == 1.0);
    assert_true(fabs(rho(NOOK_FALLOFF_LINEAR, 0.5, 2.0) - 0.75) < 1e-15);
    assert_true(fabs(rho(NOOK_FALLOFF_QUADRATIC, 0.5, 2.0) - 0.9375) < 1e-15);
    assert_true(fabs(rho(NOOK_FALLOFF_WENDLAND, 0.5, 2.0) - 0.75 * 0.75 * 0.75 * 0.75 * 2.0) < 1e-15);
    assert_true(fabs(rho(NOOK_FALLOFF_EXPONENTIAL, 0.5, 2.0) - exp(-tau * k)) < 1e-15);
}

/** The shader's values at `distances`, all falling with r_max and one choice. */
static void evaluate_on_gpu(nook_gpu *gpu, int falloff, float r_max, const float *distances, float *values,
                            size_t count)
{
    nook_buffer frame;
    frame_block block = { .r_max = r_max, .falloff = falloff, .falloff_tau = (float)tau };
    assert_int_equal(nook_buffer_create(gpu, &block, sizeof block, &frame), NOOK_OK);
    nook_bind_uniform(gpu, 0, frame);
    test_gpu_map(gpu, "tests/ao/falloff.comp.glsl", distances, sizeof *distances, values, sizeof *values, count);
    nook_buffer_destroy(gpu, &frame);
}

static void test_falloff_in_glsl_agrees_with_c(void **state)
{
    const float ranges[] = { 0.003f, 2.5f, 4e6f };
    for (size_t r = 0; r < NOOK_COUNT(ranges); r++) {
        float distances[STEPS + 3], values[STEPS + 3];
        for (int i = 0; i < STEPS; i++)
            distances[i] = ranges[r] * 1.2f * (float)i / STEPS;
        distances[STEPS] = ranges[r], distances[STEPS + 1] = INFINITY, distances[STEPS + 2] = NAN;
        for (int k = 0; k < CHOICES; k++) {
            evaluate_on_gpu(test_gpu_of(state), k, ranges[r], distances, values, NOOK_COUNT(values));
            for (size_t i = 0; i < NOOK_COUNT(values); i++) {
                double truth = rho(k, distances[i], ranges[r]);
                if (!(fabs(values[i] - truth) <= 1e-5))
                    fail_msg("falloff %d at %g of %g: %.7f in GLSL, %.7f in C", k, distances[i], ranges[r], values[i],
                             truth);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_falloff_is_one_at_the_surface_and_zero_from_r_max_on),
        cmocka_unit_test(test_falloff_never_rises_with_distance),
        cmocka_unit_test(test_falloff_of_what_is_not_a_number_is_zero),
        cmocka_unit_test(test_falloff_has_the_values_of_its_formulas),
        cmocka_unit_test(test_falloff_in_glsl_agrees_with_c),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
