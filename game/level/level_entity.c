/* The entities of a level's text: "[kind name]" and the lines below it. */
#include "engine/core/log.h"
#include "engine/core/suggestion.h"
#include "engine/core/vector.h"
#include "game/level/level_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KIND_COUNT = NOOK_LEVEL_GOAL + 1 };
enum {
    BODY = 1 << NOOK_LEVEL_BODY,
    FIXED = 1 << NOOK_LEVEL_FIXED,
    MOVER = 1 << NOOK_LEVEL_MOVER,
    SPINNER = 1 << NOOK_LEVEL_SPINNER,
    PLATE = 1 << NOOK_LEVEL_PLATE,
    SHADE = 1 << NOOK_LEVEL_SHADE,
    GOAL = 1 << NOOK_LEVEL_GOAL,
    SOLID = BODY | FIXED | MOVER | SPINNER | PLATE | SHADE
};

typedef enum line_type { TEXT, NUMBERS, SHAPE, NAMES, YES_NO } line_type;

/* A line that entities can have. */
typedef struct entity_line {
    const char *name;
    unsigned kinds, needed; /* which may have it, and which of them must */
    line_type type;
    uint32_t count; /* NUMBERS */
    double lowest, highest;
    size_t offset;
} entity_line;

#define AT(member) offsetof(nook_level_entity, member)
static const entity_line entity_lines[] = {
    { "node", SOLID, 0, TEXT, 0, 0, 0, AT(node) },
    { "at", SOLID | GOAL, GOAL, NUMBERS, 3, -1e6, 1e6, AT(at) },
    { "turn", SOLID, 0, NUMBERS, 3, -360, 360, AT(turn) },
    { "shape", SOLID, 0, SHAPE, 0, 0, 0, AT(shape) },
    { "mass", BODY, 0, NUMBERS, 1, 1e-3, 1e6, AT(mass) },
    { "friction", SOLID, 0, NUMBERS, 1, 0, 10, AT(friction) },
    { "restitution", SOLID, 0, NUMBERS, 1, 0, 1, AT(restitution) },
    { "needs", MOVER | SPINNER | GOAL, 0, NAMES, 0, 0, 0, AT(needs) },
    { "slide", MOVER, 0, NUMBERS, 3, -1e3, 1e3, AT(slide) },
    { "swing", MOVER, 0, NUMBERS, 3, -360, 360, AT(swing) },
    { "seconds", MOVER | PLATE | SHADE, MOVER, NUMBERS, 1, 0, 3600, AT(seconds) },
    { "latch", MOVER | SPINNER | PLATE | SHADE, 0, YES_NO, 0, 0, 0, AT(latch) },
    { "axis", SPINNER, SPINNER, NUMBERS, 3, -1e3, 1e3, AT(axis) },
    { "rpm", SPINNER, SPINNER, NUMBERS, 1, -600, 600, AT(rpm) },
    { "weight", PLATE, PLATE, NUMBERS, 1, 1e-3, 1e6, AT(weight) },
    { "accepts", PLATE, 0, TEXT, 0, 0, 0, AT(accepts) },
    { "visibility", SHADE, SHADE, NUMBERS, 1, 0, 1, AT(visibility) },
    { "reach", SHADE, SHADE, NUMBERS, 1, 1e-2, 1e3, AT(reach) },
    { "size", GOAL, GOAL, NUMBERS, 3, 1e-3, 1e6, AT(size) },
};
#undef AT

static nook_level_entity *last_entity(const nook_level_reading *r)
{
    return &r->level->entities[r->level->entity_count - 1];
}

/* ", did you mean x?", or nothing. */
static const char *hint(const nook_suggestion *near, char out[96])
{
    snprintf(out, 96, near->nearest ? "; did you mean %s?" : "", near->nearest);
    return out;
}

/* ---- Beginning --------------------------------------------------------------------------------------------------- */

static bool parse_kind(const char *text, nook_level_kind *out)
{
    for (int kind = 0; kind < KIND_COUNT; kind++) {
        if (strcmp(text, nook_level_kind_name((nook_level_kind)kind)) == 0) {
            *out = (nook_level_kind)kind;
            return true;
        }
    }
    return false;
}

static nook_result refuse_kind(const nook_level_reading *r, const char *kind)
{
    char text[96];
    nook_suggestion near = nook_suggestion_for(kind);
    for (int i = 0; i < KIND_COUNT; i++)
        nook_suggestion_offer(&near, nook_level_kind_name((nook_level_kind)i));
    return nook_fail(NOOK_E_FORMAT, "%s: there is no kind %s%s; body, fixed, mover, spinner, plate, shade and goal are",
                     r->lines.where, kind, hint(&near, text));
}

