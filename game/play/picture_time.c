#include "game/play/picture_time.h"

void nook_picture_time_begin(nook_picture_time *time, nook_gpu *gpu)
{
    if (!nook_gpu_timer_trusted(gpu))
        return;
    nook_gpu_timer *timer = &time->timers[time->slot];
    if (timer->begin == 0)
        nook_gpu_timer_create(gpu, timer);
    nook_gpu_timer_begin(gpu, *timer);
}

void nook_picture_time_end(nook_picture_time *time, nook_gpu *gpu)
{
    if (!nook_gpu_timer_trusted(gpu))
        return;
    nook_gpu_timer_end(gpu, time->timers[time->slot]);
    time->pending[time->slot] = true;
    time->slot = (time->slot + 1) % NOOK_PICTURE_TIME_LATENCY;
}

double nook_picture_time_take(nook_picture_time *time, nook_gpu *gpu, double frame_ms)
{
    if (!nook_gpu_timer_trusted(gpu))
        return frame_ms;
    if (!time->pending[time->slot])
        return 0.0;
    time->pending[time->slot] = false;
    return nook_gpu_timer_ms(gpu, time->timers[time->slot]);
}

void nook_picture_time_release(nook_picture_time *time, nook_gpu *gpu)
{
    for (uint32_t i = 0; i < NOOK_PICTURE_TIME_LATENCY; i++) {
        if (time->timers[i].begin != 0)
            nook_gpu_timer_destroy(gpu, &time->timers[i]);
    }
    *time = (nook_picture_time){ .slot = 0 };
}
