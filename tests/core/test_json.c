#include "engine/core/file.h"
#include "engine/core/json.h"
#include "tests/support/abort.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void assert_text(nook_json *json, const char *expected)
{
    const char *text = NULL;
    size_t size = 0;
    assert_int_equal(nook_json_finish(json, &text, &size), NOOK_OK);
    assert_string_equal(text, expected);
    assert_int_equal(size, strlen(expected));
    nook_json_free(json);
}

static void test_json_writes_nested_objects_and_arrays(void **state)
{
    (void)state;
    nook_json json = { 0 };
    nook_json_begin_object(&json);
    nook_json_member_string(&json, "scene", "hall");
    nook_json_key(&json, "sizes");
    nook_json_begin_array(&json);
    nook_json_integer(&json, -3);
    nook_json_begin_object(&json);
    nook_json_member_bool(&json, "open", true);
    nook_json_end_object(&json);
    nook_json_null(&json);
    nook_json_end_array(&json);
    nook_json_key(&json, "eye");
    nook_json_numbers(&json, (const double[]){ 0.5, -1.0, 1e300 }, 3);
    nook_json_end_object(&json);
    assert_text(&json,
                "{\n  \"scene\": \"hall\",\n  \"sizes\": [\n    -3,\n    {\n      \"open\": true\n    },\n    null\n"
                "  ],\n  \"eye\": [0.5, -1, 1e+300]\n}\n");
}

static void test_json_writes_empty_containers_on_one_line(void **state)
{
    (void)state;
    nook_json json = { 0 };
    nook_json_begin_array(&json);
    nook_json_begin_object(&json);
    nook_json_end_object(&json);
    nook_json_begin_array(&json);
    nook_json_end_array(&json);
    nook_json_numbers(&json, NULL, 0);
    nook_json_end_array(&json);
    assert_text(&json, "[\n  {},\n  [],\n  []\n]\n");
}

static void test_json_escapes_strings(void **state)
{
    (void)state;
    nook_json json = { 0 };
    nook_json_string(&json, "a\"b\\c\n\t\r\b\f\x01/\xC3\xA9\xF0\x9F\x98\x80");
    assert_text(&json, "\"a\\\"b\\\\c\\n\\t\\r\\b\\f\\u0001/\xC3\xA9\xF0\x9F\x98\x80\"\n");
}

static void test_json_replaces_bytes_that_are_not_utf8(void **state)
{
    (void)state;
#define BAD "\xEF\xBF\xBD"
    const struct {
        const char *input, *output;
    } cases[] = {
        { "\xFFx", BAD "x" },
        { "\x80", BAD },
        { "\xC0\xAF", BAD BAD },                 /* overlong '/' */
        { "\xE0\x80\x80", BAD BAD BAD },         /* overlong */
        { "\xED\xA0\x80", BAD BAD BAD },         /* surrogate */
        { "\xF4\x90\x80\x80", BAD BAD BAD BAD }, /* above U+10FFFF */
        { "\xE2\x82", BAD BAD },                 /* cut short at the end */
        { "\xC3\"", BAD "\\\"" },                /* cut short by a quote that must stay escaped */
        { "\xF4\x8F\xBF\xBF", "\xF4\x8F\xBF\xBF" },
    };
#undef BAD
    for (size_t i = 0; i < NOOK_COUNT(cases); i++) {
        char expected[64];
        snprintf(expected, sizeof expected, "\"%s\"\n", cases[i].output);
        nook_json json = { 0 };
        nook_json_string(&json, cases[i].input);
        assert_text(&json, expected);
    }
}

static void test_json_escapes_keys_too(void **state)
{
    (void)state;
    nook_json json = { 0 };
    nook_json_begin_object(&json);
    nook_json_member_integer(&json, "a\"b", INT64_MIN);
    nook_json_end_object(&json);
    assert_text(&json, "{\n  \"a\\\"b\": -9223372036854775808\n}\n");
}

static void test_json_numbers_read_back_the_same(void **state)
{
    (void)state;
    const double values[] = {
        0.0, 0.1, 1.0 / 3.0, DBL_MAX, DBL_TRUE_MIN, -2.5e-7, 123456789012345680.0, 0.30000000000000004
    };
    for (size_t i = 0; i < NOOK_COUNT(values); i++) {
        nook_json json = { 0 };
        const char *text = NULL;
        nook_json_number(&json, values[i]);
        assert_int_equal(nook_json_finish(&json, &text, NULL), NOOK_OK);
        assert_true(strtod(text, NULL) == values[i]);
        nook_json_free(&json);
    }
    const float floats[] = { 0.1f, 1.0f / 3.0f, FLT_MAX, FLT_TRUE_MIN, 16777217.0f };
    for (size_t i = 0; i < NOOK_COUNT(floats); i++) {
        nook_json json = { 0 };
        const char *text = NULL;
        nook_json_float(&json, floats[i]);
        assert_int_equal(nook_json_finish(&json, &text, NULL), NOOK_OK);
        assert_true((float)strtod(text, NULL) == floats[i]);
        nook_json_free(&json);
    }
}

