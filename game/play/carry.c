/*
 * Taking, carrying, throwing. What is carried stays a body that collides: forces within what two arms can do draw its middle to
 * a place before the player and turn it to the heading it was taken with; where that does not suffice it lags, and slips away.
 */
#include "engine/core/rotation.h"
#include "engine/core/vector.h"
#include "game/play/session_internal.h"
#include <math.h>
#include <string.h>

static const double upward[3] = { 0, 1, 0 };

/* 1/s: how fast an error of place and of heading is closed, and how fast the difference in speed that asks for. */
static const double place_rate = 12.0, turn_rate = 10.0, speed_rate = 20.0;
static const double turn_speed = 6.0; /* radians per second at most */
/* What is let go keeps no more than this, so that it stays where it is put. */
static const double parting_speed = 1.0;
/* How high and how low things can be held, from the eyes and from the soles, metres. */
static const double hold_highest = 0.6, hold_lowest = 0.12;

static session_thing *carried(nook_session *s)
{
    return s->carry.thing == NOOK_NONE ? NULL : &s->things[s->carry.thing];
}

/* ---- Looking for something --------------------------------------------------------------------------------------- */

uint32_t session_carry_looked_at(nook_session *s, uint32_t *out_heavy)
{
    double eyes[3], forward[3];
    const nook_body ignored[2] = { s->player.body, { 0 } };
    nook_ray_hit hit;
    if (out_heavy)
        *out_heavy = NOOK_NONE;
    session_player_eyes(&s->player, eyes);
    session_player_forward(&s->player, forward);
    if (!nook_physics_ray(s->physics, eyes, forward, (double)s->params.reach, ignored, &hit))
        return NOOK_NONE;
    uint32_t thing = session_thing_of_body(s, hit.body);
    if (thing == NOOK_NONE || s->things[thing].motion != NOOK_BODY_DYNAMIC)
        return NOOK_NONE;
    if (hit.body.id == s->player.ground.id) /* nobody lifts what he stands on */
        return NOOK_NONE;
    if (nook_physics_mass(s->physics, hit.body) <= (double)s->params.lift)
        return thing;
    if (out_heavy)
        *out_heavy = thing;
    return NOOK_NONE;
}

/* ---- Taking ------------------------------------------------------------------------------------------------------ */

static void heading(const nook_session *s, double out[4])
{
    nook_rotation_about(upward, s->player.yaw, out);
}

static double hold_distance(const nook_session *s, const session_thing *thing)
{
    const nook_player_params *p = &s->params;
    double distance = (double)p->radius + (double)p->hold_gap + nook_vector_length(thing->half);
    return fmax((double)p->hold_nearest, fmin((double)p->hold_farthest, distance));
}

static void end_parting(nook_session *s)
{
    if (s->carry.parting != NOOK_NONE)
        nook_physics_ignore(s->physics, s->things[s->carry.parting].body, (nook_body){ 0 });
    s->carry.parting = NOOK_NONE;
}

static void take(nook_session *s)
{
    uint32_t heavy, thing = session_carry_looked_at(s, &heavy);
    if (heavy != NOOK_NONE)
        session_say(s, 3.0, "Too heavy to lift: %.0f kg", nook_physics_mass(s->physics, s->things[heavy].body));
    if (thing == NOOK_NONE)
        return;
    end_parting(s);
    const session_thing *t = &s->things[thing];
    nook_pose pose = nook_physics_pose(s->physics, t->body, 1.0);
    double turn[4];
    heading(s, turn);
    nook_rotation_inverse(turn, turn);
    nook_rotation_multiply(turn, pose.rotation, s->carry.turn);
    s->carry.thing = thing;
    s->carry.distance = hold_distance(s, t);
    s->carry.stuck_ticks = 0;
    nook_physics_ignore(s->physics, t->body, s->player.body);
    nook_physics_wake(s->physics, t->body);
}

/* ---- Letting go -------------------------------------------------------------------------------------------------- */

static void limit(double v[3], double most)
{
    double length = nook_vector_length(v);
    for (int k = 0; k < 3 && length > most; k++)
        v[k] *= most / length;
}

void session_carry_drop(nook_session *s)
{
    const session_thing *thing = carried(s);
    if (!thing)
        return;
    double linear[3], angular[3];
    nook_physics_velocity(s->physics, thing->body, linear, angular);
    limit(linear, parting_speed);
    limit(angular, parting_speed);
    nook_physics_set_velocity(s->physics, thing->body, linear, angular);
    s->carry.parting = s->carry.thing;
    s->carry.thing = NOOK_NONE;
}

static void throw(nook_session * s)
{
    const session_thing *thing = carried(s);
    if (!thing)
        return;
    double linear[3], angular[3], forward[3];
    double mass = nook_physics_mass(s->physics, thing->body);
    double speed = fmin((double)s->params.throw_speed, (double)s->params.throw_impulse / mass);
    nook_physics_velocity(s->physics, s->player.body, linear, angular);
    session_player_forward(&s->player, forward);
    nook_vector_add_scaled(linear, speed, forward, linear);
    nook_physics_velocity(s->physics, thing->body, forward, angular);
    nook_physics_set_velocity(s->physics, thing->body, linear, angular);
    s->carry.parting = s->carry.thing;
    s->carry.thing = NOOK_NONE;
}

