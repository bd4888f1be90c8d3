#include "engine/core/json.h"
#include "engine/core/log.h"
#include <assert.h>
#include <errno.h>
#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INDENT = 2, FIRST_CAPACITY = 1024, NUMBER_CAPACITY = 40 };

/* ---- the growing buffer ---- */

static bool reserve(nook_json *json, size_t extra)
{
    if (json->out_of_memory)
        return false;
    size_t needed = json->size + extra + 1; /* and the zero at the end */
    if (needed <= json->capacity)
        return true;
    size_t capacity = json->capacity ? json->capacity : FIRST_CAPACITY;
    while (capacity < needed)
        capacity *= 2;
    char *text = realloc(json->text, capacity);
    if (!text) {
        json->out_of_memory = true;
        return false;
    }
    json->text = text;
    json->capacity = capacity;
    return true;
}

static void put(nook_json *json, const char *bytes, size_t size)
{
    if (!reserve(json, size))
        return;
    memcpy(json->text + json->size, bytes, size);
    json->size += size;
    json->text[json->size] = 0;
}

static void put_text(nook_json *json, const char *text)
{
    put(json, text, strlen(text));
}

static void put_line_break(nook_json *json)
{
    put_text(json, "\n");
    for (uint32_t i = 0; i < json->depth * INDENT; i++)
        put_text(json, " ");
}

/* ---- strings ---- */

/* Bytes of the well-formed UTF-8 sequence at `s` (zero-terminated), 0 when there is none. Unicode 15, table 3-7. */
static size_t utf8_length(const unsigned char *s)
{
    unsigned char low = 0x80, high = 0xBF; /* of the second byte: excludes overlong forms and surrogates */
    size_t length;
    if (s[0] < 0x80)
        return 1;
    if (s[0] >= 0xC2 && s[0] <= 0xDF) {
        length = 2;
    } else if (s[0] >= 0xE0 && s[0] <= 0xEF) {
        length = 3;
        low = s[0] == 0xE0 ? 0xA0 : 0x80;
        high = s[0] == 0xED ? 0x9F : 0xBF;
    } else if (s[0] >= 0xF0 && s[0] <= 0xF4) {
        length = 4;
        low = s[0] == 0xF0 ? 0x90 : 0x80;
        high = s[0] == 0xF4 ? 0x8F : 0xBF;
    } else {
        return 0;
    }
    if (s[1] < low || s[1] > high)
        return 0;
    for (size_t i = 2; i < length; i++) {
        if (s[i] < 0x80 || s[i] > 0xBF)
            return 0;
    }
    return length;
}

static void put_control(nook_json *json, unsigned char c)
{
    static const char named[][2] = { { '"', '"' },  { '\\', '\\' }, { '\b', 'b' }, { '\f', 'f' },
                                     { '\n', 'n' }, { '\r', 'r' },  { '\t', 't' } };
    char escape[8];
    for (size_t i = 0; i < NOOK_COUNT(named); i++) {
        if (c == (unsigned char)named[i][0]) {
            put(json, (const char[]){ '\\', named[i][1] }, 2);
            return;
        }
    }
    snprintf(escape, sizeof escape, "\\u%04x", c);
    put_text(json, escape);
}

static void put_string(nook_json *json, const char *text)
{
    const unsigned char *s = (const unsigned char *)text;
    put_text(json, "\"");
    while (*s) {
        size_t length = utf8_length(s);
        if (length == 0)
            put_text(json, "\xEF\xBF\xBD"); /* U+FFFD for each byte that starts nothing */
        else if (length == 1 && (*s < 0x20 || *s == '"' || *s == '\\'))
            put_control(json, *s);
        else
            put(json, (const char *)s, length);
        s += length ? length : 1;
    }
    put_text(json, "\"");
}

/* ---- numbers ---- */

/* snprintf writes the decimal point of the host's locale; JSON knows only one. */
static void use_point(char *number)
{
    for (char *c = number; *c; c++) {
        if (!strchr("0123456789+-eE", *c))
            *c = '.';
    }
}

/* The read-back happens before use_point, in the same locale as the print. */
static void put_number(nook_json *json, double value, bool is_float)
{
    char number[NUMBER_CAPACITY];
    if (!isfinite(value)) {
        put_text(json, "null");
        return;
    }
    int most = is_float ? FLT_DECIMAL_DIG : DBL_DECIMAL_DIG;
    for (int digits = is_float ? FLT_DIG : DBL_DIG; digits <= most; digits++) {
        snprintf(number, sizeof number, "%.*g", digits, value);
        double back = strtod(number, NULL);
        if (is_float ? (float)back == (float)value : back == value)
            break;
    }
    use_point(number);
    put_text(json, number);
}

/* ---- structure ---- */

