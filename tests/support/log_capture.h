#pragma once
#include "engine/core/log.h"

/** The last line that was logged, and how many there were: for tests that check what a failure says. */
typedef struct nook_log_capture {
    char text[2048];
    nook_log_level level;
    int count;  /**< Lines of any level. */
    int errors; /**< Those of level NOOK_LOG_ERROR. */
} nook_log_capture;

/** Empties the capture and sends all further lines to it alone. It must outlive the logging: see nook_log_capture_end. */
void nook_log_capture_begin(nook_log_capture *capture);

/** Sends lines to standard error again. */
void nook_log_capture_end(void);
