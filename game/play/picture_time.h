/**
 * picture_time.h - how long the picture of a frame took, as far as its size can change that: a GPU's own time where it can be
 * asked, some frames late, when it has been there for long; else, where software draws, the whole frame's.
 */
#pragma once
#include "engine/gpu/gpu.h"

enum { NOOK_PICTURE_TIME_LATENCY = 4 };

/** Zeroed: nothing known. */
typedef struct nook_picture_time {
    nook_gpu_timer timers[NOOK_PICTURE_TIME_LATENCY];
    bool pending[NOOK_PICTURE_TIME_LATENCY];
    uint32_t slot;
} nook_picture_time;

/** Around what draws the picture. */
void nook_picture_time_begin(nook_picture_time *time, nook_gpu *gpu);
void nook_picture_time_end(nook_picture_time *time, nook_gpu *gpu);
/** After end. @param frame_ms  of the last whole frame @return milliseconds; 0: not known yet */
double nook_picture_time_take(nook_picture_time *time, nook_gpu *gpu, double frame_ms);
/** Zeroes it. */
void nook_picture_time_release(nook_picture_time *time, nook_gpu *gpu);
