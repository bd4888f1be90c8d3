/** pilot_internal.h - what pilot.c and pilot_script.c share. */
#pragma once
#include "game/play/pilot.h"

enum { PILOT_WORD_SIZE = 64 };

typedef enum pilot_verb {
    PILOT_WALK_TO,
    PILOT_RUN_TO,
    PILOT_LOOK_AT,
    PILOT_TURN_TO,
    PILOT_TAKE,
    PILOT_PLACE_AT,
    PILOT_SPIN,
    PILOT_DROP,
    PILOT_THROW,
    PILOT_JUMP,
    PILOT_RESTART,
    PILOT_CROUCH,
    PILOT_STAND,
    PILOT_WAIT,
    PILOT_WAIT_FOR
} pilot_verb;

typedef struct pilot_step {
    pilot_verb verb;
    char name[PILOT_WORD_SIZE]; /* what it is about; "" for a place */
    double numbers[3];
    double seconds; /* to do it in */
    unsigned line;
    char text[128]; /* as it stands in the script, for messages */
} pilot_step;

struct nook_pilot {
    char file[1024];
    pilot_step *steps;
    uint32_t step_count, step_capacity;
    /* Where it is. */
    uint32_t at;
    uint32_t ticks;   /* in this step */
    uint32_t phase;   /* of steps that are made of several */
    uint32_t settled; /* ticks for which what was wanted was so */
    double spun;      /* degrees so far */
    bool crouched, failed;
};
