#include "game/commands/bench_line.h"
#include <math.h>

static double mean_of(const double *values, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++)
        sum += values[i];
    return sum / (double)count;
}

nook_bench_line nook_bench_line_fit(const double *x, const double *y, size_t count)
{
    double mean_x = mean_of(x, count), mean_y = mean_of(y, count), xx = 0.0, xy = 0.0, yy = 0.0, off = 0.0;
    for (size_t i = 0; i < count; i++) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
        yy += (y[i] - mean_y) * (y[i] - mean_y);
    }
    nook_bench_line line = { .slope = xy / xx };
    line.start = mean_y - line.slope * mean_x;
    for (size_t i = 0; i < count; i++) {
        double difference = y[i] - line.start - line.slope * x[i];
        off += difference * difference;
    }
    line.residual = sqrt(off / (double)count) / mean_y;
    line.determination = yy > 0.0 ? 1.0 - off / yy : 1.0;
    return line;
}
