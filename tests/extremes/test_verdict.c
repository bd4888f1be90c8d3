/* What a case's numbers mean: what holds, what does not, and that a run says so. */
#include "game/extremes/extreme_report.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_gpu.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static void test_what_is_within_its_bound_holds(void **state)
{
    (void)state;
    assert_true(nook_extreme_holds(&(nook_extreme_found){ .measured = 0.5, .bound = 0.5, .where = "here" }));
    assert_true(nook_extreme_holds(&(nook_extreme_found){ .measured = 0.0, .bound = 0.0, .checked = 1 }));
}

static void test_what_looked_at_nothing_does_not_hold(void **state)
{
    (void)state;
    assert_false(nook_extreme_holds(&(nook_extreme_found){ .measured = 0.0, .bound = 0.0 }));
    assert_false(nook_extreme_holds(&(nook_extreme_found){ .measured = 0.0, .bound = 1.0 }));
}

static void test_more_than_the_bound_does_not_hold(void **state)
{
    (void)state;
    assert_false(
        nook_extreme_holds(&(nook_extreme_found){ .measured = nextafter(0.5, 1.0), .bound = 0.5, .where = "here" }));
    assert_false(nook_extreme_holds(&(nook_extreme_found){ .measured = INFINITY, .bound = 1e300, .where = "here" }));
}

static void test_nan_does_not_hold(void **state)
{
    (void)state;
    assert_false(nook_extreme_holds(&(nook_extreme_found){ .measured = NAN, .bound = 0.5, .where = "here" }));
    assert_false(nook_extreme_holds(&(nook_extreme_found){ .measured = 0.0, .bound = NAN, .where = "here" }));
}

static void test_one_visibility_outside_does_not_hold(void **state)
{
    (void)state;
    assert_false(
        nook_extreme_holds(&(nook_extreme_found){ .measured = 0.0, .bound = 1.0, .outside = 1, .where = "here" }));
}

static void test_a_stated_number_holds_within_its_tolerance_and_else_nothing_does(void **state)
{
    (void)state;
    nook_extreme_found found = { .bound = 1.0, .where = "here" };
    nook_extreme_state(&found, 0.6, 0.01, 0.609, "A with %d voxels", 2);
    assert_string_equal(found.stated[0].what, "A with 2 voxels");
    assert_true(nook_extreme_holds(&found));
    nook_extreme_state(&found, 0.6, 0.01, 0.589, "too low");
    assert_false(nook_extreme_holds(&found));
    found.stated_count = 1;
    nook_extreme_state(&found, 0.6, 0.01, NAN, "not measured");
    assert_false(nook_extreme_holds(&found));
}

static void test_worst_keeps_the_largest_and_its_place(void **state)
{
    (void)state;
    nook_extreme_found found = { 0 };
    nook_extreme_worst(&found, 0.0, "the first");
    assert_string_equal(found.where, "the first"); /* also when it is no worse than 0 */
    nook_extreme_worst(&found, 2.0, "number %d", 2);
    nook_extreme_worst(&found, 1.0, "after it");
    assert_float_equal(found.measured, 2.0, 0.0);
    assert_string_equal(found.where, "number 2");
}

static void test_worst_keeps_nan_whatever_comes_after(void **state)
{
    (void)state;
    nook_extreme_found found = { .bound = 1e9 };
    nook_extreme_worst(&found, 1.0, "a number");
    nook_extreme_worst(&found, NAN, "none");
    nook_extreme_worst(&found, 5.0, "a number again");
    assert_true(isnan(found.measured));
    assert_string_equal(found.where, "none");
    assert_false(nook_extreme_holds(&found));
}

static void test_check_counts_what_is_no_visibility(void **state)
{
    (void)state;
    const float good[] = { 0.0f, 1.0f, 0.5f }, bad[] = { NAN, -1e-7f, 1.0000001f, INFINITY, 0.5f };
    nook_extreme_found found = { .bound = 1.0 };
    nook_extreme_check(&found, good, NOOK_COUNT(good), "good");
    assert_true(nook_extreme_holds(&found));
    nook_extreme_check(&found, bad, NOOK_COUNT(bad), "%s", "bad");
    nook_extreme_check(&found, bad, NOOK_COUNT(bad), "bad again");
    nook_extreme_worst(&found, 0.5, "elsewhere");
    assert_int_equal(found.outside, 8);
    assert_int_equal(found.checked, 13);
    assert_string_equal(found.where, "bad"); /* the graver place stays */
    assert_false(nook_extreme_holds(&found));
}

/* ---- Running made-up cases ---- */

static nook_result hold(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    (void)extremes;
    out_found->checked = 10;
    return NOOK_OK;
}

static nook_result exceed(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    (void)extremes;
    nook_extreme_worst(out_found, 3.0, "here");
    out_found->bound = 2.0;
    return NOOK_OK;
}

static nook_result break_down(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    (void)extremes, (void)out_found;
    return NOOK_E_MEMORY;
}

static nook_result misuse_gl(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    (void)out_found;
    extremes->gpu->gl->Enable(0xffffu);
    return NOOK_OK;
}

static nook_result state_wrongly(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    nook_extreme_state(out_found, 2.0, 0.5, 3.0, "what is stated");
    return hold(extremes, out_found);
}

static const nook_extreme made_up[] = {
    { .name = "holds", .unit = "units", .why = "because", .run = hold },
    { .name = "exceeds", .unit = "units", .why = "because", .limit = "up to 2", .run = exceed },
    { .name = "breaks down", .unit = "units", .why = "because", .run = break_down },
    { .name = "misuses GL", .unit = "units", .why = "because", .run = misuse_gl },
    { .name = "states nothing", .unit = "units", .why = "because", .limit = "up to 3", .run = hold },
    { .name = "states wrongly", .unit = "units", .why = "because", .limit = "up to 4", .run = state_wrongly },
};
static const nook_extreme_group group = { .name = "made up", .cases = made_up, .count = NOOK_COUNT(made_up) };

