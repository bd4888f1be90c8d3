/**
 * tune_run.h - the whole of `tune`: search, proof, and what came of them.
 */
#pragma once
#include "game/stage.h"
#include "game/tune/search.h"
#include "game/tune/tune_options.h"

/** Within this part of the predicted error the actual one must be. */
#define NOOK_TUNE_TOLERANCE 0.15
/** Truths may have this part of the error as noise of their own before that is said: in quadrature it is 3 % of the error. */
#define NOOK_TUNE_TRUTH_NOISE 0.25

typedef struct nook_tune_result {
    nook_tune_outcome outcome;
    nook_tune_estimate
        predicted; /**< outcome.estimate, timed afresh when something fits: in all its views where time is limited, else in 8. */
    nook_tune_estimate actual;  /**< On the held-back cameras; zero when nothing fits. */
    double difference;          /**< actual / predicted error - 1. */
    double difference_standard; /**< Its standard error, as far as it comes from the choice of cameras. */
    bool near;                  /**< |difference| <= NOOK_TUNE_TOLERANCE. */
    bool error_holds;           /**< The actual error is not over the budget by more than its standard error. */
    bool ms_holds;   /**< Neither time is over the budget by more than the spread of its own frames (ms_spread). */
    bool holds;      /**< Something fits, and all three. */
    double settings; /**< How many there are. */
    double r_max;    /**< Metres. */
    char falloff[32];
    double seconds;
} nook_tune_result;

/** @param stage  opened, not filled @return why it could not be done; *out is untouched then */
nook_result nook_tune_run(nook_stage *stage, const nook_tune_options *options, nook_tune_result *out);
