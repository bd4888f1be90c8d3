/* Memory over time, made up: what grows, and what only comes and goes. */
#include "game/play/soak_memory.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { FRAMES = 100000, MIB = 1 << 20 };

/* A run that holds `held` at first and `leak` more in each frame, and `burst` more in frames but each tenth. */
static nook_soak_memory run(uint64_t held, uint64_t leak, uint64_t burst)
{
    nook_soak_memory memory = { 0 };
    for (uint32_t frame = 1; frame <= FRAMES; frame++)
        nook_soak_memory_add(&memory, frame, FRAMES, held + frame * leak + (frame % 10 ? burst : 0));
    return memory;
}

static bool heap_holds(const nook_soak_memory *memory)
{
    return nook_soak_memory_holds(memory, NOOK_SOAK_HEAP_ALLOWED);
}

static void test_memory_that_stays_holds(void **state)
{
    (void)state;
    nook_soak_memory memory = run(100 * MIB, 0, 0);
    assert_true(nook_soak_memory_holds(&memory, 0));
    for (int i = 0; i < NOOK_SOAK_PARTS; i++)
        assert_true(memory.least[i] == 100 * MIB);
    assert_true(memory.most == 100 * MIB);
}

static void test_bursts_that_are_given_back_are_no_growth(void **state)
{
    (void)state;
    nook_soak_memory memory = run(100 * MIB, 0, 40 * MIB);
    assert_true(nook_soak_memory_holds(&memory, 0));
    assert_true(memory.most == 140 * MIB);
}

static void test_a_leak_of_a_few_bytes_a_frame_is_seen_also_between_bursts(void **state)
{
    (void)state;
    static const uint64_t leaks[] = { 14, 50, 1000 };
    for (int i = 0; i < 3; i++) {
        nook_soak_memory plain = run(100 * MIB, leaks[i], 0), bursts = run(100 * MIB, leaks[i], 40 * MIB);
        assert_false(heap_holds(&plain));
        assert_false(heap_holds(&bursts));
        assert_true(nook_soak_memory_growth(&plain) == leaks[i] * (FRAMES - 2 * (FRAMES / 10)));
    }
}

static void test_what_is_allowed_is_the_limit(void **state)
{
    (void)state;
    nook_soak_memory memory = { .least = { [1] = 100 * MIB, [9] = 100 * MIB + NOOK_SOAK_HEAP_ALLOWED } };
    assert_true(heap_holds(&memory));
    memory.least[9]++;
    assert_false(heap_holds(&memory));
    assert_true(nook_soak_resident_allowed(&memory) == 6 * MIB); /* 2 % and 4 MiB */
}

static void test_what_shrinks_has_not_grown(void **state)
{
    (void)state;
    nook_soak_memory memory = { .least = { [1] = 100 * MIB, [9] = 90 * MIB } };
    assert_true(nook_soak_memory_growth(&memory) == 0);
    assert_true(heap_holds(&memory));
}

static void test_what_is_taken_while_it_warms_up_counts_nowhere(void **state)
{
    (void)state;
    nook_soak_memory memory = run(100 * MIB, 0, 0);
    nook_soak_memory_add(&memory, FRAMES / 10, FRAMES, 500 * MIB);
    nook_soak_memory_add(&memory, 1, FRAMES, MIB);
    assert_true(memory.most == 100 * MIB && memory.least[1] == 100 * MIB);
    assert_true(nook_soak_memory_holds(&memory, 0));
}

static void test_a_run_that_was_stopped_early_has_shown_nothing(void **state)
{
    (void)state;
    nook_soak_memory memory = { 0 };
    for (uint32_t frame = 1; frame <= FRAMES / 2; frame++)
        nook_soak_memory_add(&memory, frame, FRAMES, MIB);
    assert_true(memory.least[1] == MIB && memory.least[9] == 0);
    assert_false(heap_holds(&memory));
}

static void test_tenths_of_long_and_of_short_runs_are_tenths(void **state)
{
    (void)state;
    static const uint32_t frames[] = { 10, 200, 4000000000u };
    for (int i = 0; i < 3; i++) {
        nook_soak_memory memory = { 0 };
        nook_soak_memory_add(&memory, 1, frames[i], 1);
        nook_soak_memory_add(&memory, frames[i] / 2 + 1, frames[i], 2);
        nook_soak_memory_add(&memory, frames[i], frames[i], 3);
        assert_true(memory.least[0] == 1 && memory.least[5] == 2 && memory.least[9] == 3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_memory_that_stays_holds),
        cmocka_unit_test(test_bursts_that_are_given_back_are_no_growth),
        cmocka_unit_test(test_a_leak_of_a_few_bytes_a_frame_is_seen_also_between_bursts),
        cmocka_unit_test(test_what_is_allowed_is_the_limit),
        cmocka_unit_test(test_what_shrinks_has_not_grown),
        cmocka_unit_test(test_what_is_taken_while_it_warms_up_counts_nowhere),
        cmocka_unit_test(test_a_run_that_was_stopped_early_has_shown_nothing),
        cmocka_unit_test(test_tenths_of_long_and_of_short_runs_are_tenths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
