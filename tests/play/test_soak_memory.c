/* Memory over time, made up: what grows, and what only comes and goes. */
#include "game/play/soak_memory.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { FRAMES = 1000, MIB = 1 << 20 };

/* A run that holds `held` at first and `leak` more in each frame, and `burst` more in frames but each tenth. */
static nook_soak_memory run(uint64_t held, uint64_t leak, uint64_t burst)
{
    nook_soak_memory memory = { 0 };
    for (uint32_t frame = 1; frame <= FRAMES; frame++)
        nook_soak_memory_add(&memory, frame, FRAMES, held + frame * leak + (frame % 10 ? burst : 0));
    return memory;
}

static void test_memory_that_stays_holds(void **state)
{
    (void)state;
    nook_soak_memory memory = run(100 * MIB, 0, 0);
    assert_true(nook_soak_memory_holds(&memory));
    assert_true(memory.early == 100 * MIB && memory.late == 100 * MIB && memory.most == 100 * MIB);
}

static void test_bursts_that_are_given_back_are_no_growth(void **state)
{
    (void)state;
    nook_soak_memory memory = run(100 * MIB, 0, 40 * MIB);
    assert_true(nook_soak_memory_holds(&memory));
    assert_true(memory.most == 140 * MIB);
}

static void test_a_leak_is_seen_also_between_bursts(void **state)
{
    (void)state;
    nook_soak_memory plain = run(100 * MIB, MIB / 100, 0), bursts = run(100 * MIB, MIB / 100, 40 * MIB);
    assert_false(nook_soak_memory_holds(&plain)); /* 8 MiB from the second tenth to the last */
    assert_false(nook_soak_memory_holds(&bursts));
}

static void test_growth_is_allowed_up_to_two_percent_and_four_mebibytes(void **state)
{
    (void)state;
    nook_soak_memory memory = { .early = 100 * MIB, .late = 106 * MIB };
    assert_true(nook_soak_memory_allowed(&memory) == 6 * MIB);
    assert_true(nook_soak_memory_holds(&memory));
    memory.late++;
    assert_false(nook_soak_memory_holds(&memory));
}

static void test_what_is_taken_while_it_warms_up_counts_nowhere(void **state)
{
    (void)state;
    nook_soak_memory memory = { 0 };
    nook_soak_memory_add(&memory, FRAMES / 10, FRAMES, MIB);
    assert_true(memory.early == 0 && memory.late == 0 && memory.most == 0);
}

static void test_a_run_that_was_stopped_early_has_shown_nothing(void **state)
{
    (void)state;
    nook_soak_memory memory = { 0 };
    for (uint32_t frame = 1; frame <= FRAMES / 2; frame++)
        nook_soak_memory_add(&memory, frame, FRAMES, MIB);
    assert_true(memory.early == MIB && memory.late == 0);
    assert_false(nook_soak_memory_holds(&memory));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_memory_that_stays_holds),
        cmocka_unit_test(test_bursts_that_are_given_back_are_no_growth),
        cmocka_unit_test(test_a_leak_is_seen_also_between_bursts),
        cmocka_unit_test(test_growth_is_allowed_up_to_two_percent_and_four_mebibytes),
        cmocka_unit_test(test_what_is_taken_while_it_warms_up_counts_nowhere),
        cmocka_unit_test(test_a_run_that_was_stopped_early_has_shown_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
