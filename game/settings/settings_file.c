#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/settings/line_reader.h"
#include "game/settings/settings_internal.h"
#include "game/techniques.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_MAX_BYTES = 256, SEEN_MAX = 64 };

/* ---- Reading ---------------------------------------------------------------------------------------------------- */

/* A file being read. */
typedef struct reading {
    nook_line_reader lines;
    nook_settings_file out;
    char seen[SEEN_MAX][LINE_MAX_BYTES]; /* names so far: each may stand once */
    size_t seen_count;
} reading;

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
        return nook_fail(NOOK_E_FORMAT, "%s: %s before the technique; the first line is technique = NAME",
                         r->lines.where, name);
    const nook_ao_technique *technique = nook_technique_find(value);
    if (!technique)
        return nook_technique_refuse(r->lines.where, value);
    r->out.setting = nook_setting_initial(technique);
    return NOOK_OK;
}

/* One of the shared parameters that say what is computed. @return its value, as text was checked */
static nook_result read_shared(reading *r, const char *name, const char *value, double *out_value)
{
    char owner[NOOK_LINE_WHERE_SIZE + 8];
    nook_param alone = *nook_shared_param(name);
    int32_t block = 0; /* room for any one value */
    alone.offset = 0;
    snprintf(owner, sizeof owner, "%s: ao", r->lines.where);
    nook_result result = nook_param_parse(&alone, owner, &block, value);
    if (result == NOOK_OK)
        *out_value = alone.type == NOOK_PARAM_FLOAT ? strtod(value, NULL) : nook_param_get(&alone, &block);
    return result;
}

static nook_result read_volumes(reading *r, const char *value)
{
    r->out.live = strcmp(value, "live") == 0;
    return r->out.live || strcmp(value, "baked") == 0
               ? NOOK_OK
               : nook_fail(NOOK_E_FORMAT, "%s: volumes is baked or live, not %s; their MiB are volumes.budget",
                           r->lines.where, value);
}

static nook_result read_entry(reading *r, const char *name, const char *value)
{
    double choice;
    if (!is_new(r, name))
        return nook_fail(NOOK_E_FORMAT, "%s: %s stands there twice; leave one of them", r->lines.where, name);
    if (!r->out.setting.technique)
        return read_technique(r, name, value);
    if (strcmp(name, "r_max") == 0)
        return read_shared(r, name, value, &r->out.r_max);
    if (strcmp(name, "plan") == 0 || strncmp(name, "plan.", 5) == 0)
        return nook_plan_params_assign(r->lines.where, &r->out.plan, name, value);
    if (strcmp(name, "volumes") == 0)
        return read_volumes(r, value);
    if (strncmp(name, "volumes.", 8) == 0)
        return nook_stream_params_assign(r->lines.where, &r->out.stream, name, value);
    if (strcmp(name, "falloff") != 0)
        return nook_setting_assign(r->lines.where, &r->out.setting, name, value);
    nook_result result = read_shared(r, name, value, &choice);
    if (result == NOOK_OK)
        snprintf(r->out.falloff, sizeof r->out.falloff, "%s", value);
    return result;
}

static nook_result read_lines(reading *r)
{
    char *line, *name, *value;
    nook_result result = nook_line_next(&r->lines, &line);
    while (result == NOOK_OK && line) {
        if (!nook_line_split(line, &name, &value) || strpbrk(value, NOOK_LINE_BLANKS))
            return nook_fail(NOOK_E_FORMAT, "%s: give name = value", r->lines.where);
        if (read_entry(r, name, value) != NOOK_OK)
            return NOOK_E_FORMAT; /* whatever is wrong with the value is wrong with the file */
        result = nook_line_next(&r->lines, &line);
    }
    if (result == NOOK_OK && !r->out.setting.technique)
        result =
            nook_fail(NOOK_E_FORMAT, "%s: no settings file: it names no technique; the first line is technique = NAME",
                      r->lines.file);
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
        r->lines = (nook_line_reader){ .file = path,
                                       .text = (const char *)file.bytes,
                                       .size = file.size,
                                       .longest = LINE_MAX_BYTES - 1,
                                       .refusal = "no settings file: a line of it is not name = value" };
        r->out.plan = nook_plan_params_initial();
        r->out.stream = nook_stream_params_initial();
        result = read_lines(r);
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

/* Those that are not as they come. */
static void write_rows(const char *owner, const nook_param *rows, size_t count, const void *params, FILE *stream)
{
    char value[NOOK_SETTING_VALUE_MAX];
    for (size_t i = 0; i < count; i++)
        if (nook_param_get(&rows[i], params) != (double)(float)rows[i].initial)
            fprintf(stream, "%s.%s = %s\n", owner, rows[i].name,
                    nook_param_print(&rows[i], params, value, sizeof value));
}

static void write_plan(const nook_plan_params *plan, FILE *stream)
{
    size_t count;
    char mode[NOOK_SETTING_VALUE_MAX];
    const nook_param *rows = nook_plan_param_table(&count);
    nook_plan_params rest = *plan;
    if (plan->mode == NOOK_PLAN_OFF)
        return;
    rest.mode = NOOK_PLAN_OFF; /* has its line: */
    fprintf(stream, "plan = %s\n", nook_param_print(nook_param_find(rows, count, "mode"), plan, mode, sizeof mode));
    write_rows("plan", rows, count, &rest, stream);
}

static void write_stream(const nook_stream_params *params, FILE *stream)
{
    size_t count;
    const nook_param *rows = nook_stream_param_table(&count);
    if (params->budget > 0.0f)
        write_rows("volumes", rows, count, params, stream);
}

void settings_print(const nook_settings_file *file, FILE *stream)
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
    write_plan(&file->plan, stream);
    if (file->live)
        fprintf(stream, "volumes = live\n");
    write_stream(&file->stream, stream);
}

/* What nook_settings_file_write is given. */
typedef struct commented_file {
    const nook_settings_file *file;
    const char *comment;
} commented_file;

static nook_result print(const void *user, FILE *stream)
{
    const commented_file *given = user;
    if (given->comment)
        write_comment(given->comment, stream);
    settings_print(given->file, stream);
    return NOOK_OK;
}

nook_result nook_settings_file_write(const char *path, const nook_settings_file *file, const char *comment)
{
    return nook_file_write_text(path, print, &(commented_file){ file, comment });
}
