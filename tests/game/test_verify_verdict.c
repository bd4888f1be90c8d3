/* What verify makes of a measured number. */
#include "game/techniques.h"
#include "game/verify/claims.h"
#include "game/verify/scene.h"
#include "game/verify/verify_run.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const nook_verify_check good = { .expected = 0.5, .measured = 0.51, .tolerance = 0.02, .claimed = true };

static nook_verdict judge(double expected, double measured, double missing, bool claimed)
{
    nook_verify_check check = good;
    check.expected = expected, check.measured = measured, check.missing = missing, check.claimed = claimed;
    return nook_verify_judge(&check);
}

static void test_verdict_is_off_when_the_expectation_is_wrong(void **state)
{
    (void)state;
    assert_int_equal(nook_verify_judge(&good), NOOK_VERDICT_OK);
    assert_int_equal(judge(0.5, 0.5199, 0.0, true), NOOK_VERDICT_OK);
    assert_int_equal(judge(0.7071, 0.51, 0.0, true),
                     NOOK_VERDICT_OFF); /* a pit by hbao's formula, measured by another's */
    assert_int_equal(judge(0.5, 0.47, 0.0, true), NOOK_VERDICT_OFF);
}

static void test_verdict_of_what_is_no_number_is_never_ok(void **state)
{
    (void)state;
    assert_int_equal(judge(0.5, NAN, 0.0, true), NOOK_VERDICT_OFF);
    assert_int_equal(judge(NAN, 0.5, 0.0, true), NOOK_VERDICT_OFF);
    assert_int_equal(judge(0.5, 0.5, NAN, true), NOOK_VERDICT_UNSEEN);
}

static void test_a_mean_that_is_right_where_no_pixel_is_is_off(void **state)
{
    (void)state;
    nook_verify_check check = good;
    check.measured = check.expected, check.spread_max = 0.02, check.spread = 0.0199;
    assert_int_equal(nook_verify_judge(&check), NOOK_VERDICT_OK);
    check.spread = 0.0201;
    assert_int_equal(nook_verify_judge(&check), NOOK_VERDICT_OFF);
    check.spread = NAN;
    assert_int_equal(nook_verify_judge(&check), NOOK_VERDICT_OFF);
}

static void test_pixels_scatter_by_the_tolerance_and_by_what_independent_samples_do(void **state)
{
    (void)state;
    assert_true(fabs(nook_verify_spread_max(0.02, 0.5, 0.0) - 0.02) < 1e-12);
    assert_true(fabs(nook_verify_spread_max(0.0, 0.5, 16.0) - 0.125) < 1e-12); /* tosses of a coin */
    assert_true(fabs(nook_verify_spread_max(0.03, 0.2, 16.0) - sqrt(0.0009 + 0.01)) < 1e-12);
    assert_true(nook_verify_spread_max(0.01, 1.0, 1.0) == 0.01);
}

static void test_verdict_is_unresolved_by_the_picture_and_not_by_the_number(void **state)
{
    (void)state;
    nook_verify_check check = good;
    for (double measured = 0.0; measured < 1.0; measured += 0.25) {
        check.measured = measured, check.unresolved = NOOK_VERIFY_UNRESOLVED_MAX + 0.001;
        assert_int_equal(nook_verify_judge(&check), NOOK_VERDICT_UNRESOLVED);
        check.unresolved = NOOK_VERIFY_UNRESOLVED_MAX - 0.001;
        assert_int_equal(nook_verify_judge(&check), measured == 0.5 ? NOOK_VERDICT_OK : NOOK_VERDICT_OFF);
    }
    check.unresolved = 0.5, check.claimed = false;
    assert_int_equal(nook_verify_judge(&check), NOOK_VERDICT_UNRESOLVED);
    check.missing = 0.5;
    assert_int_equal(nook_verify_judge(&check), NOOK_VERDICT_UNSEEN);
    assert_string_equal(nook_verdict_name(NOOK_VERDICT_UNRESOLVED), "unresolved");
}

static void test_tallies_tell_what_is_judged_from_what_comes(void **state)
{
    (void)state;
    nook_verify_rows rows = { 0 };
    nook_verify_tally tallies[2];
    nook_verify_row row = { .number = 10, .fixture = "pit", .technique = "volume", .check = good, .initial = 0.4 };
    row.check.spread = 0.03, row.check.spread_max = 0.1;
    assert_int_equal(nook_verify_rows_add(&rows, &row), NOOK_OK); /* error +.01, initially -.1 */
    row.fixture = "wall", row.check.measured = 0.488, row.initial = 0.5, row.check.spread = 0.04;
    assert_int_equal(nook_verify_rows_add(&rows, &row), NOOK_OK); /* -.012, 0 */
    row.technique = "gtao", row.check.missing = 0.5;
    assert_int_equal(nook_verify_rows_add(&rows, &row), NOOK_OK); /* no check */
    assert_int_equal(nook_verify_tally_techniques(&rows, tallies, 2), 1);
    assert_int_equal(tallies[0].checks, 2);
    assert_true(fabs(tallies[0].bias + 0.001) < 1e-12 && fabs(tallies[0].rmse - sqrt(0.000122)) < 1e-12);
    assert_true(fabs(tallies[0].initial_bias + 0.05) < 1e-12);
    assert_true(fabs(tallies[0].initial_rmse - sqrt(0.005)) < 1e-12);
    assert_true(fabs(tallies[0].spread - sqrt(0.00125)) < 1e-12);
    assert_true(fabs(tallies[0].largest + 0.012) < 1e-12);
    assert_string_equal(tallies[0].where, "wall");
    nook_verify_rows_free(&rows);
}

