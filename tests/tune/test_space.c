#include "game/techniques.h"
#include "game/tune/goal.h"
#include "game/tune/space.h"
#include "game/tune/trial.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static nook_tune_space make_space(void)
{
    nook_tune_space space = { .technique_count = 0 };
    size_t count;
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    for (size_t i = 0; i < count; i++) {
        if (!techniques[i]->exact)
            nook_tune_space_add(&space, techniques[i]);
    }
    return space;
}

static void test_the_initial_point_is_the_technique_as_it_comes(void **state)
{
    (void)state;
    nook_tune_space space = make_space();
    for (uint32_t i = 0; i < space.technique_count; i++) {
        nook_tune_point point = nook_tune_initial(&space, i);
        nook_setting setting = nook_tune_setting(&space, &point);
        assert_int_equal(setting.param_count, 0);
        assert_true(setting.technique == space.techniques[i].technique);
    }
}

static void test_rungs_of_counts_go_up_and_are_values_of_their_parameter(void **state)
{
    (void)state;
    nook_tune_space space = make_space();
    int counts = 0;
    for (uint32_t t = 0; t < space.technique_count; t++) {
        const nook_tune_ladders *ladders = &space.techniques[t];
        for (uint32_t i = 0; i < ladders->axis_count; i++) {
            const nook_tune_axis *axis = &ladders->axes[i];
            assert_true(axis->rung_count >= 2 && axis->initial < axis->rung_count);
            const nook_param *param =
                nook_param_find(ladders->technique->params, ladders->technique->param_count, axis->name);
            for (uint32_t k = 1; param && k < axis->rung_count; k++, counts++)
                assert_true(atof(axis->rungs[k]) > atof(axis->rungs[k - 1]));
            if (param)
                assert_true(atof(axis->rungs[axis->initial]) == param->initial);
        }
    }
    assert_true(counts > 20);
}

static void test_every_rung_is_another_setting(void **state)
{
    (void)state;
    nook_tune_space space = make_space();
    for (uint32_t t = 0; t < space.technique_count; t++) {
        for (uint32_t i = 0; i < space.techniques[t].axis_count; i++) {
            char before[NOOK_SETTING_TEXT_MAX] = "", text[NOOK_SETTING_TEXT_MAX];
            nook_tune_point point = nook_tune_initial(&space, t);
            point.rungs[i] = 0;
            do {
                nook_setting setting = nook_tune_setting(&space, &point);
                assert_string_not_equal(nook_setting_print(&setting, text), before);
                memcpy(before, text, sizeof before);
            } while (nook_tune_step(&space, &point, i, 1));
            assert_int_equal(point.rungs[i], space.techniques[t].axes[i].rung_count - 1);
        }
    }
}

static void test_steps_beyond_a_ladder_are_refused(void **state)
{
    (void)state;
    nook_tune_space space = make_space();
    nook_tune_point point = nook_tune_initial(&space, 0), before = point;
    assert_false(nook_tune_step(&space, &point, 0, 100));
    assert_false(nook_tune_step(&space, &point, 0, -100));
    assert_true(nook_tune_same(&point, &before));
    assert_true(nook_tune_step(&space, &point, 0, 1));
    assert_false(nook_tune_same(&point, &before));
}

static void test_the_size_is_the_product_of_the_ladders(void **state)
{
    (void)state;
    nook_tune_space space = { .technique_count = 0 };
    nook_tune_space_add(&space, nook_technique_find("ssao"));
    double product = 1.0;
    for (uint32_t i = 0; i < space.techniques[0].axis_count; i++)
        product *= space.techniques[0].axes[i].rung_count;
    assert_true(nook_tune_space_size(&space) == product);
    nook_tune_space_add(&space, nook_technique_find("ssao"));
    assert_true(nook_tune_space_size(&space) == 2.0 * product);
}

