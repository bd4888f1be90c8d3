#include "game/compare/frame_times.h"
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "engine/core/order.h"
#include "game/stage.h"
#include <math.h>
#include <stdlib.h>

/* One frame's wall clock, and the GPU's own where it can be trusted. */
static nook_result time_frame(nook_stage *stage, nook_gpu_timer timer, double *out_ms, double *out_gpu_ms)
{
    nook_stage_begin_means(stage);
    nook_gpu_finish(stage->gpu);
    double start = nook_clock_ms();
    if (timer.begin)
        nook_gpu_timer_begin(stage->gpu, timer);
    nook_result result = nook_stage_occlude(stage);
    if (timer.begin)
        nook_gpu_timer_end(stage->gpu, timer);
    nook_gpu_finish(stage->gpu);
    *out_ms = nook_clock_ms() - start;
    *out_gpu_ms = timer.begin ? nook_gpu_timer_ms(stage->gpu, timer) : NAN;
    return result;
}

/* Until `frames` are timed, or after `budget_ms` if that is sooner. */
static nook_result time_each(nook_stage *stage, nook_gpu_timer timer, uint32_t frames, double budget_ms, double *times,
                             double *gpu_times, nook_frame_times *out)
{
    double spent = 0.0;
    uint32_t done = 0;
    while (done < frames && (done == 0 || spent < budget_ms)) {
        nook_result result = time_frame(stage, timer, &times[done], &gpu_times[done]);
        if (result != NOOK_OK)
            return result;
        spent += times[done++];
    }
    double middle = nook_median(times, done); /* leaves them sorted */
    *out = (nook_frame_times){ .median = middle,
                               .min = times[0],
                               .max = times[done - 1],
                               .gpu_median = timer.begin ? nook_median(gpu_times, done) : NAN,
                               .frames = done };
    return NOOK_OK;
}

nook_result nook_frame_times_measure(nook_stage *stage, uint32_t frames, double budget_ms, nook_frame_times *out_times)
{
    double *times = calloc(frames, 2 * sizeof *times);
    if (!times)
        return nook_fail(NOOK_E_MEMORY, "no memory for %u times", frames);
    nook_gpu_timer timer = { 0 };
    if (nook_gpu_timer_trusted(stage->gpu))
        nook_gpu_timer_create(stage->gpu, &timer);
    nook_result result = time_each(stage, timer, frames, budget_ms, times, times + frames, out_times);
    nook_gpu_timer_destroy(stage->gpu, &timer);
    free(times);
    return result;
}
