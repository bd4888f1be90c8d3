#include "game/play/controls.h"
#include <math.h>

static const double turns_per_degree = 65536.0 / 360.0;
static const double asks_for_seconds = 3.0; /* time to read the question */

/* Two directions of keys and one of a stick, as a part of the walking speed. */
static double axis(bool minus, bool plus, double stick)
{
    return fmin(fmax((plus ? 1.0 : 0.0) - (minus ? 1.0 : 0.0) + stick, -1.0), 1.0);
}

/* A key that was down for less than a frame counts for that frame: where frames are long, a step to the side is one. */
static bool is_held(const nook_input *input, nook_key key, nook_key other)
{
    return input->down[key] || input->pressed[key] || input->down[other] || input->pressed[other];
}

static uint16_t held_buttons(const nook_input *input)
{
    const bool *down = input->down;
    const nook_gamepad *pad = &input->pad;
    uint16_t buttons = 0;
    if (down[NOOK_KEY_SPACE] || pad->down[NOOK_PAD_SOUTH])
        buttons |= NOOK_PLAY_JUMP;
    if (down[NOOK_KEY_SHIFT] || pad->left_trigger > 0.5)
        buttons |= NOOK_PLAY_RUN;
    if (down[NOOK_KEY_CONTROL] || down[NOOK_KEY_C] || pad->down[NOOK_PAD_EAST])
        buttons |= NOOK_PLAY_CROUCH;
    if (down[NOOK_KEY_R] || pad->down[NOOK_PAD_RIGHT_BUMPER])
        buttons |= NOOK_PLAY_TURN;
    return buttons;
}

/* Whether the player wants from the start again, and means it. */
static bool is_restart_meant(nook_controls *controls, const nook_input *input, double seconds)
{
    bool meant = controls->try_is_over || controls->asks_for > 0.0;
    controls->asks_for = fmax(controls->asks_for - seconds, 0.0);
    if (!input->pressed[NOOK_KEY_BACKSPACE] && !input->pad.pressed[NOOK_PAD_BACK])
        return false;
    controls->asks_for = meant ? 0.0 : asks_for_seconds;
    return meant;
}

/* A jump is in both: a key that was down for less than a frame counts too. */
static uint16_t pressed_buttons(nook_controls *controls, const nook_input *input)
{
    const bool *pressed = input->pressed;
    const nook_gamepad *pad = &input->pad;
    bool trigger = pad->right_trigger > 0.5;
    uint16_t buttons = 0;
    if (pressed[NOOK_KEY_SPACE] || pad->pressed[NOOK_PAD_SOUTH])
        buttons |= NOOK_PLAY_JUMP;
    if (pressed[NOOK_KEY_E] || input->mouse_pressed[0] || pad->pressed[NOOK_PAD_WEST])
        buttons |= NOOK_PLAY_TAKE;
    if (pressed[NOOK_KEY_Q] || input->mouse_pressed[1] || (trigger && !controls->thrown))
        buttons |= NOOK_PLAY_THROW;
    controls->thrown = trigger;
    return buttons;
}

void nook_controls_add(nook_controls *controls, const nook_input *input, const nook_preferences *preferences,
                       double seconds)
{
    const nook_gamepad *pad = &input->pad;
    double mouse = (double)preferences->mouse_speed * turns_per_degree;
    double stick = (double)preferences->pad_speed * seconds * turns_per_degree;
    double up = preferences->invert_y ? -1.0 : 1.0;
    controls->yaw += -input->mouse_dx * mouse - pad->right[0] * stick;
    controls->pitch += (-input->mouse_dy * mouse + pad->right[1] * stick) * up;
    double right =
        axis(is_held(input, NOOK_KEY_A, NOOK_KEY_LEFT), is_held(input, NOOK_KEY_D, NOOK_KEY_RIGHT), pad->left[0]);
    double forward =
        axis(is_held(input, NOOK_KEY_S, NOOK_KEY_DOWN), is_held(input, NOOK_KEY_W, NOOK_KEY_UP), pad->left[1]);
    controls->held.right = (int8_t)lround(127.0 * right);
    controls->held.forward = (int8_t)lround(127.0 * forward);
    uint16_t held = held_buttons(input);
    controls->not_ours &= held;
    controls->held.buttons = held & (uint16_t)~controls->not_ours;
    controls->pressed |= pressed_buttons(controls, input);
    if (is_restart_meant(controls, input, seconds))
        controls->pressed |= NOOK_PLAY_RESTART;
}

void nook_controls_skip(nook_controls *controls, const nook_input *input)
{
    controls->not_ours = held_buttons(input);
    controls->thrown = input->pad.right_trigger > 0.5;
    controls->asks_for = 0.0;
}

/* Takes whole steps; what is left of one waits for the next tick. */
static int16_t take_turn(double *turn)
{
    double whole = fmin(fmax(trunc(*turn), INT16_MIN), INT16_MAX);
    *turn -= whole;
    return (int16_t)whole;
}

nook_play_input nook_controls_take(nook_controls *controls)
{
    nook_play_input input = controls->held;
    input.buttons |= controls->pressed;
    input.yaw = take_turn(&controls->yaw);
    input.pitch = take_turn(&controls->pitch);
    controls->pressed = 0;
    return input;
}
