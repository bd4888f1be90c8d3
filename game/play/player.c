/*
 * The player's body: a capsule that hovers one step above the soles, carried by rays that feel for the ground. Stairs, edges and
 * small things are one height each for it and not contacts to stumble over; walls and large things meet the capsule.
 */
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "game/play/session_internal.h"
#include <math.h>
#include <string.h>

enum { FEELERS = 8 };                    /* around one in the middle */
static const double feeler_radius = 0.7; /* of the capsule's */

void session_player_forward(const session_player *player, double out[3])
{
    out[0] = -sin(player->yaw) * cos(player->pitch);
    out[1] = sin(player->pitch);
    out[2] = -cos(player->yaw) * cos(player->pitch);
}

void session_player_eyes(const session_player *player, double out[3])
{
    memcpy(out, player->feet, 3 * sizeof(double));
    out[1] += player->eye_height;
}

/* ---- Body -------------------------------------------------------------------------------------------------------- */

static nook_result make_body(nook_session *s, const double feet[3], bool crouched, nook_body *out)
{
    const nook_player_params *p = &s->params;
    double height = (double)(crouched ? p->crouched_height : p->height);
    double low = (double)p->step, straight = fmax(0.5 * (height - low) - (double)p->radius, 0.01);
    const nook_shape capsule = { .kind = NOOK_SHAPE_CAPSULE,
                                 .half = { (double)p->radius, straight },
                                 .body_from_shape = { { 0, 0.5 * (low + height), 0 }, { 0, 0, 0, 1 } } };
    nook_body_desc desc = { .motion = NOOK_BODY_DYNAMIC,
                            .shapes = &capsule,
                            .shape_count = 1,
                            .mass = (double)p->mass,
                            .pose = { .rotation = { 0, 0, 0, 1 } },
                            .upright = true }; /* no friction: its speed along walls is its own */
    memcpy(desc.pose.position, feet, sizeof desc.pose.position);
    return nook_physics_add(s->physics, &desc, out);
}

/* Straight up and straight down no camera knows which way is left. */
static double within_neck(const nook_session *s, double pitch)
{
    const double most = (double)s->params.pitch * NOOK_DEGREE;
    return fmax(-most, fmin(most, pitch));
}

nook_result session_player_enter(nook_session *s)
{
    const nook_level *level = s->desc.level;
    session_player *player = &s->player;
    if (session_is_outside(s->desc.scene, level->start))
        return nook_fail(NOOK_E_FORMAT, "%s: start = %g %g %g: there is nothing near it to stand on", level->path,
                         level->start[0], level->start[1], level->start[2]);
    *player = (session_player){ .yaw = level->yaw * NOOK_DEGREE,
                                .pitch = within_neck(s, level->pitch * NOOK_DEGREE),
                                .eye_height = (double)s->params.eyes,
                                .grounded = true };
    memcpy(player->feet, level->start, sizeof player->feet);
    player->was_yaw = player->yaw;
    player->was_pitch = player->pitch;
    player->was_eye_height = player->eye_height;
    memcpy(player->was_feet, player->feet, sizeof player->was_feet);
    return make_body(s, player->feet, false, &player->body);
}

/* ---- Looking ----------------------------------------------------------------------------------------------------- */

static void look(nook_session *s, const nook_play_input *input)
{
    const double unit = 2.0 * NOOK_PI / 65536.0;
    session_player *player = &s->player;
    player->was_yaw = player->yaw;
    player->was_pitch = player->pitch;
    if ((input->buttons & NOOK_PLAY_TURN) && s->carry.thing != NOOK_NONE)
        return; /* carry.c takes it */
    player->yaw += input->yaw * unit;
    player->pitch = within_neck(s, player->pitch + input->pitch * unit);
    double turns = floor((player->yaw + NOOK_PI) / (2.0 * NOOK_PI));
    player->yaw -= turns * 2.0 * NOOK_PI;
    player->was_yaw -= turns * 2.0 * NOOK_PI;
}

/* ---- Crouching --------------------------------------------------------------------------------------------------- */

typedef struct headroom {
    const nook_session *session;
    bool taken;
} headroom;

static void note_taken(void *user, nook_body body)
{
    headroom *room = user;
    const nook_session *s = room->session;
    bool carried = s->carry.thing != NOOK_NONE && body.id == s->things[s->carry.thing].body.id;
    room->taken = room->taken || (body.id != s->player.body.id && !carried);
}

