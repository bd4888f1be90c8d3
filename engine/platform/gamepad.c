#include "engine/platform/gamepad_internal.h"
#include <math.h>
#include <string.h>

static const double dead_zone = 0.15; /* of a stick's way: worn ones do not come back to their middle */

static const int buttons[NOOK_PAD_COUNT] = {
    [NOOK_PAD_SOUTH] = GLFW_GAMEPAD_BUTTON_A,
    [NOOK_PAD_EAST] = GLFW_GAMEPAD_BUTTON_B,
    [NOOK_PAD_WEST] = GLFW_GAMEPAD_BUTTON_X,
    [NOOK_PAD_NORTH] = GLFW_GAMEPAD_BUTTON_Y,
    [NOOK_PAD_LEFT_BUMPER] = GLFW_GAMEPAD_BUTTON_LEFT_BUMPER,
    [NOOK_PAD_RIGHT_BUMPER] = GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER,
    [NOOK_PAD_BACK] = GLFW_GAMEPAD_BUTTON_BACK,
    [NOOK_PAD_START] = GLFW_GAMEPAD_BUTTON_START,
    [NOOK_PAD_LEFT_THUMB] = GLFW_GAMEPAD_BUTTON_LEFT_THUMB,
    [NOOK_PAD_RIGHT_THUMB] = GLFW_GAMEPAD_BUTTON_RIGHT_THUMB,
    [NOOK_PAD_UP] = GLFW_GAMEPAD_BUTTON_DPAD_UP,
    [NOOK_PAD_DOWN] = GLFW_GAMEPAD_BUTTON_DPAD_DOWN,
    [NOOK_PAD_LEFT] = GLFW_GAMEPAD_BUTTON_DPAD_LEFT,
    [NOOK_PAD_RIGHT] = GLFW_GAMEPAD_BUTTON_DPAD_RIGHT,
};

/* A driver's number may be anything. */
static double in_range(float value)
{
    return isfinite(value) ? fmax(-1.0, fmin(1.0, (double)value)) : 0.0;
}

/* A stick's two axes, its middle made quiet; what lies outside of that starts from 0 again. */
static void read_stick(const float axes[2], double out[2])
{
    double x = in_range(axes[0]), y = -in_range(axes[1]); /* GLFW's y points down */
    double length = sqrt(x * x + y * y);
    double scale = length > dead_zone ? fmin((length - dead_zone) / (1.0 - dead_zone), 1.0) / length : 0.0;
    out[0] = x * scale;
    out[1] = y * scale;
}

void nook_gamepad_take(const GLFWgamepadstate *state, bool was_down[NOOK_PAD_COUNT], nook_gamepad *out)
{
    *out = (nook_gamepad){ .present = state != NULL };
    for (int i = 0; i < NOOK_PAD_COUNT; i++) {
        out->down[i] = state && state->buttons[buttons[i]] == GLFW_PRESS;
        out->pressed[i] = out->down[i] && !was_down[i];
    }
    memcpy(was_down, out->down, sizeof out->down);
    if (!state)
        return;
    read_stick(&state->axes[GLFW_GAMEPAD_AXIS_LEFT_X], out->left);
    read_stick(&state->axes[GLFW_GAMEPAD_AXIS_RIGHT_X], out->right);
    out->left_trigger = 0.5 + 0.5 * in_range(state->axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER]);
    out->right_trigger = 0.5 + 0.5 * in_range(state->axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER]);
}
