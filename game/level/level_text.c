/* The text of a level: its lines, and those at the top. */
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/suggestion.h"
#include "game/level/level_internal.h"
#include "game/option.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

nook_result nook_level_read_numbers(const nook_level_reading *r, const char *name, const char *value, double *out,
                                    uint32_t count, double lowest, double highest)
{
    static const char *const wanted[] = { "", "a number", "two numbers", "three numbers" };
    double numbers[3];
    uint32_t found = 0;
    const char *at = value;
    for (; *at && found < count; found++) {
        char word[64];
        size_t length = strcspn(at, NOOK_LINE_BLANKS);
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        if (length >= sizeof word || !nook_text_to_number(word, &numbers[found]))
            break;
        if (numbers[found] < lowest || numbers[found] > highest)
            return nook_fail(NOOK_E_FORMAT, "%s: %s = %s: not within %g and %g", r->lines.where, name, value, lowest,
                             highest);
        at += length;
        at += strspn(at, NOOK_LINE_BLANKS);
    }
    if (found != count || *at)
        return nook_fail(NOOK_E_FORMAT, "%s: %s = %s: give %s", r->lines.where, name, value, wanted[count]);
    memcpy(out, numbers, count * sizeof *out);
    return NOOK_OK;
}

nook_result nook_level_read_text(const nook_level_reading *r, const char *name, const char *value, char *out,
                                 size_t capacity)
{
    if (strlen(value) >= capacity)
        return nook_fail(NOOK_E_FORMAT, "%s: %s is longer than %zu bytes", r->lines.where, name, capacity - 1);
    snprintf(out, capacity, "%s", value);
    return NOOK_OK;
}

/* A path that is relative to the level's own file. */
static nook_result read_path(const nook_level_reading *r, const char *name, const char *value, char *out,
                             size_t capacity)
{
    const char *end = nook_path_name(r->level->path);
    int folder = *value == '/' ? 0 : (int)(end - r->level->path);
    int length = snprintf(out, capacity, "%.*s%s", folder, r->level->path, value);
    if (length < 0 || (size_t)length >= capacity)
        return nook_fail(NOOK_E_FORMAT, "%s: %s: the path is longer than %zu bytes", r->lines.where, name,
                         capacity - 1);
    return NOOK_OK;
}

