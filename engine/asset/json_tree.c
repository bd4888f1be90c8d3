#include "engine/asset/json_tree.h"
#include "engine/core/log.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { DEPTH_LIMIT = 256, NUMBER_CAPACITY = 400 };

typedef struct reader {
    const char *name;
    const char *text;
    size_t size, at;
    nook_json_value *values;
    uint32_t count, capacity;
    uint32_t open[DEPTH_LIMIT]; /**< Containers not closed yet, outermost first. */
    uint32_t depth, depth_max;
} reader;

static nook_result fail(const reader *r, const char *what)
{
    size_t line = 1;
    for (size_t i = 0; i < r->at && i < r->size; i++)
        line += r->text[i] == '\n';
    return nook_fail(NOOK_E_FORMAT, "%s: JSON line %zu: %s", r->name, line, what);
}

static char peek(const reader *r)
{
    return r->at < r->size ? r->text[r->at] : '\0';
}

static void skip_space(reader *r)
{
    while (r->at < r->size && strchr(" \t\r\n", r->text[r->at]) && r->text[r->at])
        r->at++;
}

static nook_result push(reader *r, nook_json_kind kind, size_t start, size_t length)
{
    if (r->count == r->capacity) {
        uint32_t capacity = r->capacity ? r->capacity * 2 : 256;
        nook_json_value *values = capacity < r->capacity ? NULL : realloc(r->values, capacity * sizeof *values);
        if (!values)
            return nook_fail(NOOK_E_MEMORY, "%s: no memory for its JSON", r->name);
        r->values = values;
        r->capacity = capacity;
    }
    r->values[r->count] = (nook_json_value){ kind, (uint32_t)start, (uint32_t)length, 0, r->count + 1 };
    r->count++;
    return NOOK_OK;
}

/* Bytes of the UTF-8 sequence at p, or 0 when it is not one (overlong and surrogate forms included). */
static size_t utf8_length(const unsigned char *p, size_t left)
{
    if (p[0] < 0x80)
        return 1;
    size_t length = p[0] >= 0xF0 ? 4 : p[0] >= 0xE0 ? 3 : 2;
    if (p[0] < 0xC2 || p[0] > 0xF4 || left < length)
        return 0;
    for (size_t i = 1; i < length; i++)
        if ((p[i] & 0xC0) != 0x80)
            return 0;
    bool bad = (p[0] == 0xE0 && p[1] < 0xA0) || (p[0] == 0xED && p[1] > 0x9F) || (p[0] == 0xF0 && p[1] < 0x90) ||
               (p[0] == 0xF4 && p[1] > 0x8F);
    return bad ? 0 : length;
}

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

static nook_result read_escape(reader *r)
{
    char c = ++r->at < r->size ? r->text[r->at] : '\0';
    if (c == 'u') {
        for (int i = 0; i < 4; i++)
            if (++r->at >= r->size || hex_digit(r->text[r->at]) < 0)
                return fail(r, "broken \\u escape");
    } else if (!c || !strchr("\"\\/bfnrt", c)) {
        return fail(r, "unknown escape in a string");
    }
    r->at++;
    return NOOK_OK;
}

static nook_result read_string(reader *r)
{
    size_t start = ++r->at;
    while (r->at < r->size && r->text[r->at] != '"') {
        const unsigned char *p = (const unsigned char *)r->text + r->at;
        if (*p < 0x20)
            return fail(r, "control character in a string");
        if (*p == '\\') {
            nook_result result = read_escape(r);
            if (result != NOOK_OK)
                return result;
            continue;
        }
        size_t length = utf8_length(p, r->size - r->at);
        if (!length)
            return fail(r, "not UTF-8");
        r->at += length;
    }
    if (r->at >= r->size)
        return fail(r, "a string without end");
    size_t end = r->at++;
    return push(r, NOOK_JSON_STRING, start, end - start);
}

static size_t skip_digits(reader *r)
{
    size_t start = r->at;
    while (peek(r) >= '0' && peek(r) <= '9')
        r->at++;
    return r->at - start;
}

