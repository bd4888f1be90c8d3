/* Calls that may crash. */
#include "engine/core/jobs.h"
#include "engine/module/guard.h"
#include "tests/support/abort.h"
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static void count(void *user)
{
    ++*(int *)user;
}

static void crash(void *user)
{
    raise(*(int *)user);
}

static void test_a_call_that_ends_well_is_no_crash(void **state)
{
    (void)state;
    int calls = 0;
    nook_crash ended = nook_guard_call(count, &calls);
    assert_int_equal(calls, 1);
    assert_int_equal(ended.number, 0);
    assert_string_equal(nook_crash_name(ended), "no crash");
}

static void test_every_kind_of_crash_ends_the_call_alone_and_can_come_again(void **state)
{
    (void)state;
    static const struct {
        int number;
        const char *name;
    } kinds[] = {
        { SIGSEGV, "SIGSEGV" }, { SIGBUS, "SIGBUS" }, { SIGFPE, "SIGFPE" }, { SIGILL, "SIGILL" }, { SIGABRT, "SIGABRT" }
    };
    for (int i = 0; i < 50; i++) {
        int number = kinds[i % 5].number;
        nook_crash ended = nook_guard_call(crash, &number);
        assert_int_equal(ended.number, number);
        assert_string_equal(nook_crash_name(ended), kinds[i % 5].name);
    }
}

static void handler_of_somebody_else(int number)
{
    (void)number;
}

static void test_handlers_and_signal_masks_are_afterwards_as_before(void **state)
{
    (void)state;
    struct sigaction own = { .sa_handler = handler_of_somebody_else }, before, after;
    sigset_t blocked;
    int number = SIGFPE;
    sigaction(SIGFPE, &own, &before);
    nook_guard_call(crash, &number);
    sigaction(SIGFPE, &before, &after);
    assert_true(after.sa_handler == handler_of_somebody_else);
    sigprocmask(SIG_SETMASK, NULL, &blocked);
    assert_false(sigismember(&blocked, SIGFPE));
}

static void look_at_workers(void *user, size_t first, size_t last, unsigned worker)
{
    (void)worker;
    if (first == 0 && last == 1000)
        *(int *)user = 1; /* all of it in one piece */
}

static void hand_out_work(void *user)
{
    nook_parallel_for(1000, 4, look_at_workers, user);
}

static void test_work_for_many_threads_is_done_by_the_caller(void **state)
{
    (void)state;
    int inlined = 0;
    nook_guard_call(hand_out_work, &inlined);
    assert_int_equal(inlined, 1);
    inlined = 0;
    hand_out_work(&inlined);
    assert_int_equal(inlined, 0);
}

static void nest(void *user)
{
    nook_guard_call(count, user);
}

static void nest_calls(void)
{
    int calls = 0;
    signal(SIGABRT, SIG_DFL);
    nook_crash ended = nook_guard_call(nest, &calls);
    if (ended.number == SIGABRT)
        abort();
}

static void test_calls_within_calls_are_our_mistake(void **state)
{
    (void)state;
    assert_true(nook_aborts(nest_calls));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_call_that_ends_well_is_no_crash),
        cmocka_unit_test(test_every_kind_of_crash_ends_the_call_alone_and_can_come_again),
        cmocka_unit_test(test_handlers_and_signal_masks_are_afterwards_as_before),
        cmocka_unit_test(test_work_for_many_threads_is_done_by_the_caller),
        cmocka_unit_test(test_calls_within_calls_are_our_mistake),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
