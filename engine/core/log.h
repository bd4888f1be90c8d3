#pragma once
#include "engine/core/result.h"
#include <stdarg.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum nook_log_level {
    NOOK_LOG_INFO,    /**< Progress and results. */
    NOOK_LOG_WARNING, /**< Went on with what it had; the line says what was left out. */
    NOOK_LOG_ERROR,   /**< A call failed; the line says what is wrong and what to do. */
} nook_log_level;

/** Receives every line, without its newline. `file` and `line` are where in our sources it was said. */
typedef void (*nook_log_sink)(void *user, nook_log_level level, const char *file, int line, const char *text);

/**
 * What this thread logs as an error is written to `text` as well, cut to capacity, each in place of the one before: for those who
 * must show why a call has failed. NULL ends it. A setting of the thread, which lasts no longer than it.
 */
void nook_log_keep_errors(char *text, size_t capacity);

/**
 * Sends all further lines to `sink`; NULL restores the default, which writes "nook: text" to standard error.
 * The one process-wide setting of engine/core. Set it before threads start; sinks must be thread-safe.
 */
void nook_log_set_sink(nook_log_sink sink, void *user);

#if defined(__GNUC__)
#define NOOK_PRINTF(format_index, first) __attribute__((format(printf, format_index, first)))
#else
#define NOOK_PRINTF(format_index, first)
#endif

/** Logs printf-style text; lines over 2047 bytes are cut. */
void nook_log_at(const char *file, int line, nook_log_level level, const char *format, ...) NOOK_PRINTF(4, 5);
#define nook_log_info(...) nook_log_at(__FILE__, __LINE__, NOOK_LOG_INFO, __VA_ARGS__)
#define nook_log_warning(...) nook_log_at(__FILE__, __LINE__, NOOK_LOG_WARNING, __VA_ARGS__)

/**
 * Logs an error and gives `code` back, so that one line reports and returns. A macro around an inline function so that
 * compilers and analysers see which code comes back: after `if (result != NOOK_OK) return result;` outputs are set.
 */
#define nook_fail(code, ...) (nook_log_at(__FILE__, __LINE__, NOOK_LOG_ERROR, __VA_ARGS__), nook_fail_with((code)))
static inline nook_result nook_fail_with(nook_result code)
{
    return code;
}

/**
 * For what may fail without a line in the log: writes printf-style text to `out`, cut to capacity.
 * @return `code`
 */
nook_result nook_refuse(char *out, size_t capacity, nook_result code, const char *format, ...) NOOK_PRINTF(4, 5);

#ifdef __cplusplus
}
#endif
