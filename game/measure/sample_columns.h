/**
 * sample_columns.h - the numbers of a sample by name, and how each goes over several cameras (sample_members.def): for the report,
 * its script and the tables of the document.
 */
#pragma once
#include "game/measure/site.h"
#include <stddef.h>

/** How one number stands for several cameras. Cameras that have none (NaN) are left out. */
typedef enum nook_over_cameras {
    NOOK_OVER_MEAN,    /**< What adds up: times, fetches, signed and absolute errors. */
    NOOK_OVER_RMS,     /**< Root of the mean square: what is such a root itself. */
    NOOK_OVER_LARGEST, /**< The worst camera: maxima, percentiles, memory. */
} nook_over_cameras;

typedef struct nook_sample_column {
    const char *key;        /**< As the report's script calls it. */
    nook_over_cameras over; /**< Bias is NOOK_OVER_MEAN, with its sign. */
    size_t offset;          /**< Of the double in nook_sample. */
} nook_sample_column;

/** @param out_count  of the table @return the table, in the order of the files' columns */
const nook_sample_column *nook_sample_columns(size_t *out_count);

double nook_sample_number(const nook_sample *sample, const nook_sample_column *column);

/** "mean", "rms", "largest". */
const char *nook_over_cameras_name(nook_over_cameras over);

/** One number for `count` of them; NaN when none is a number. */
double nook_over_cameras_of(nook_over_cameras over, const double *values, size_t count);