static void run_made_up(void **state, nook_extreme_row rows[NOOK_COUNT(made_up)])
{
    const nook_extremes extremes = { .gpu = test_gpu_of(state) };
    nook_log_capture capture;
    nook_log_capture_begin(&capture);
    for (size_t i = 0; i < NOOK_COUNT(made_up); i++)
        nook_extreme_run(&extremes, &group, &made_up[i], &rows[i]);
    nook_log_capture_end();
    assert_true(capture.errors > 0); /* the GL error is named */
}

static void test_only_what_ran_within_its_bound_without_a_gl_error_holds(void **state)
{
    nook_extreme_row rows[NOOK_COUNT(made_up)];
    run_made_up(state, rows);
    assert_true(nook_extreme_row_holds(&rows[0]));
    for (size_t i = 1; i < NOOK_COUNT(made_up); i++)
        assert_false(nook_extreme_row_holds(&rows[i]));
    assert_int_equal(rows[2].result, NOOK_E_MEMORY);
    assert_int_equal(rows[3].result, NOOK_E_DEVICE);
    nook_extreme_summary sum = nook_extreme_summarize(&(nook_extreme_rows){ rows, NOOK_COUNT(made_up) });
    assert_int_equal(sum.cases, 6);
    assert_int_equal(sum.groups, 1);
    assert_int_equal(sum.holding, 1);
    assert_int_equal(sum.failing, 5);
    assert_int_equal(sum.limits, 3);
    assert_int_equal(sum.checked, 30);
}

static void test_reports_name_each_verdict(void **state)
{
    static const char *const verdicts[] = { "holds", "FAILS", "ERROR", "ERROR", "FAILS", "NOT AS STATED" };
    nook_extreme_row rows[NOOK_COUNT(made_up)];
    run_made_up(state, rows);
    for (size_t i = 0; i < NOOK_COUNT(made_up); i++) {
        char line[1024] = "";
        FILE *stream = fmemopen(line, sizeof line, "w");
        assert_non_null(stream);
        nook_extreme_print_row(stream, &rows[i], false);
        fclose(stream);
        assert_non_null(strstr(line, verdicts[i]));
    }
    nook_json json = { 0 };
    const char *text;
    nook_extreme_write_json(&json, &(nook_extreme_rows){ rows, NOOK_COUNT(made_up) }, "a renderer", true);
    assert_int_equal(nook_json_finish(&json, &text, NULL), NOOK_OK);
    assert_non_null(strstr(text, "\"limit\": \"up to 2\""));
    assert_non_null(strstr(text, "\"failing\": 5"));
    assert_non_null(strstr(text, "\"what\": \"what is stated\""));
    nook_json_free(&json);
}

/* ---- The real ones ---- */

static void test_every_case_says_what_holds_in_which_unit_and_why(void **state)
{
    (void)state;
    size_t count;
    const nook_extreme_group *const *groups = nook_extreme_groups(&count);
    assert_true(count > 0);
    for (size_t i = 0; i < count; i++) {
        assert_true(groups[i]->count > 0);
        for (size_t k = 0; k < groups[i]->count; k++) {
            const nook_extreme *extreme = &groups[i]->cases[k];
            assert_true(extreme->name && extreme->unit && extreme->why && extreme->run);
            if (strlen(extreme->name) > 90 || strlen(extreme->unit) > 22 || strlen(extreme->why) < 20)
                fail_msg("%s: the table has 90 letters for the name, 22 for the unit, and why is a sentence",
                         extreme->name);
        }
    }
}

static void test_only_chooses_by_any_part_of_either_name(void **state)
{
    (void)state;
    assert_true(nook_extreme_matches(&group, &made_up[1], NULL));
    assert_true(nook_extreme_matches(&group, &made_up[1], "MADE"));
    assert_true(nook_extreme_matches(&group, &made_up[1], "ceed"));
    assert_false(nook_extreme_matches(&group, &made_up[1], "holds"));
    assert_int_equal(nook_extreme_count("no case is called so"), 0);
}

static void test_a_groups_whole_name_chooses_its_cases_alone(void **state)
{
    (void)state;
    size_t count, cases = 0;
    const nook_extreme_group *const *groups = nook_extreme_groups(&count);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(nook_extreme_count(groups[i]->name), groups[i]->count);
        cases += groups[i]->count;
    }
    assert_int_equal(nook_extreme_count(NULL), cases);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_within_its_bound_holds),
        cmocka_unit_test(test_what_looked_at_nothing_does_not_hold),
        cmocka_unit_test(test_more_than_the_bound_does_not_hold),
        cmocka_unit_test(test_nan_does_not_hold),
        cmocka_unit_test(test_one_visibility_outside_does_not_hold),
        cmocka_unit_test(test_a_stated_number_holds_within_its_tolerance_and_else_nothing_does),
        cmocka_unit_test(test_worst_keeps_the_largest_and_its_place),
        cmocka_unit_test(test_worst_keeps_nan_whatever_comes_after),
        cmocka_unit_test(test_check_counts_what_is_no_visibility),
        cmocka_unit_test_setup_teardown(test_only_what_ran_within_its_bound_without_a_gl_error_holds, test_gpu_setup,
                                        test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_reports_name_each_verdict, test_gpu_setup, test_gpu_teardown),
        cmocka_unit_test(test_every_case_says_what_holds_in_which_unit_and_why),
        cmocka_unit_test(test_only_chooses_by_any_part_of_either_name),
        cmocka_unit_test(test_a_groups_whole_name_chooses_its_cases_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