static void test_verdict_says_unseen_before_not_claimed_before_ok(void **state)
{
    (void)state;
    assert_int_equal(judge(0.5, 0.5, 0.2, true), NOOK_VERDICT_UNSEEN);
    assert_int_equal(judge(0.5, 0.5, 0.2, false), NOOK_VERDICT_UNSEEN);
    assert_int_equal(judge(0.5, 0.5, 0.0, false), NOOK_VERDICT_NOT_CLAIMED);
    assert_int_equal(judge(0.5, 0.5, 0.009, true), NOOK_VERDICT_OK);
}

static void test_summary_counts_verdicts_and_finds_the_row_nearest_to_its_bound(void **state)
{
    (void)state;
    nook_verify_rows rows = { 0 };
    nook_verify_row row = { .fixture = "first", .check = good };
    assert_int_equal(nook_verify_rows_add(&rows, &row), NOOK_OK);
    row.fixture = "second", row.check.measured = 0.485, row.check.tolerance = 0.1;
    assert_int_equal(nook_verify_rows_add(&rows, &row), NOOK_OK);
    row.check.missing = 0.5;
    assert_int_equal(nook_verify_rows_add(&rows, &row), NOOK_OK);
    nook_verify_summary sum = nook_verify_summarize(&rows);
    assert_int_equal(sum.checks, 2);
    assert_int_equal(sum.verdicts[NOOK_VERDICT_OK], 2);
    assert_int_equal(sum.verdicts[NOOK_VERDICT_UNSEEN], 1);
    assert_string_equal(sum.worst->fixture, "first");
    assert_true(fabs(sum.largest_error - 0.015) < 1e-12);
    row.check = good, row.outside = 1; /* one visibility that is none makes any number worthless */
    assert_int_equal(nook_verify_rows_add(&rows, &row), NOOK_OK);
    sum = nook_verify_summarize(&rows);
    assert_int_equal(sum.verdicts[NOOK_VERDICT_OFF], 1);
    assert_int_equal(sum.outside, 1);
    nook_verify_rows_free(&rows);
}

static void test_every_technique_has_a_claim_whose_settings_can_be_read(void **state)
{
    (void)state;
    size_t count;
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    for (size_t i = 0; i < count; i++) {
        const nook_verify_claim *claim = nook_verify_claim_of(techniques[i]->name);
        nook_setting setting;
        assert_non_null(claim);
        assert_int_equal(nook_setting_parse("claim", claim->settings, &setting), NOOK_OK);
        assert_ptr_equal(setting.technique, techniques[i]);
    }
    assert_null(nook_verify_claim_of("nonsense"));
}

static void test_exceptions_name_fixtures_that_there_are(void **state)
{
    (void)state;
    size_t fixture_count, technique_count, found = 0;
    const nook_verify_fixture *fixtures = nook_verify_fixtures(&fixture_count);
    const nook_ao_technique *const *techniques = nook_techniques(&technique_count);
    for (size_t i = 0; i < fixture_count; i++) {
        for (size_t k = 0; k < technique_count; k++) {
            const nook_verify_exception *e = nook_verify_exception_for(techniques[k]->name, fixtures[i].name, "");
            if (!e)
                continue;
            nook_setting setting;
            found++;
            assert_true(strlen(e->reason) > 10);
            if (e->settings)
                assert_int_equal(nook_setting_parse("exception", e->settings, &setting), NOOK_OK);
        }
    }
    assert_true(found >= 3);
    assert_null(nook_verify_exception_for("volume", "ceiling", ""));
}

static void test_choices_refuse_what_there_is_not(void **state)
{
    (void)state;
    char storage[64];
    nook_log_capture log;
    nook_verify_desc desc = { 0 };
    nook_log_capture_begin(&log);
    assert_int_equal(nook_verify_choose_techniques("volume,nonsense", &desc), NOOK_E_NOT_FOUND);
    assert_int_equal(nook_verify_choose_fixtures("pit,21", &desc, storage, sizeof storage), NOOK_E_NOT_FOUND);
    assert_non_null(strstr(log.text, "upright_rectangle"));
    nook_log_capture_end();
    desc = (nook_verify_desc){ 0 };
    assert_int_equal(nook_verify_choose_techniques("filter,hsao,hsao", &desc), NOOK_OK);
    assert_true(desc.filter && desc.technique_count == 1);
    assert_int_equal(nook_verify_choose_fixtures("pit,4", &desc, storage, sizeof storage), NOOK_OK);
    assert_true(nook_verify_wants(&desc, 10, "pit") && nook_verify_wants(&desc, 4, "ceiling"));
    assert_false(nook_verify_wants(&desc, 5, "wall"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_verdict_is_off_when_the_expectation_is_wrong),
        cmocka_unit_test(test_verdict_of_what_is_no_number_is_never_ok),
        cmocka_unit_test(test_a_mean_that_is_right_where_no_pixel_is_is_off),
        cmocka_unit_test(test_pixels_scatter_by_the_tolerance_and_by_what_independent_samples_do),
        cmocka_unit_test(test_verdict_is_unresolved_by_the_picture_and_not_by_the_number),
        cmocka_unit_test(test_tallies_tell_what_is_judged_from_what_comes),
        cmocka_unit_test(test_verdict_says_unseen_before_not_claimed_before_ok),
        cmocka_unit_test(test_summary_counts_verdicts_and_finds_the_row_nearest_to_its_bound),
        cmocka_unit_test(test_every_technique_has_a_claim_whose_settings_can_be_read),
        cmocka_unit_test(test_exceptions_name_fixtures_that_there_are),
        cmocka_unit_test(test_choices_refuse_what_there_is_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
