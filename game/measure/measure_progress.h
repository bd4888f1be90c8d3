#pragma once
#include "game/measure/results.h"

/** How far a measurement is, on standard error: one line that is overwritten on a terminal, one line a row elsewhere. */
typedef struct nook_measure_progress {
    size_t total;   /**< Rows in all. */
    size_t handled; /**< Measured or reused. */
    size_t measured;
    double started_ms;
    bool terminal, shown;
} nook_measure_progress;

nook_measure_progress nook_measure_progress_begin(size_t total);
/** Before a row is measured: what is being done. */
void nook_measure_progress_show(nook_measure_progress *progress, const nook_result_row *row);
/** After it. */
void nook_measure_progress_row(nook_measure_progress *progress, const nook_result_row *row);
void nook_measure_progress_reused(nook_measure_progress *progress, size_t rows);
void nook_measure_progress_end(nook_measure_progress *progress); /**< Clears the line. */

/** "under a minute left", "12 min left"; "" before there is anything to tell it from. @return out */
const char *nook_measure_time_left(size_t measured, size_t left, double elapsed_ms, char out[32]);
