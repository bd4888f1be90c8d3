#include "engine/core/log.h"
#include <stdio.h>

enum { LINE_CAPACITY = 2048 };

static void write_to_stderr(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    (void)user, (void)file, (void)line;
    fprintf(stderr, "nook: %s%s\n", level == NOOK_LOG_WARNING ? "warning: " : "", text);
}

static struct {
    nook_log_sink sink;
    void *user;
} log_state = { write_to_stderr, NULL };

static _Thread_local struct {
    char *text;
    size_t capacity;
} kept;

void nook_log_keep_errors(char *text, size_t capacity)
{
    kept.text = text;
    kept.capacity = capacity;
}

void nook_log_set_sink(nook_log_sink sink, void *user)
{
    log_state.sink = sink ? sink : write_to_stderr;
    log_state.user = sink ? user : NULL;
}

void nook_log_at(const char *file, int line, nook_log_level level, const char *format, ...)
{
    char text[LINE_CAPACITY];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (kept.text && level == NOOK_LOG_ERROR)
        snprintf(kept.text, kept.capacity, "%s", text);
    log_state.sink(log_state.user, level, file, line, text);
}

nook_result nook_refuse(char *out, size_t capacity, nook_result code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(out, capacity, format, arguments);
    va_end(arguments);
    return code;
}
