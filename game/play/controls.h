/**
 * controls.h - from keys, mouse and gamepad of a frame to the inputs of its ticks.
 *
 *   W A S D, arrows   walk           left stick         mouse         look           right stick
 *   Shift             run            left trigger       Space         jump           A / cross
 *   Ctrl, C           crouch         B / circle         E, click      take, let go   X / square
 *   Q, right click    throw          right trigger      R, held       turn it        right bumper
 *   Backspace         from the start again              Back
 */
#pragma once
#include "engine/platform/context.h"
#include "game/play/play_input.h"
#include "game/play/preferences.h"

/** What has come in and no tick has taken yet. Zeroed is nothing. */
typedef struct nook_controls {
    double yaw, pitch; /**< 1/65536 of a full turn. */
    uint16_t pressed;  /**< Buttons that count once. */
    bool thrown;       /**< The trigger that throws was down at the last frame. */
    nook_play_input held;
} nook_controls;

/** Takes in what came since the last frame. @param seconds of that frame: sticks turn with time, mice do not */
void nook_controls_add(nook_controls *controls, const nook_input *input, const nook_preferences *preferences,
                       double seconds);
/** The next tick's input: all turning and pressing that came goes into the first tick after it. */
nook_play_input nook_controls_take(nook_controls *controls);
