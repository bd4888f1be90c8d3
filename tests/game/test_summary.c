#include "game/measure/sample_columns.h"
#include "game/measure/summary.h"
#include "tests/support/results_fixture.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const char *const two_scenes[] = { "hall", "crypt" };

/* ---- fronts ---- */

static void test_front_holds_what_no_other_beats_in_both(void **state)
{
    (void)state;
    const double costs[] = { 3.0, 1.0, 2.0, 2.0, 4.0, 0.5, NAN, 5.0 };
    const double errors[] = { 0.2, 0.5, 0.4, 0.3, 0.2, NAN, 0.0, 0.1 };
    bool on_front[8];
    assert_int_equal(nook_front_mark(costs, errors, 8, on_front), NOOK_OK);
    const bool expected[] = { true, true, false, true, false, false, false, true };
    assert_memory_equal(on_front, expected, sizeof expected);
}

static void test_equal_points_are_on_the_front_together(void **state)
{
    (void)state;
    const double costs[] = { 1.0, 1.0, 1.0 }, errors[] = { 0.5, 0.5, 0.6 };
    bool on_front[3];
    assert_int_equal(nook_front_mark(costs, errors, 3, on_front), NOOK_OK);
    assert_true(on_front[0] && on_front[1] && !on_front[2]);
    assert_int_equal(nook_front_mark(costs, errors, 0, on_front), NOOK_OK);
}

/* Against the definition, pair by pair. */
static void test_front_agrees_with_its_definition(void **state)
{
    (void)state;
    enum { COUNT = 200 };
    double costs[COUNT], errors[COUNT];
    bool on_front[COUNT];
    uint32_t seed = 7;
    for (int i = 0; i < COUNT; i++) {
        costs[i] = (seed = seed * 1664525u + 1013904223u) >> 26; /* few values: many are equal */
        errors[i] = (seed = seed * 1664525u + 1013904223u) >> 26;
    }
    assert_int_equal(nook_front_mark(costs, errors, COUNT, on_front), NOOK_OK);
    for (int i = 0; i < COUNT; i++) {
        bool beaten = false;
        for (int j = 0; j < COUNT; j++)
            beaten |= costs[j] <= costs[i] && errors[j] <= errors[i] && (costs[j] < costs[i] || errors[j] < errors[i]);
        assert_int_equal(on_front[i], !beaten);
    }
}

/* ---- over cameras ---- */

static void test_numbers_go_over_cameras_as_their_kind_asks(void **state)
{
    (void)state;
    const double values[] = { 1.0, NAN, -7.0 };
    assert_true(nook_over_cameras_of(NOOK_OVER_MEAN, values, 3) == -3.0);
    assert_true(nook_over_cameras_of(NOOK_OVER_RMS, values, 3) == 5.0);
    assert_true(nook_over_cameras_of(NOOK_OVER_LARGEST, values, 3) == 1.0);
    assert_true(isnan(nook_over_cameras_of(NOOK_OVER_LARGEST, values + 1, 1)));
    assert_true(isnan(nook_over_cameras_of(NOOK_OVER_MEAN, values, 0)));
}

static void test_columns_read_the_sample(void **state)
{
    (void)state;
    const nook_sample sample = {
        .ms_median = 3.0, .truth.rmse = 0.25, .truth.bias = -0.5, .instability.relative = 0.75, .reference_noise = 0.125
    };
    size_t count, found = 0;
    const nook_sample_column *columns = nook_sample_columns(&count);
    for (size_t i = 0; i < count; i++) {
        double value = nook_sample_number(&sample, &columns[i]);
        found += strcmp(columns[i].key, "ms") == 0 && value == 3.0;
        found += strcmp(columns[i].key, "rmse") == 0 && value == 0.25 && columns[i].over == NOOK_OVER_RMS;
        found += strcmp(columns[i].key, "bias") == 0 && value == -0.5 && columns[i].over == NOOK_OVER_MEAN;
        found += strcmp(columns[i].key, "instability_relative") == 0 && value == 0.75;
        found += strcmp(columns[i].key, "reference_noise") == 0 && value == 0.125;
    }
    assert_int_equal(found, 5);
}

static void test_settings_are_summed_up_over_the_cameras_of_their_view(void **state)
{
    (void)state;
    nook_results results = nook_results_fixture_numbers(two_scenes, 2, 3, 4);
    nook_summary summary;
    assert_int_equal(nook_summary_create(&results, &summary), NOOK_OK);
    assert_int_equal(summary.view_count, 2);
    assert_int_equal(summary.row_count, 2 * (3 * 4 + 1));
    const nook_summary_view *view = &summary.views[1];
    assert_string_equal(view->rows[0].row->scene, "hall");
    assert_int_equal(view->row_count, 13);
    assert_int_equal(view->cameras, 3);
    const nook_summary_row *gtao = &view->rows[0]; /* as it comes: first of its technique */
    assert_string_equal(gtao->row->setting, "gtao");
    double squares = 0.0, bias = 0.0, largest = 0.0;
    for (size_t i = 0; i < results.row_count; i++) {
        const nook_result_row *row = &results.rows[i];
        if (strcmp(row->scene, "hall") == 0 && strcmp(row->setting, "gtao") == 0) {
            squares += row->sample.truth.rmse * row->sample.truth.rmse;
            bias += row->sample.truth.bias;
            largest = fmax(largest, row->sample.truth.max);
        }
    }
    assert_true(fabs(gtao->sample.truth.rmse - sqrt(squares / 3.0)) < 1e-12);
    assert_true(fabs(gtao->sample.truth.bias - bias / 3.0) < 1e-12);
    assert_true(gtao->sample.truth.max == largest);
    nook_summary_free(&summary);
    nook_results_free(&results);
}

