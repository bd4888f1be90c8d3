/**
 * guard.h - calls a function that may crash, for code that runs for the first time.
 *
 * A crash of the calling thread (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT: failed asserts too) ends the call instead of the
 * process. What the function had locked stays locked and what it had allocated stays allocated; so this is for the
 * developer's next try, not for handling errors. Crashes of other threads, and those outside of such calls, end the process
 * as ever.
 */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_crash {
    int number;          /**< The signal; 0: it did not crash. */
    const void *address; /**< Of the instruction; NULL where the machine does not tell. */
} nook_crash;

/** Calls action(user) on this thread, with work of nook_parallel_for inline, so that its crashes are this thread's. Not nested. */
nook_crash nook_guard_call(void (*action)(void *user), void *user);

/** "SIGSEGV", ... */
const char *nook_crash_name(nook_crash crash);

#ifdef __cplusplus
}
#endif
