#include "game/play/controls.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h> /* wants those above first */

static nook_preferences likings(void)
{
    nook_preferences preferences;
    nook_preferences_reset(&preferences);
    return preferences;
}

static nook_play_input take_after(const nook_input *input, double seconds)
{
    nook_controls controls = { 0 };
    nook_preferences preferences = likings();
    nook_controls_add(&controls, input, &preferences, seconds);
    return nook_controls_take(&controls);
}

static void test_nothing_pressed_is_an_input_of_zeros(void **state)
{
    (void)state;
    const nook_input idle = { 0 };
    nook_play_input input = take_after(&idle, 0.1);
    assert_int_equal(input.right, 0);
    assert_int_equal(input.forward, 0);
    assert_int_equal(input.buttons, 0);
    assert_int_equal(input.yaw, 0);
    assert_int_equal(input.pitch, 0);
}

static void test_opposite_keys_cancel_and_a_stick_adds_up_to_full_speed_only(void **state)
{
    (void)state;
    nook_input input = { 0 };
    input.down[NOOK_KEY_W] = input.down[NOOK_KEY_DOWN] = true;
    input.down[NOOK_KEY_D] = true;
    input.pad.left[0] = 0.7;
    nook_play_input out = take_after(&input, 0.1);
    assert_int_equal(out.forward, 0);
    assert_int_equal(out.right, 127);
}

static void test_a_press_and_a_turn_go_into_one_tick_and_holding_into_all(void **state)
{
    (void)state;
    nook_controls controls = { 0 };
    nook_preferences preferences = likings();
    nook_input input = { 0 };
    input.pressed[NOOK_KEY_E] = true;
    input.down[NOOK_KEY_SHIFT] = true;
    input.mouse_dx = -100.0; /* 12 degrees to the left */
    nook_controls_add(&controls, &input, &preferences, 0.05);
    nook_play_input first = nook_controls_take(&controls), second = nook_controls_take(&controls);
    assert_int_equal(first.buttons, NOOK_PLAY_TAKE | NOOK_PLAY_RUN);
    assert_int_equal(second.buttons, NOOK_PLAY_RUN);
    assert_in_range(first.yaw, 2184, 2185); /* 12 / 360 of 65536 */
    assert_int_equal(second.yaw, 0);
}

static void test_a_key_that_was_down_for_less_than_a_frame_walks_for_it(void **state)
{
    (void)state;
    nook_controls controls = { 0 };
    nook_preferences preferences = likings();
    nook_input input = { 0 };
    input.pressed[NOOK_KEY_A] = input.pressed[NOOK_KEY_UP] = true;
    nook_controls_add(&controls, &input, &preferences, 0.05);
    for (int i = 0; i < 2; i++) { /* ticks of that frame */
        nook_play_input out = nook_controls_take(&controls);
        assert_int_equal(out.right, -127);
        assert_int_equal(out.forward, 127);
    }
    const nook_input idle = { 0 };
    nook_controls_add(&controls, &idle, &preferences, 0.05);
    nook_play_input out = nook_controls_take(&controls);
    assert_true(out.right == 0 && out.forward == 0);
}

static void test_parts_of_a_step_are_not_lost(void **state)
{
    (void)state;
    nook_controls controls = { 0 };
    nook_preferences preferences = likings();
    preferences.mouse_speed = 0.01f; /* 1.82 steps a pixel */
    nook_input input = { .mouse_dx = 1.0 };
    int sum = 0;
    for (int i = 0; i < 1000; i++) {
        nook_controls_add(&controls, &input, &preferences, 0.01);
        sum += nook_controls_take(&controls).yaw;
    }
    assert_in_range(-sum, 1819, 1821);
}

static void test_a_stick_turns_with_time_and_a_mouse_does_not(void **state)
{
    (void)state;
    const nook_input stick = { .pad = { .right = { 1.0, 0.0 } } }, mouse = { .mouse_dx = 10.0 };
    assert_in_range(take_after(&stick, 0.02).yaw / (double)take_after(&stick, 0.01).yaw * 100.0, 199, 201);
    assert_int_equal(take_after(&mouse, 0.02).yaw, take_after(&mouse, 0.01).yaw);
}

static void test_looking_up_is_up_unless_it_is_inverted(void **state)
{
    (void)state;
    nook_controls controls = { 0 };
    nook_preferences preferences = likings();
    const nook_input away = { .mouse_dy = -50.0 };
    assert_true(take_after(&away, 0.01).pitch > 0);
    preferences.invert_y = 1;
    nook_controls_add(&controls, &away, &preferences, 0.01);
    assert_true(nook_controls_take(&controls).pitch < 0);
}