static nook_result read_file(nook_level_reading *r, const char *name, const char *library, const char *path)
{
    nook_level *level = r->level;
    if (level->file_count == NOOK_LEVEL_FILES_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: more than %d files", r->lines.where, NOOK_LEVEL_FILES_MAX);
    for (uint32_t i = 0; i < level->file_count && *library; i++) {
        if (strcmp(level->files[i].name, library) == 0)
            return nook_fail(NOOK_E_FORMAT, "%s: there are two libraries of the name %s", r->lines.where, library);
    }
    nook_level_file *file = &level->files[level->file_count];
    file->line = r->lines.line;
    nook_result result = read_path(r, name, path, file->path, sizeof file->path);
    if (result == NOOK_OK)
        result = nook_level_read_text(r, name, library, file->name, sizeof file->name);
    level->file_count += result == NOOK_OK;
    return result;
}

static nook_result read_scene(nook_level_reading *r, const char *name, const char *value)
{
    return read_file(r, name, "", value);
}

/* "name path" */
static nook_result read_library(nook_level_reading *r, const char *name, const char *value)
{
    char library[NOOK_LINE_CAPACITY];
    size_t length = strcspn(value, NOOK_LINE_BLANKS);
    const char *path = value + length + strspn(value + length, NOOK_LINE_BLANKS);
    snprintf(library, sizeof library, "%.*s", (int)length, value);
    if (!*path || strchr(library, ':'))
        return nook_fail(NOOK_E_FORMAT, "%s: give library = NAME PATH, the name without a colon", r->lines.where);
    return read_file(r, name, library, path);
}

#define TEXT_LINE(member)                                                                        \
    static nook_result read_##member(nook_level_reading *r, const char *name, const char *value) \
    {                                                                                            \
        return nook_level_read_text(r, name, value, r->level->member, sizeof r->level->member);  \
    }
TEXT_LINE(title)
TEXT_LINE(task)
TEXT_LINE(won)
TEXT_LINE(lost)
#undef TEXT_LINE

static nook_result read_settings(nook_level_reading *r, const char *name, const char *value)
{
    return read_path(r, name, value, r->level->settings, sizeof r->level->settings);
}

static nook_result read_start(nook_level_reading *r, const char *name, const char *value)
{
    return nook_level_read_numbers(r, name, value, r->level->start, 3, -1e6, 1e6);
}

static nook_result read_look(nook_level_reading *r, const char *name, const char *value)
{
    double angles[2];
    nook_result result = nook_level_read_numbers(r, name, value, angles, 2, -360.0, 360.0);
    if (result != NOOK_OK)
        return result;
    if (fabs(angles[1]) > 90.0)
        return nook_fail(NOOK_E_FORMAT, "%s: look = %s: the pitch is beyond 90 degrees", r->lines.where, value);
    r->level->yaw = angles[0];
    r->level->pitch = angles[1];
    return NOOK_OK;
}

static nook_result read_seconds(nook_level_reading *r, const char *name, const char *value)
{
    return nook_level_read_numbers(r, name, value, &r->level->seconds, 1, 0.0, 86400.0);
}

/* What can stand at the top. */
static const struct {
    const char *name;
    bool often;
    nook_result (*read)(nook_level_reading *r, const char *name, const char *value);
} header_lines[] = {
    { "title", false, read_title },       { "task", false, read_task },   { "won", false, read_won },
    { "lost", false, read_lost },         { "scene", true, read_scene },  { "library", true, read_library },
    { "settings", false, read_settings }, { "start", false, read_start }, { "look", false, read_look },
    { "seconds", false, read_seconds },
};

static nook_result read_header_line(nook_level_reading *r, const char *name, const char *value)
{
    nook_suggestion near = nook_suggestion_for(name);
    for (size_t i = 0; i < NOOK_COUNT(header_lines); i++) {
        nook_suggestion_offer(&near, header_lines[i].name);
        if (strcmp(name, header_lines[i].name) != 0)
            continue;
        uint32_t bit = 1u << i;
        if ((r->header_seen & bit) && !header_lines[i].often)
            return nook_fail(NOOK_E_FORMAT, "%s: %s stands there twice; leave one of them", r->lines.where, name);
        r->header_seen |= bit;
        return header_lines[i].read(r, name, value);
    }
    return nook_fail(NOOK_E_FORMAT, "%s: no level has a %s%s%s%s", r->lines.where, name,
                     near.nearest ? "; did you mean " : "", near.nearest ? near.nearest : "", near.nearest ? "?" : "");
}

static nook_result read_line(nook_level_reading *r, char *line)
{
    char *name, *value;
    if (*line == '[')
        return nook_level_begin_entity(r, line);
    if (!nook_line_split(line, &name, &value))
        return nook_fail(NOOK_E_FORMAT, "%s: give name = value, or [kind name]", r->lines.where);
    if (r->level->entity_count > 0)
        return nook_level_read_entity_line(r, name, value);
    return read_header_line(r, name, value);
}

static nook_result read_lines(nook_level_reading *r)
{
    char *line;
    nook_result result = nook_line_next(&r->lines, &line);
    while (result == NOOK_OK && line) {
        result = read_line(r, line);
        if (result == NOOK_OK)
            result = nook_line_next(&r->lines, &line);
    }
    if (result == NOOK_OK)
        result = nook_level_end_entity(r);
    if (result == NOOK_OK)
        result = nook_level_check_needs(r->level);
    if (result != NOOK_OK)
        return result;
    for (uint32_t i = 0; i < r->level->file_count; i++) {
        if (!*r->level->files[i].name)
            return NOOK_OK;
    }
    return nook_fail(NOOK_E_FORMAT, "%s:%u: it names no scene to stand in; give scene = PATH", r->lines.file,
                     r->lines.line);
}

nook_result nook_level_read_file(const char *path, nook_level *level)
{
    nook_file file;
    nook_result result = nook_file_read(path, &file);
    if (result != NOOK_OK)
        return result;
    nook_level_reading *r = calloc(1, sizeof *r);
    if (r) {
        r->level = level;
        r->lines = (nook_line_reader){ .file = path,
                                       .text = (const char *)file.bytes,
                                       .size = file.size,
                                       .longest = NOOK_LINE_CAPACITY - 1,
                                       .refusal = "no level: a line of it is no text or too long" };
        r->body = nook_body_defaults_initial();
        result = read_lines(r);
    } else {
        result = nook_fail(NOOK_E_MEMORY, "%s: no memory to read it", path);
    }
    free(r);
    nook_file_free(&file);
    return result;
}
