/**
 * summary.h - results over cameras: one row a setting for every scene, size, r_max, falloff, machine and build, and which of
 * them are on the front.
 */
#pragma once
#include "game/measure/results.h"

/** The technique whose rows are truths, not choices: it never stands on a front. */
#define NOOK_SUMMARY_REFERENCE "reference"

/** One setting of one view (scene, size, r_max, falloff, machine, build) over its cameras. */
typedef struct nook_summary_row {
    const nook_result_row *row; /**< One of those summed up: names, setting, r_max. Borrowed. */
    uint32_t cameras;           /**< How many were. */
    nook_sample sample;         /**< Over them, as game/measure/sample_columns.h says. Only its numbers are filled. */
    bool on_front; /**< No other setting of its view is both at most as slow and at most as wrong (RMSE). */
} nook_summary_row;

/** All settings of one view. */
typedef struct nook_summary_view {
    nook_summary_row *rows; /**< By technique, as it comes first, then setting; the reference last. */
    size_t row_count;
    size_t compared;      /**< Of them, those that the front was found among. */
    uint32_t cameras;     /**< The most that any setting was measured with. */
    double largest_noise; /**< Of the truths: the largest over the cameras. */
    double smallest_rmse; /**< Of the settings, at one camera; NaN when there is none. */
} nook_summary_view;

typedef struct nook_summary {
    nook_summary_view *views; /**< By scene, then r_max, size, falloff, machine, build. */
    size_t view_count;
    nook_summary_row *rows; /**< Those of all views, one view after the other. */
    size_t row_count;
} nook_summary;

/**
 * Sums up. Fronts are among settings that were measured with all cameras of the view.
 * @param results  outlives the summary
 * @return NOOK_E_MEMORY; *out_summary is untouched then
 */
nook_result nook_summary_create(const nook_results *results, nook_summary *out_summary);
void nook_summary_free(nook_summary *summary); /**< Zeroed ones are allowed. */

/** Whether the setting of that row is on its view's front. @param row  one of the results that were summed up */
bool nook_summary_on_front(const nook_summary *summary, const nook_result_row *row);

/**
 * Marks what no other point beats: [i] is true when no j has both at most its cost and at most its error, one of them less. Points
 * with a NaN are never on it; of equal points all are.
 * @return NOOK_E_MEMORY
 */
nook_result nook_front_mark(const double *costs, const double *errors, size_t count, bool *out_on_front);
