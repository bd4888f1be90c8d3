/* The text of a pilot. */
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/suggestion.h"
#include "game/option.h"
#include "game/play/pilot_internal.h"
#include "game/settings/line_reader.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS_MAX = 5 };

/* What a step is made of: numbers, or a name and numbers behind it. */
static const struct {
    const char *verb;
    const char *usage;
    pilot_verb id;
    uint32_t least, most; /* numbers behind it */
    bool name;            /* a name comes first */
    bool place_instead;   /* three numbers do instead of the name */
} verbs[] = {
    { "walk_to", "walk_to X Z", PILOT_WALK_TO, 2, 2, false, false },
    { "run_to", "run_to X Z", PILOT_RUN_TO, 2, 2, false, false },
    { "look_at", "look_at NAME, or look_at X Y Z", PILOT_LOOK_AT, 0, 0, true, true },
    { "turn_to", "turn_to YAW PITCH", PILOT_TURN_TO, 2, 2, false, false },
    { "take", "take NAME", PILOT_TAKE, 0, 0, true, false },
    { "place_at", "place_at X Y Z", PILOT_PLACE_AT, 3, 3, false, false },
    { "spin", "spin DEGREES", PILOT_SPIN, 1, 1, false, false },
    { "drop", "drop", PILOT_DROP, 0, 0, false, false },
    { "throw", "throw", PILOT_THROW, 0, 0, false, false },
    { "jump", "jump", PILOT_JUMP, 0, 0, false, false },
    { "restart", "restart", PILOT_RESTART, 0, 0, false, false },
    { "crouch", "crouch", PILOT_CROUCH, 0, 0, false, false },
    { "stand", "stand", PILOT_STAND, 0, 0, false, false },
    { "wait", "wait SECONDS", PILOT_WAIT, 1, 1, false, false },
    { "wait_for", "wait_for NAME [STATE]", PILOT_WAIT_FOR, 0, 1, true, false },
};

typedef struct script {
    nook_line_reader lines;
    nook_pilot *pilot;
    double seconds; /* for the steps that follow */
} script;

static uint32_t split(char *line, char *out_words[WORDS_MAX])
{
    uint32_t count = 0;
    for (char *word = strtok_r(line, NOOK_LINE_BLANKS, &line); word; word = strtok_r(NULL, NOOK_LINE_BLANKS, &line)) {
        if (count == WORDS_MAX)
            return WORDS_MAX + 1;
        out_words[count++] = word;
    }
    return count;
}

static bool numbers(char *const *words, uint32_t count, double *out)
{
    for (uint32_t i = 0; i < count; i++) {
        if (!nook_text_to_number(words[i], &out[i]))
            return false;
    }
    return true;
}

static nook_result append(script *s, const pilot_step *step)
{
    nook_pilot *pilot = s->pilot;
    if (pilot->step_count == pilot->step_capacity) {
        uint32_t capacity = pilot->step_capacity ? 2 * pilot->step_capacity : 64;
        pilot_step *steps = realloc(pilot->steps, capacity * sizeof *steps);
        if (!steps)
            return nook_fail(NOOK_E_MEMORY, "%s: no memory for its steps", s->lines.file);
        pilot->steps = steps;
        pilot->step_capacity = capacity;
    }
    pilot->steps[pilot->step_count++] = *step;
    return NOOK_OK;
}

static nook_result read_within(script *s, char *const *words, uint32_t count)
{
    double seconds;
    if (count != 2 || !nook_text_to_number(words[1], &seconds) || !(seconds > 0.0 && seconds <= 3600.0))
        return nook_fail(NOOK_E_FORMAT, "%s: give within SECONDS, up to 3600", s->lines.where);
    s->seconds = seconds;
    return NOOK_OK;
}

static nook_result read_step(script *s, size_t verb, char *const *words, uint32_t count, pilot_step *step)
{
    bool place = verbs[verb].place_instead && count == 4;
    bool named = verbs[verb].name && !place;
    uint32_t first = named ? 2 : 1, given = count >= first ? count - first : 0;
    uint32_t least = place ? 3 : verbs[verb].least, most = place ? 3 : verbs[verb].most;
    if (count < first || given < least || given > most || !numbers(words + first, given, step->numbers) ||
        (named && strlen(words[1]) >= sizeof step->name))
        return nook_fail(NOOK_E_FORMAT, "%s: give %s", s->lines.where, verbs[verb].usage);
    if (named)
        snprintf(step->name, sizeof step->name, "%s", words[1]);
    step->verb = verbs[verb].id;
    if (step->verb == PILOT_WAIT_FOR && given == 0)
        step->numbers[0] = 1.0;
    step->seconds = step->verb == PILOT_WAIT ? step->numbers[0] + 1.0 : s->seconds;
    return append(s, step);
}

static nook_result read_line(script *s, char *line)
{
    pilot_step step = { .line = s->lines.line };
    char *words[WORDS_MAX] = { NULL };
    snprintf(step.text, sizeof step.text, "%s", line);
    uint32_t count = split(line, words);
    if (count == 0 || count > WORDS_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: no step is made of so many words", s->lines.where);
    if (strcmp(words[0], "within") == 0)
        return read_within(s, words, count);
    nook_suggestion near = nook_suggestion_for(words[0]);
    for (size_t i = 0; i < NOOK_COUNT(verbs); i++) {
        nook_suggestion_offer(&near, verbs[i].verb);
        if (strcmp(words[0], verbs[i].verb) == 0)
            return read_step(s, i, words, count, &step);
    }
    return nook_fail(NOOK_E_FORMAT, "%s: there is no step %s%s%s%s", s->lines.where, words[0],
                     near.nearest ? "; did you mean " : "", near.nearest ? near.nearest : "", near.nearest ? "?" : "");
}

static nook_result read_all(script *s)
{
    char *line;
    for (;;) {
        nook_result result = nook_line_next(&s->lines, &line);
        if (result != NOOK_OK || !line)
            return result;
        result = read_line(s, line);
        if (result != NOOK_OK)
            return result;
    }
}

static nook_result parse(const char *name, const char *text, size_t size, nook_pilot **out_pilot)
{
    *out_pilot = NULL;
    script *s = calloc(1, sizeof *s);
    nook_pilot *pilot = calloc(1, sizeof *pilot);
    nook_result result = NOOK_OK;
    if (!s || !pilot) {
        result = nook_fail(NOOK_E_MEMORY, "%s: no memory for the pilot", name);
    } else {
        snprintf(pilot->file, sizeof pilot->file, "%s", name);
        *s = (script){ .lines = { .file = name,
                                  .text = text,
                                  .size = size,
                                  .longest = 200,
                                  .refusal = "no pilot: a line of it is no text or too long" },
                       .pilot = pilot,
                       .seconds = 20.0 };
        result = read_all(s);
    }
    free(s);
    if (result != NOOK_OK) {
        nook_pilot_destroy(pilot);
        return result;
    }
    *out_pilot = pilot;
    return NOOK_OK;
}

nook_result nook_pilot_parse(const char *name, const char *text, nook_pilot **out_pilot)
{
    return parse(name, text, strlen(text), out_pilot);
}

nook_result nook_pilot_read(const char *path, nook_pilot **out_pilot)
{
    nook_file file;
    *out_pilot = NULL;
    nook_result result = nook_file_read(path, &file);
    if (result != NOOK_OK)
        return result;
    result = parse(path, (const char *)file.bytes, file.size, out_pilot);
    nook_file_free(&file);
    return result;
}

void nook_pilot_destroy(nook_pilot *pilot)
{
    if (!pilot)
        return;
    free(pilot->steps);
    free(pilot);
}