/* What was let go collides with the player again as soon as the two are apart. */
static void part(nook_session *s)
{
    if (s->carry.parting == NOOK_NONE)
        return;
    const session_thing *thing = &s->things[s->carry.parting];
    double middle[3], away[2];
    session_thing_middle(s, thing, middle);
    for (int i = 0; i < 2; i++)
        away[i] = middle[2 * i] - s->player.feet[2 * i];
    double apart = hypot(away[0], away[1]), reach = (double)s->params.radius + nook_vector_length(thing->half);
    bool above = middle[1] - nook_vector_length(thing->half) > s->player.feet[1] + (double)s->params.height;
    if (apart > reach || above)
        end_parting(s);
}

/* ---- Carrying ---------------------------------------------------------------------------------------------------- */

/* Where the middle of what is carried belongs. */
static void hold_point(const nook_session *s, double out[3])
{
    const session_player *player = &s->player;
    double eyes[3], distance = s->carry.distance;
    session_player_eyes(player, eyes);
    double height = eyes[1] + distance * tan(player->pitch) - (double)s->params.hold_below;
    out[0] = eyes[0] - distance * sin(player->yaw);
    out[1] = fmax(player->feet[1] + hold_lowest, fmin(eyes[1] + hold_highest, height));
    out[2] = eyes[2] - distance * cos(player->yaw);
}

static void turn_in_hands(nook_session *s, const nook_play_input *input)
{
    const double unit = 2.0 * NOOK_PI / 65536.0, right[3] = { 1, 0, 0 };
    double turn[4];
    nook_rotation_about(upward, input->yaw * unit, turn);
    nook_rotation_multiply(turn, s->carry.turn, s->carry.turn);
    nook_rotation_about(right, -input->pitch * unit, turn);
    nook_rotation_multiply(turn, s->carry.turn, s->carry.turn);
}

static void pull(nook_session *s, const session_thing *thing, const double error[3], const double velocity[3])
{
    double mass = nook_physics_mass(s->physics, thing->body), own[3], unused[3], force[3];
    double wanted[3] = { 0, 0, 0 };
    nook_physics_velocity(s->physics, s->player.body, own, unused);
    nook_vector_add_scaled(wanted, place_rate, error, wanted);
    limit(wanted, (double)s->params.hold_speed);
    for (int k = 0; k < 3; k++)
        force[k] = mass * speed_rate * (wanted[k] + own[k] - velocity[k]);
    force[1] += mass * session_gravity;
    limit(force, (double)s->params.arms);
    nook_physics_push(s->physics, thing->body, force);
}

/* The heaviest way to turn its box: arms are as slow about every axis, which needs no more of it than its size. */
static double inertia(const nook_session *s, const session_thing *thing)
{
    const double *h = thing->half;
    double least = fmin(h[0], fmin(h[1], h[2]));
    double mass = nook_physics_mass(s->physics, thing->body);
    return mass * (nook_vector_dot(h, h) - least * least) / 3.0;
}

static void straighten(nook_session *s, const session_thing *thing, const nook_pose *pose, const double linear[3],
                       const double angular[3])
{
    double wanted[4], rate[3], change[3];
    heading(s, wanted);
    nook_rotation_multiply(wanted, s->carry.turn, wanted);
    nook_pose_turn_rate(pose->rotation, wanted, 1.0 / turn_rate, rate);
    limit(rate, turn_speed);
    for (int k = 0; k < 3; k++)
        change[k] = speed_rate * NOOK_PHYSICS_STEP * (rate[k] - angular[k]);
    limit(change, (double)s->params.wrists / inertia(s, thing) * NOOK_PHYSICS_STEP);
    for (int k = 0; k < 3; k++)
        change[k] += angular[k];
    nook_physics_set_velocity(s->physics, thing->body, linear, change);
}

/* @return whether it slipped out of the hands */
static bool slips(nook_session *s, double distance)
{
    const nook_player_params *p = &s->params;
    s->carry.stuck_ticks = distance > (double)p->stuck_distance ? s->carry.stuck_ticks + 1 : 0;
    return distance > (double)p->lose_distance || s->carry.stuck_ticks * NOOK_PHYSICS_STEP > (double)p->stuck_seconds;
}

static void carry(nook_session *s, const nook_play_input *input)
{
    const session_thing *thing = carried(s);
    if (!thing)
        return;
    double point[3], middle[3], error[3], linear[3], angular[3];
    nook_pose pose = nook_physics_pose(s->physics, thing->body, 1.0);
    if (input->buttons & NOOK_PLAY_TURN)
        turn_in_hands(s, input);
    hold_point(s, point);
    nook_pose_apply_point(&pose, thing->middle, middle);
    nook_vector_add_scaled(point, -1.0, middle, error);
    if (slips(s, nook_vector_length(error))) {
        session_carry_drop(s);
        return;
    }
    nook_physics_velocity(s->physics, thing->body, linear, angular);
    straighten(s, thing, &pose, linear, angular);
    pull(s, thing, error, linear);
    nook_physics_ignore(s->physics, thing->body, s->player.body); /* which is another one after crouching */
}

void session_carry_move(nook_session *s, const nook_play_input *input, uint16_t pressed)
{
    bool has = s->carry.thing != NOOK_NONE;
    part(s);
    if (has && (pressed & NOOK_PLAY_THROW))
        throw(s);
    else if (has && (pressed & NOOK_PLAY_TAKE))
        session_carry_drop(s);
    else if (pressed & NOOK_PLAY_TAKE)
        take(s);
    carry(s, input);
}
