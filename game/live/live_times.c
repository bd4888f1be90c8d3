/* Where a frame's time goes. On software GL timer queries lie, so passes are waited for while their times are shown, and not else. */
#include "engine/core/clock.h"
#include "engine/core/order.h"
#include "game/live/live_internal.h"
#include <string.h>

static const double share_of_new = 0.1; /* of a smoothed time */
static const float slow_frame = 2.0f;   /* times the median */

static void add(live_times *times, live_pass pass, double ms)
{
    double *smooth = &times->ms[pass];
    *smooth = *smooth > 0.0 ? *smooth + share_of_new * (ms - *smooth) : ms;
}

static void remember_frame(live_times *times)
{
    double now = nook_clock_ms();
    if (times->frame_ms > 0.0) {
        times->frames[times->frame_next] = (float)(now - times->frame_ms);
        times->frame_next = (times->frame_next + 1) % LIVE_TICKS;
        times->frame_count += times->frame_count < LIVE_TICKS;
    }
    times->frame_ms = now;
}

/* Timers of some frames ago: waiting for them costs nothing any more. */
static void read_timers(nook_live *live)
{
    live_times *times = &live->times;
    times->slot = (times->slot + 1) % LIVE_LATENCY;
    for (uint32_t i = 0; i < LIVE_PASS_COUNT; i++) {
        if (times->pending[times->slot][i])
            add(times, (live_pass)i, nook_gpu_timer_ms(live->stage->gpu, times->timers[times->slot][i]));
        times->pending[times->slot][i] = false;
    }
}

void live_times_frame(nook_live *live)
{
    live_times *times = &live->times;
    remember_frame(times);
    for (uint32_t i = 0; i < LIVE_PASS_COUNT && !live->frozen; i++) { /* a frame that stands still keeps its times */
        if (!times->done[i])
            times->ms[i] = 0.0;
        times->done[i] = false;
    }
    times->measuring = live->times_shown || live->timing;
    if (times->measuring && nook_gpu_timer_trusted(live->stage->gpu))
        read_timers(live);
    else if (times->measuring)
        nook_gpu_finish(live->stage->gpu);
}

void live_times_begin(nook_live *live, live_pass pass)
{
    live_times *times = &live->times;
    nook_gpu *gpu = live->stage->gpu;
    if (!times->measuring)
        return;
    if (!nook_gpu_timer_trusted(gpu)) {
        times->began_ms = nook_clock_ms();
        return;
    }
    nook_gpu_timer *timer = &times->timers[times->slot][pass];
    if (timer->begin == 0)
        nook_gpu_timer_create(gpu, timer);
    nook_gpu_timer_begin(gpu, *timer);
}

void live_times_end(nook_live *live, live_pass pass)
{
    live_times *times = &live->times;
    nook_gpu *gpu = live->stage->gpu;
    if (!times->measuring)
        return;
    times->done[pass] = true;
    if (nook_gpu_timer_trusted(gpu)) {
        nook_gpu_timer_end(gpu, times->timers[times->slot][pass]);
        times->pending[times->slot][pass] = true;
        return;
    }
    nook_gpu_finish(gpu);
    add(times, pass, nook_clock_ms() - times->began_ms);
}

void live_times_release(nook_live *live)
{
    for (uint32_t i = 0; i < LIVE_LATENCY; i++) {
        for (uint32_t k = 0; k < LIVE_PASS_COUNT; k++) {
            if (live->times.timers[i][k].begin != 0)
                nook_gpu_timer_destroy(live->stage->gpu, &live->times.timers[i][k]);
        }
    }
}

/* ---- Pacing ----------------------------------------------------------------------------------------------------- */

live_pacing live_times_pacing(const live_times *times)
{
    float sorted[LIVE_TICKS];
    live_pacing pacing = { 0 };
    uint32_t count = times->frame_count;
    if (count == 0)
        return pacing;
    memcpy(sorted, times->frames, count * sizeof *sorted);
    nook_order_floats(sorted, count);
    pacing.median_ms = sorted[count / 2];
    pacing.p99_ms = sorted[(count - 1) * 99 / 100];
    pacing.worst_ms = sorted[count - 1];
    for (uint32_t i = 0; i < count; i++)
        pacing.slow += sorted[i] > slow_frame * pacing.median_ms;
    return pacing;
}
