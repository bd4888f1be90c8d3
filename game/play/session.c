#include "game/play/session.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "engine/ecs/query.h"
#include "game/play/session_internal.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

static const nook_session_status playing = NOOK_SESSION_PLAYING;

/* ---- Life -------------------------------------------------------------------------------------------------------- */

static nook_result make_query(nook_session *s)
{
    const nook_query_desc desc = { .with = { NOOK_TYPE(nook_played), NOOK_TYPE(nook_transform) } };
    return nook_query_create(nook_game_world_entities(s->desc.world), &desc, &s->query);
}

/* Everything that a try has, as at its first tick. */
static nook_result begin(nook_session *s)
{
    const nook_physics_desc physics = { .gravity = session_gravity, .seed = s->desc.seed };
    nook_physics_destroy(s->physics);
    s->physics = NULL;
    s->was_buttons = 0;
    for (uint32_t i = 0; i < s->thing_count; i++)
        s->things[i].returned = (session_return){ .count = 0 };
    s->status = playing;
    s->ticks = s->end_tick = 0;
    s->open = 0;
    s->message[0] = '\0';
    s->message_until = 0;
    s->looked_at = NOOK_NONE;
    s->carry = (session_carry){ .thing = NOOK_NONE, .turn = { 0, 0, 0, 1 }, .parting = NOOK_NONE };
    nook_result result = nook_physics_create(&physics, &s->physics);
    if (result == NOOK_OK)
        result = session_make_bodies(s);
    if (result == NOOK_OK)
        result = session_player_enter(s);
    if (result == NOOK_OK)
        session_reset_rules(s);
    return result;
}

nook_result nook_session_create(const nook_session_desc *desc, nook_session **out_session)
{
    *out_session = NULL;
    nook_session *s = calloc(1, sizeof *s);
    if (!s)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to play it", desc->level->path);
    s->desc = *desc;
    s->params = nook_player_params_initial();
    nook_result result = make_query(s);
    if (result == NOOK_OK)
        result = session_make_things(s);
    if (result == NOOK_OK)
        result = session_make_rules(s);
    if (result == NOOK_OK)
        result = begin(s);
    if (result != NOOK_OK) {
        nook_session_destroy(s);
        return result;
    }
    *out_session = s;
    return NOOK_OK;
}

void nook_session_destroy(nook_session *session)
{
    if (!session)
        return;
    nook_physics_destroy(session->physics);
    free(session->things);
    free(session->rules);
    free(session);
}

nook_result nook_session_restart(nook_session *session)
{
    return begin(session);
}

/* ---- Ticks ------------------------------------------------------------------------------------------------------- */

static void forget_message(nook_session *s)
{
    if (s->ticks >= s->message_until)
        s->message[0] = '\0';
}

nook_result nook_session_tick(nook_session *session, const nook_play_input *input)
{
    nook_session *s = session;
    uint16_t pressed = (uint16_t)(input->buttons & ~s->was_buttons);
    if (pressed & NOOK_PLAY_RESTART)
        return begin(s);
    s->was_buttons = input->buttons;
    nook_result result = session_player_move(s, input, pressed);
    if (result != NOOK_OK)
        return result;
    session_carry_move(s, input, pressed);
    session_move_movers(s);
    result = nook_physics_step(s->physics);
    if (result != NOOK_OK)
        return result;
    s->ticks++;
    session_player_read(s);
    session_return_bodies(s);
    session_measure_locks(s);
    forget_message(s);
    session_judge(s);
    s->looked_at = session_carry_looked_at(s, NULL);
    return NOOK_OK;
}

/* ---- To be seen -------------------------------------------------------------------------------------------------- */

/* Clips run with the ticks, between them too, and begin again with a try. */
static void advance_clips(nook_session *s, double alpha)
{
    double now = s->ticks > 0 ? ((double)(s->ticks - 1) + alpha) * NOOK_PHYSICS_STEP : 0.0;
    nook_game_world_advance(s->desc.world, now - s->placed_at);
    s->placed_at = now;
}

void nook_session_place(nook_session *session, double alpha)
{
    nook_world *world = nook_game_world_entities(session->desc.world);
    advance_clips(session, alpha);
    nook_query_walk walk = nook_query_begin(world, session->query);
    while (nook_query_next(&walk)) {
        const nook_played *played = walk.columns[0];
        nook_transform *transform = walk.columns[1];
        for (uint32_t i = 0; i < walk.count; i++) {
            uint32_t thing = session_thing_of_body(session, played[i].body);
            if (thing == NOOK_NONE || session->things[thing].motion == NOOK_BODY_STATIC)
                continue;
            nook_pose pose = nook_physics_pose(session->physics, played[i].body, alpha);
            nook_matrix world_from_body = nook_pose_matrix(&pose);
            nook_matrix m = nook_matrix_multiply(&world_from_body, &session->things[thing].body_from_node);
            memcpy(transform[i].world_from_local, m.m, sizeof transform[i].world_from_local);
        }
    }
}

static double between(double from, double to, double alpha)
{
    return from + alpha * (to - from);
}

