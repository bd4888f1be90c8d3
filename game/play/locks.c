/* Plates, which feel weight, and shades, which feel darkness. */
#include "game/play/session_internal.h"
#include <math.h>
#include <string.h>

enum { RAYS_A_TICK = 16 };

/* A plate that is down stays down at this part of its weight: what lies on it may still be coming to rest. */
static const double keep_down = 0.85;
/* Bodies press down with as much as their weight within this. */
static const double weight_tolerance = 0.98;
bool session_is_lock(const nook_level_entity *entity)
{
    return entity->kind == NOOK_LEVEL_PLATE || entity->kind == NOOK_LEVEL_SHADE;
}

/* The upright box around a thing that stands still. */
static void box_of(const session_thing *thing, double low[3], double high[3])
{
    for (int k = 0; k < 3; k++)
        low[k] = INFINITY, high[k] = -INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = thing->middle[k] + (corner >> k & 1 ? 1.0 : -1.0) * thing->half[k];
        nook_pose_apply_point(&thing->start, p, p);
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], p[k]);
            high[k] = fmax(high[k], p[k]);
        }
    }
}

/* ---- Plates ------------------------------------------------------------------------------------------------------ */

typedef struct weighing {
    const nook_session *session;
    const nook_level_entity *plate;
    double all, accepted; /* newtons */
} weighing;

static void weigh(void *user, nook_body body, double newtons)
{
    weighing *w = user;
    uint32_t thing = session_thing_of_body(w->session, body);
    w->all += newtons;
    if (thing != NOOK_NONE && nook_level_name_matches(w->plate->accepts, session_thing_name(w->session, thing)))
        w->accepted += newtons;
}

/* Kilograms on it that count. */
static double weight_on(const nook_session *s, const nook_level_entity *entity, session_rule *rule)
{
    const nook_body body = s->things[rule->thing].body;
    weighing w = { s, entity, 0.0, 0.0 };
    nook_physics_each_load(s->physics, body, weigh, &w);
    if (s->player.grounded && s->player.ground.id == body.id) /* which hovers, and touches nothing */
        w.all += (double)s->params.mass * session_gravity;
    rule->measured = w.all;
    return (*entity->accepts ? w.accepted : w.all) / session_gravity;
}

static bool plate_holds(const nook_session *s, const nook_level_entity *entity, session_rule *rule)
{
    double part = rule->holds ? keep_down : weight_tolerance;
    return weight_on(s, entity, rule) >= part * entity->weight;
}

/* ---- Shades ------------------------------------------------------------------------------------------------------ */

/* Ray i of 256 from a plane that looks up, as dense as the cosine: points of Hammersley's set on the disc, lifted (Malley). */
static void shade_ray(uint32_t i, double out[3])
{
    uint32_t bits = i;
    double inverse = 0.0;
    for (double digit = 0.5; bits; bits >>= 1, digit *= 0.5)
        inverse += digit * (bits & 1);
    double u = (i + 0.5) / NOOK_SHADE_RAYS, angle = 2.0 * NOOK_PI * (inverse + 0.5 / NOOK_SHADE_RAYS);
    double radius = sqrt(u);
    out[0] = radius * cos(angle);
    out[1] = sqrt(1.0 - u);
    out[2] = radius * sin(angle);
}

/* The middle of its top, a little above it. */
static void shade_point(const session_thing *thing, double out[3])
{
    double low[3], high[3];
    box_of(thing, low, high);
    out[0] = 0.5 * (low[0] + high[0]);
    out[1] = high[1] + 0.001;
    out[2] = 0.5 * (low[2] + high[2]);
}

static void cast_rays(nook_session *s, const nook_level_entity *entity, session_rule *rule, uint32_t count)
{
    const session_thing *thing = &s->things[rule->thing];
    const nook_body ignored[2] = { thing->body, s->player.body }; /* nobody need stand there all the time */
    double point[3], direction[3];
    nook_ray_hit hit;
    shade_point(thing, point);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t ray = rule->next_ray;
        uint64_t bit = (uint64_t)1 << (ray % 64);
        shade_ray(ray, direction);
        if (nook_physics_ray(s->physics, point, direction, entity->reach, ignored, &hit))
            rule->hidden[ray / 64] |= bit;
        else
            rule->hidden[ray / 64] &= ~bit;
        rule->next_ray = (ray + 1) % NOOK_SHADE_RAYS;
    }
    uint32_t hidden = 0;
    for (int i = 0; i < NOOK_SHADE_RAYS / 64; i++) {
        for (uint64_t word = rule->hidden[i]; word; word &= word - 1)
            hidden++;
    }
    rule->measured = 1.0 - (double)hidden / NOOK_SHADE_RAYS;
}

void session_measure_shade_whole(nook_session *s, uint32_t rule)
{
    cast_rays(s, &s->desc.level->entities[rule], &s->rules[rule], NOOK_SHADE_RAYS);
}

static bool shade_holds(nook_session *s, const nook_level_entity *entity, session_rule *rule)
{
    cast_rays(s, entity, rule, RAYS_A_TICK);
    return rule->measured <= entity->visibility;
}

/* ---- Both -------------------------------------------------------------------------------------------------------- */

void session_measure_locks(nook_session *s)
{
    for (uint32_t i = 0; i < s->desc.level->entity_count; i++) {
        const nook_level_entity *entity = &s->desc.level->entities[i];
        session_rule *rule = &s->rules[i];
        if (!session_is_lock(entity) || rule->thing == NOOK_NONE)
            continue;
        rule->holds = entity->kind == NOOK_LEVEL_PLATE ? plate_holds(s, entity, rule) : shade_holds(s, entity, rule);
        if (entity->latch && session_rule_open(s, i))
            continue;
        if (!rule->holds)
            rule->progress = 0.0;
        else if (entity->seconds > 0.0)
            rule->progress = fmin(1.0, rule->progress + NOOK_PHYSICS_STEP / entity->seconds);
        else
            rule->progress = 1.0;
    }
}
