/**
 * surrogate.h - what the settings of a technique that were not tried would do, by those that were: a fit, to say which is worth trying next.
 */
#pragma once
#include "game/tune/trials.h"

/* Per axis of the space two coefficients at most for each rung of an unordered one; one more for the constant. */
enum { NOOK_TUNE_TERMS_MAX = 48 };

/**
 * Logarithms of error and ms are sums of one function for each axis: of ordered axes a parabola over the rungs, of others a number for
 * each rung. Trials that do much the same as the technique's best one count most.
 */
typedef struct nook_tune_surrogate {
    const nook_tune_ladders *ladders;
    nook_tune_point centre;
    double error[NOOK_TUNE_TERMS_MAX], ms[NOOK_TUNE_TERMS_MAX];
    uint32_t terms;
} nook_tune_surrogate;

/** @return false: too little is known (an error of 0) */
bool nook_tune_surrogate_fit(const nook_tune_trials *trials, uint32_t technique, nook_tune_surrogate *out);

nook_tune_cost nook_tune_surrogate_predict(const nook_tune_surrogate *surrogate, const nook_tune_point *point);

/**
 * The setting that promises most of those not tried.
 * @param goal  for what @param best  what is to be bettered
 * @return false: none promises to
 */
bool nook_tune_surrogate_choose(const nook_tune_surrogate *surrogate, const nook_tune_trials *trials,
                                const nook_tune_goal *goal, const nook_tune_cost *best, nook_tune_point *out_point);