static nook_result read_number(reader *r)
{
    size_t start = r->at;
    if (peek(r) == '-')
        r->at++;
    bool zero = peek(r) == '0';
    size_t digits = skip_digits(r);
    if (digits == 0 || (zero && digits > 1))
        return fail(r, "expected a value");
    if (peek(r) == '.') {
        r->at++;
        if (!skip_digits(r))
            return fail(r, "a number without digits after its point");
    }
    if (peek(r) == 'e' || peek(r) == 'E') {
        r->at++;
        if (peek(r) == '+' || peek(r) == '-')
            r->at++;
        if (!skip_digits(r))
            return fail(r, "a number without digits in its exponent");
    }
    if (r->at - start >= NUMBER_CAPACITY)
        return fail(r, "a number of more than 400 characters");
    return push(r, NOOK_JSON_NUMBER, start, r->at - start);
}

static nook_result read_word(reader *r)
{
    static const char *const words[] = { "null", "true", "false" };
    for (size_t i = 0; i < NOOK_COUNT(words); i++) {
        size_t length = strlen(words[i]);
        if (r->size - r->at < length || memcmp(r->text + r->at, words[i], length) != 0)
            continue;
        r->at += length;
        return push(r, i == 0 ? NOOK_JSON_NULL : NOOK_JSON_BOOL, r->at - length, length);
    }
    return read_number(r);
}

static nook_result open_container(reader *r, nook_json_kind kind)
{
    if (r->depth == r->depth_max)
        return fail(r, "nested too deeply");
    r->open[r->depth++] = r->count;
    return push(r, kind, r->at++, 0);
}

static nook_result read_key(reader *r)
{
    skip_space(r);
    if (peek(r) != '"')
        return fail(r, "expected a member name");
    nook_result result = read_string(r);
    if (result != NOOK_OK)
        return result;
    skip_space(r);
    if (peek(r) != ':')
        return fail(r, "expected ':'");
    r->at++;
    return NOOK_OK;
}

static bool close_if_ended(reader *r)
{
    nook_json_value *container = &r->values[r->open[r->depth - 1]];
    skip_space(r);
    if (peek(r) != (container->kind == NOOK_JSON_OBJECT ? '}' : ']'))
        return false;
    r->at++;
    container->length = (uint32_t)(r->at - container->start);
    container->next = r->count;
    r->depth--;
    return true;
}

/* One value at the place of reading: a scalar whole, a container's opening bracket only. */
static nook_result read_value(reader *r)
{
    skip_space(r);
    switch (peek(r)) {
    case '{':
        return open_container(r, NOOK_JSON_OBJECT);
    case '[':
        return open_container(r, NOOK_JSON_ARRAY);
    case '"':
        return read_string(r);
    default:
        return read_word(r);
    }
}

static nook_result read_member(reader *r)
{
    nook_json_value *container = &r->values[r->open[r->depth - 1]];
    if (container->count > 0) {
        if (peek(r) != ',')
            return fail(r, r->at < r->size ? "expected ',' or a closing bracket" : "the text ends too early");
        r->at++;
    }
    container->count++;
    nook_result result = container->kind == NOOK_JSON_OBJECT ? read_key(r) : NOOK_OK;
    return result == NOOK_OK ? read_value(r) : result;
}

static nook_result read_all(reader *r)
{
    nook_result result = read_value(r);
    while (result == NOOK_OK && r->depth > 0)
        if (!close_if_ended(r))
            result = read_member(r);
    if (result != NOOK_OK)
        return result;
    skip_space(r);
    return r->at == r->size ? NOOK_OK : fail(r, "something stands after the end");
}

nook_result nook_json_tree_read(const char *name, const char *text, size_t size, uint32_t depth_max,
                                nook_json_tree *out_tree)
{
    assert(depth_max <= DEPTH_LIMIT);
    if (size >= UINT32_MAX)
        return nook_fail(NOOK_E_MEMORY, "%s: more than 4 GiB of JSON", name);
    reader r = { .name = name, .text = text, .size = size, .depth_max = depth_max };
    nook_result result = read_all(&r);
    if (result != NOOK_OK) {
        free(r.values);
        return result;
    }
    *out_tree = (nook_json_tree){ text, r.values, r.count };
    return NOOK_OK;
}

void nook_json_tree_free(nook_json_tree *tree)
{
    free(tree->values);
    *tree = (nook_json_tree){ 0 };
}

