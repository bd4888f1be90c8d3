#include "game/settings/line_reader.h"
#include "engine/core/log.h"
#include <assert.h>
#include <stdio.h>
#include <string.h>

/* Cuts blanks off both ends, in place. */
static char *trim(char *text)
{
    text += strspn(text, NOOK_LINE_BLANKS);
    size_t length = strlen(text);
    while (length > 0 && strchr(NOOK_LINE_BLANKS, text[length - 1]))
        text[--length] = '\0';
    return text;
}

/* Where a comment begins, or the end. */
static size_t find_comment(const nook_line_reader *reader, const char *text, size_t length)
{
    const char *comment = memchr(text, '#', length);
    size_t at = comment ? (size_t)(comment - text) : length, blanks = 0;
    while (blanks < length && memchr(NOOK_LINE_BLANKS, text[blanks], sizeof NOOK_LINE_BLANKS - 1))
        blanks++;
    return reader->verbatim && at > blanks ? length : at;
}

/* Copies a line without its comment, which may be as long as it likes. */
static nook_result take(nook_line_reader *reader, const char *text, size_t length)
{
    length = find_comment(reader, text, length);
    if (length > reader->longest || memchr(text, '\0', length))
        return nook_fail(NOOK_E_FORMAT, "%s: %s", reader->where, reader->refusal);
    memcpy(reader->buffer, text, length);
    reader->buffer[length] = '\0';
    return NOOK_OK;
}

nook_result nook_line_next(nook_line_reader *reader, char **out_line)
{
    assert(reader->longest < NOOK_LINE_CAPACITY);
    static const char mark[] = "\xef\xbb\xbf"; /* of UTF-8, which some editors put first */
    *out_line = NULL;
    if (reader->at == 0 && reader->size >= 3 && memcmp(reader->text, mark, 3) == 0)
        reader->at = 3;
    while (reader->at < reader->size && !*out_line) {
        const char *text = reader->text + reader->at;
        const char *end = memchr(text, '\n', reader->size - reader->at);
        size_t length = end ? (size_t)(end - text) : reader->size - reader->at;
        reader->at += length + 1;
        snprintf(reader->where, sizeof reader->where, "%s:%u", reader->file, ++reader->line);
        nook_result result = take(reader, text, length);
        if (result != NOOK_OK)
            return result;
        char *line = trim(reader->buffer);
        *out_line = *line ? line : NULL;
    }
    return NOOK_OK;
}

bool nook_line_split(char *line, char **out_name, char **out_value)
{
    char *equals = strchr(line, '=');
    if (!equals)
        return false;
    *equals = '\0';
    *out_name = trim(line);
    *out_value = trim(equals + 1);
    return **out_name && !strpbrk(*out_name, NOOK_LINE_BLANKS) && **out_value;
}
