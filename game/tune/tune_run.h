/**
 * tune_run.h - the whole of `tune`: search, proof, and what came of them.
 */
#pragma once
#include "game/stage.h"
#include "game/tune/search.h"
#include "game/tune/tune_options.h"

/** Within this part of the predicted error the actual one must be. */
#define NOOK_TUNE_TOLERANCE 0.15

typedef struct nook_tune_result {
    nook_tune_outcome outcome;
    nook_tune_estimate actual;  /**< On the cameras that were not used; zero when nothing fits. */
    double difference;          /**< actual / predicted error - 1. */
    double difference_standard; /**< Its standard error, as far as it comes from the choice of cameras. */
    bool holds;                 /**< Something fits, and |difference| <= NOOK_TUNE_TOLERANCE. */
    double settings;            /**< How many there are. */
    double noise_worst;         /**< RMS of the truths' own noise, at most. */
    double r_max;               /**< Metres. */
    char falloff[32];
    double seconds;
} nook_tune_result;

/** @param stage  opened, not filled @return why it could not be done; *out is untouched then */
nook_result nook_tune_run(nook_stage *stage, const nook_tune_options *options, nook_tune_result *out);
