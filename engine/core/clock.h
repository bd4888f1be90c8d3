#pragma once

/** Milliseconds of a monotonic clock with an arbitrary start; differences are wall time. */
double nook_clock_ms(void);
