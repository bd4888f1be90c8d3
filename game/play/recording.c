#include "game/play/recording.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/option.h"
#include "game/settings/line_reader.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    RECORDING_VERSION = 1,
    TICKS_MAX = 60 * 60 * 60 * 4 /* four hours: a run of 2^31 ticks in one line must not ask for all memory */
};

nook_result nook_recording_append(nook_recording *recording, const nook_play_input *input)
{
    if (recording->tick_count == recording->capacity) {
        size_t capacity = recording->capacity ? 2 * recording->capacity : 4096;
        nook_play_input *inputs = realloc(recording->inputs, capacity * sizeof *inputs);
        if (!inputs)
            return nook_fail(NOOK_E_MEMORY, "no memory to record %zu ticks", capacity);
        recording->inputs = inputs;
        recording->capacity = capacity;
    }
    recording->inputs[recording->tick_count++] = *input;
    return NOOK_OK;
}

void nook_recording_free(nook_recording *recording)
{
    free(recording->inputs);
    *recording = (nook_recording){ .tick_count = 0 };
}

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

static bool same(const nook_play_input *a, const nook_play_input *b)
{
    return a->right == b->right && a->forward == b->forward && a->buttons == b->buttons && a->yaw == b->yaw &&
           a->pitch == b->pitch;
}

static void write_runs(const nook_recording *recording, FILE *stream)
{
    for (size_t i = 0; i < recording->tick_count;) {
        const nook_play_input *input = &recording->inputs[i];
        size_t length = 1;
        while (i + length < recording->tick_count && same(input, input + length))
            length++;
        fprintf(stream, "%zu %d %d %#x %d %d\n", length, input->right, input->forward, input->buttons, input->yaw,
                input->pitch);
        i += length;
    }
}

static nook_result print(const void *user, FILE *stream)
{
    const nook_recording *recording = user;
    fprintf(stream, "nook recording %d\nlevel %s\nseed %u\n", RECORDING_VERSION, recording->level, recording->seed);
    if (recording->origin != 0)
        fprintf(stream, "origin %016llx\n", (unsigned long long)recording->origin);
    write_runs(recording, stream);
    return NOOK_OK;
}

