/* A settings file that keeps what people have written around its values. */
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/settings/line_reader.h"
#include "game/settings/settings_internal.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { ENTRIES_MAX = 64, ENTRY_SIZE = 64, PRINTED_MAX = ENTRIES_MAX * 2 * ENTRY_SIZE };

typedef struct entry {
    char name[ENTRY_SIZE], value[ENTRY_SIZE];
    bool written;
} entry;

typedef struct entries {
    entry items[ENTRIES_MAX];
    size_t count;
} entries;

/* What a file is rewritten from. */
typedef struct update {
    nook_file text;      /* as it is now */
    entries before, now; /* that are not as they come */
    bool same_technique;
} update;

/* ---- Entries ------------------------------------------------------------------------------------------------------ */

static entry *find(entries *all, const char *name, size_t length)
{
    for (size_t i = 0; i < all->count; i++)
        if (strlen(all->items[i].name) == length && memcmp(all->items[i].name, name, length) == 0)
            return &all->items[i];
    return NULL;
}

/* @return false without memory */
static bool list(const nook_settings_file *file, entries *out)
{
    char printed[PRINTED_MAX] = "", *name, *value, *rest = printed;
    FILE *stream = fmemopen(printed, sizeof printed, "w");
    out->count = 0;
    if (!stream)
        return false;
    settings_print(file, stream);
    if (fclose(stream) != 0)
        return false;
    for (char *line = strsep(&rest, "\n"); line && *line; line = strsep(&rest, "\n")) {
        bool split = nook_line_split(line, &name, &value);
        assert(split && out->count < ENTRIES_MAX);
        (void)split;
        entry *made = &out->items[out->count++];
        snprintf(made->name, sizeof made->name, "%s", name);
        snprintf(made->value, sizeof made->value, "%s", value);
        made->written = false;
    }
    return true;
}

/* ---- Lines -------------------------------------------------------------------------------------------------------- */

/* A line of the file: where its parts are. */
typedef struct line_span {
    const char *text, *name, *value;
    size_t length, name_length, value_length; /* without the newline; value_length 0: nothing but a comment */
} line_span;

static size_t trim(const char **text, size_t length)
{
    while (length > 0 && strchr(NOOK_LINE_BLANKS, **text))
        (*text)++, length--;
    while (length > 0 && strchr(NOOK_LINE_BLANKS, (*text)[length - 1]))
        length--;
    return length;
}

static line_span parts_of(const char *text, size_t length)
{
    static const char mark[] = "\xef\xbb\xbf"; /* as nook_line_next skips it */
    line_span line = { .text = text, .length = length, .name = text };
    if (length >= 3 && memcmp(text, mark, 3) == 0)
        line.name += 3;
    size_t rest = (size_t)(text + length - line.name);
    const char *comment = memchr(line.name, '#', rest);
    rest = comment ? (size_t)(comment - line.name) : rest;
    const char *equals = memchr(line.name, '=', rest);
    if (!equals)
        return line;
    line.value = equals + 1;
    line.value_length = trim(&line.value, (size_t)(line.name + rest - line.value));
    line.name_length = trim(&line.name, (size_t)(equals - line.name));
    return line;
}

static bool begins(const line_span *line, const char *with)
{
    return line->name_length >= strlen(with) && memcmp(line->name, with, strlen(with)) == 0;
}

/* Of a technique, and not for all of them. */
static bool is_own(const line_span *line)
{
    static const char *const others[] = { "technique", "resolution", "ao.", "r_max", "falloff", "plan", "volumes" };
    for (size_t i = 0; i < NOOK_COUNT(others); i++)
        if (begins(line, others[i]))
            return false;
    return true;
}

/* A value that is said and is as it comes stays, unless nobody knows it any more; one that has become that goes. */
static bool stays(update *u, const line_span *line)
{
    return !find(&u->before, line->name, line->name_length) && (u->same_technique || !is_own(line));
}

static void write_line(update *u, const line_span *line, const char *end, FILE *stream)
{
    const char *behind = line->value + line->value_length;
    entry *now = line->value_length ? find(&u->now, line->name, line->name_length) : NULL;
    const entry *before = now ? find(&u->before, line->name, line->name_length) : NULL;
    if (now)
        now->written = true;
    if (line->value_length && !now && !stays(u, line))
        return;
    if (!now || (before && strcmp(before->value, now->value) == 0))
        fprintf(stream, "%.*s%s", (int)line->length, line->text, end);
    else
        fprintf(stream, "%.*s%s%.*s%s", (int)(line->value - line->text), line->text, now->value,
                (int)(line->text + line->length - behind), behind, end);
}

static nook_result print(const void *user, FILE *stream)
{
    update *u = *(update *const *)user; /* whose entries remember that they were written */
    const char *at = (const char *)u->text.bytes, *end = at + u->text.size;
    const char *missing = ""; /* newline of the last line */
    while (at < end) {
        const char *newline = memchr(at, '\n', (size_t)(end - at));
        const line_span line = parts_of(at, (size_t)((newline ? newline : end) - at));
        missing = newline ? "" : "\n";
        write_line(u, &line, newline ? "\n" : "", stream);
        at += line.length + 1;
    }
    for (size_t i = 0; i < u->now.count; i++) {
        if (!u->now.items[i].written) {
            fprintf(stream, "%s%s = %s\n", missing, u->now.items[i].name, u->now.items[i].value);
            missing = "";
        }
    }
    return NOOK_OK;
}

/* ---- The file ----------------------------------------------------------------------------------------------------- */

static nook_result rewrite(const char *path, const nook_settings_file *file)
{
    nook_settings_file before;
    nook_result result = nook_settings_file_read(path, &before);
    if (result != NOOK_OK)
        return result;
    update *u = calloc(1, sizeof *u);
    if (!u)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to write it", path);
    result = nook_file_read(path, &u->text);
    if (result == NOOK_OK && (!list(&before, &u->before) || !list(file, &u->now)))
        result = nook_fail(NOOK_E_MEMORY, "%s: no memory to write it", path);
    if (result == NOOK_OK) {
        u->same_technique = before.setting.technique == file->setting.technique;
        result = nook_file_write_text(path, print, &u);
    }
    nook_file_free(&u->text);
    free(u);
    return result;
}

nook_result nook_settings_file_update(const char *path, const nook_settings_file *file)
{
    return nook_file_exists(path) ? rewrite(path, file) : nook_settings_file_write(path, file, NULL);
}
