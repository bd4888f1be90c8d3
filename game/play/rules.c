/* What waits for what, and how a try ends. */
#include "engine/core/log.h"
#include "engine/core/suggestion.h"
#include "game/play/session_internal.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double lock_seconds = 4.0, task_seconds = 12.0; /* of messages */

static uint32_t thing_of_entity(const nook_session *s, uint32_t entity)
{
    for (uint32_t i = 0; i < s->thing_count; i++) {
        if (s->things[i].entity == entity)
            return i;
    }
    return NOOK_NONE;
}

static uint32_t index_of(const nook_level *level, const char *name)
{
    const nook_level_entity *entity = nook_level_find(level, name);
    return entity ? (uint32_t)(entity - level->entities) : NOOK_NONE;
}

/* A plate that waits for what is not there never goes down. */
static nook_result check_accepted(const nook_session *s, const nook_level_entity *plate)
{
    nook_suggestion near = nook_suggestion_for(plate->accepts);
    for (uint32_t i = 0; i < s->thing_count; i++) {
        const char *name = session_thing_name(s, i);
        if (s->things[i].motion != NOOK_BODY_DYNAMIC)
            continue;
        if (nook_level_name_matches(plate->accepts, name))
            return NOOK_OK;
        nook_suggestion_offer(&near, name);
    }
    return nook_fail(NOOK_E_NOT_FOUND, "%s:%u: %s accepts %s, and no body has that name%s%s%s", s->desc.level->path,
                     plate->line, plate->name, plate->accepts, near.nearest ? "; did you mean " : "",
                     near.nearest ? near.nearest : "", near.nearest ? "?" : "");
}

static nook_result make_rule(nook_session *s, uint32_t index)
{
    const nook_level *level = s->desc.level;
    const nook_level_entity *entity = &level->entities[index];
    session_rule *rule = &s->rules[index];
    rule->thing = entity->kind == NOOK_LEVEL_GOAL ? NOOK_NONE : thing_of_entity(s, index);
    bool must = entity->kind != NOOK_LEVEL_GOAL && entity->shape != NOOK_LEVEL_SHAPE_NONE && !strchr(entity->name, '*');
    if (must && rule->thing == NOOK_NONE)
        return nook_fail(NOOK_E_NOT_FOUND, "%s:%u: %s: the scene has no such node, or it is flat", level->path,
                         entity->line, entity->name);
    rule->need_count = entity->need_count;
    for (uint32_t i = 0; i < entity->need_count; i++) {
        rule->needs[i] = index_of(level, entity->needs[i]);
        if (rule->needs[i] == NOOK_NONE)
            return nook_fail(NOOK_E_NOT_FOUND, "%s:%u: %s needs %s, which is not there", level->path,
                             entity->needs_line, entity->name, entity->needs[i]);
    }
    return *entity->accepts ? check_accepted(s, entity) : NOOK_OK;
}

nook_result session_make_rules(nook_session *s)
{
    uint32_t count = s->desc.level->entity_count;
    s->rules = calloc(count + 1, sizeof *s->rules);
    if (!s->rules)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for its rules", s->desc.level->path);
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < count && result == NOOK_OK; i++)
        result = make_rule(s, i);
    return result;
}

void session_reset_rules(nook_session *s)
{
    for (uint32_t i = 0; i < s->desc.level->entity_count; i++) {
        session_rule *rule = &s->rules[i];
        rule->progress = rule->measured = rule->angle = 0.0;
        rule->holds = false;
        rule->next_ray = 0;
        memset(rule->hidden, 0, sizeof rule->hidden);
        if (s->desc.level->entities[i].kind == NOOK_LEVEL_SHADE && rule->thing != NOOK_NONE)
            session_measure_shade_whole(s, i);
    }
    if (*s->desc.level->task)
        session_say(s, task_seconds, "%s", s->desc.level->task);
}

bool session_rule_open(const nook_session *s, uint32_t rule)
{
    return s->rules[rule].progress >= 1.0;
}

bool session_needs_met(const nook_session *s, uint32_t rule)
{
    for (uint32_t i = 0; i < s->rules[rule].need_count; i++) {
        if (!session_rule_open(s, s->rules[rule].needs[i]))
            return false;
    }
    return true;
}

void session_say(nook_session *s, double seconds, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(s->message, sizeof s->message, format, arguments);
    va_end(arguments);
    s->message_until = seconds > 0.0 ? s->ticks + (uint64_t)(seconds / NOOK_PHYSICS_STEP) : UINT64_MAX;
}

/* ---- The end ----------------------------------------------------------------------------------------------------- */

static bool is_there(const nook_session *s, const nook_level_entity *goal)
{
    for (int k = 0; k < 3; k++) { /* hips, so that a box on a floor need not reach below it */
        double at = s->player.feet[k] + (k == 1 ? 0.5 * (double)s->params.crouched_height : 0.0);
        if (fabs(at - goal->at[k]) > 0.5 * goal->size[k])
            return false;
    }
    return true;
}

static void end(nook_session *s, nook_session_status status, const char *text, const char *without)
{
    s->status = status;
    s->end_tick = s->ticks;
    session_say(s, 0.0, "%s", *text ? text : without);
}

static void count_locks(nook_session *s)
{
    uint32_t locks = 0, open = 0;
    for (uint32_t i = 0; i < s->desc.level->entity_count; i++) {
        if (!session_is_lock(&s->desc.level->entities[i]))
            continue;
        locks++;
        open += session_rule_open(s, i);
    }
    if (open > s->open)
        session_say(s, lock_seconds, open == locks ? "All %u hold" : "%u of %u hold", open == locks ? locks : open,
                    locks);
    else if (open < s->open)
        session_say(s, lock_seconds, "Only %u of %u hold", open, locks);
    s->open = open;
}

void session_judge(nook_session *s)
{
    const nook_level *level = s->desc.level;
    if (s->status != NOOK_SESSION_PLAYING)
        return;
    count_locks(s);
    for (uint32_t i = 0; i < level->entity_count; i++) {
        if (level->entities[i].kind != NOOK_LEVEL_GOAL || !session_needs_met(s, i) || !is_there(s, &level->entities[i]))
            continue;
        s->rules[i].progress = 1.0;
        end(s, NOOK_SESSION_WON, level->won, "Won");
        return;
    }
    if (level->seconds > 0.0 && (double)s->ticks * NOOK_PHYSICS_STEP >= level->seconds)
        end(s, NOOK_SESSION_LOST, level->lost, "Time is up");
}
