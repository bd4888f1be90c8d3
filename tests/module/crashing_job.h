/** crashing_job.h - a crash in work that is handed to other threads. */
#pragma once
#include "engine/core/jobs.h"
#include <stdlib.h>

static inline void crashing_job(void *user, size_t first, size_t last, unsigned worker)
{
    (void)user, (void)first, (void)worker;
    if (last == 64)
        abort();
}

static inline void crash_in_job(void)
{
    nook_parallel_for(64, 4, crashing_job, NULL);
}
