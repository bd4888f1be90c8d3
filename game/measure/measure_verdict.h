#pragma once
#include "game/measure/results.h"

/** Of an error, what the noise of its truth may be: in quadrature a quarter adds 3 % to a root of a mean square. */
#define NOOK_MEASURE_NOISE_PART 0.25

/**
 * The largest part that the noise of the truth is of an error: of RMSE, of MAE (noise alone has a mean absolute value of 0.8 of its
 * RMS), and of the RMSE inside, outside and away from silhouettes by the noise of these very pixels. Bias is a mean in which
 * noise cancels; of p99 and max nothing is said.
 * @param screen     of RMSE and MAE against what the screen holds instead
 * @param out_error  what it is of, for messages; NULL: not asked
 * @return 0 when there is no noise, infinite when there is noise and no error
 */
double nook_measure_noise_part(const nook_sample *sample, bool screen, const char **out_error);

/**
 * Values that a number of the sample would have needed and that are NaN or infinite: of the picture against either truth, between
 * seeds, against the second camera, along the path. One pixel counts in each that needs it.
 */
uint64_t nook_sample_non_finite(const nook_sample *sample);

/** Whether results can be believed. */
typedef struct nook_measure_verdict {
    double largest_part;          /**< Of noise and error, over all errors against either truth; 0 without rows. */
    const nook_result_row *worst; /**< Where; NULL without rows. Borrowed. */
    const char *worst_error;      /**< "RMSE", "MAE against the screen's truth", ...; "" without rows. */
    size_t over;                  /**< Rows with more than NOOK_MEASURE_NOISE_PART. */
    uint64_t non_finite;          /**< nook_sample_non_finite of all rows. */
    uint64_t outside;             /**< Visibilities that were clamped into [0, 1]: nook_sample.outside. */
} nook_measure_verdict;

/** Noise and error both zero are fine: there is nothing to see there. */
nook_measure_verdict nook_measure_judge(const nook_results *results);