static bool can_stand_up(nook_session *s)
{
    const nook_player_params *p = &s->params;
    const double *feet = s->player.feet, r = (double)p->radius * 0.7;
    const double low[3] = { feet[0] - r, feet[1] + (double)p->crouched_height - 0.05, feet[2] - r };
    const double high[3] = { feet[0] + r, feet[1] + (double)p->height, feet[2] + r };
    headroom room = { s, false };
    nook_physics_overlap(s->physics, low, high, note_taken, &room);
    return !room.taken;
}

nook_result session_player_set_crouched(nook_session *s, bool crouched)
{
    session_player *player = &s->player;
    double linear[3], angular[3];
    nook_body body;
    nook_result result = make_body(s, player->feet, crouched, &body);
    if (result != NOOK_OK)
        return result;
    nook_physics_velocity(s->physics, player->body, linear, angular);
    nook_physics_remove(s->physics, player->body);
    nook_physics_set_velocity(s->physics, body, linear, angular);
    player->body = body;
    player->crouched = crouched;
    return NOOK_OK;
}

static nook_result crouch(nook_session *s, bool wanted)
{
    session_player *player = &s->player;
    if (wanted == player->crouched || (!wanted && !can_stand_up(s)))
        return NOOK_OK;
    return session_player_set_crouched(s, wanted);
}

static void move_eyes(nook_session *s)
{
    session_player *player = &s->player;
    double wanted = (double)(player->crouched ? s->params.crouched_eyes : s->params.eyes);
    double part = 1.0 - exp(-NOOK_PHYSICS_STEP / (double)s->params.eye_seconds);
    player->was_eye_height = player->eye_height;
    player->eye_height += part * (wanted - player->eye_height);
}

/* ---- Ground ------------------------------------------------------------------------------------------------------ */

/* One feeler. Keeps the highest ground found so far. */
static void feel(nook_session *s, double x, double z, double start, bool *found)
{
    session_player *player = &s->player;
    const double origin[3] = { x, start, z }, down[3] = { 0, -1, 0 };
    const nook_body ignored[2] = { player->body,
                                   { s->carry.thing == NOOK_NONE ? 0 : s->things[s->carry.thing].body.id } };
    double length = start - player->feet[1] + (double)s->params.snap;
    nook_ray_hit hit;
    if (!nook_physics_ray(s->physics, origin, down, length, ignored, &hit))
        return;
    double height = start - hit.distance;
    if (hit.normal[1] < cos((double)s->params.slope * NOOK_DEGREE))
        return;
    if (*found && height <= player->ground_height)
        return;
    *found = true;
    player->ground = hit.body;
    player->ground_height = height;
}

static void find_ground_velocity(nook_session *s)
{
    session_player *player = &s->player;
    double linear[3], angular[3], arm[3], turning[3];
    nook_pose pose = nook_physics_pose(s->physics, player->ground, 1.0);
    nook_physics_velocity(s->physics, player->ground, linear, angular);
    nook_vector_add_scaled(player->feet, -1.0, pose.position, arm);
    nook_vector_cross(angular, arm,
                      turning); /* along the chord of the step: along the tangent one would spiral outwards */
    nook_vector_add_scaled(arm, 0.5 * NOOK_PHYSICS_STEP, turning, arm);
    nook_vector_cross(angular, arm, turning);
    nook_vector_add_scaled(linear, 1.0, turning, player->ground_velocity);
}

static void find_ground(nook_session *s, const double velocity[3])
{
    session_player *player = &s->player;
    const double *feet = player->feet, reach = (double)s->params.radius * feeler_radius;
    double start = feet[1] + (double)s->params.step;
    player->rising = player->rising && velocity[1] > NOOK_PHYSICS_STEP;
    player->grounded = false;
    player->ground = (nook_body){ 0 };
    memset(player->ground_velocity, 0, sizeof player->ground_velocity);
    if (player->rising)
        return;
    bool found = false;
    feel(s, feet[0], feet[2], start, &found);
    for (int i = 0; i < FEELERS; i++) {
        double angle = 2.0 * NOOK_PI * i / FEELERS;
        feel(s, feet[0] + reach * cos(angle), feet[2] + reach * sin(angle), start, &found);
    }
    /* One that falls reaches the ground when the soles do; one that walks keeps to it down a step. */
    double below = feet[1] - player->ground_height;
    double fall = fmax(0.0, -velocity[1]) * NOOK_PHYSICS_STEP;
    bool walked = player->was_grounded && below <= (double)s->params.snap;
    player->grounded = found && (walked || below <= fall + 0.001);
    if (player->grounded)
        find_ground_velocity(s);
}

/* ---- Going ------------------------------------------------------------------------------------------------------- */

