/* Going on in a level that was changed while it was played. */
#include "game/play/session_internal.h"
#include <string.h>

static const session_thing *same_thing(const nook_session *from, const nook_session *to, uint32_t thing)
{
    const char *name = session_thing_name(to, thing);
    for (uint32_t i = 0; i < from->thing_count; i++) {
        if (strcmp(session_thing_name(from, i), name) == 0)
            return &from->things[i];
    }
    return NULL;
}

/* What the author moved stands where he put it; what the player moved stays where he left it. */
static void carry_body(const nook_session *from, const nook_session *to, uint32_t index)
{
    const session_thing *new = &to->things[index], *old = same_thing(from, to, index);
    if (!old || old->motion != NOOK_BODY_DYNAMIC || new->motion != NOOK_BODY_DYNAMIC ||
        memcmp(&old->start, &new->start, sizeof old->start) != 0)
        return;
    double linear[3], angular[3];
    nook_pose pose = nook_physics_pose(from->physics, old->body, 1.0);
    nook_physics_velocity(from->physics, old->body, linear, angular);
    nook_physics_set_pose(to->physics, new->body, &pose);
    nook_physics_set_velocity(to->physics, new->body, linear, angular);
    if (nook_physics_asleep(from->physics, old->body))
        nook_physics_sleep(to->physics, new->body);
}

static void carry_rule(const nook_session *from, nook_session *to, uint32_t index)
{
    const nook_level_entity *new = &to->desc.level->entities[index];
    const nook_level_entity *old = nook_level_find(from->desc.level, new->name);
    if (!old || old->kind != new->kind)
        return;
    const session_rule *rule = &from->rules[old - from->desc.level->entities];
    session_rule *out = &to->rules[index];
    out->progress = rule->progress;
    out->angle = rule->angle;
    out->holds = rule->holds;
}

static nook_result carry_player(const nook_session *from, nook_session *to)
{
    nook_body body = to->player.body;
    double linear[3], angular[3];
    nook_pose pose = nook_physics_pose(from->physics, from->player.body, 1.0);
    nook_physics_velocity(from->physics, from->player.body, linear, angular);
    to->player = from->player;
    to->player.body = body;
    to->player.ground = (nook_body){ 0 };
    to->player.crouched = false;
    nook_physics_set_pose(to->physics, body, &pose);
    nook_physics_set_velocity(to->physics, body, linear, angular);
    return from->player.crouched ? session_player_set_crouched(to, true) : NOOK_OK;
}

nook_result nook_session_carry_over(nook_session *session, const nook_session *from)
{
    nook_session *to = session;
    nook_result result = carry_player(from, to);
    if (result != NOOK_OK)
        return result;
    for (uint32_t i = 0; i < to->thing_count; i++)
        carry_body(from, to, i);
    for (uint32_t i = 0; i < to->desc.level->entity_count; i++)
        carry_rule(from, to, i);
    to->was_buttons = from->was_buttons;
    to->status = from->status;
    to->ticks = from->ticks;
    to->end_tick = from->end_tick;
    to->open = from->open;
    memcpy(to->message, from->message, sizeof to->message);
    to->message_until = from->message_until;
    return NOOK_OK;
}