nook_result nook_recording_write(const char *path, const nook_recording *recording)
{
    return nook_file_write_text(path, print, recording);
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

/* The rest of a line that begins with a word. @return NULL when it begins otherwise */
static const char *after(const char *line, const char *word)
{
    size_t length = strlen(word);
    if (!line || strncmp(line, word, length) != 0 || line[length] != ' ')
        return NULL;
    return line + length + strspn(line + length, NOOK_LINE_BLANKS);
}

static nook_result read_first(nook_line_reader *lines)
{
    char *line;
    int32_t version;
    nook_result result = nook_line_next(lines, &line);
    if (result != NOOK_OK)
        return result;
    const char *number = after(line, "nook recording");
    if (!number || !nook_text_to_int(number, &version))
        return nook_fail(NOOK_E_FORMAT, "%s: no recording of a game: the first line is not \"nook recording %d\"",
                         lines->file, RECORDING_VERSION);
    if (version != RECORDING_VERSION)
        return nook_fail(NOOK_E_VERSION, "%s: a recording of version %d, this build plays %d; record it anew",
                         lines->file, version, RECORDING_VERSION);
    return NOOK_OK;
}

static nook_result read_header(nook_line_reader *lines, nook_recording *out)
{
    char *line;
    nook_result result = read_first(lines);
    lines->verbatim = true;
    if (result == NOOK_OK)
        result = nook_line_next(lines, &line);
    lines->verbatim = false;
    if (result != NOOK_OK)
        return result;
    const char *level = after(line, "level");
    if (!level || !*level || strlen(level) >= sizeof out->level)
        return nook_fail(NOOK_E_FORMAT, "%s: give level PATH", lines->where);
    snprintf(out->level, sizeof out->level, "%s", level);
    result = nook_line_next(lines, &line);
    if (result != NOOK_OK)
        return result;
    const char *seed = after(line, "seed");
    double number;
    if (!seed || !nook_text_to_number(seed, &number) || number < 0.0 || number > UINT32_MAX ||
        number != (double)(uint32_t)number)
        return nook_fail(NOOK_E_FORMAT, "%s: give seed N, a whole number below 2^32", lines->where);
    out->seed = (uint32_t)number;
    return NOOK_OK;
}

/* One word of a line as a whole number; 0x is taken. @return what follows it, or NULL */
static const char *read_word(const char *at, long lowest, long highest, long *out)
{
    char *end;
    at += strspn(at, NOOK_LINE_BLANKS);
    *out = strtol(at, &end, 0);
    bool whole = end != at && (*end == '\0' || strchr(NOOK_LINE_BLANKS, *end));
    return whole && *out >= lowest && *out <= highest ? end : NULL;
}

static nook_result read_run(const nook_line_reader *lines, const char *line, nook_recording *out)
{
    static const long limits[][2] = {
        { 1, TICKS_MAX },         { -127, 127 },           { -127, 127 }, { 0, UINT16_MAX },
        { INT16_MIN, INT16_MAX }, { INT16_MIN, INT16_MAX }
    };
    long n[NOOK_COUNT(limits)];
    const char *at = line;
    for (size_t i = 0; i < NOOK_COUNT(limits) && at; i++)
        at = read_word(at, limits[i][0], limits[i][1], &n[i]);
    if (!at || at[strspn(at, NOOK_LINE_BLANKS)])
        return nook_fail(NOOK_E_FORMAT, "%s: give TICKS RIGHT FORWARD BUTTONS YAW PITCH", lines->where);
    if ((size_t)n[0] > TICKS_MAX - out->tick_count)
        return nook_fail(NOOK_E_FORMAT, "%s: longer than %d ticks", lines->where, TICKS_MAX);
    const nook_play_input input = { (int8_t)n[1], (int8_t)n[2], (uint16_t)n[3], (int16_t)n[4], (int16_t)n[5] };
    nook_result result = NOOK_OK;
    for (long i = 0; i < n[0] && result == NOOK_OK; i++)
        result = nook_recording_append(out, &input);
    return result;
}

/* A line that need not be there. */
static nook_result read_origin(const nook_line_reader *lines, const char *number, nook_recording *out)
{
    char *end;
    out->origin = strtoull(number, &end, 16);
    bool whole = strlen(number) == 16 && *end == '\0' && strspn(number, "0123456789abcdef") == 16;
    if (!whole || out->tick_count > 0)
        return nook_fail(NOOK_E_FORMAT, "%s: give origin and 16 digits, once, before the first ticks", lines->where);
    return NOOK_OK;
}

static nook_result read_all(nook_line_reader *lines, nook_recording *out)
{
    char *line;
    nook_result result = read_header(lines, out);
    while (result == NOOK_OK) {
        result = nook_line_next(lines, &line);
        if (result == NOOK_OK && !line)
            return NOOK_OK;
        const char *origin = result == NOOK_OK ? after(line, "origin") : NULL;
        if (origin)
            result = read_origin(lines, origin, out);
        else if (result == NOOK_OK)
            result = read_run(lines, line, out);
    }
    return result;
}

nook_result nook_recording_read(const char *path, nook_recording *out)
{
    nook_file file;
    nook_recording read = { .tick_count = 0 };
    nook_result result = nook_file_read(path, &file);
    if (result != NOOK_OK)
        return result;
    nook_line_reader lines = { .file = path,
                               .text = (const char *)file.bytes,
                               .size = file.size,
                               .longest = NOOK_LINE_CAPACITY - 1,
                               .refusal = "no recording of a game: a line of it is no text or too long" };
    result = read_all(&lines, &read);
    nook_file_free(&file);
    if (result != NOOK_OK) {
        nook_recording_free(&read);
        return result;
    }
    *out = read;
    return NOOK_OK;
}
