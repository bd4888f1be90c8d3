#pragma once
#include "game/measure/results.h"

/** Of an error, what the noise of its truth may be. */
#define NOOK_MEASURE_NOISE_PART 0.25

/** Whether results can be believed. */
typedef struct nook_measure_verdict {
    double largest_part;          /**< Of noise and error, over all errors against either truth; 0 without rows. */
    const nook_result_row *worst; /**< Where; NULL without rows. Borrowed. */
    bool worst_is_screen;         /**< Of its error against what the screen holds. */
    size_t over;                  /**< Rows with more than NOOK_MEASURE_NOISE_PART. */
    uint64_t non_finite;          /**< Pixels. */
} nook_measure_verdict;

/** Noise and error both zero are fine: there is nothing to see there. */
nook_measure_verdict nook_measure_judge(const nook_results *results);
