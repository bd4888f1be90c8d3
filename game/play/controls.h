/**
 * controls.h - from keys, mouse and gamepad of a frame to the inputs of its ticks.
 *
 *   W A S D, arrows   walk           left stick         mouse         look           right stick
 *   Shift             run            left trigger       Space         jump           A / cross
 *   Ctrl, C           crouch         B / circle         E, click      take, let go   X / square
 *   Q, right click    throw          right trigger      R, held       turn it        right bumper
 *   Backspace, twice  from the start again              Back, twice
 *
 * What is pressed in a menu and still held when it closes is not the game's. From the start again is minutes of play thrown away: the
 * first press asks, the second does it; where a try is over there is nothing to lose, and the first does it.
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
    uint16_t not_ours; /**< Buttons that count again when they were let go. */
    bool try_is_over;  /**< Yours to set. */
    double asks_for;   /**< Seconds for which a second press still means from the start again; 0: nobody has asked. */
    nook_play_input held;
} nook_controls;

/** Takes in what came since the last frame. @param seconds of that frame: sticks turn with time, mice do not */
void nook_controls_add(nook_controls *controls, const nook_input *input, const nook_preferences *preferences,
                       double seconds);
/** The same of a frame whose input went to a menu: what is held in it waits to be let go. */
void nook_controls_skip(nook_controls *controls, const nook_input *input);
/** The next tick's input: all turning and pressing that came goes into the first tick after it. */
nook_play_input nook_controls_take(nook_controls *controls);
