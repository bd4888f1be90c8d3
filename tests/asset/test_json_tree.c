#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "engine/asset/json_tree.h"
#include "tests/support/log_capture.h"
#include <stdlib.h>
#include <string.h>

static nook_json_tree read_text(const char *text)
{
    nook_json_tree tree = { 0 };
    assert_int_equal(nook_json_tree_read("t.json", text, strlen(text), 256, &tree), NOOK_OK);
    return tree;
}

static void test_members_are_found_behind_nested_values(void **state)
{
    (void)state;
    uint64_t number = 0;
    nook_json_tree tree = read_text(" { \"a\" : [ 1, { \"b\": [ ] }, \"c\" ] , \"b\" : 7, \"c\": { } } ");
    uint32_t value = nook_json_tree_find(&tree, 0, "b");
    assert_true(nook_json_tree_integer(&tree, value, &number));
    assert_int_equal(number, 7);
    assert_int_equal(tree.values[nook_json_tree_find(&tree, 0, "a")].count, 3);
    assert_int_equal(tree.values[0].next, tree.value_count);
    assert_int_equal(nook_json_tree_find(&tree, 0, "d"), NOOK_JSON_NONE);
    assert_int_equal(nook_json_tree_find(&tree, value, "b"), NOOK_JSON_NONE);
    nook_json_tree_free(&tree);
}

static void check_string(const char *text, const char *expected, size_t expected_length)
{
    size_t length = 0;
    nook_json_tree tree = read_text(text);
    char *copy = nook_json_tree_copy_string(&tree, 0, &length);
    assert_int_equal(length, expected_length);
    assert_memory_equal(copy, expected, length + 1);
    assert_int_equal(nook_json_tree_string_is(&tree, 0, expected), strlen(expected) == expected_length);
    free(copy);
    nook_json_tree_free(&tree);
}

static void test_strings_are_read_with_their_escapes(void **state)
{
    (void)state;
    check_string("\"\"", "", 0);
    check_string("\"a\\\"b\\\\\\/\\n\\t\"", "a\"b\\/\n\t", 7);
    check_string("\"\\u0041\\u00e4\\u20AC\"", "A\xC3\xA4\xE2\x82\xAC", 6);
    check_string("\"\\uD83D\\uDE00\"", "\xF0\x9F\x98\x80", 4);
    check_string("\"\\uD83Dx\"", "\xEF\xBF\xBDx", 4); /* half a pair */
    check_string("\"a\\u0000b\"", "a\0b", 3);
}

static void test_integers_are_only_those_written_as_such(void **state)
{
    (void)state;
    static const char *const good[] = { "0", "42", "4294967296", "999999999999999999" };
    static const char *const bad[] = {
        "-1", "1.0", "1e3", "1000000000000000000", "4611686018427387904", "\"1\"", "true"
    };
    uint64_t number;
    for (size_t i = 0; i < NOOK_COUNT(good); i++) {
        nook_json_tree tree = read_text(good[i]);
        assert_true(nook_json_tree_integer(&tree, 0, &number));
        assert_int_equal(number, strtoull(good[i], NULL, 10));
        nook_json_tree_free(&tree);
    }
    for (size_t i = 0; i < NOOK_COUNT(bad); i++) {
        nook_json_tree tree = read_text(bad[i]);
        assert_false(nook_json_tree_integer(&tree, 0, &number));
        nook_json_tree_free(&tree);
    }
}

static void test_numbers_are_read_as_double(void **state)
{
    (void)state;
    nook_json_tree tree = read_text("-12.5e-1");
    assert_true(nook_json_tree_number(&tree, 0) == -1.25);
    nook_json_tree_free(&tree);
}

static void test_text_that_is_not_json_is_refused(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "",
        " ",
        "{",
        "[",
        "[1,]",
        "[1 2]",
        "{\"a\":}",
        "{\"a\" 1}",
        "{'a':1}",
        "{1:2}",
        "{\"a\":1,}",
        "01",
        "-",
        "1.",
        ".5",
        "1e",
        "+1",
        "NaN",
        "tru",
        "nulll",
        "1 2",
        "[1]]",
        "\"",
        "\"\\x\"",
        "\"\\u12\"",
        "\"\\u12g4\"",
        "\"\x01\"",
        "\"\xFF\"",
        "\"\xC0\x80\"",
        "\"\xED\xA0\x80\"",
        "\"\xF5\x80\x80\x80\"",
        "\"\xE2\x82\"",
        "\xFF{}",
        "[1}",
        "{\"a\":1]",
    };
    nook_json_tree tree = { 0 };
    for (size_t i = 0; i < NOOK_COUNT(bad); i++) {
        nook_log_capture log;
        nook_log_capture_begin(&log);
        nook_result result = nook_json_tree_read("t.json", bad[i], strlen(bad[i]), 256, &tree);
        nook_log_capture_end();
        if (result != NOOK_E_FORMAT || log.errors != 1)
            fail_msg("'%s' gave %d and %d lines", bad[i], result, log.errors);
        assert_null(tree.values);
    }
}

static void test_every_cut_of_a_text_is_refused(void **state)
{
    (void)state;
    static const char text[] = "{\"a\":[1,-2.5e3,true,null,\"x\\u0041\\n\"],\"b\":{\"c\":false}}";
    nook_json_tree tree = { 0 };
    for (size_t size = 0; size < sizeof text - 1; size++) {
        char *exact = malloc(size ? size : 1); /* exact, so that the sanitizer sees a read past the end */
        nook_log_capture log;
        assert_non_null(exact);
        memcpy(exact, text, size);
        nook_log_capture_begin(&log);
        assert_int_equal(nook_json_tree_read("t.json", exact, size, 256, &tree), NOOK_E_FORMAT);
        nook_log_capture_end();
        free(exact);
    }
}

static void test_nesting_is_limited(void **state)
{
    (void)state;
    enum { DEEP = 1000000 };
    char *text = malloc(DEEP);
    nook_json_tree tree = { 0 };
    nook_log_capture log;
    assert_non_null(text);
    memset(text, '[', 256);
    memset(text + 256, ']', 256);
    assert_int_equal(nook_json_tree_read("t.json", text, 512, 256, &tree), NOOK_OK);
    nook_json_tree_free(&tree);
    memset(text, '[', DEEP);
    nook_log_capture_begin(&log);
    assert_int_equal(nook_json_tree_read("t.json", text, DEEP, 256, &tree), NOOK_E_FORMAT);
    nook_log_capture_end();
    assert_non_null(strstr(log.text, "nested too deeply"));
    free(text);
}

static void test_a_refusal_names_file_and_line(void **state)
{
    (void)state;
    static const char text[] = "{\n\"a\": 1,\n\"b\": oops\n}";
    nook_json_tree tree = { 0 };
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_json_tree_read("t.json", text, strlen(text), 256, &tree), NOOK_E_FORMAT);
    nook_log_capture_end();
    assert_string_equal(log.text, "t.json: JSON line 3: expected a value");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_members_are_found_behind_nested_values),
        cmocka_unit_test(test_strings_are_read_with_their_escapes),
        cmocka_unit_test(test_integers_are_only_those_written_as_such),
        cmocka_unit_test(test_numbers_are_read_as_double),
        cmocka_unit_test(test_text_that_is_not_json_is_refused),
        cmocka_unit_test(test_every_cut_of_a_text_is_refused),
        cmocka_unit_test(test_nesting_is_limited),
        cmocka_unit_test(test_a_refusal_names_file_and_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
