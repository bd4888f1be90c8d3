#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { NOOK_JSON_DEPTH_MAX = 32 }; /**< Objects and arrays inside one another. */

/**
 * Writes one JSON text, front to back, indented by 2 spaces. Start it from zero: nook_json json = { 0 };
 * Misuse (a value without its key, an end that does not match, a second root) is asserted. Running out of memory is
 * remembered and reported by nook_json_finish, so that calls in between need no checks. Members are private.
 */
typedef struct nook_json {
    char *text; /**< Owned; release with nook_json_free. */
    size_t size, capacity;
    uint32_t depth;                       /**< Open objects and arrays. */
    bool in_array[NOOK_JSON_DEPTH_MAX];   /**< Per open level: array or object. */
    bool has_values[NOOK_JSON_DEPTH_MAX]; /**< Per open level: needs a comma before the next one. */
    bool after_key;                       /**< The value of a key comes next. */
    bool complete;                        /**< The root is closed. */
    bool out_of_memory;
} nook_json;

void nook_json_begin_object(nook_json *json);
void nook_json_end_object(nook_json *json);
void nook_json_begin_array(nook_json *json);
void nook_json_end_array(nook_json *json);

/** Names the next value of an object. The caller keeps keys apart. */
void nook_json_key(nook_json *json, const char *key);

/** UTF-8; what is not valid UTF-8 becomes U+FFFD. NULL writes null. */
void nook_json_string(nook_json *json, const char *text);
/** With the fewest digits that read back as the same double; null when not finite (JSON has no word for it). */
void nook_json_number(nook_json *json, double value);
/** With the fewest digits that read back as the same float: 0.1f is 0.1. */
void nook_json_float(nook_json *json, float value);
void nook_json_integer(nook_json *json, int64_t value);
void nook_json_bool(nook_json *json, bool value);
void nook_json_null(nook_json *json);
/** An array of numbers on one line: vectors and matrices. */
void nook_json_numbers(nook_json *json, const double *values, size_t count);

/** A key and its value in one call. */
void nook_json_member_string(nook_json *json, const char *key, const char *text);
void nook_json_member_number(nook_json *json, const char *key, double value);
void nook_json_member_integer(nook_json *json, const char *key, int64_t value);
void nook_json_member_bool(nook_json *json, const char *key, bool value);

/**
 * Ends the text with a newline; everything must be closed. May be called again.
 * @param out_text  zero-terminated, belongs to `json`
 * @param out_size  bytes without the zero; NULL is allowed
 * @return NOOK_E_MEMORY; the outputs are untouched then
 */
nook_result nook_json_finish(nook_json *json, const char **out_text, size_t *out_size);

/** Finishes and prints the text. @return NOOK_E_MEMORY, NOOK_E_IO */
nook_result nook_json_print(nook_json *json, FILE *stream);

void nook_json_free(nook_json *json); /**< Leaves it zero, ready for another text. */

#ifdef __cplusplus
}
#endif
