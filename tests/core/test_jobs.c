#include "engine/core/jobs.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <time.h>

#include <cmocka.h>

typedef struct tally {
    size_t count;
    unsigned workers;
    unsigned char *visits; /* one writer per item, so plain memory */
    atomic_uint calls, bad;
} tally;

static void visit(void *user, size_t first, size_t last, unsigned worker)
{
    tally *t = user;
    atomic_fetch_add(&t->calls, 1);
    if (first >= last || last > t->count || worker >= t->workers) {
        atomic_fetch_add(&t->bad, 1);
        return;
    }
    for (size_t i = first; i < last; i++)
        t->visits[i]++;
}

static void check_each_visited_once(size_t count, unsigned threads)
{
    tally t = { .count = count, .workers = nook_parallel_workers(count, threads), .visits = calloc(count + 1, 1) };
    assert_non_null(t.visits);
    nook_parallel_for(count, threads, visit, &t);
    assert_int_equal(atomic_load(&t.bad), 0);
    for (size_t i = 0; i < count; i++)
        assert_int_equal(t.visits[i], 1);
    assert_int_equal(t.visits[count], 0);
    free(t.visits);
}

static void test_parallel_for_visits_each_item_once(void **state)
{
    (void)state;
    const size_t counts[] = { 1, 2, 3, 7, 63, 64, 65, 1000, 100003 };
    const unsigned threads[] = { 0, 1, 2, 3, 8, 100 };
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
        for (size_t t = 0; t < sizeof threads / sizeof threads[0]; t++)
            check_each_visited_once(counts[c], threads[t]);
    }
}

static void test_parallel_for_of_nothing_calls_nothing(void **state)
{
    (void)state;
    tally t = { .count = 0 };
    nook_parallel_for(0, 0, visit, &t);
    assert_int_equal(atomic_load(&t.calls), 0);
}

static void test_one_thread_runs_inline_in_one_piece(void **state)
{
    (void)state;
    unsigned char visits[1000] = { 0 };
    tally t = { .count = sizeof visits, .workers = 1, .visits = visits };
    nook_parallel_for(sizeof visits, 1, visit, &t);
    assert_int_equal(atomic_load(&t.calls), 1);
    assert_int_equal(atomic_load(&t.bad), 0);
}

static void test_worker_count_is_bounded_by_items_and_never_zero(void **state)
{
    (void)state;
    assert_true(nook_core_count() >= 1);
    assert_int_equal(nook_parallel_workers(0, 8), 1);
    assert_int_equal(nook_parallel_workers(3, 8), 3);
    assert_int_equal(nook_parallel_workers(1000, 8), 8);
    assert_true(nook_parallel_workers(SIZE_MAX, UINT32_MAX) >= 8);
    assert_true(nook_parallel_workers(SIZE_MAX, UINT32_MAX) <= 4096);
}

typedef struct meeting {
    atomic_uint arrived;
    atomic_uint met;
} meeting;

/* Both items wait for the other one: only two threads at once can finish this before the deadline. */
static void meet(void *user, size_t first, size_t last, unsigned worker)
{
    (void)worker;
    meeting *m = user;
    atomic_fetch_add(&m->arrived, (unsigned)(last - first));
    for (int i = 0; i < 10000 && atomic_load(&m->arrived) < 2; i++)
        nanosleep(&(struct timespec){ .tv_nsec = 1000000 }, NULL);
    if (last - first == 1 && atomic_load(&m->arrived) == 2)
        atomic_fetch_add(&m->met, 1);
}

static void test_two_threads_work_at_the_same_time(void **state)
{
    (void)state;
    meeting m = { 0 };
    nook_parallel_for(2, 2, meet, &m);
    assert_int_equal(atomic_load(&m.met), 2);
}

static void run_inner(void *user, size_t first, size_t last, unsigned worker)
{
    (void)worker;
    for (size_t i = first; i < last; i++)
        nook_parallel_for(100, 2, visit, (tally *)user + i);
}

static void test_parallel_for_may_be_nested(void **state)
{
    (void)state;
    unsigned char visits[4][101] = { { 0 } };
    tally inner[4];
    for (size_t i = 0; i < 4; i++)
        inner[i] = (tally){ .count = 100, .workers = 2, .visits = visits[i] };
    nook_parallel_for(4, 2, run_inner, inner);
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(atomic_load(&inner[i].bad), 0);
        for (size_t j = 0; j < 100; j++)
            assert_int_equal(visits[i][j], 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parallel_for_visits_each_item_once),
        cmocka_unit_test(test_parallel_for_of_nothing_calls_nothing),
        cmocka_unit_test(test_one_thread_runs_inline_in_one_piece),
        cmocka_unit_test(test_worker_count_is_bounded_by_items_and_never_zero),
        cmocka_unit_test(test_two_threads_work_at_the_same_time),
        cmocka_unit_test(test_parallel_for_may_be_nested),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