/* Parts "[kind name]" in place. */
static bool split_header(char *line, char **out_kind, char **out_name)
{
    size_t length = strlen(line);
    if (length < 2 || line[length - 1] != ']')
        return false;
    line[length - 1] = '\0';
    *out_kind = line + 1 + strspn(line + 1, NOOK_LINE_BLANKS);
    char *end = *out_kind + strcspn(*out_kind, NOOK_LINE_BLANKS);
    *out_name = end + strspn(end, NOOK_LINE_BLANKS);
    *end = '\0';
    length = strlen(*out_name);
    while (length > 0 && strchr(NOOK_LINE_BLANKS, (*out_name)[length - 1]))
        (*out_name)[--length] = '\0';
    return **out_kind && **out_name;
}

static nook_result grow(nook_level_reading *r)
{
    if (r->level->entity_count < r->entity_capacity)
        return NOOK_OK;
    uint32_t capacity = r->entity_capacity ? 2 * r->entity_capacity : 32;
    nook_level_entity *entities = realloc(r->level->entities, capacity * sizeof *entities);
    if (!entities)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for its entities", r->lines.where);
    r->level->entities = entities;
    r->entity_capacity = capacity;
    return NOOK_OK;
}

nook_result nook_level_begin_entity(nook_level_reading *r, char *line)
{
    char *kind_name, *name;
    nook_level_kind kind;
    nook_result result = nook_level_end_entity(r);
    if (result != NOOK_OK)
        return result;
    if (!split_header(line, &kind_name, &name))
        return nook_fail(NOOK_E_FORMAT, "%s: give [kind name]", r->lines.where);
    if (!parse_kind(kind_name, &kind))
        return refuse_kind(r, kind_name);
    const nook_level_entity *same = nook_level_find(r->level, name);
    if (same)
        return nook_fail(NOOK_E_FORMAT, "%s: %s stands there already, in line %u; names are unique", r->lines.where,
                         name, same->line);
    if (r->level->entity_count == NOOK_LEVEL_ENTITIES_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: more than %d entities", r->lines.where, NOOK_LEVEL_ENTITIES_MAX);
    result = grow(r);
    if (result != NOOK_OK)
        return result;
    nook_level_entity entity = { .kind = kind,
                                 .friction = (double)r->body.friction,
                                 .restitution = (double)r->body.restitution,
                                 .line = r->lines.line };
    result = nook_level_read_text(r, "its name", name, entity.name, sizeof entity.name);
    if (result != NOOK_OK)
        return result;
    if (kind != NOOK_LEVEL_GOAL)
        snprintf(entity.node, sizeof entity.node, "%s", name);
    r->level->entities[r->level->entity_count++] = entity;
    r->entity_seen = 0;
    return NOOK_OK;
}

/* ---- Lines ------------------------------------------------------------------------------------------------------- */

static nook_result read_shape(const nook_level_reading *r, const char *value, nook_level_shape *out)
{
    static const char *const names[] = { "auto", "box", "cylinder", "sphere", "mesh", "none" };
    char text[96];
    nook_suggestion near = nook_suggestion_for(value);
    for (size_t i = 0; i < NOOK_COUNT(names); i++) {
        nook_suggestion_offer(&near, names[i]);
        if (strcmp(value, names[i]) == 0) {
            *out = (nook_level_shape)i;
            return NOOK_OK;
        }
    }
    return nook_fail(NOOK_E_FORMAT, "%s: there is no shape %s%s; auto, box, cylinder, sphere, mesh and none are",
                     r->lines.where, value, hint(&near, text));
}

static nook_result read_needs(const nook_level_reading *r, const char *value, nook_level_entity *entity)
{
    entity->needs_line = r->lines.line;
    for (const char *at = value; *at; at += strspn(at, NOOK_LINE_BLANKS)) {
        char name[NOOK_LINE_CAPACITY];
        size_t length = strcspn(at, NOOK_LINE_BLANKS);
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        if (entity->need_count == NOOK_LEVEL_NEEDS_MAX)
            return nook_fail(NOOK_E_FORMAT, "%s: %s needs more than %d", r->lines.where, entity->name,
                             NOOK_LEVEL_NEEDS_MAX);
        nook_result result =
            nook_level_read_text(r, "a need", name, entity->needs[entity->need_count], sizeof *entity->needs);
        if (result != NOOK_OK)
            return result;
        entity->need_count++;
        at += length;
    }
    return NOOK_OK;
}

static nook_result read_yes_no(const nook_level_reading *r, const char *name, const char *value, bool *out)
{
    bool yes = strcmp(value, "yes") == 0;
    if (!yes && strcmp(value, "no") != 0)
        return nook_fail(NOOK_E_FORMAT, "%s: %s is %s; give yes or no", r->lines.where, name, value);
    *out = yes;
    return NOOK_OK;
}

static nook_result read_value(nook_level_reading *r, const entity_line *line, const char *value)
{
    nook_level_entity *entity = last_entity(r);
    void *target = (char *)entity + line->offset;
    switch (line->type) {
    case TEXT:
        return nook_level_read_text(r, line->name, value, target, NOOK_LEVEL_NAME_SIZE);
    case NUMBERS:
        return nook_level_read_numbers(r, line->name, value, target, line->count, line->lowest, line->highest);
    case SHAPE:
        return read_shape(r, value, target);
    case NAMES:
        return read_needs(r, value, entity);
    case YES_NO:
        return read_yes_no(r, line->name, value, target);
    }
    return NOOK_OK;
}

static nook_result refuse_line(const nook_level_reading *r, const char *name, const char *kind)
{
    char text[96];
    unsigned bit = 1u << last_entity(r)->kind;
    nook_suggestion near = nook_suggestion_for(name);
    for (size_t i = 0; i < NOOK_COUNT(entity_lines); i++) {
        if (entity_lines[i].kinds & bit)
            nook_suggestion_offer(&near, entity_lines[i].name);
    }
    return nook_fail(NOOK_E_FORMAT, "%s: a %s has no %s%s", r->lines.where, kind, name, hint(&near, text));
}

nook_result nook_level_read_entity_line(nook_level_reading *r, const char *name, const char *value)
{
    nook_level_entity *entity = last_entity(r);
    const char *kind = nook_level_kind_name(entity->kind);
    size_t i = 0;
    while (i < NOOK_COUNT(entity_lines) && strcmp(name, entity_lines[i].name) != 0)
        i++;
    if (i == NOOK_COUNT(entity_lines) || !(entity_lines[i].kinds & (1u << entity->kind)))
        return refuse_line(r, name, kind);
    if (r->entity_seen & (1u << i))
        return nook_fail(NOOK_E_FORMAT, "%s: %s stands there twice; leave one of them", r->lines.where, name);
    r->entity_seen |= 1u << i;
    if (strcmp(name, "at") == 0 || strcmp(name, "turn") == 0)
        entity->placed = true;
    return read_value(r, &entity_lines[i], value);
}

/* ---- Ending ------------------------------------------------------------------------------------------------------ */

static nook_result check_pattern(const nook_level *level, const nook_level_entity *entity)
{
    if (!strchr(entity->name, '*') && !strchr(entity->node, '*'))
        return NOOK_OK;
    bool plain = entity->kind == NOOK_LEVEL_BODY || entity->kind == NOOK_LEVEL_FIXED;
    if (plain && strchr(entity->name, '*') == entity->name + strlen(entity->name) - 1 &&
        strcmp(entity->name, entity->node) == 0 && !entity->placed)
        return NOOK_OK;
    return nook_fail(NOOK_E_FORMAT,
                     "%s:%u: %s: a * stands at the end of the name of bodies and fixed ones that stay where they are",
                     level->path, entity->line, entity->name);
}

static nook_result check_mover(const nook_level *level, const nook_level_entity *entity)
{
    if (nook_vector_length(entity->slide) == 0.0 && nook_vector_length(entity->swing) == 0.0)
        return nook_fail(NOOK_E_FORMAT, "%s:%u: %s goes nowhere; give slide or swing", level->path, entity->line,
                         entity->name);
    if (!(entity->seconds > 0.0))
        return nook_fail(NOOK_E_FORMAT, "%s:%u: %s: a mover takes more than 0 seconds", level->path, entity->line,
                         entity->name);
    return NOOK_OK;
}

nook_result nook_level_end_entity(nook_level_reading *r)
{
    const nook_level *level = r->level;
    if (level->entity_count == 0)
        return NOOK_OK;
    nook_level_entity *entity = last_entity(r);
    for (size_t i = 0; i < NOOK_COUNT(entity_lines); i++) {
        if ((entity_lines[i].needed & (1u << entity->kind)) && !(r->entity_seen & (1u << i)))
            return nook_fail(NOOK_E_FORMAT, "%s:%u: the %s %s has no %s", level->path, entity->line,
                             nook_level_kind_name(entity->kind), entity->name, entity_lines[i].name);
    }
    if (entity->kind == NOOK_LEVEL_BODY && entity->shape == NOOK_LEVEL_SHAPE_MESH)
        return nook_fail(NOOK_E_FORMAT, "%s:%u: %s: bodies cannot have the shape mesh; give box, cylinder or sphere",
                         level->path, entity->line, entity->name);
    if (entity->kind == NOOK_LEVEL_SPINNER && !nook_vector_normalize(entity->axis, entity->axis))
        return nook_fail(NOOK_E_FORMAT, "%s:%u: %s: an axis of no length", level->path, entity->line, entity->name);
    nook_result result = entity->kind == NOOK_LEVEL_MOVER ? check_mover(level, entity) : NOOK_OK;
    return result == NOOK_OK ? check_pattern(level, entity) : result;
}

/* Whether others can wait for it. */
static bool opens(const nook_level_entity *entity)
{
    return entity->kind != NOOK_LEVEL_BODY && entity->kind != NOOK_LEVEL_FIXED;
}

static nook_result check_need(const nook_level *level, const nook_level_entity *entity, const char *need)
{
    char text[96];
    const nook_level_entity *found = nook_level_find(level, need);
    if (found && opens(found) && found != entity)
        return NOOK_OK;
    if (found == entity)
        return nook_fail(NOOK_E_FORMAT, "%s:%u: %s needs itself", level->path, entity->needs_line, need);
    if (found)
        return nook_fail(NOOK_E_FORMAT, "%s:%u: %s needs %s, and a %s is never open", level->path, entity->needs_line,
                         entity->name, need, nook_level_kind_name(found->kind));
    nook_suggestion near = nook_suggestion_for(need);
    for (uint32_t i = 0; i < level->entity_count; i++) {
        if (opens(&level->entities[i]))
            nook_suggestion_offer(&near, level->entities[i].name);
    }
    return nook_fail(NOOK_E_FORMAT, "%s:%u: %s needs %s, which is not there%s", level->path, entity->needs_line,
                     entity->name, need, hint(&near, text));
}

/* ---- Circles ----------------------------------------------------------------------------------------------------- */

static const nook_level_entity *first_shut(const nook_level *level, const nook_level_entity *entity,
                                           const bool *can_open)
{
    for (uint32_t n = 0; n < entity->need_count; n++) {
        const nook_level_entity *need = nook_level_find(level, entity->needs[n]);
        if (!can_open[need - level->entities])
            return need;
    }
    return NULL;
}

/* Finds what can open because all that it needs can, until there is nothing new. */
static void spread(const nook_level *level, bool *can_open)
{
    bool news = true;
    while (news) {
        news = false;
        for (uint32_t i = 0; i < level->entity_count; i++) {
            if (can_open[i] || first_shut(level, &level->entities[i], can_open))
                continue;
            can_open[i] = news = true;
        }
    }
}

/* What waits for itself by way of others never opens, nor what waits for that. */
static nook_result check_circles(const nook_level *level)
{
    bool *can_open = calloc(level->entity_count + 1, sizeof *can_open);
    const nook_level_entity *shut = NULL;
    if (!can_open)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to check it", level->path);
    spread(level, can_open);
    for (uint32_t i = 0; i < level->entity_count && !shut; i++)
        shut = can_open[i] ? NULL : &level->entities[i];
    for (uint32_t i = 0; i < level->entity_count && shut; i++)
        shut = first_shut(level, shut, can_open); /* after so many steps one goes round in the circle */
    const nook_level_entity *need = shut ? first_shut(level, shut, can_open) : NULL;
    free(can_open);
    if (!shut)
        return NOOK_OK;
    return nook_fail(NOOK_E_FORMAT, "%s:%u: %s needs %s, which waits for %s in turn: neither ever opens", level->path,
                     shut->needs_line, shut->name, need->name, shut->name);
}

nook_result nook_level_check_needs(const nook_level *level)
{
    for (uint32_t i = 0; i < level->entity_count; i++) {
        const nook_level_entity *entity = &level->entities[i];
        for (uint32_t n = 0; n < entity->need_count; n++) {
            nook_result result = check_need(level, entity, entity->needs[n]);
            if (result != NOOK_OK)
                return result;
        }
    }
    return check_circles(level);
}
