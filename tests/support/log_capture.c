#include "tests/support/log_capture.h"
#include <stdio.h>

static void keep_line(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    (void)file, (void)line;
    nook_log_capture *capture = user;
    snprintf(capture->text, sizeof capture->text, "%s", text);
    capture->level = level;
    capture->count++;
    capture->errors += level == NOOK_LOG_ERROR;
}

void nook_log_capture_begin(nook_log_capture *capture)
{
    *capture = (nook_log_capture){ .count = 0 };
    nook_log_set_sink(keep_line, capture);
}

void nook_log_capture_end(void)
{
    nook_log_set_sink(NULL, NULL);
}
