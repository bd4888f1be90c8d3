/* Frames of different index are estimates of one truth that have nothing else to do with each other: they can be averaged. */
#include "modules/measure/noise.h"
#include "tests/support/ao_view.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 64, PIXELS = SIDE * SIDE, SEEDS = 4 };

static int setup(void **state)
{
    nook_fixture_view *view = ao_view_create(SIDE, SIDE);
    ao_view_add_yard(view, 9.0, 0);
    ao_view_param(view, "ao.falloff", "linear");
    ao_view_param(view, "ao.r_max", "3");
    *state = view;
    return 0;
}

static void record(nook_fixture_view *view, const char *rays, uint32_t index, float *out)
{
    ao_view_param(view, "reference.rays", rays);
    view->index = index;
    ao_view_record(view, "reference");
    memcpy(out, view->visibility, PIXELS * sizeof *out);
}

static double rmse(const float *picture, const float *truth)
{
    return ao_view_rmse(picture, truth, PIXELS);
}

static void test_the_mean_of_four_seeds_has_half_the_noise_of_one(void **state)
{
    static float truth[PIXELS], seeds[SEEDS][PIXELS], mean[PIXELS];
    const float *list[SEEDS];
    double one = 0.0;
    record(*state, "1024", 100, truth); /* 16 times the rays */
    for (uint32_t i = 0; i < SEEDS; i++) {
        record(*state, "64", i, seeds[i]);
        list[i] = seeds[i];
        one += rmse(seeds[i], truth) / SEEDS;
        for (size_t k = 0; k < PIXELS; k++)
            mean[k] += seeds[i][k] / SEEDS;
    }
    double four = rmse(mean, truth), noise = nook_noise_measure(list, SEEDS, NULL, PIXELS).rms;
    assert_true(one > 0.001);
    if (fabs(four / one - 0.5) > 0.04)
        fail_msg("RMS against the truth: one seed %.5f, the mean of four %.5f", one, four);
    if (fabs(noise / one - 1.0) > 0.04)
        fail_msg("noise between seeds %.5f, RMS against the truth %.5f", noise, one);
}

static void test_errors_of_two_seeds_have_nothing_in_common(void **state)
{
    static float truth[PIXELS], first[PIXELS], second[PIXELS];
    static const uint32_t pairs[][2] = { { 0, 1 }, { 1, 2 }, { 7, 8 }, { 0, 65536 }, { 1, 0x80000001u } };
    record(*state, "1024", 100, truth);
    for (size_t i = 0; i < NOOK_COUNT(pairs); i++) {
        double product = 0.0, squares[2] = { 0.0, 0.0 };
        record(*state, "64", pairs[i][0], first);
        record(*state, "64", pairs[i][1], second);
        for (size_t k = 0; k < PIXELS; k++) {
            double a = (double)(first[k] - truth[k]), b = (double)(second[k] - truth[k]);
            product += a * b, squares[0] += a * a, squares[1] += b * b;
        }
        double correlation = product / sqrt(squares[0] * squares[1]);
        if (fabs(correlation) > 0.08) /* five deviations of 4096 pixels' */
            fail_msg("seeds %u and %u: correlation %.3f", pairs[i][0], pairs[i][1], correlation);
    }
}

static void test_one_seed_gives_one_picture(void **state)
{
    static float first[PIXELS], second[PIXELS];
    record(*state, "16", 5, first);
    record(*state, "16", 6, second);
    assert_memory_not_equal(first, second, sizeof first);
    ao_view_param(*state, "reference.threads", "1");
    record(*state, "16", 5, second);
    ao_view_param(*state, "reference.threads", "0");
    assert_memory_equal(first, second, sizeof first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_mean_of_four_seeds_has_half_the_noise_of_one),
        cmocka_unit_test(test_errors_of_two_seeds_have_nothing_in_common),
        cmocka_unit_test(test_one_seed_gives_one_picture),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
