#include "engine/core/result.h"
#include "engine/platform/gamepad_internal.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* As it lies on a table: triggers are at -1. */
static GLFWgamepadstate untouched(void)
{
    GLFWgamepadstate state;
    memset(&state, 0, sizeof state);
    state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] = state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] = -1.0f;
    return state;
}

static nook_gamepad take(const GLFWgamepadstate *state)
{
    bool was_down[NOOK_PAD_COUNT] = { false };
    nook_gamepad pad;
    nook_gamepad_take(state, was_down, &pad);
    return pad;
}

static nook_gamepad take_left_stick(float x, float y)
{
    GLFWgamepadstate state = untouched();
    state.axes[GLFW_GAMEPAD_AXIS_LEFT_X] = x;
    state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y] = y;
    return take(&state);
}

static bool near(double a, double b)
{
    return fabs(a - b) < 1e-6;
}

static void test_one_that_nobody_touches_does_nothing(void **state)
{
    (void)state;
    GLFWgamepadstate still = untouched();
    nook_gamepad pad = take(&still);
    assert_true(pad.present && pad.left_trigger == 0.0 && pad.right_trigger == 0.0);
    for (int k = 0; k < 2; k++)
        assert_true(pad.left[k] == 0.0 && pad.right[k] == 0.0);
    for (int i = 0; i < NOOK_PAD_COUNT; i++)
        assert_false(pad.down[i] || pad.pressed[i]);
}

static void test_no_gamepad_is_not_present_and_lets_go_of_everything(void **state)
{
    (void)state;
    bool was_down[NOOK_PAD_COUNT] = { [NOOK_PAD_SOUTH] = true };
    nook_gamepad pad;
    nook_gamepad_take(NULL, was_down, &pad);
    assert_true(!pad.present && !pad.down[NOOK_PAD_SOUTH] && !was_down[NOOK_PAD_SOUTH]);
    assert_true(pad.left_trigger == 0.0 && pad.left[0] == 0.0);
}

static void test_a_worn_stick_in_its_dead_zone_is_quiet_in_every_direction(void **state)
{
    (void)state;
    for (int i = 0; i < 16; i++) {
        const double angle = 6.2831853 * i / 16;
        nook_gamepad pad = take_left_stick((float)(0.149 * cos(angle)), (float)(0.149 * sin(angle)));
        assert_true(pad.left[0] == 0.0 && pad.left[1] == 0.0);
    }
}

static void test_a_stick_grows_from_the_dead_zone_s_rim_to_full_without_a_jump(void **state)
{
    (void)state;
    assert_true(take_left_stick(0.151f, 0.0f).left[0] < 0.002);
    assert_true(near(take_left_stick(0.575f, 0.0f).left[0], 0.5));
    assert_true(near(take_left_stick(1.0f, 0.0f).left[0], 1.0));
    assert_true(near(take_left_stick(-1.0f, 0.0f).left[0], -1.0));
    for (float x = 0.0f; x < 1.0f; x += 0.01f)
        assert_true(take_left_stick(x + 0.01f, 0.0f).left[0] >= take_left_stick(x, 0.0f).left[0]);
}

static void test_a_stick_pushed_away_is_up_and_a_corner_is_no_longer_than_one(void **state)
{
    (void)state;
    assert_true(take_left_stick(0.0f, -1.0f).left[1] > 0.99); /* GLFW's y points down */
    nook_gamepad corner = take_left_stick(1.0f, -1.0f);       /* of a stick in a square gate */
    assert_true(near(hypot(corner.left[0], corner.left[1]), 1.0));
    assert_true(near(corner.left[0], corner.left[1]));
}

static void test_numbers_that_are_none_are_a_stick_in_its_middle(void **state)
{
    (void)state;
    static const float wrong[] = { NAN, INFINITY, -INFINITY };
    for (size_t i = 0; i < NOOK_COUNT(wrong); i++) {
        nook_gamepad pad = take_left_stick(wrong[i], wrong[i]);
        assert_true(pad.left[0] == 0.0 && pad.left[1] == 0.0);
    }
    assert_true(near(take_left_stick(7.0f, 0.0f).left[0], 1.0));
}

