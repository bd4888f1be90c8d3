/**
 * interrupt.h - Ctrl-C while something is being done that should end in order. Signals can only be told to something global, so
 * this is of the process: one holder at a time, or one inside another.
 */
#pragma once
#include <stdbool.h>

/** From here on SIGINT, SIGTERM and SIGHUP (the terminal was closed; unless nohup has it ignored) wait. Every hold needs its release. */
void nook_interrupt_hold(void);
/** Someone wants the program to end: stop soon. */
bool nook_interrupt_asked(void);
/** What was asked for is being done: the release does not raise it again. */
void nook_interrupt_answer(void);
/** The outermost release lets signals through again, and raises the one that waited. */
void nook_interrupt_release(void);
