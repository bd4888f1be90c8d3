#pragma once
#include <stdbool.h>

/**
 * Says on standard error how far a long job is: one line that is overwritten on a terminal, one line at its start
 * elsewhere. Jobs shorter than half a second say nothing.
 */
typedef struct nook_progress {
    const char *what; /**< "baking volumes" */
    double started_ms, shown_ms;
    bool terminal, shown;
} nook_progress;

nook_progress nook_progress_begin(const char *what);
/**
 * A part of a longer job: where there is no terminal, and the whole has said what it does, it says nothing.
 * @param whole  NULL: as nook_progress_begin
 */
nook_progress nook_progress_begin_within(const nook_progress *whole, const char *what);
/** @param user  a nook_progress @param fraction  [0, 1]; may come from any one thread at a time */
void nook_progress_update(void *user, double fraction);
void nook_progress_end(nook_progress *progress); /**< Clears the line. */