static void test_the_right_stick_and_the_triggers_are_their_own(void **state)
{
    (void)state;
    GLFWgamepadstate raw = untouched();
    raw.axes[GLFW_GAMEPAD_AXIS_RIGHT_X] = -1.0f;
    raw.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] = 0.0f;
    raw.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] = 1.0f;
    nook_gamepad pad = take(&raw);
    assert_true(near(pad.right[0], -1.0) && pad.left[0] == 0.0 && pad.right[1] == 0.0);
    assert_true(near(pad.left_trigger, 0.5) && near(pad.right_trigger, 1.0));
}

static void test_a_button_is_pressed_once_and_down_until_it_is_let_go(void **state)
{
    (void)state;
    GLFWgamepadstate raw = untouched();
    bool was_down[NOOK_PAD_COUNT] = { false };
    nook_gamepad pad;
    raw.buttons[GLFW_GAMEPAD_BUTTON_A] = GLFW_PRESS;
    nook_gamepad_take(&raw, was_down, &pad);
    assert_true(pad.pressed[NOOK_PAD_SOUTH] && pad.down[NOOK_PAD_SOUTH]);
    nook_gamepad_take(&raw, was_down, &pad);
    assert_true(!pad.pressed[NOOK_PAD_SOUTH] && pad.down[NOOK_PAD_SOUTH]);
    nook_gamepad_take(NULL, was_down, &pad); /* pulled out and put in again: the press is a new one */
    nook_gamepad_take(&raw, was_down, &pad);
    assert_true(pad.pressed[NOOK_PAD_SOUTH]);
    raw.buttons[GLFW_GAMEPAD_BUTTON_A] = GLFW_RELEASE;
    nook_gamepad_take(&raw, was_down, &pad);
    assert_true(!pad.down[NOOK_PAD_SOUTH]);
}

static void test_every_button_has_its_place(void **state)
{
    (void)state;
    static const struct {
        int theirs;
        nook_pad_button ours;
    } places[] = {
        { GLFW_GAMEPAD_BUTTON_CROSS, NOOK_PAD_SOUTH },
        { GLFW_GAMEPAD_BUTTON_CIRCLE, NOOK_PAD_EAST },
        { GLFW_GAMEPAD_BUTTON_SQUARE, NOOK_PAD_WEST },
        { GLFW_GAMEPAD_BUTTON_TRIANGLE, NOOK_PAD_NORTH },
        { GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, NOOK_PAD_LEFT_BUMPER },
        { GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, NOOK_PAD_RIGHT_BUMPER },
        { GLFW_GAMEPAD_BUTTON_BACK, NOOK_PAD_BACK },
        { GLFW_GAMEPAD_BUTTON_START, NOOK_PAD_START },
        { GLFW_GAMEPAD_BUTTON_LEFT_THUMB, NOOK_PAD_LEFT_THUMB },
        { GLFW_GAMEPAD_BUTTON_RIGHT_THUMB, NOOK_PAD_RIGHT_THUMB },
        { GLFW_GAMEPAD_BUTTON_DPAD_UP, NOOK_PAD_UP },
        { GLFW_GAMEPAD_BUTTON_DPAD_DOWN, NOOK_PAD_DOWN },
        { GLFW_GAMEPAD_BUTTON_DPAD_LEFT, NOOK_PAD_LEFT },
        { GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, NOOK_PAD_RIGHT },
    };
    assert_int_equal(NOOK_COUNT(places), NOOK_PAD_COUNT);
    for (size_t i = 0; i < NOOK_COUNT(places); i++) {
        GLFWgamepadstate raw = untouched();
        raw.buttons[places[i].theirs] = GLFW_PRESS;
        nook_gamepad pad = take(&raw);
        for (int button = 0; button < NOOK_PAD_COUNT; button++)
            assert_int_equal(pad.down[button], button == (int)places[i].ours);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_that_nobody_touches_does_nothing),
        cmocka_unit_test(test_no_gamepad_is_not_present_and_lets_go_of_everything),
        cmocka_unit_test(test_a_worn_stick_in_its_dead_zone_is_quiet_in_every_direction),
        cmocka_unit_test(test_a_stick_grows_from_the_dead_zone_s_rim_to_full_without_a_jump),
        cmocka_unit_test(test_a_stick_pushed_away_is_up_and_a_corner_is_no_longer_than_one),
        cmocka_unit_test(test_numbers_that_are_none_are_a_stick_in_its_middle),
        cmocka_unit_test(test_the_right_stick_and_the_triggers_are_their_own),
        cmocka_unit_test(test_a_button_is_pressed_once_and_down_until_it_is_let_go),
        cmocka_unit_test(test_every_button_has_its_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
