#include "engine/core/param.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#define NOOK_PARAM_STRUCT sample_params
#define NOOK_PARAM_TABLE sample_table
#define NOOK_PARAM_FILE "tests/core/test_params.def"
#include "engine/core/param_block.inl"

enum { ROWS = NOOK_COUNT(sample_table) };

static nook_log_capture logged;

static int begin(void **state)
{
    (void)state;
    nook_log_capture_begin(&logged);
    return 0;
}

static int end(void **state)
{
    (void)state;
    nook_log_capture_end();
    return 0;
}

static sample_params initial_params(void)
{
    sample_params params = { -1, -1, -1 };
    nook_param_reset(sample_table, ROWS, &params);
    return params;
}

static const nook_param *find(const char *name)
{
    const nook_param *param = nook_param_find(sample_table, ROWS, name);
    assert_non_null(param);
    return param;
}

static void test_param_block_makes_the_struct_and_the_table_of_one_file(void **state)
{
    (void)state;
    assert_int_equal(ROWS, 3);
    assert_int_equal(sizeof(sample_params), 12);
    assert_int_equal(find("samples")->offset, offsetof(sample_params, samples));
    assert_int_equal(find("samples")->type, NOOK_PARAM_INT);
    assert_int_equal(find("radius")->unit, NOOK_UNIT_METRE);
    assert_string_equal(find("radius")->help, "reach of the effect");
    assert_string_equal(find("falloff")->choices, "hard|linear|wendland");
    assert_true(find("falloff")->highest == 2);
}

static void test_param_reset_writes_every_initial_value(void **state)
{
    (void)state;
    const sample_params params = initial_params();
    assert_true(params.radius == 0.5f);
    assert_int_equal(params.samples, 16);
    assert_int_equal(params.falloff, 1);
}

static void test_param_find_knows_only_whole_names(void **state)
{
    (void)state;
    assert_null(nook_param_find(sample_table, ROWS, "radiu"));
    assert_null(nook_param_find(sample_table, ROWS, "radius2"));
    assert_null(nook_param_find(sample_table, ROWS, ""));
}

static void test_param_set_accepts_both_ends_of_the_range(void **state)
{
    (void)state;
    sample_params params = initial_params();
    assert_int_equal(nook_param_set(find("samples"), "ssao", &params, 1), NOOK_OK);
    assert_int_equal(params.samples, 1);
    assert_int_equal(nook_param_set(find("samples"), "ssao", &params, 64), NOOK_OK);
    assert_int_equal(params.samples, 64);
    assert_int_equal(nook_param_set(find("radius"), "ssao", &params, 10.0), NOOK_OK);
    assert_true(nook_param_get(find("radius"), &params) == 10.0);
}

static void check_set_refused(const char *name, double value)
{
    sample_params params = initial_params();
    const sample_params before = params;
    assert_int_equal(nook_param_set(find(name), "ssao", &params, value), NOOK_E_RANGE);
    assert_memory_equal(&params, &before, sizeof params);
}

static void test_param_set_refuses_what_is_outside_the_range_and_keeps_the_old_value(void **state)
{
    (void)state;
    check_set_refused("radius", 0.0);
    check_set_refused("radius", 10.001);
    check_set_refused("radius", NAN);
    check_set_refused("radius", INFINITY);
    check_set_refused("samples", 65);
    check_set_refused("samples", 1e30);
    check_set_refused("samples", 1.5);
    check_set_refused("falloff", -1);
    check_set_refused("falloff", 3);
    check_set_refused("falloff", 0.5);
}

static void test_param_set_says_owner_name_value_and_range(void **state)
{
    (void)state;
    check_set_refused("samples", 65);
    assert_string_equal(logged.text, "ssao.samples = 65: give a whole number from 1 to 64");
    assert_int_equal(logged.level, NOOK_LOG_ERROR);
}

static void test_param_parse_reads_numbers_and_names_of_choices(void **state)
{
    (void)state;
    sample_params params = initial_params();
    assert_int_equal(nook_param_parse(find("radius"), "ssao", &params, "0.25"), NOOK_OK);
    assert_int_equal(nook_param_parse(find("samples"), "ssao", &params, "32"), NOOK_OK);
    assert_int_equal(nook_param_parse(find("falloff"), "ssao", &params, "wendland"), NOOK_OK);
    assert_true(params.radius == 0.25f);
    assert_int_equal(params.samples, 32);
    assert_int_equal(params.falloff, 2);
}