static void begin_value(nook_json *json)
{
    assert(!json->complete && "a JSON text has one root");
    if (json->depth == 0)
        return;
    uint32_t level = json->depth - 1;
    if (json->in_array[level]) {
        if (json->has_values[level])
            put_text(json, ",");
        json->has_values[level] = true;
        put_line_break(json);
    } else {
        assert(json->after_key && "a value in an object needs a key");
        json->after_key = false;
    }
}

static void end_value(nook_json *json)
{
    if (json->depth == 0)
        json->complete = true;
}

static void begin_level(nook_json *json, bool array)
{
    begin_value(json);
    assert(json->depth < NOOK_JSON_DEPTH_MAX);
    json->in_array[json->depth] = array;
    json->has_values[json->depth] = false;
    json->depth++;
    put_text(json, array ? "[" : "{");
}

static void end_level(nook_json *json, bool array)
{
    assert(json->depth > 0 && json->in_array[json->depth - 1] == array && "end matches no begin");
    assert(!json->after_key && "a key without its value");
    json->depth--;
    if (json->has_values[json->depth])
        put_line_break(json);
    put_text(json, array ? "]" : "}");
    end_value(json);
}

void nook_json_begin_object(nook_json *json)
{
    begin_level(json, false);
}

void nook_json_end_object(nook_json *json)
{
    end_level(json, false);
}

void nook_json_begin_array(nook_json *json)
{
    begin_level(json, true);
}

void nook_json_end_array(nook_json *json)
{
    end_level(json, true);
}

void nook_json_key(nook_json *json, const char *key)
{
    assert(json->depth > 0 && !json->in_array[json->depth - 1] && "keys belong in objects");
    assert(!json->after_key && "a key without its value");
    uint32_t level = json->depth - 1;
    if (json->has_values[level])
        put_text(json, ",");
    json->has_values[level] = true;
    put_line_break(json);
    put_string(json, key);
    put_text(json, ": ");
    json->after_key = true;
}

/* ---- values ---- */

static void put_word(nook_json *json, const char *word)
{
    begin_value(json);
    put_text(json, word);
    end_value(json);
}

void nook_json_string(nook_json *json, const char *text)
{
    if (!text) {
        nook_json_null(json);
        return;
    }
    begin_value(json);
    put_string(json, text);
    end_value(json);
}

void nook_json_number(nook_json *json, double value)
{
    begin_value(json);
    put_number(json, value, false);
    end_value(json);
}

void nook_json_float(nook_json *json, float value)
{
    begin_value(json);
    put_number(json, (double)value, true);
    end_value(json);
}

void nook_json_integer(nook_json *json, int64_t value)
{
    char number[NUMBER_CAPACITY];
    snprintf(number, sizeof number, "%" PRId64, value);
    put_word(json, number);
}

void nook_json_bool(nook_json *json, bool value)
{
    put_word(json, value ? "true" : "false");
}

void nook_json_null(nook_json *json)
{
    put_word(json, "null");
}

void nook_json_numbers(nook_json *json, const double *values, size_t count)
{
    begin_value(json);
    for (size_t i = 0; i < count; i++) {
        put_text(json, i == 0 ? "[" : ", ");
        put_number(json, values[i], false);
    }
    put_text(json, count == 0 ? "[]" : "]");
    end_value(json);
}

void nook_json_member_string(nook_json *json, const char *key, const char *text)
{
    nook_json_key(json, key);
    nook_json_string(json, text);
}

void nook_json_member_number(nook_json *json, const char *key, double value)
{
    nook_json_key(json, key);
    nook_json_number(json, value);
}

void nook_json_member_integer(nook_json *json, const char *key, int64_t value)
{
    nook_json_key(json, key);
    nook_json_integer(json, value);
}

void nook_json_member_bool(nook_json *json, const char *key, bool value)
{
    nook_json_key(json, key);
    nook_json_bool(json, value);
}

/* ---- the whole ---- */

nook_result nook_json_finish(nook_json *json, const char **out_text, size_t *out_size)
{
    assert(json->complete && "something is still open, or nothing was written");
    if (!json->out_of_memory && json->text[json->size - 1] != '\n')
        put_text(json, "\n");
    if (json->out_of_memory)
        return nook_fail(NOOK_E_MEMORY, "JSON: no memory for more than %zu bytes", json->capacity);
    *out_text = json->text;
    if (out_size)
        *out_size = json->size;
    return NOOK_OK;
}

nook_result nook_json_print(nook_json *json, FILE *stream)
{
    const char *text = NULL;
    nook_result result = nook_json_finish(json, &text, NULL);
    if (result == NOOK_OK && fputs(text, stream) == EOF)
        return nook_fail(NOOK_E_IO, "JSON: cannot be printed: %s", strerror(errno));
    return result;
}

void nook_json_free(nook_json *json)
{
    free(json->text);
    *json = (nook_json){ 0 };
}
