#include "engine/core/log.h"
#include "tests/support/log_capture.h"
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h> /* wants those above first */

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
    nook_log_keep_errors(NULL, 0);
    nook_log_capture_end();
    return 0;
}

static void test_kept_errors_are_the_last_one_and_still_logged(void **state)
{
    (void)state;
    char text[64] = "nothing";
    nook_log_keep_errors(text, sizeof text);
    nook_log_warning("a warning");
    assert_string_equal(text, "nothing");
    assert_int_equal(nook_fail(NOOK_E_IO, "first %d", 1), NOOK_E_IO);
    assert_int_equal(nook_fail(NOOK_E_IO, "second %d", 2), NOOK_E_IO);
    assert_string_equal(text, "second 2");
    assert_string_equal(logged.text, "second 2");
    assert_int_equal(logged.count, 3);
    nook_log_keep_errors(NULL, 0);
    assert_int_equal(nook_fail(NOOK_E_IO, "third"), NOOK_E_IO);
    assert_string_equal(text, "second 2");
}

static void test_kept_errors_are_cut_to_their_room(void **state)
{
    (void)state;
    char text[8] = "";
    nook_log_keep_errors(text, sizeof text);
    assert_int_equal(nook_fail(NOOK_E_RANGE, "0123456789"), NOOK_E_RANGE);
    assert_string_equal(text, "0123456");
}

static void *fail_elsewhere(void *user)
{
    (void)user;
    return nook_fail(NOOK_E_IO, "elsewhere") == NOOK_E_IO ? user : NULL;
}

static void test_errors_of_other_threads_are_not_kept(void **state)
{
    (void)state;
    char text[64] = "";
    pthread_t thread;
    nook_log_keep_errors(text, sizeof text);
    assert_int_equal(pthread_create(&thread, NULL, fail_elsewhere, NULL), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
    assert_string_equal(text, "");
    assert_string_equal(logged.text, "elsewhere");
}

static void test_a_refusal_writes_its_line_and_logs_nothing(void **state)
{
    (void)state;
    char text[16];
    assert_int_equal(nook_refuse(text, sizeof text, NOOK_E_FORMAT, "%s: wrong, and how", "file"), NOOK_E_FORMAT);
    assert_string_equal(text, "file: wrong, an");
    assert_int_equal(logged.count, 0);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, begin, end)
    const struct CMUnitTest tests[] = {
        TEST(test_kept_errors_are_the_last_one_and_still_logged),
        TEST(test_kept_errors_are_cut_to_their_room),
        TEST(test_errors_of_other_threads_are_not_kept),
        TEST(test_a_refusal_writes_its_line_and_logs_nothing),
    };
    return cmocka_run_group_tests_name("log", tests, NULL, NULL);
}
