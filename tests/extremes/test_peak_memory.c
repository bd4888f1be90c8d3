/* Work in a process of its own: its memory is seen, and what goes wrong there is a failure here. */
#include "game/extremes/peak_memory.h"
#include "tests/support/log_capture.h"
#include <stdlib.h>
#include <unistd.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { BYTES = 64 << 20 };

static nook_result touch(const void *user, void *out)
{
    nook_memory before, after;
    const size_t size = *(const size_t *)user;
    if (nook_memory_read(&before) != NOOK_OK)
        return NOOK_E_IO;
    char *block = malloc(size ? size : 1);
    if (!block)
        return NOOK_E_MEMORY;
    for (volatile char *at = block; at < block + size; at += 4096)
        *at = 1;
    free(block); /* the peak stays */
    nook_result result = nook_memory_read(&after);
    *(uint64_t *)out = nook_peak_memory_ours(after.peak - before.resident);
    return result;
}

static void test_memory_that_is_touched_and_freed_is_seen(void **state)
{
    (void)state;
    const size_t size = BYTES;
    for (int again = 0; again < 2; again++) { /* the second time too: a peak of before hides nothing */
        uint64_t bytes = 0;
        assert_int_equal(nook_run_in_child(touch, &size, &bytes, sizeof bytes), NOOK_OK);
        assert_true(bytes > BYTES * 0.95 && bytes < BYTES * 1.05);
    }
}

static void test_what_this_process_had_before_is_not_counted(void **state)
{
    (void)state;
    const size_t none = 0;
    uint64_t bytes = UINT64_MAX;
    char *ours = malloc(BYTES);
    assert_non_null(ours);
    for (volatile char *at = ours; at < ours + BYTES; at += 4096)
        *at = 1;
    assert_int_equal(nook_run_in_child(touch, &none, &bytes, sizeof bytes), NOOK_OK);
    assert_true(bytes < BYTES / 16);
    free(ours);
}

static nook_result give_up(const void *user, void *out)
{
    (void)user, (void)out;
    return NOOK_E_RANGE;
}

static nook_result die(const void *user, void *out)
{
    (void)user, (void)out;
    _exit(3);
}

static void test_a_child_that_fails_or_dies_is_a_failure(void **state)
{
    (void)state;
    uint64_t bytes = 7;
    nook_log_capture capture;
    nook_log_capture_begin(&capture);
    assert_int_equal(nook_run_in_child(give_up, NULL, &bytes, sizeof bytes), NOOK_E_RANGE);
    assert_int_equal(nook_run_in_child(die, NULL, &bytes, sizeof bytes), NOOK_E_MEMORY);
    nook_log_capture_end();
    assert_int_equal(capture.errors, 1);
    assert_int_equal(bytes, 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_memory_that_is_touched_and_freed_is_seen),
        cmocka_unit_test(test_what_this_process_had_before_is_not_counted),
        cmocka_unit_test(test_a_child_that_fails_or_dies_is_a_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
