#include "engine/core/order.h"
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { COUNT_MAX = 200 };

static uint32_t next_random(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

/* Few values, so that many are equal. */
static void fill(float *floats, double *numbers, size_t count, uint32_t seed)
{
    for (size_t i = 0; i < count; i++) {
        floats[i] = (float)(next_random(&seed) % (count + 1)) - 0.5f * (float)count;
        numbers[i] = (double)floats[i];
    }
}

static void test_floats_and_numbers_of_any_count_are_ascending_and_the_same_ones(void **state)
{
    (void)state;
    float floats[COUNT_MAX];
    double numbers[COUNT_MAX], sum, sum_after;
    for (size_t count = 0; count <= COUNT_MAX; count++) {
        fill(floats, numbers, count, (uint32_t)count);
        sum = sum_after = 0.0;
        for (size_t i = 0; i < count; i++)
            sum += numbers[i] * numbers[i]; /* whole halves: exact */
        nook_order_floats(floats, count);
        nook_order_numbers(numbers, count);
        for (size_t i = 0; i < count; i++) {
            assert_true((double)floats[i] == numbers[i]);
            assert_true(i == 0 || numbers[i - 1] <= numbers[i]);
            sum_after += numbers[i] * numbers[i];
        }
        assert_true(sum == sum_after);
    }
}

static void test_infinities_stand_at_the_ends(void **state)
{
    (void)state;
    float floats[] = { INFINITY, 1.0f, -INFINITY, 0.0f };
    nook_order_floats(floats, 4);
    assert_true(floats[0] == -INFINITY && floats[1] == 0.0f && floats[2] == 1.0f && floats[3] == INFINITY);
}

static void test_a_median_is_in_the_middle_or_between_the_two_there(void **state)
{
    (void)state;
    double one[] = { 3.0 }, three[] = { 5.0, 1.0, 2.0 }, four[] = { 8.0, 1.0, 4.0, 2.0 };
    assert_true(nook_median(one, 1) == 3.0);
    assert_true(nook_median(three, 3) == 2.0);
    assert_true(nook_median(four, 4) == 3.0);
    assert_true(four[0] == 1.0 && four[3] == 8.0);
}

static void test_quantiles_are_values_of_the_nearest_rank(void **state)
{
    (void)state;
    const double numbers[] = { 1.0, 2.0, 3.0, 8.0 };
    const float floats[] = { 1.0f, 2.0f, 3.0f, 8.0f };
    const struct {
        double part, value;
    } known[] = { { 0.0, 1.0 }, { 0.25, 1.0 }, { 0.26, 2.0 }, { 0.5, 2.0 }, { 0.95, 8.0 }, { 1.0, 8.0 }, { 7.0, 8.0 } };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        assert_true(nook_quantile(numbers, 4, known[i].part) == known[i].value);
        assert_true((double)nook_quantile_floats(floats, 4, known[i].part) == known[i].value);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_floats_and_numbers_of_any_count_are_ascending_and_the_same_ones),
        cmocka_unit_test(test_infinities_stand_at_the_ends),
        cmocka_unit_test(test_a_median_is_in_the_middle_or_between_the_two_there),
        cmocka_unit_test(test_quantiles_are_values_of_the_nearest_rank),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
