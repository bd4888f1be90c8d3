#include "engine/core/clock.h"
#include <time.h>

double nook_clock_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

double nook_clock_cpu_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

void nook_clock_rest(double ms)
{
    const time_t seconds = (time_t)(ms * 1e-3);
    const struct timespec pause = { seconds, (long)((ms - (double)seconds * 1e3) * 1e6) };
    nanosleep(&pause, NULL);
}
