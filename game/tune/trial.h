/**
 * trial.h - one setting that was tried: what it did in some views of the scene, and what follows for all of them.
 */
#pragma once
#include "game/tune/goal.h"
#include "game/tune/space.h"

enum { NOOK_TUNE_VIEWS_MAX = 64 };

/** A setting in one view. */
typedef struct nook_tune_view {
    double
        squared; /**< Mean squared error of visibility, without what the truth's own noise adds to it; by chance negative. */
    double pixels;    /**< That it is the mean of. */
    double ms;        /**< That of the middle round (game/measure/site_time.h); NaN: not timed. */
    double ms_spread; /**< Half of what its slowest and its fastest round are apart. */
    double noise;     /**< Of the truth: what was subtracted is its square. */
} nook_tune_view;

/** What a number of views say. */
typedef struct nook_tune_estimate {
    nook_tune_cost
        cost; /**< RMSE pooled over all pixels, 0 where the truth's noise is all there is; mean of the times. */
    double error_standard; /**< Standard error of the RMSE, from how the views differ; NaN for a single view. */
    double ms_standard;    /**< ... of ms; NaN with fewer than two that are timed. */
    double ms_spread;      /**< Mean of the views'. */
    double noise;          /**< Of the truths, pooled as the error is. */
    uint32_t views;
} nook_tune_estimate;

typedef struct nook_tune_trial {
    nook_tune_point point;
    nook_setting setting;
    nook_tune_view views[NOOK_TUNE_VIEWS_MAX];
    uint32_t view_count; /**< Measured so far, from the first on. */
} nook_tune_trial;

nook_tune_estimate nook_tune_pool(const nook_tune_view *views, uint32_t count);

/** What the budget is held against: of what it limits, the estimate and one standard error. */
nook_tune_cost nook_tune_with_margin(const nook_tune_goal *goal, const nook_tune_estimate *estimate);

/** The next multiple of a period. */
uint32_t nook_tune_round_up(double views, uint32_t period);

/**
 * So many views of each of two sets make three times the standard error of the difference of their RMSE no more than `part` of it.
 * @param estimate  from a few of them @return infinite where it has no error, or comes from one view
 */
double nook_tune_views_needed(const nook_tune_estimate *estimate, double part);

/** As many more as Student's distribution asks for, because few views do not know well how they differ (Stein 1945, two-stage sampling). */
double nook_tune_views_needed_surely(const nook_tune_estimate *estimate, double part);