nook_camera nook_session_camera(const nook_session *session, double alpha, double fov_y_radians)
{
    const session_player *p = &session->player;
    const double up[3] = { 0, 1, 0 };
    session_player seen = { .yaw = between(p->was_yaw, p->yaw, alpha),
                            .pitch = between(p->was_pitch, p->pitch, alpha) };
    double eye[3], forward[3], target[3];
    for (int k = 0; k < 3; k++)
        eye[k] = between(p->was_feet[k], p->feet[k], alpha);
    eye[1] += between(p->was_eye_height, p->eye_height, alpha);
    session_player_forward(&seen, forward);
    nook_vector_add_scaled(eye, 1.0, forward, target);
    return (nook_camera){ .view_from_world = nook_matrix_look_at(eye, target, up),
                          .fov_y_radians = fov_y_radians,
                          .z_near = 0.05 };
}

static double seconds_left(const nook_session *s)
{
    uint64_t until = s->status == playing ? s->ticks : s->end_tick;
    double left = s->desc.level->seconds - (double)until * NOOK_PHYSICS_STEP;
    return left > 0.0 ? left : 0.0;
}

nook_session_view nook_session_look(const nook_session *session)
{
    const session_player *player = &session->player;
    bool carries = session->carry.thing != NOOK_NONE;
    nook_session_view view = { .status = session->status,
                               .ticks = session->ticks,
                               .seconds_left = seconds_left(session),
                               .open = session->open,
                               .message = session->message,
                               .looked_at = session_thing_name(session, carries ? NOOK_NONE : session->looked_at),
                               .carried = session_thing_name(session, session->carry.thing),
                               .yaw = player->yaw,
                               .pitch = player->pitch,
                               .grounded = player->grounded,
                               .crouched = player->crouched,
                               .hold_distance = carries ? session->carry.distance : 0.0,
                               .hold_below = (double)session->params.hold_below };
    for (uint32_t i = 0; i < session->desc.level->entity_count; i++)
        view.locks += session_is_lock(&session->desc.level->entities[i]);
    memcpy(view.feet, player->feet, sizeof view.feet);
    session_player_eyes(player, view.eyes);
    return view;
}

double nook_session_state_of(const nook_session *session, const char *entity)
{
    const nook_level_entity *found = nook_level_find(session->desc.level, entity);
    if (!found || found->kind == NOOK_LEVEL_BODY || found->kind == NOOK_LEVEL_FIXED)
        return -1.0;
    return session->rules[found - session->desc.level->entities].progress;
}

double nook_session_measure_of(const nook_session *session, const char *entity)
{
    const nook_level_entity *found = nook_level_find(session->desc.level, entity);
    if (!found || !session_is_lock(found))
        return -1.0;
    return session->rules[found - session->desc.level->entities].measured;
}

static const session_thing *find_thing(const nook_session *s, const char *name)
{
    for (uint32_t i = 0; i < s->thing_count; i++) {
        if (strcmp(session_thing_name(s, i), name) == 0)
            return &s->things[i];
    }
    for (uint32_t i = 0; i < s->thing_count; i++) {
        const nook_level_entity *entity = session_entity_of(s, &s->things[i]);
        if (entity && strcmp(entity->name, name) == 0)
            return &s->things[i];
    }
    return NULL;
}

nook_body nook_session_body_of(const nook_session *session, const char *name)
{
    const session_thing *thing = find_thing(session, name);
    return thing ? thing->body : (nook_body){ 0 };
}

bool nook_session_middle_of(const nook_session *session, const char *name, double out_middle[3])
{
    const session_thing *thing = find_thing(session, name);
    if (thing)
        session_thing_middle(session, thing, out_middle);
    return thing != NULL;
}

nook_physics *nook_session_physics(nook_session *session)
{
    return session->physics;
}

/* ---- Hash -------------------------------------------------------------------------------------------------------- */

uint64_t session_mix(uint64_t hash, const void *bytes, size_t size)
{
    return XXH3_64bits_withSeed(bytes, size, hash);
}

/* Number for number: between the members of structs there are bytes that nobody set. */
uint64_t nook_session_hash(const nook_session *session)
{
    const session_player *p = &session->player;
    const double numbers[] = { p->yaw,
                               p->pitch,
                               p->eye_height,
                               p->feet[0],
                               p->feet[1],
                               p->feet[2],
                               p->was_feet[0],
                               p->was_feet[1],
                               p->was_feet[2],
                               session->carry.turn[0],
                               session->carry.turn[1],
                               session->carry.turn[2],
                               session->carry.turn[3] };
    const uint64_t words[] = { session->status,
                               session->ticks,
                               session->end_tick,
                               session->was_buttons,
                               session->carry.thing,
                               session->carry.parting,
                               session->carry.stuck_ticks,
                               p->grounded,
                               p->was_grounded,
                               p->crouched,
                               p->rising,
                               p->body.id };
    uint64_t hash = nook_physics_hash(session->physics);
    hash = session_mix(hash, numbers, sizeof numbers);
    hash = session_mix(hash, words, sizeof words);
    for (uint32_t i = 0; i < session->desc.level->entity_count; i++) {
        const session_rule *rule = &session->rules[i];
        const double state[] = { rule->progress, rule->measured, rule->angle };
        hash = session_mix(hash, state, sizeof state);
        hash = session_mix(hash, rule->hidden, sizeof rule->hidden);
    }
    return hash;
}
