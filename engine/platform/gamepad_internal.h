/**
 * gamepad_internal.h - from what GLFW says of a gamepad to ours: pure numbers, without a device. Not for use outside engine/platform.
 */
#pragma once
#include "engine/platform/context.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

/**
 * @param state  NULL: there is none, and everything is let go
 * @param was_down  buttons at the last call; becomes those of now
 */
void nook_gamepad_take(const GLFWgamepadstate *state, bool was_down[NOOK_PAD_COUNT], nook_gamepad *out);