static void test_a_trigger_throws_once_until_it_is_let_go(void **state)
{
    (void)state;
    nook_controls controls = { 0 };
    nook_preferences preferences = likings();
    nook_input input = { .pad = { .right_trigger = 1.0 } };
    for (int i = 0; i < 3; i++) {
        nook_controls_add(&controls, &input, &preferences, 0.01);
        assert_int_equal(nook_controls_take(&controls).buttons & NOOK_PLAY_THROW, i == 0 ? NOOK_PLAY_THROW : 0);
    }
    input.pad.right_trigger = 0.0;
    nook_controls_add(&controls, &input, &preferences, 0.01);
    input.pad.right_trigger = 1.0;
    nook_controls_add(&controls, &input, &preferences, 0.01);
    assert_int_equal(nook_controls_take(&controls).buttons, NOOK_PLAY_THROW);
}

static void test_what_is_held_when_a_menu_closes_counts_when_it_is_pressed_again(void **state)
{
    (void)state;
    nook_controls controls = { .yaw = 0.0 };
    nook_preferences preferences;
    nook_input input = { .pad = { .present = true, .down = { [NOOK_PAD_SOUTH] = true }, .right_trigger = 1.0 } };
    nook_preferences_reset(&preferences);
    nook_controls_skip(&controls, &input);
    for (int frame = 0; frame < 2; frame++) {
        nook_controls_add(&controls, &input, &preferences, 0.016);
        assert_int_equal(nook_controls_take(&controls).buttons, 0);
    }
    const nook_input let_go = { .pad = { .present = true } };
    nook_controls_add(&controls, &let_go, &preferences, 0.016);
    nook_controls_add(&controls, &input, &preferences, 0.016);
    assert_int_equal(nook_controls_take(&controls).buttons, NOOK_PLAY_JUMP | NOOK_PLAY_THROW);
}

/* A frame in which Backspace, or the gamepad's Back, went down. @return whether it is from the start again */
static bool restarts_after(nook_controls *controls, bool key, bool pad, double seconds)
{
    nook_preferences preferences = likings();
    nook_input input = { 0 };
    input.pressed[NOOK_KEY_BACKSPACE] = key;
    input.pad.pressed[NOOK_PAD_BACK] = pad;
    nook_controls_add(controls, &input, &preferences, seconds);
    return (nook_controls_take(controls).buttons & NOOK_PLAY_RESTART) != 0;
}

static void test_from_the_start_again_is_asked_by_the_first_press_and_done_by_the_second(void **state)
{
    (void)state;
    for (int pad = 0; pad < 2; pad++) {
        nook_controls controls = { 0 };
        assert_false(restarts_after(&controls, !pad, pad, 0.1));
        assert_true(controls.asks_for > 2.0);
        assert_false(restarts_after(&controls, false, false, 2.0)); /* time to read it */
        assert_true(restarts_after(&controls, !pad, pad, 0.1));
        assert_true(controls.asks_for == 0.0);
        assert_false(restarts_after(&controls, !pad, pad, 0.1)); /* the next try is another question */
    }
}

static void test_a_press_by_mistake_is_forgotten_and_so_is_one_before_a_pause(void **state)
{
    (void)state;
    nook_controls controls = { 0 };
    const nook_input idle = { 0 };
    assert_false(restarts_after(&controls, true, false, 0.1));
    assert_false(restarts_after(&controls, false, false, 5.0));
    assert_true(controls.asks_for == 0.0);
    assert_false(restarts_after(&controls, true, false, 0.1));
    nook_controls_skip(&controls, &idle);
    assert_false(restarts_after(&controls, true, false, 0.1));
}

static void test_where_a_try_is_over_one_press_begins_the_next(void **state)
{
    (void)state;
    nook_controls controls = { .try_is_over = true };
    assert_true(restarts_after(&controls, true, false, 0.1));
    assert_true(controls.asks_for == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_pressed_is_an_input_of_zeros),
        cmocka_unit_test(test_opposite_keys_cancel_and_a_stick_adds_up_to_full_speed_only),
        cmocka_unit_test(test_a_press_and_a_turn_go_into_one_tick_and_holding_into_all),
        cmocka_unit_test(test_a_key_that_was_down_for_less_than_a_frame_walks_for_it),
        cmocka_unit_test(test_parts_of_a_step_are_not_lost),
        cmocka_unit_test(test_a_stick_turns_with_time_and_a_mouse_does_not),
        cmocka_unit_test(test_looking_up_is_up_unless_it_is_inverted),
        cmocka_unit_test(test_a_trigger_throws_once_until_it_is_let_go),
        cmocka_unit_test(test_what_is_held_when_a_menu_closes_counts_when_it_is_pressed_again),
        cmocka_unit_test(test_from_the_start_again_is_asked_by_the_first_press_and_done_by_the_second),
        cmocka_unit_test(test_a_press_by_mistake_is_forgotten_and_so_is_one_before_a_pause),
        cmocka_unit_test(test_where_a_try_is_over_one_press_begins_the_next),
    };
    return cmocka_run_group_tests_name("controls", tests, NULL, NULL);
}
