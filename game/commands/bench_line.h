/** bench_line.h - the straight line nearest to measured points, and how far off they are: does a cost grow in proportion? */
#pragma once
#include <stddef.h>

typedef struct nook_bench_line {
    double start, slope;  /**< y = start + slope x, least squares. */
    double residual;      /**< RMS of what the points are off it, as a part of their mean; 0: they lie on it. */
    double determination; /**< R^2: the part of the points' variance that the line has; 1 where there is none. */
} nook_bench_line;

/** @param count  at least 2 points, not all at the same x @param y  positive mean */
nook_bench_line nook_bench_line_fit(const double *x, const double *y, size_t count);
