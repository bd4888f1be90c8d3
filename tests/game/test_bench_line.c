#include "game/commands/bench_line.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void test_points_on_a_line_are_found_to_lie_on_it(void **state)
{
    (void)state;
    const double x[] = { 1, 2, 5, 9 }, y[] = { 5, 7, 13, 21 };
    const nook_bench_line line = nook_bench_line_fit(x, y, 4);
    assert_true(fabs(line.start - 3.0) < 1e-12 && fabs(line.slope - 2.0) < 1e-12);
    assert_true(line.residual < 1e-12 && fabs(line.determination - 1.0) < 1e-12);
}

/* y = x^2 at 0, 1, 2, 3: the line is 3 x - 1, the points are off it by 1, -1, -1, 1, their mean is 3.5, their variance 12.25. */
static void test_points_off_the_line_say_by_how_much(void **state)
{
    (void)state;
    const double x[] = { 0, 1, 2, 3 }, y[] = { 0, 1, 4, 9 };
    const nook_bench_line line = nook_bench_line_fit(x, y, 4);
    assert_true(fabs(line.start + 1.0) < 1e-12 && fabs(line.slope - 3.0) < 1e-12);
    assert_true(fabs(line.residual - 1.0 / 3.5) < 1e-12);
    assert_true(fabs(line.determination - (1.0 - 1.0 / 12.25)) < 1e-12);
}

static void test_a_level_line_accounts_for_everything(void **state)
{
    (void)state;
    const double x[] = { 1, 2, 3 }, y[] = { 4, 4, 4 };
    const nook_bench_line line = nook_bench_line_fit(x, y, 3);
    assert_true(line.slope == 0.0 && line.start == 4.0 && line.residual == 0.0 && line.determination == 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points_on_a_line_are_found_to_lie_on_it),
        cmocka_unit_test(test_points_off_the_line_say_by_how_much),
        cmocka_unit_test(test_a_level_line_accounts_for_everything),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
