/**
 * trials.h - the settings tried so far, and how what they did in few views is scaled to what they would do in many.
 */
#pragma once
#include "game/tune/search.h"

typedef struct nook_tune_trials {
    const nook_tune_search_desc *desc;
    nook_tune_trial *items; /**< NOOK_TUNE_TRIALS_MAX; owned. */
    uint32_t count;
    uint32_t measurements;
} nook_tune_trials;

/** Whether another setting may be tried. */
bool nook_tune_trials_open(const nook_tune_trials *trials);

/** The trial of a point, or NULL. */
nook_tune_trial *nook_tune_trials_find(const nook_tune_trials *trials, const nook_tune_point *point);

/** Tries a point in the first views, unless it has been. There must be room. @return what measure returned */
nook_result nook_tune_trials_try(nook_tune_trials *trials, const char *doing, const nook_tune_point *point);

/**
 * Measures a trial in that many views. It is timed in all where time is limited, else in half of views_few: the winner is timed again
 * at the end. @return what measure returned
 */
nook_result nook_tune_trials_extend(nook_tune_trials *trials, nook_tune_trial *trial, uint32_t views);

/** How many views a proof needs, as the spread of what was measured so far surely asks for: [views_few, views_max]. */
uint32_t nook_tune_wanted_surely(const nook_tune_search_desc *desc, const nook_tune_estimate *estimate);

/** In how many views a trial must be measured to be told: as its own spread asks for, [views_few, views_max]. */
uint32_t nook_tune_trials_wanted(const nook_tune_trials *trials, const nook_tune_trial *trial);

/**
 * What a trial would do in as many views as any setting of its technique was measured in; of what the goal limits, with the standard
 * error on top that it would have in as many views as are wanted (of the technique, once one was measured in views_few).
 */
nook_tune_cost nook_tune_trials_cost(const nook_tune_trials *trials, const nook_tune_trial *trial);

/** The best by that. @param technique  of the space, or UINT32_MAX: all @return NULL: none was tried */
nook_tune_trial *nook_tune_trials_best(const nook_tune_trials *trials, uint32_t technique);