static void check_parse_refused(const char *name, const char *text, nook_result expected)
{
    sample_params params = initial_params();
    const sample_params before = params;
    int lines = logged.count;
    assert_int_equal(nook_param_parse(find(name), "ssao", &params, text), expected);
    assert_memory_equal(&params, &before, sizeof params);
    assert_int_equal(logged.count, lines + 1);
}

static void test_param_parse_refuses_what_is_neither(void **state)
{
    (void)state;
    check_parse_refused("radius", "", NOOK_E_ARG);
    check_parse_refused("radius", "1m", NOOK_E_ARG);
    check_parse_refused("radius", "nan", NOOK_E_RANGE);
    check_parse_refused("samples", "8.5", NOOK_E_RANGE);
    check_parse_refused("falloff", "lin", NOOK_E_ARG);
    check_parse_refused("falloff", "linear|", NOOK_E_ARG);
    check_parse_refused("falloff", "", NOOK_E_ARG);
}

static void test_param_assign_takes_names_with_and_without_their_owner(void **state)
{
    (void)state;
    sample_params params = initial_params();
    assert_int_equal(nook_param_assign(sample_table, ROWS, "a.txt:3", "ssao", &params, "ssao.samples", "32"), NOOK_OK);
    assert_int_equal(nook_param_assign(sample_table, ROWS, "a.txt:4", "ssao", &params, "falloff", "wendland"), NOOK_OK);
    assert_int_equal(params.samples, 32);
    assert_int_equal(params.falloff, 2);
}

static void check_assign_refused(const char *name, const char *text, nook_result expected, const char *why)
{
    sample_params params = initial_params();
    const sample_params before = params;
    int lines = logged.count;
    assert_int_equal(nook_param_assign(sample_table, ROWS, "a.txt:3", "ssao", &params, name, text), expected);
    assert_memory_equal(&params, &before, sizeof params);
    assert_int_equal(logged.count, lines + 1);
    if (!strstr(logged.text, why))
        fail_msg("expected '%s' in: %s", why, logged.text);
}

static void test_param_assign_says_where_what_is_wrong_and_which_names_there_are(void **state)
{
    (void)state;
    check_assign_refused("ssao.sample", "32", NOOK_E_NOT_FOUND,
                         "a.txt:3: ssao has no parameter sample; there are ssao.");
    check_assign_refused("hbao.samples", "32", NOOK_E_NOT_FOUND, "ssao has no parameter hbao.samples");
    check_assign_refused("samples", "many", NOOK_E_ARG, "a.txt:3: ssao.samples = many: not a number");
}

static void test_param_print_writes_what_parse_reads(void **state)
{
    (void)state;
    sample_params params = initial_params(), copy;
    const char *const texts[] = { "0.125", "48", "hard" };
    char text[32];
    for (size_t i = 0; i < ROWS; i++) {
        assert_int_equal(nook_param_parse(&sample_table[i], "ssao", &params, texts[i]), NOOK_OK);
        assert_string_equal(nook_param_print(&sample_table[i], &params, text, sizeof text), texts[i]);
    }
    copy = initial_params();
    for (size_t i = 0; i < ROWS; i++)
        nook_param_parse(&sample_table[i], "ssao", &copy,
                         nook_param_print(&sample_table[i], &params, text, sizeof text));
    assert_memory_equal(&copy, &params, sizeof params);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_param_block_makes_the_struct_and_the_table_of_one_file),
        cmocka_unit_test(test_param_reset_writes_every_initial_value),
        cmocka_unit_test(test_param_find_knows_only_whole_names),
        cmocka_unit_test(test_param_set_accepts_both_ends_of_the_range),
        cmocka_unit_test(test_param_set_refuses_what_is_outside_the_range_and_keeps_the_old_value),
        cmocka_unit_test(test_param_set_says_owner_name_value_and_range),
        cmocka_unit_test(test_param_parse_reads_numbers_and_names_of_choices),
        cmocka_unit_test(test_param_parse_refuses_what_is_neither),
        cmocka_unit_test(test_param_assign_takes_names_with_and_without_their_owner),
        cmocka_unit_test(test_param_assign_says_where_what_is_wrong_and_which_names_there_are),
        cmocka_unit_test(test_param_print_writes_what_parse_reads),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
