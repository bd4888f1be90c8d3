/**
 * tune_progress.h - how far the search is, on standard error: one line that is rewritten on a terminal, else a line now and then.
 */
#pragma once
#include "game/progress.h"
#include "game/tune/trial.h"

typedef struct nook_tune_progress {
    const nook_tune_goal *goal; /**< Borrowed. */
    uint32_t tries_max;
    double started_ms, shown_ms;
    bool terminal, shown;
    nook_progress
        whole; /**< For what is inside (nook_progress_begin_within): where there is no terminal, these lines are all. */
} nook_tune_progress;

nook_tune_progress nook_tune_progress_begin(const nook_tune_goal *goal, uint32_t tries_max);
/** @param best  so far; NULL: none yet */
void nook_tune_progress_search(nook_tune_progress *progress, const char *doing, uint32_t tried,
                               const nook_tune_trial *best);
/** @param held_back  the cameras that nothing was chosen by; before these the winner is timed afresh in the others */
void nook_tune_progress_proof(nook_tune_progress *progress, bool held_back, uint32_t view, uint32_t views);
/** Clears the line. */
void nook_tune_progress_end(nook_tune_progress *progress);
