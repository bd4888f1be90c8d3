/* What rules move: doors and wheels. They are moved by hand, to the very place that their state says. */
#include "engine/core/rotation.h"
#include "game/play/session_internal.h"
#include <math.h>

static const double spin_up_seconds = 3.0;

/* Begins and ends gently: no speed at either end (smoothstep). */
static double eased(double t)
{
    return t * t * (3.0 - 2.0 * t);
}

static double towards(double value, double target, double step)
{
    return value < target ? fmin(target, value + step) : fmax(target, value - step);
}

static nook_pose mover_pose(const session_thing *thing, const nook_level_entity *entity, double progress)
{
    nook_pose pose = thing->start, swung = { .rotation = { 0, 0, 0, 1 } };
    double part = eased(progress), degrees[3];
    for (int k = 0; k < 3; k++) {
        degrees[k] = part * entity->swing[k];
        pose.position[k] += part * entity->slide[k];
    }
    nook_rotation_from_degrees(degrees, swung.rotation);
    return nook_pose_multiply(&pose, &swung);
}

/* Whether it opens. One that latches needs only once what it needs. */
static bool opens(const nook_session *s, uint32_t index)
{
    bool begun = s->rules[index].progress > 0.0;
    return session_needs_met(s, index) || (s->desc.level->entities[index].latch && begun);
}

static void move(nook_session *s, uint32_t index)
{
    session_rule *rule = &s->rules[index];
    const nook_level_entity *entity = &s->desc.level->entities[index];
    const session_thing *thing = &s->things[rule->thing];
    double target = opens(s, index) ? 1.0 : 0.0;
    rule->progress = towards(rule->progress, target, NOOK_PHYSICS_STEP / entity->seconds);
    nook_pose pose = mover_pose(thing, entity, rule->progress);
    nook_physics_move(s->physics, thing->body, &pose);
}

static void spin(nook_session *s, uint32_t index)
{
    session_rule *rule = &s->rules[index];
    const nook_level_entity *entity = &s->desc.level->entities[index];
    const session_thing *thing = &s->things[rule->thing];
    double target = opens(s, index) ? 1.0 : 0.0, turned[4];
    rule->progress = towards(rule->progress, target, NOOK_PHYSICS_STEP / spin_up_seconds);
    rule->angle += rule->progress * entity->rpm / 60.0 * 2.0 * NOOK_PI * NOOK_PHYSICS_STEP;
    rule->angle -= 2.0 * NOOK_PI * floor(rule->angle / (2.0 * NOOK_PI));
    nook_rotation_about(entity->axis, rule->angle, turned);
    nook_pose turn = { .rotation = { turned[0], turned[1], turned[2], turned[3] } };
    nook_pose pose = nook_pose_multiply(&thing->start, &turn);
    nook_physics_move(s->physics, thing->body, &pose);
}

void session_move_movers(nook_session *s)
{
    for (uint32_t i = 0; i < s->desc.level->entity_count; i++) {
        nook_level_kind kind = s->desc.level->entities[i].kind;
        if (s->rules[i].thing == NOOK_NONE)
            continue; /* without a body */
        if (kind == NOOK_LEVEL_MOVER)
            move(s, i);
        else if (kind == NOOK_LEVEL_SPINNER)
            spin(s, i);
    }
}
