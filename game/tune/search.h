/**
 * search.h - finds the setting of a space that serves a goal best, from few measurements. It knows nothing of scenes: what a setting does
 * in a view is asked of a callback.
 *
 *   anchors   every technique at a few settings, in the first views alone; techniques that are far from the budget are dropped
 *   descent   from the best anchor of each: one step along every axis, then the combinations that these steps promise most, again from
 *             where that led, with smaller steps
 *   confirm   the best in many views, twice as many at a time; views differ, so what the first ones said is scaled by what many say of
 *             another setting of the technique, and what then looks best is measured in many views too, until the best one is
 *
 * Within the budget is what is so with one standard error on top.
 */
#pragma once
#include "game/tune/trial.h"

enum { NOOK_TUNE_TRIALS_MAX = 256, NOOK_TUNE_TRIES_DEFAULT = 70 };

typedef struct nook_tune_search_desc {
    const nook_tune_space *space;
    nook_tune_goal goal;
    uint32_t views_first; /**< In these every setting is tried; [1, views_few]. */
    uint32_t views_few;   /**< In these the best ones. */
    uint32_t views_max;   /**< The winner in as many as its own spread asks for, at most this; NOOK_TUNE_VIEWS_MAX. */
    uint32_t period;      /**< Numbers of views are multiples of it where there is room; 1: any. */
    double part;          /**< Wanted accuracy of the error, see nook_tune_views_needed; 0: take views_max. */
    uint32_t tries_max;   /**< Settings; at most NOOK_TUNE_TRIALS_MAX. */
    /** Measures a setting in a view. @param timed  false: ms may be NaN @return why not: the search ends with it */
    nook_result (*measure)(void *user, const nook_setting *setting, uint32_t view, bool timed, nook_tune_view *out);
    /**
     * In how many views the winner must be measured, asked when it was in as many as its own spread asks for; NULL: no more than those.
     * @param out_views  at most views_max
     */
    nook_result (*ask)(void *user, const nook_tune_trial *winner, uint32_t *out_views);
    /** Told before each setting; NULL: nobody. @param best  so far, NULL at first */
    void (*tell)(void *user, const char *doing, uint32_t tried, const nook_tune_trial *best);
    void *user;
} nook_tune_search_desc;

typedef struct nook_tune_outcome {
    nook_tune_trial best;        /**< When nothing fits, the nearest. */
    nook_tune_estimate estimate; /**< Of it, by what it was chosen by. */
    bool fits;                   /**< The estimate does, with one standard error on top: nook_tune_with_margin. */
    bool settled;                /**< false: something else promised more to the last, but never held in more views. */
    uint32_t tried;              /**< Settings. */
    uint32_t measurements;       /**< Settings x views. */
} nook_tune_outcome;

/** @return what measure or ask returned, NOOK_E_MEMORY; *out is untouched then */
nook_result nook_tune_search(const nook_tune_search_desc *desc, nook_tune_outcome *out);
