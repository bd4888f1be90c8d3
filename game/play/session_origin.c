/* What a session was made of, as one number. */
#include "game/play/session_internal.h"
#include <string.h>

static uint64_t mix_text(uint64_t hash, const char *text)
{
    return session_mix(hash, text, strlen(text) + 1);
}

static uint64_t mix_level(uint64_t hash, const nook_level *level)
{
    const double numbers[] = { level->start[0], level->start[1], level->start[2],
                               level->yaw,      level->pitch,    level->seconds };
    return session_mix(hash, numbers, sizeof numbers);
}

/* Number for number, as names have bytes behind their end. */
static uint64_t mix_entity(uint64_t hash, const nook_level_entity *e)
{
    const double numbers[] = { e->kind,     e->shape,      e->mass,     e->friction, e->restitution, e->slide[0],
                               e->slide[1], e->slide[2],   e->swing[0], e->swing[1], e->swing[2],    e->seconds,
                               e->axis[0],  e->axis[1],    e->axis[2],  e->rpm,      e->weight,      e->visibility,
                               e->reach,    e->size[0],    e->size[1],  e->size[2],  e->at[0],       e->at[1],
                               e->at[2],    e->need_count, e->latch };
    hash = session_mix(hash, numbers, sizeof numbers);
    hash = mix_text(mix_text(hash, e->name), e->accepts);
    for (uint32_t i = 0; i < e->need_count; i++)
        hash = mix_text(hash, e->needs[i]);
    return hash;
}

static uint64_t mix_thing(uint64_t hash, const nook_session *s, const session_thing *thing)
{
    const nook_node *node = &s->desc.scene->nodes[thing->node];
    const double numbers[] = { thing->motion,  node->mass,       thing->half[0],   thing->half[1],
                               thing->half[2], thing->middle[0], thing->middle[1], thing->middle[2] };
    hash = session_mix(hash, numbers, sizeof numbers);
    hash = session_mix(hash, thing->start.position, sizeof thing->start.position);
    hash = session_mix(hash, thing->start.rotation, sizeof thing->start.rotation);
    hash = session_mix(hash, thing->body_from_node.m, sizeof thing->body_from_node.m);
    return mix_text(hash, node->name);
}

uint64_t nook_session_origin(const nook_session *session)
{
    uint64_t hash = mix_level(0, session->desc.level);
    hash = session_mix(hash, &session->params, sizeof session->params);
    for (uint32_t i = 0; i < session->desc.level->entity_count; i++)
        hash = mix_entity(hash, &session->desc.level->entities[i]);
    for (uint32_t i = 0; i < session->thing_count; i++)
        hash = mix_thing(hash, session, &session->things[i]);
    return hash;
}