uint32_t nook_json_tree_find(const nook_json_tree *tree, uint32_t object, const char *key)
{
    if (object == NOOK_JSON_NONE || tree->values[object].kind != NOOK_JSON_OBJECT)
        return NOOK_JSON_NONE;
    uint32_t member = object + 1;
    for (uint32_t i = 0; i < tree->values[object].count; i++) {
        uint32_t value = tree->values[member].next;
        if (nook_json_tree_string_is(tree, member, key))
            return value;
        member = tree->values[value].next;
    }
    return NOOK_JSON_NONE;
}

static unsigned hex4(const char *p)
{
    unsigned code = 0;
    for (int i = 0; i < 4; i++)
        code = code << 4 | (unsigned)hex_digit(p[i]);
    return code;
}

static size_t put_utf8(unsigned code, char out[4])
{
    if (code < 0x80) {
        out[0] = (char)code;
        return 1;
    }
    size_t length = code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (size_t i = length - 1; i > 0; i--, code >>= 6)
        out[i] = (char)(0x80 | (code & 0x3F));
    out[0] = (char)((0xF00 >> length & 0xFF) | code);
    return length;
}

/* One character at p: its bytes in `out`, their number in *used_out. A lone surrogate becomes U+FFFD.
   @return bytes of p that were read */
static size_t unescape(const char *p, size_t left, char out[4], size_t *used_out)
{
    static const char from[] = "bfnrt", to[] = "\b\f\n\r\t";
    *used_out = 1;
    out[0] = p[0];
    if (p[0] != '\\')
        return 1;
    const char *simple = strchr(from, p[1]);
    out[0] = simple ? to[simple - from] : p[1];
    if (p[1] != 'u')
        return 2;
    unsigned code = hex4(p + 2);
    size_t read = 6;
    if (code >= 0xD800 && code < 0xDC00 && left >= 12 && p[6] == '\\' && p[7] == 'u') {
        unsigned low = hex4(p + 8);
        if (low >= 0xDC00 && low < 0xE000) {
            code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
            read = 12;
        }
    }
    *used_out = put_utf8(code >= 0xD800 && code < 0xE000 ? 0xFFFD : code, out);
    return read;
}

bool nook_json_tree_string_is(const nook_json_tree *tree, uint32_t value, const char *text)
{
    const nook_json_value *v = &tree->values[value];
    const char *p = tree->text + v->start;
    size_t length = strlen(text), matched = 0;
    if (v->kind != NOOK_JSON_STRING)
        return false;
    for (size_t i = 0; i < v->length;) {
        char bytes[4];
        size_t used;
        i += unescape(p + i, v->length - i, bytes, &used);
        if (used > length - matched || memcmp(text + matched, bytes, used) != 0)
            return false;
        matched += used;
    }
    return matched == length;
}

char *nook_json_tree_copy_string(const nook_json_tree *tree, uint32_t value, size_t *out_length)
{
    const nook_json_value *v = &tree->values[value];
    const char *p = tree->text + v->start;
    char *copy = malloc((size_t)v->length + 4); /* no escape is shorter than what it stands for */
    size_t length = 0;
    assert(v->kind == NOOK_JSON_STRING);
    for (size_t i = 0; copy && i < v->length;) {
        size_t used;
        i += unescape(p + i, v->length - i, copy + length, &used);
        length += used;
    }
    if (!copy)
        return NULL;
    copy[length] = '\0';
    if (out_length)
        *out_length = length;
    return copy;
}

bool nook_json_tree_integer(const nook_json_tree *tree, uint32_t value, uint64_t *out)
{
    const nook_json_value *v = &tree->values[value];
    uint64_t sum = 0;
    if (v->kind != NOOK_JSON_NUMBER || v->length > 18)
        return false;
    for (uint32_t i = 0; i < v->length; i++) {
        char c = tree->text[v->start + i];
        if (c < '0' || c > '9')
            return false;
        sum = sum * 10 + (uint64_t)(c - '0');
    }
    *out = sum;
    return true;
}

double nook_json_tree_number(const nook_json_tree *tree, uint32_t value)
{
    const nook_json_value *v = &tree->values[value];
    char digits[NUMBER_CAPACITY];
    assert(v->kind == NOOK_JSON_NUMBER);
    memcpy(digits, tree->text + v->start, v->length);
    digits[v->length] = '\0';
    return strtod(digits, NULL);
}
