#pragma once
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * A piece of work: the items [first, last), last > first.
 * @param worker  in [0, nook_parallel_workers(count, threads)): for scratch memory of one's own; 0 is the calling thread
 */
typedef void (*nook_job)(void *user, size_t first, size_t last, unsigned worker);

/** Processors this process may run on, at least 1. */
unsigned nook_core_count(void);

/** The most workers nook_parallel_for uses for these arguments, at least 1: how many scratch buffers to prepare. */
unsigned nook_parallel_workers(size_t count, unsigned threads);

/**
 * Calls `job` on pieces of [0, count), each item exactly once, and returns when all are done. Pieces are handed out as
 * workers become free, large ones first, so that uneven items even out; their borders differ from run to run, so results
 * must not depend on them. What the caller wrote before is seen by the workers, and what they wrote by the caller after.
 * Cannot fail: where a thread cannot be started, the others do its work. Calls may be nested. count 0 calls nothing.
 * @param threads  0 = nook_core_count(); 1 = inline, in one piece, on the calling thread
 */
void nook_parallel_for(size_t count, unsigned threads, nook_job job, void *user);

/**
 * From now on nook_parallel_for, called on this thread, runs in one piece on this thread (1), or on many again (0): for code
 * that may crash, whose crash must be that of its caller (engine/module/guard.h).
 */
void nook_parallel_inline(int inlined);

#ifdef __cplusplus
}
#endif