static void wanted_velocity(const nook_session *s, const nook_play_input *input, double out[3])
{
    const nook_player_params *p = &s->params;
    double right = input->right / 127.0, forward = input->forward / 127.0;
    double length = hypot(right, forward), scale = length > 1.0 ? 1.0 / length : 1.0;
    bool runs = (input->buttons & NOOK_PLAY_RUN) && !s->player.crouched;
    double speed = (double)(s->player.crouched ? p->crouch : runs ? p->run : p->walk) * scale;
    double sine = sin(s->player.yaw), cosine = cos(s->player.yaw);
    out[0] = speed * (right * cosine - forward * sine);
    out[1] = 0.0;
    out[2] = speed * (-right * sine - forward * cosine);
}

/* The change of the level velocity in this tick, within what legs can do. */
static void steer(const nook_session *s, const double velocity[3], const double wanted[3], double out_change[3])
{
    const nook_player_params *p = &s->params;
    for (int k = 0; k < 3; k++)
        out_change[k] = wanted[k] + s->player.ground_velocity[k] - velocity[k];
    out_change[1] = 0.0;
    bool slows = nook_vector_dot(out_change, wanted) <= 0.0;
    double most = (double)(!s->player.grounded ? p->air_acceleration : slows ? p->braking : p->acceleration);
    double length = nook_vector_length(out_change), limit = most * NOOK_PHYSICS_STEP;
    for (int k = 0; k < 3 && length > limit; k++)
        out_change[k] *= limit / length;
}

/* The change of the speed upwards that brings the soles to the ground: as fast as it takes up, down no faster than one ducks. */
static double climb(const nook_session *s, double velocity)
{
    const session_player *player = &s->player;
    double wanted = (player->ground_height - player->feet[1]) / (double)s->params.step_seconds;
    double lowest = fmin(velocity, 0.0) - 2.0 * session_gravity * NOOK_PHYSICS_STEP;
    return fmax(wanted + player->ground_velocity[1], lowest) - velocity;
}

/* What one stands on feels the weight. What is kinematic or still feels nothing; plates are told in locks.c. */
static void weigh(nook_session *s)
{
    const double weight[3] = { 0, -(double)s->params.mass * session_gravity, 0 };
    if (s->player.grounded && nook_physics_mass(s->physics, s->player.ground) > 0.0)
        nook_physics_push(s->physics, s->player.ground, weight);
}

/* From a standing jump the soles come to exactly the height that was asked for: what flies follows a parabola. */
static double jump_speed(double height)
{
    return sqrt(2.0 * session_gravity * height);
}

/* The speed up or down at once; a force would come in pieces. Only flight is left to gravity. @return whether legs hold it */
static bool rise(nook_session *s, double velocity[3], bool jumps)
{
    session_player *player = &s->player;
    const double no_turning[3] = { 0, 0, 0 };
    bool stands = player->grounded, jumped = jumps && stands && !player->crouched;
    if (jumped) {
        velocity[1] = jump_speed((double)s->params.jump) + player->ground_velocity[1];
        player->rising = true;
        player->grounded = false;
    } else if (stands) {
        velocity[1] += climb(s, velocity[1]);
    } else if (player->was_grounded && !player->rising) {
        velocity[1] = fmin(0.0, velocity[1]); /* the ground slipped away under a step up: that was no jump */
    }
    player->was_grounded = player->grounded;
    nook_physics_set_velocity(s->physics, player->body, velocity, no_turning);
    return player->grounded;
}

static void go(nook_session *s, const nook_play_input *input, bool jumps)
{
    session_player *player = &s->player;
    double linear[3], angular[3], wanted[3], force[3];
    nook_physics_velocity(s->physics, player->body, linear, angular);
    find_ground(s, linear);
    wanted_velocity(s, input, wanted);
    steer(s, linear, wanted, force);
    weigh(s);
    force[1] = rise(s, linear, jumps) ? session_gravity * NOOK_PHYSICS_STEP : 0.0;
    for (int k = 0; k < 3; k++)
        force[k] *= (double)s->params.mass / NOOK_PHYSICS_STEP;
    nook_physics_push(s->physics, player->body, force);
}

nook_result session_player_move(nook_session *s, const nook_play_input *input, uint16_t pressed)
{
    look(s, input);
    nook_result result = crouch(s, input->buttons & NOOK_PLAY_CROUCH);
    move_eyes(s);
    if (result == NOOK_OK)
        go(s, input, pressed & NOOK_PLAY_JUMP);
    return result;
}

void session_player_read(nook_session *s)
{
    session_player *player = &s->player;
    nook_pose pose = nook_physics_pose(s->physics, player->body, 1.0);
    memcpy(player->was_feet, player->feet, sizeof player->was_feet);
    memcpy(player->feet, pose.position, sizeof player->feet);
}