static void test_what_fits_is_better_than_what_does_not(void **state)
{
    (void)state;
    const nook_tune_goal by_error = { .max_error = 0.1 }, by_ms = { .max_ms = 10.0 }, both = { 0.1, 10.0 };
    const nook_tune_cost fine = { 0.05, 50.0 }, cheap = { 0.099, 5.0 }, coarse = { 0.3, 1.0 }, dear = { 0.09, 9.0 };
    assert_true(nook_tune_better(&by_error, &cheap, &fine));
    assert_true(nook_tune_better(&by_error, &fine, &coarse));
    assert_true(nook_tune_better(&by_ms, &cheap, &fine));
    assert_true(nook_tune_better(&by_ms, &dear, &cheap)); /* more accurate, and there is time for it */
    assert_true(nook_tune_better(&both, &dear, &cheap));
    assert_true(nook_tune_better(&both, &cheap, &fine));
    assert_false(nook_tune_fits(&both, &fine) || nook_tune_fits(&both, &coarse));
    assert_true(nook_tune_fits(&both, &cheap));
    assert_false(nook_tune_better(&both, &cheap, &cheap));
}

static void test_of_two_that_do_not_fit_the_nearer_is_better(void **state)
{
    (void)state;
    const nook_tune_goal goal = { 0.1, 10.0 };
    const nook_tune_cost a = { 0.2, 5.0 }, b = { 0.15, 12.0 }, c = { 0.05, 80.0 };
    assert_true(fabs(nook_tune_excess(&goal, &a) - log(2.0)) < 1e-12);
    assert_true(fabs(nook_tune_excess(&goal, &b) - log(1.5) - log(1.2)) < 1e-12);
    assert_true(nook_tune_better(&goal, &b, &a));
    assert_true(nook_tune_better(&goal, &a, &c));
}

static void test_views_are_pooled_over_their_pixels(void **state)
{
    (void)state;
    const nook_tune_view views[] = { { 0.01, 100.0, 4.0, 1.0, 0.02 },
                                     { 0.04, 300.0, NAN, NAN, 0.01 },
                                     { 0.09, 100.0, 8.0, 2.0, 0.03 } };
    nook_tune_estimate estimate = nook_tune_pool(views, 3);
    assert_true(fabs(estimate.cost.error - sqrt((1.0 + 12.0 + 9.0) / 500.0)) < 1e-12);
    assert_true(fabs(estimate.cost.ms - 6.0) < 1e-12);
    assert_true(fabs(estimate.ms_standard - 2.0) < 1e-12); /* 4 and 8: a deviation of sqrt 8, of two */
    assert_true(fabs(estimate.ms_spread - 1.5) < 1e-12);
    assert_true(fabs(estimate.noise - sqrt((0.04 + 0.03 + 0.09) / 500.0)) < 1e-12);
    assert_int_equal(estimate.views, 3);
    assert_true(isnan(nook_tune_pool(views, 1).error_standard));
    const nook_tune_view alike[] = { { 0.01, 100.0, 4.0, 0.0, 0.0 }, { 0.01, 900.0, 4.0, 0.0, 0.0 } };
    assert_true(nook_tune_pool(alike, 2).error_standard == 0.0);
}

/* Where the truth's noise is about all there is, half of the views come out negative. */
static void test_errors_below_the_truths_noise_cancel_before_they_are_cut_off(void **state)
{
    (void)state;
    const nook_tune_view views[] = { { .squared = 0.0004, .pixels = 100.0, .ms = 1.0 },
                                     { .squared = -0.0002, .pixels = 100.0, .ms = 1.0 } };
    assert_true(fabs(nook_tune_pool(views, 2).cost.error - 0.01) < 1e-12);
    nook_tune_estimate nothing = nook_tune_pool(&views[1], 1);
    assert_true(nothing.cost.error == 0.0);
    const nook_tune_goal goal = { .max_error = 0.1 }, by_ms = { .max_ms = 10.0 };
    assert_true(nook_tune_excess(&goal, &nothing.cost) == 0.0);
    assert_true(isfinite(nook_tune_log_ratio(0.0, 0.0)) && isfinite(nook_tune_log_ratio(0.1, 0.0)));
    const nook_tune_cost some = { 0.01, 1.0 };
    assert_true(nook_tune_better(&by_ms, &nothing.cost, &some));
    assert_true(isinf(nook_tune_views_needed(&nothing, 0.15)));
}

