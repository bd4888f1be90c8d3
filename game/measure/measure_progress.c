#include "game/measure/measure_progress.h"
#include "engine/core/clock.h"
#include <math.h>
#include <stdio.h>
#include <unistd.h>

nook_measure_progress nook_measure_progress_begin(size_t total)
{
    return (
        nook_measure_progress){ .total = total, .started_ms = nook_clock_ms(), .terminal = isatty(STDERR_FILENO) == 1 };
}

const char *nook_measure_time_left(size_t measured, size_t left, double elapsed_ms, char out[32])
{
    double minutes = measured > 0 ? elapsed_ms / (double)measured * (double)left / 60000.0 : NAN;
    if (left == 0 || isnan(minutes))
        snprintf(out, 32, "%s", "");
    else if (minutes < 1.0)
        snprintf(out, 32, ", under a minute left");
    else if (minutes < 120.0)
        snprintf(out, 32, ", %.0f min left", ceil(minutes));
    else
        snprintf(out, 32, ", %.0f h left", ceil(minutes / 60.0));
    return out;
}

static void print_head(const nook_measure_progress *progress, const nook_result_row *row)
{
    char left[32];
    nook_measure_time_left(progress->measured, progress->total - progress->handled,
                           nook_clock_ms() - progress->started_ms, left);
    fprintf(stderr, "nook: %zu of %zu%s: %s, %s, %.3g m: %s", progress->handled, progress->total, left, row->scene,
            row->camera, row->r_max, row->setting);
}

void nook_measure_progress_show(nook_measure_progress *progress, const nook_result_row *row)
{
    if (!progress->terminal)
        return;
    fputs("\r\033[K", stderr);
    print_head(progress, row);
    progress->shown = true;
}

void nook_measure_progress_row(nook_measure_progress *progress, const nook_result_row *row)
{
    progress->handled++;
    progress->measured++;
    if (progress->terminal)
        return;
    print_head(progress, row);
    fprintf(stderr, ": RMSE %.4f, %.1f ms\n", row->sample.truth.rmse, row->sample.ms_median);
}

void nook_measure_progress_reused(nook_measure_progress *progress, size_t rows)
{
    progress->handled += rows;
}

void nook_measure_progress_end(nook_measure_progress *progress)
{
    if (progress->terminal && progress->shown)
        fputs("\r\033[K", stderr);
    progress->shown = false;
}
