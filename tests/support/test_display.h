/**
 * test_display.h - an X display for tests of the window: the one there is, else a virtual one (Xvfb) of our own.
 */
#pragma once
#include <stdbool.h>
#include <sys/types.h>

typedef struct test_display {
    pid_t server; /**< 0: the display is not ours. */
} test_display;

/** Sets DISPLAY when it is not set. @return false when there is none and Xvfb does not start: skip the test aloud */
bool test_display_open(test_display *out_display);
/** Ends our own server and unsets DISPLAY again; zeroed is allowed. */
void test_display_close(test_display *display);