static void test_the_budget_is_held_against_one_standard_error_more(void **state)
{
    (void)state;
    const nook_tune_estimate estimate = { .cost = { 0.095, 9.5 }, .error_standard = 0.006, .ms_standard = 0.6 };
    const nook_tune_goal by_error = { .max_error = 0.1 }, by_ms = { .max_ms = 10.0 }, loose = { 0.102, 10.2 };
    nook_tune_cost error = nook_tune_with_margin(&by_error, &estimate), ms = nook_tune_with_margin(&by_ms, &estimate);
    assert_true(nook_tune_fits(&by_error, &estimate.cost) && !nook_tune_fits(&by_error, &error));
    assert_true(nook_tune_fits(&by_ms, &estimate.cost) && !nook_tune_fits(&by_ms, &ms));
    assert_true(error.ms == 9.5 && ms.error == 0.095); /* what is not limited is as it is */
    nook_tune_cost both = nook_tune_with_margin(&loose, &estimate);
    assert_true(nook_tune_fits(&loose, &both));
}

static double chance(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) / 16777216.0;
}

/* The stated standard error against how the error of random sets of views really scatters. */
static void test_the_standard_error_is_what_it_says(void **state)
{
    (void)state;
    enum { SETS = 4000, VIEWS = 20 };
    uint32_t seed = 7;
    double sum = 0.0, squares = 0.0, stated = 0.0;
    for (int i = 0; i < SETS; i++) {
        nook_tune_view views[VIEWS];
        for (int k = 0; k < VIEWS; k++) {
            double squared = 0.01 * (0.4 + 1.2 * chance(&seed));
            views[k] = (nook_tune_view){ .squared = squared, .pixels = 500.0 + 1000.0 * chance(&seed), .ms = 1.0 };
        }
        nook_tune_estimate estimate = nook_tune_pool(views, VIEWS);
        sum += estimate.cost.error;
        squares += estimate.cost.error * estimate.cost.error;
        stated += estimate.error_standard;
    }
    double mean = sum / SETS, scatter = sqrt(squares / SETS - mean * mean);
    print_message("stated %.3g, scatter %.3g\n", stated / SETS, scatter);
    assert_true(fabs(stated / SETS / scatter - 1.0) < 0.1);
}

static void test_the_number_of_views_follows_from_their_spread(void **state)
{
    (void)state;
    /* 8 views give 5 % standard error, so one view 14 %; two sets of n: 3 sqrt(2 / n) 14 % = 15 % */
    nook_tune_estimate estimate = { .cost = { 0.1, 1.0 }, .error_standard = 0.005, .views = 8 };
    double plain = nook_tune_views_needed(&estimate, 0.15);
    assert_true(fabs(plain - 18.0 * 8.0 * 0.0025 / 0.0225) < 1e-9);
    /* Of Student's distribution of 7 degrees as much lies beyond 4.530 as of the normal one beyond 3. */
    double surely = nook_tune_views_needed_surely(&estimate, 0.15);
    assert_true(fabs(surely / plain / pow(4.530 / 3.0, 2.0) - 1.0) < 0.01);
    /* Many views know their own spread. */
    estimate.views = 1000000;
    assert_true(nook_tune_views_needed_surely(&estimate, 0.15) / nook_tune_views_needed(&estimate, 0.15) - 1.0 < 1e-5);
    estimate.views = 1;
    assert_true(isinf(nook_tune_views_needed(&estimate, 0.15)));
    assert_true(isinf(nook_tune_views_needed_surely(&estimate, 0.15)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_initial_point_is_the_technique_as_it_comes),
        cmocka_unit_test(test_rungs_of_counts_go_up_and_are_values_of_their_parameter),
        cmocka_unit_test(test_every_rung_is_another_setting),
        cmocka_unit_test(test_steps_beyond_a_ladder_are_refused),
        cmocka_unit_test(test_the_size_is_the_product_of_the_ladders),
        cmocka_unit_test(test_what_fits_is_better_than_what_does_not),
        cmocka_unit_test(test_of_two_that_do_not_fit_the_nearer_is_better),
        cmocka_unit_test(test_views_are_pooled_over_their_pixels),
        cmocka_unit_test(test_errors_below_the_truths_noise_cancel_before_they_are_cut_off),
        cmocka_unit_test(test_the_budget_is_held_against_one_standard_error_more),
        cmocka_unit_test(test_the_standard_error_is_what_it_says),
        cmocka_unit_test(test_the_number_of_views_follows_from_their_spread),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