static void test_json_numbers_use_few_digits(void **state)
{
    (void)state;
    nook_json json = { 0 };
    nook_json_number(&json, 0.1);
    assert_text(&json, "0.1\n");
    nook_json_float(&json, 0.1f);
    assert_text(&json, "0.1\n");
}

static void test_json_writes_null_for_what_is_not_finite(void **state)
{
    (void)state;
    nook_json json = { 0 };
    nook_json_begin_array(&json);
    nook_json_number(&json, (double)NAN);
    nook_json_float(&json, -INFINITY);
    nook_json_string(&json, NULL);
    nook_json_end_array(&json);
    assert_text(&json, "[\n  null,\n  null,\n  null\n]\n");
}

static void test_json_grows_past_its_first_buffer(void **state)
{
    (void)state;
    nook_json json = { 0 };
    const char *text = NULL;
    size_t size = 0;
    nook_json_begin_array(&json);
    for (int64_t i = 0; i < 20000; i++)
        nook_json_integer(&json, i);
    nook_json_end_array(&json);
    assert_int_equal(nook_json_finish(&json, &text, &size), NOOK_OK);
    assert_int_equal(strlen(text), size);
    const char *read = text + 1;
    for (long i = 0; i < 20000; i++) {
        char *end = NULL;
        assert_int_equal(strtol(read, &end, 10), i);
        read = end + 1;
    }
    nook_json_free(&json);
}

static void test_json_is_printed_and_a_stream_that_takes_nothing_is_an_error(void **state)
{
    (void)state;
    char path[512];
    nook_scratch_path(path, sizeof path, "a.json");
    nook_json json = { 0 };
    nook_json_bool(&json, false);
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    assert_int_equal(nook_json_print(&json, stream), NOOK_OK);
    fclose(stream);
    nook_file file = { 0 };
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    assert_string_equal((const char *)file.bytes, "false\n");
    nook_file_free(&file);
    stream = fopen(path, "r"); /* not for writing */
    assert_non_null(stream);
    nook_log_capture capture;
    nook_log_capture_begin(&capture);
    assert_int_equal(nook_json_print(&json, stream), NOOK_E_IO);
    nook_log_capture_end();
    assert_int_equal(capture.count, 1);
    fclose(stream);
    nook_json_free(&json);
}

static void misuse_value_without_key(void)
{
    nook_json json = { 0 };
    nook_json_begin_object(&json);
    nook_json_integer(&json, 1);
}

static void misuse_wrong_end(void)
{
    nook_json json = { 0 };
    nook_json_begin_object(&json);
    nook_json_end_array(&json);
}

static void misuse_two_roots(void)
{
    nook_json json = { 0 };
    nook_json_integer(&json, 1);
    nook_json_integer(&json, 2);
}

static void misuse_finish_while_open(void)
{
    nook_json json = { 0 };
    const char *text = NULL;
    nook_json_begin_array(&json);
    nook_json_finish(&json, &text, NULL);
}

static void misuse_key_without_value(void)
{
    nook_json json = { 0 };
    nook_json_begin_object(&json);
    nook_json_key(&json, "a");
    nook_json_end_object(&json);
}

static void test_json_asserts_on_misuse(void **state)
{
    (void)state;
    assert_true(nook_aborts(misuse_value_without_key));
    assert_true(nook_aborts(misuse_wrong_end));
    assert_true(nook_aborts(misuse_two_roots));
    assert_true(nook_aborts(misuse_finish_while_open));
    assert_true(nook_aborts(misuse_key_without_value));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_json_writes_nested_objects_and_arrays),
        cmocka_unit_test(test_json_writes_empty_containers_on_one_line),
        cmocka_unit_test(test_json_escapes_strings),
        cmocka_unit_test(test_json_replaces_bytes_that_are_not_utf8),
        cmocka_unit_test(test_json_escapes_keys_too),
        cmocka_unit_test(test_json_numbers_read_back_the_same),
        cmocka_unit_test(test_json_numbers_use_few_digits),
        cmocka_unit_test(test_json_writes_null_for_what_is_not_finite),
        cmocka_unit_test(test_json_grows_past_its_first_buffer),
        cmocka_unit_test(test_json_is_printed_and_a_stream_that_takes_nothing_is_an_error),
        cmocka_unit_test(test_json_asserts_on_misuse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
