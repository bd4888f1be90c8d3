#include "game/progress.h"
#include "engine/core/clock.h"
#include <stdio.h>
#include <unistd.h>

static const double first_after_ms = 500.0, again_after_ms = 100.0;

nook_progress nook_progress_begin(const char *what)
{
    double now = nook_clock_ms();
    return (nook_progress){ what, now, now, isatty(STDERR_FILENO) == 1, false };
}

nook_progress nook_progress_begin_within(const nook_progress *whole, const char *what)
{
    nook_progress progress = nook_progress_begin(what);
    progress.shown = whole && whole->shown && !whole->terminal;
    return progress;
}

void nook_progress_update(void *user, double fraction)
{
    nook_progress *progress = user;
    double now = nook_clock_ms();
    if (now - progress->started_ms < first_after_ms || now - progress->shown_ms < again_after_ms)
        return;
    if (!progress->terminal && progress->shown)
        return;
    progress->shown_ms = now;
    if (progress->terminal)
        fprintf(stderr, "\r\033[Knook: %s: %3.0f %%", progress->what, 100.0 * fraction);
    else
        fprintf(stderr, "nook: %s ...\n", progress->what);
    progress->shown = true;
}

void nook_progress_end(nook_progress *progress)
{
    if (progress->terminal && progress->shown)
        fprintf(stderr, "\r\033[K");
    progress->shown = false;
}