static const nook_summary_row *find_row(const nook_summary *summary, const char *setting)
{
    for (size_t i = 0; i < summary->row_count; i++) {
        if (strcmp(summary->rows[i].row->setting, setting) == 0)
            return &summary->rows[i];
    }
    return NULL;
}

static void test_truths_and_settings_that_miss_a_camera_are_on_no_front(void **state)
{
    (void)state;
    nook_results results = nook_results_fixture_numbers(two_scenes, 1, 2, 3);
    nook_summary summary;
    const size_t row_count =
        results.row_count; /* the last of technique 2 and the reference's; technique 0 stands first */
    results.rows[1].sample.ms_median = 0.001;
    results.rows[1].sample.truth.rmse = 1e-6; /* best in both, at the first camera */
    results.row_count = row_count / 2 + 1;    /* of the second camera only the first setting */
    assert_int_equal(nook_summary_create(&results, &summary), NOOK_OK);
    assert_int_equal(find_row(&summary, "volume rays=1")->cameras, 1);
    assert_false(find_row(&summary, "volume rays=1")->on_front);
    assert_true(find_row(&summary, "volume")->on_front);
    assert_false(find_row(&summary, "reference sees=screen")->on_front);
    assert_true(nook_summary_on_front(&summary, &results.rows[0]));
    assert_false(nook_summary_on_front(&summary, &results.rows[1]));
    nook_summary_free(&summary);
    results.row_count = row_count;
    assert_int_equal(nook_summary_create(&results, &summary), NOOK_OK);
    assert_int_equal(find_row(&summary, "volume rays=1")->cameras, 2);
    assert_true(find_row(&summary, "volume rays=1")->on_front);
    nook_summary_free(&summary);
    nook_results_free(&results);
}

static void test_noise_of_the_truth_stands_beside_the_smallest_error(void **state)
{
    (void)state;
    nook_results results = nook_results_fixture_numbers(two_scenes, 1, 2, 3);
    nook_summary summary;
    results.rows[1].sample.truth.rmse = 0.001;
    results.rows[1].sample.reference_noise = 0.0625;
    results.rows[9].sample.truth.rmse = 0.0; /* the reference's own */
    assert_string_equal(results.rows[9].technique, NOOK_SUMMARY_REFERENCE);
    assert_int_equal(nook_summary_create(&results, &summary), NOOK_OK);
    assert_true(summary.views[0].largest_noise == 0.0625);
    assert_true(summary.views[0].smallest_rmse == 0.001);
    nook_summary_free(&summary);
    nook_results_free(&results);
}

/* Times of one machine say nothing about another's, nor those of one build about another's. */
static void test_machines_and_builds_have_fronts_of_their_own(void **state)
{
    (void)state;
    nook_results results = nook_results_fixture_numbers(two_scenes, 1, 1, 4);
    nook_summary summary;
    nook_result_row *fast = &results.rows[0], *other = &results.rows[1];
    fast->sample.ms_median = 1e-3; /* would beat all the others */
    fast->sample.truth.rmse = 1e-6;
    fast->machine[0] = 'L';
    assert_int_equal(nook_summary_create(&results, &summary), NOOK_OK);
    assert_int_equal(summary.view_count, 2);
    assert_int_equal(summary.views[0].row_count, 1);
    assert_true(nook_summary_on_front(&summary, fast));
    size_t on_front = 0;
    for (size_t i = 0; i < summary.views[1].row_count; i++)
        on_front += summary.views[1].rows[i].on_front;
    assert_true(on_front > 0);
    nook_summary_free(&summary);
    other->build[0] = '7';
    assert_int_equal(nook_summary_create(&results, &summary), NOOK_OK);
    assert_int_equal(summary.view_count, 3);
    nook_summary_free(&summary);
    nook_results_free(&results);
}

static void test_nothing_measured_is_no_view(void **state)
{
    (void)state;
    nook_summary summary;
    assert_int_equal(nook_summary_create(&(nook_results){ 0 }, &summary), NOOK_OK);
    assert_int_equal(summary.view_count, 0);
    nook_summary_free(&summary);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_front_holds_what_no_other_beats_in_both),
        cmocka_unit_test(test_equal_points_are_on_the_front_together),
        cmocka_unit_test(test_front_agrees_with_its_definition),
        cmocka_unit_test(test_numbers_go_over_cameras_as_their_kind_asks),
        cmocka_unit_test(test_columns_read_the_sample),
        cmocka_unit_test(test_settings_are_summed_up_over_the_cameras_of_their_view),
        cmocka_unit_test(test_truths_and_settings_that_miss_a_camera_are_on_no_front),
        cmocka_unit_test(test_noise_of_the_truth_stands_beside_the_smallest_error),
        cmocka_unit_test(test_machines_and_builds_have_fronts_of_their_own),
        cmocka_unit_test(test_nothing_measured_is_no_view),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
