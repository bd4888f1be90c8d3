#pragma once
#include <stdint.h>

/** What a player can do in a tick; bits of nook_play_input.buttons. Held, but where it says pressed. */
enum {
    NOOK_PLAY_JUMP = 1,
    NOOK_PLAY_RUN = 2,
    NOOK_PLAY_CROUCH = 4,
    NOOK_PLAY_TAKE = 8,     /**< Pressed: takes what is looked at, or lets go of what is carried. */
    NOOK_PLAY_THROW = 16,   /**< Pressed: throws what is carried. */
    NOOK_PLAY_RESTART = 32, /**< Pressed: from the start again. */
    NOOK_PLAY_TURN = 64     /**< Turns what is carried instead of the head. */
};

/** All that a tick takes from outside, in whole numbers: recordings of it play back bit for bit. */
typedef struct nook_play_input {
    int8_t right, forward; /**< [-127, 127] of the walking speed. */
    uint16_t buttons;      /**< NOOK_PLAY_*. */
    int16_t yaw, pitch;    /**< Turn since the last tick, in 1/65536 of a full turn; + left, + up. */
} nook_play_input;
