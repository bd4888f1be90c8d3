/**
 * host_internal.h - the inside of a host, shared by host.c, swap.c and trial.c only.
 */
#pragma once
#include "engine/module/guard.h"
#include "engine/module/host.h"
#include "engine/module/module_image_internal.h"

/** A module's place: what runs, what ran before it until that has proved itself, and what is about to run. */
typedef struct nook_module_slot {
    const nook_module_builtin *builtin;
    nook_module_image now, before, next; /* zero: none */
    bool swapped;                        /* `before` ran until the exchange under way */
    nook_file_mark refused;              /* the file that was refused or put back last */
} nook_module_slot;

typedef enum nook_module_trial {
    NOOK_TRIAL_NONE,
    NOOK_TRIAL_NEW, /* the next frame is the first of new code */
    NOOK_TRIAL_OLD  /* ... the first after old code was put back */
} nook_module_trial;

/** What becomes of the state in an exchange of the main module. */
typedef enum nook_module_fate { NOOK_STATE_KEPT, NOOK_STATE_MIGRATED, NOOK_STATE_MADE } nook_module_fate;

struct nook_module_host {
    nook_module_builtin main;
    nook_module_arguments arguments;
    bool stop_asked;
    nook_live_folder folder;                           /* path "": none */
    nook_interface *program;                           /* of the executable; read when the first library comes */
    nook_module_slot slots[1 + NOOK_MODULE_PARTS_MAX]; /* the main module first */
    uint32_t slot_count;
    nook_module_part parts[NOOK_MODULE_PARTS_MAX]; /* as the main module sees them */
    void *state, *state_before;                    /* before: as it was until it was migrated; else NULL */
    bool main_layout_differs;                      /* in the exchange under way */
    nook_module_fate fate;                         /* the same */
    nook_module_trial trial;
    bool look_again; /* at what was built: what is left of it may do without what was put back */
    char message[NOOK_LIVE_TEXT_MAX];
    uint32_t swaps, refusals, kept, made;
    double swap_ms, swap_start_ms;
};

/* swap.c: finds what was built and puts it in place. @return why even the last good code does not run */
nook_result nook_module_host_look_for_code(nook_module_host *host);

/* state.c: calls into the main module that may fail or crash. @return false: *out_reason says why */
bool nook_module_host_create_state(nook_module_host *host, nook_module_reason *out_reason);
/* Lets new code have the state of the old, or makes it anew. */
bool nook_module_host_take_state_over(nook_module_host *host, nook_module_reason *out_reason);
/* Stops what runs code of modules. */
void nook_module_host_suspend(nook_module_host *host);
/* Tells the main module that code was exchanged. */
bool nook_module_host_resume(nook_module_host *host, nook_module_reason *out_reason);
bool nook_module_host_guarded_frame(nook_module_host *host, bool *out_running, nook_module_reason *out_reason);
/* What new code had made of the state goes; the main slot must hold the new code still. */
void nook_module_host_drop_state(nook_module_host *host);
nook_module_news nook_module_host_news(const nook_module_host *host);

/* trial.c */
/* The first frame of new or of old code. @return why even the last good code does not run */
nook_result nook_module_host_try_frame(nook_module_host *host, bool *out_running);
/* Puts the code before in the place of what was exchanged, and the state with it. @return the same */
nook_result nook_module_host_put_back(nook_module_host *host, const nook_module_reason *reason);
/* Logs a refusal and keeps it for the screen. */
void nook_module_host_say(nook_module_host *host, const nook_module_reason *reason);
