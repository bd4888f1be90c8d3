#pragma once

#ifdef __cplusplus
extern "C" {
#endif

/** Milliseconds of a monotonic clock with an arbitrary start; differences are wall time. */
double nook_clock_ms(void);
/** Milliseconds that all threads of this process have computed: what a busy machine stretches less than wall time. */
double nook_clock_cpu_ms(void);
/** Leaves the processor to others for so long: between frames in which nothing is to be done. */
void nook_clock_rest(double ms);

#ifdef __cplusplus
}
#endif
