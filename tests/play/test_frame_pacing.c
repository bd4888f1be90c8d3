#include "game/play/play_window.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h> /* wants those above first */

static void test_quantiles_of_known_frames_are_the_nearest_rank(void **state)
{
    (void)state;
    nook_frame_pacing pacing = { .count = 0 };
    for (int i = 10; i >= 1; i--)
        nook_frame_pacing_add(&pacing, i);
    assert_true(nook_frame_pacing_quantile(&pacing, 0.5) == 5.0);
    assert_true(nook_frame_pacing_quantile(&pacing, 0.0) == 1.0);
    assert_true(nook_frame_pacing_quantile(&pacing, 0.95) == 10.0);
    assert_true(nook_frame_pacing_quantile(&pacing, 7.0) == 10.0);
}

static void test_no_frames_have_no_quantile(void **state)
{
    (void)state;
    const nook_frame_pacing pacing = { .count = 0 };
    assert_true(nook_frame_pacing_quantile(&pacing, 0.5) == 0.0);
}

static void test_old_frames_are_forgotten(void **state)
{
    (void)state;
    nook_frame_pacing pacing = { .count = 0 };
    for (int i = 0; i < 10; i++)
        nook_frame_pacing_add(&pacing, 500.0);
    for (int i = 0; i < NOOK_PLAY_HISTORY; i++)
        nook_frame_pacing_add(&pacing, 20.0);
    assert_true(nook_frame_pacing_quantile(&pacing, 1.0) == 20.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quantiles_of_known_frames_are_the_nearest_rank),
        cmocka_unit_test(test_no_frames_have_no_quantile),
        cmocka_unit_test(test_old_frames_are_forgotten),
    };
    return cmocka_run_group_tests_name("frame pacing", tests, NULL, NULL);
}
