/* Frames of a made-up machine: what a frame takes is its load by the part of the pixels that are drawn. */
#include "game/play/picture_fit.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h> /* wants those above first */

static const double budget = 50.0; /* ms: 20 frames a second */

/* What came of some frames. */
typedef struct outcome {
    uint32_t late, changes;
} outcome;

static double frame_ms(const nook_picture_fit *fit, double load)
{
    double scale = nook_picture_fit_scale(fit);
    return load * scale * scale;
}

/* Frames differ by up to +-4 %, always in the same way. */
static outcome play(nook_picture_fit *fit, double load, uint32_t frames)
{
    outcome result = { 0 };
    for (uint32_t i = 0; i < frames; i++) {
        double ms = frame_ms(fit, load) * (0.96 + 0.01 * (i * 5 % 9));
        result.late += ms > budget;
        result.changes += nook_picture_fit_add(fit, ms, budget);
    }
    return result;
}

static void test_frames_in_time_keep_the_whole_picture(void **state)
{
    (void)state;
    nook_picture_fit fit = { .step = 0 };
    outcome result = play(&fit, 44.0, 1000);
    assert_int_equal(result.changes, 0);
    assert_true(nook_picture_fit_scale(&fit) == 1.0);
}

static void test_a_picture_too_large_gets_smaller_at_once_and_by_as_much_as_it_must(void **state)
{
    (void)state;
    for (double load = 52.0; load < 170.0; load += 6.0) {
        nook_picture_fit fit = { .step = 0 };
        outcome begin = play(&fit, load, 20), then = play(&fit, load, 600);
        assert_in_range(begin.late, 3, 8);
        assert_int_equal(then.late, 0);
        assert_in_range(begin.changes + then.changes, 1, 2);
        assert_true(frame_ms(&fit, load) > 0.6 * budget); /* and by no more */
    }
}

static void test_what_no_size_mends_is_drawn_in_the_smallest(void **state)
{
    (void)state;
    nook_picture_fit fit = { .step = 0 };
    play(&fit, 900.0, 100);
    assert_true(nook_picture_fit_scale(&fit) == 0.5);
    assert_int_equal(play(&fit, 900.0, 500).changes, 0);
}

static void test_one_or_two_long_frames_among_twenty_are_chance(void **state)
{
    (void)state;
    nook_picture_fit fit = { .step = 0 };
    for (uint32_t i = 0; i < 400; i++)
        assert_false(nook_picture_fit_add(&fit, i % 20 < 2 ? 300.0 : 40.0, budget));
}

static void test_the_picture_grows_again_when_there_is_time_for_it(void **state)
{
    (void)state;
    nook_picture_fit fit = { .step = 0 };
    play(&fit, 130.0, 100);
    assert_true(nook_picture_fit_scale(&fit) < 0.65);
    outcome result = play(&fit, 30.0, 300);
    assert_true(nook_picture_fit_scale(&fit) == 1.0);
    assert_int_equal(result.late, 0);
}

static void test_a_load_between_two_sizes_does_not_pump(void **state)
{
    (void)state;
    for (double load = 46.0; load < 100.0; load += 0.5) {
        nook_picture_fit fit = { .step = 0 };
        play(&fit, load, 200);
        outcome result = play(&fit, load, 4000);
        assert_true(result.changes <= 2);
        assert_true(result.late <= 3);
    }
}

/* Times follow pixels less than they should, so that a size that promises to be in time never is. */
static void test_a_size_that_has_failed_soon_is_tried_ever_more_rarely(void **state)
{
    (void)state;
    nook_picture_fit fit = { .step = 0 };
    uint32_t tries = 0, in_the_last_half = 0;
    for (uint32_t i = 0; i < 6000; i++) {
        double ms = fit.step == 0 ? 60.0 : 30.0;
        bool changed = nook_picture_fit_add(&fit, ms, budget);
        tries += changed && fit.step == 0;
        in_the_last_half += changed && fit.step == 0 && i >= 3000;
    }
    assert_in_range(tries, 4, 16);
    assert_true(in_the_last_half <= 5); /* without doubts: 45 */
    assert_true(in_the_last_half >= 1); /* it is not given up */
}

static void test_frames_of_a_new_size_settle_before_they_count(void **state)
{
    (void)state;
    nook_picture_fit fit = { .step = 0 };
    play(&fit, 60.0, 20);
    uint32_t step = fit.step;
    assert_true(step > 0);
    nook_picture_fit fresh = { .step = step, .changes = 1 };
    for (uint32_t i = 0; i < 4; i++)
        assert_false(nook_picture_fit_add(&fresh, 500.0, budget));
    assert_int_equal(play(&fresh, 60.0, 100).changes, 0);
}

static void test_without_a_rate_the_picture_is_whole(void **state)
{
    (void)state;
    nook_picture_fit fit = { .step = 0 };
    play(&fit, 130.0, 100);
    assert_true(nook_picture_fit_add(&fit, 500.0, 0.0));
    assert_true(nook_picture_fit_scale(&fit) == 1.0);
    for (uint32_t i = 0; i < 100; i++)
        assert_false(nook_picture_fit_add(&fit, 500.0, 0.0));
}

static void test_sides_are_rounded_and_never_nothing(void **state)
{
    (void)state;
    const nook_picture_fit whole = { .step = 0 }, smaller = { .step = 1 }, least = { .step = 5 };
    assert_int_equal(nook_picture_fit_side(&whole, 360), 360);
    assert_int_equal(nook_picture_fit_side(&smaller, 640), 576);
    assert_int_equal(nook_picture_fit_side(&smaller, 333), 300);
    assert_int_equal(nook_picture_fit_side(&least, 1), 1);
    assert_int_equal(nook_picture_fit_side(&whole, 0), 1);
}

/* 640 x 360 at 0.8 would be 512 wide, and its trace 128. */
static void test_no_side_becomes_a_power_of_two_that_was_none(void **state)
{
    (void)state;
    const nook_picture_fit fit = { .step = 2 };
    assert_int_equal(nook_picture_fit_side(&fit, 640), 508);
    assert_int_equal(nook_picture_fit_side(&fit, 1280), 1020);
    assert_int_equal(nook_picture_fit_side(&fit, 360), 288);
    assert_int_equal(nook_picture_fit_side(&fit, 320), 252); /* 256, 255: half is 128; 254, 253: quarter is 64 */
    assert_int_equal(nook_picture_fit_side(&fit, 1024), 819);
    assert_int_equal(nook_picture_fit_side(&fit, 5), 4); /* nothing else is near */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frames_in_time_keep_the_whole_picture),
        cmocka_unit_test(test_a_picture_too_large_gets_smaller_at_once_and_by_as_much_as_it_must),
        cmocka_unit_test(test_what_no_size_mends_is_drawn_in_the_smallest),
        cmocka_unit_test(test_one_or_two_long_frames_among_twenty_are_chance),
        cmocka_unit_test(test_the_picture_grows_again_when_there_is_time_for_it),
        cmocka_unit_test(test_a_load_between_two_sizes_does_not_pump),
        cmocka_unit_test(test_a_size_that_has_failed_soon_is_tried_ever_more_rarely),
        cmocka_unit_test(test_frames_of_a_new_size_settle_before_they_count),
        cmocka_unit_test(test_without_a_rate_the_picture_is_whole),
        cmocka_unit_test(test_no_side_becomes_a_power_of_two_that_was_none),
        cmocka_unit_test(test_sides_are_rounded_and_never_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
