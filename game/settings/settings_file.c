#include "game/settings/settings_file.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/techniques.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_MAX_BYTES = 256, WHERE_MAX_BYTES = 4096 + 32, SEEN_MAX = 64 };
static const char blanks[] = " \t\r";

/* ---- Reading ---------------------------------------------------------------------------------------------------- */

/* A file being read. */
typedef struct reading {
    const char *path;
    unsigned line;
    char where[WHERE_MAX_BYTES]; /* "file:line" */
    nook_settings_file out;
    char seen[SEEN_MAX][LINE_MAX_BYTES]; /* names so far: each may stand once */
    size_t seen_count;
} reading;

/* Cuts comment and blanks off. @return NULL for a line without anything */
static char *trim(char *line)
{
    line[strcspn(line, "#")] = '\0';
    line += strspn(line, blanks);
    size_t length = strlen(line);
    while (length > 0 && strchr(blanks, line[length - 1]))
        line[--length] = '\0';
    return length > 0 ? line : NULL;
}

/* "name = value" in place. @return false when it is something else */
static bool split(char *line, char **out_name, char **out_value)
{
    char *equals = strchr(line, '=');
    if (!equals)
        return false;
    *equals = '\0';
    *out_name = trim(line);
    *out_value = trim(equals + 1);
    return *out_name && *out_value && !strpbrk(*out_name, blanks) && !strpbrk(*out_value, blanks);
}

static bool is_new(reading *r, const char *name)
{
    for (size_t i = 0; i < r->seen_count; i++) {
        if (strcmp(r->seen[i], name) == 0)
            return false;
    }
    if (r->seen_count < SEEN_MAX) /* more names than there are were refused before that */
        snprintf(r->seen[r->seen_count++], LINE_MAX_BYTES, "%s", name);
    return true;
}

static nook_result read_technique(reading *r, const char *name, const char *value)
{
    if (strcmp(name, "technique") != 0)
        return nook_fail(NOOK_E_FORMAT, "%s: %s before the technique; the first line is technique = NAME", r->where,
                         name);
    const nook_ao_technique *technique = nook_technique_find(value);
    if (!technique)
        return nook_technique_refuse(r->where, value);
    r->out.setting = nook_setting_initial(technique);
    return NOOK_OK;
}

/* One of the shared parameters that say what is computed. @return its value, as text was checked */
static nook_result read_shared(reading *r, const char *name, const char *value, double *out_value)
{
    char owner[WHERE_MAX_BYTES + 8];
    nook_param alone = *nook_shared_param(name);
    int32_t block = 0; /* room for any one value */
    alone.offset = 0;
    snprintf(owner, sizeof owner, "%s: ao", r->where);
    nook_result result = nook_param_parse(&alone, owner, &block, value);
    if (result == NOOK_OK)
        *out_value = alone.type == NOOK_PARAM_FLOAT ? strtod(value, NULL) : nook_param_get(&alone, &block);
    return result;
}

static nook_result read_entry(reading *r, const char *name, const char *value)
{
    double choice;
    if (!is_new(r, name))
        return nook_fail(NOOK_E_FORMAT, "%s: %s stands there twice; leave one of them", r->where, name);
    if (!r->out.setting.technique)
        return read_technique(r, name, value);
    if (strcmp(name, "r_max") == 0)
        return read_shared(r, name, value, &r->out.r_max);
    if (strcmp(name, "falloff") != 0)
        return nook_setting_assign(r->where, &r->out.setting, name, value);
    nook_result result = read_shared(r, name, value, &choice);
    if (result == NOOK_OK)
        snprintf(r->out.falloff, sizeof r->out.falloff, "%s", value);
    return result;
}

static nook_result read_line(reading *r, const char *text, size_t length)
{
    char line[LINE_MAX_BYTES], *name, *value;
    snprintf(r->where, sizeof r->where, "%s:%u", r->path, r->line);
    const char *comment = memchr(text, '#', length);
    if (comment) /* which may be as long as it likes */
        length = (size_t)(comment - text);
    if (length >= sizeof line || memchr(text, '\0', length))
        return nook_fail(NOOK_E_FORMAT, "%s: no settings file: a line of it is not name = value", r->where);
    memcpy(line, text, length);
    line[length] = '\0';
    char *trimmed = trim(line);
    if (!trimmed)
        return NOOK_OK;
    if (!split(trimmed, &name, &value))
        return nook_fail(NOOK_E_FORMAT, "%s: give name = value", r->where);
    /* Whatever is wrong with the value is wrong with the file. */
    return read_entry(r, name, value) == NOOK_OK ? NOOK_OK : NOOK_E_FORMAT;
}

static nook_result read_lines(reading *r, const char *text, size_t size)
{
    nook_result result = NOOK_OK;
    for (size_t at = 0; at < size && result == NOOK_OK;) {
        const char *end = memchr(text + at, '\n', size - at);
        size_t length = end ? (size_t)(end - text) - at : size - at;
        r->line++;
        result = read_line(r, text + at, length);
        at += length + 1;
    }
    if (result == NOOK_OK && !r->out.setting.technique)
        result = nook_fail(NOOK_E_FORMAT,
                           "%s: no settings file: it names no technique; the first line is technique = NAME", r->path);
    return result;
}

nook_result nook_settings_file_read(const char *path, nook_settings_file *out)
{
    nook_file file;
    nook_result result = nook_file_read(path, &file);
    if (result != NOOK_OK)
        return result;
    reading *r = calloc(1, sizeof *r);
    if (r) {
        r->path = path;
        result = read_lines(r, (const char *)file.bytes, file.size);
    } else {
        result = nook_fail(NOOK_E_MEMORY, "%s: no memory to read it", path);
    }
    if (result == NOOK_OK)
        *out = r->out;
    free(r);
    nook_file_free(&file);
    return result;
}

/* ---- Writing ---------------------------------------------------------------------------------------------------- */

static void write_comment(const char *comment, FILE *stream)
{
    while (*comment) {
        size_t length = strcspn(comment, "\n");
        fprintf(stream, "#%s%.*s\n", length ? " " : "", (int)length, comment);
        comment += length + (comment[length] == '\n');
    }
}

/* The fewest digits, from six on, that read back as the same number. */
static void write_number(const char *name, double value, FILE *stream)
{
    char text[32];
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    fprintf(stream, "%s = %s\n", name, text);
}

static void write_setting(const nook_settings_file *file, FILE *stream)
{
    const nook_setting *setting = &file->setting;
    char value[NOOK_SETTING_VALUE_MAX];
    fprintf(stream, "technique = %s\n", setting->technique->name);
    if (setting->resolution > 0)
        fprintf(stream, "resolution = %u\n", setting->resolution);
    for (uint32_t i = 0; i < setting->param_count; i++) {
        const nook_setting_param *entry = &setting->params[i];
        fprintf(stream, "%s%s = %s\n", entry->shared ? "ao." : "", entry->param->name,
                nook_setting_value(entry, value));
    }
    if (file->r_max > 0.0)
        write_number("r_max", file->r_max, stream);
    if (*file->falloff)
        fprintf(stream, "falloff = %s\n", file->falloff);
}

nook_result nook_settings_file_write(const char *path, const nook_settings_file *file, const char *comment)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (stream) {
        if (comment)
            write_comment(comment, stream);
        write_setting(file, stream);
    }
    if (!stream || fclose(stream) != 0) {
        free(text);
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to write it", path);
    }
    nook_result result = nook_file_write(path, text, size);
    free(text);
    return result;
}
