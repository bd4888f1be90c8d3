/** session_internal.h - inside game/play only: what a session is made of. Everything here is plain; see session.h, Reload. */
#pragma once
#include "engine/core/angle.h"
#include "engine/core/log.h"
#include "engine/physics/pose.h"
#include "game/play/player_params.h"
#include "game/play/session.h"

enum { NOOK_SHADE_RAYS = 256, NOOK_MESSAGE_SIZE = 320 };

/** What left the world and was brought back. */
typedef struct session_return {
    uint32_t count;    /**< In this try. */
    double left_at[3]; /**< Where it was the last time. */
} session_return;

/** A node with a body. */
typedef struct session_thing {
    uint32_t node;   /**< Into scene->nodes. */
    uint32_t entity; /**< Into level->entities, or NOOK_NONE. */
    nook_body body;
    nook_body_motion motion;
    nook_pose start;            /**< Of the body: the node's place without its scale. */
    nook_matrix body_from_node; /**< What the pose lacks of the node's transform: scale and shear. */
    double half[3], middle[3];  /**< Of the box around what it draws, body space, metres. */
    session_return returned;
} session_thing;

/** The state of an entity that opens: as many as the level has entities, the others unused. */
typedef struct session_rule {
    uint32_t thing;                       /**< Into things; NOOK_NONE: goals. */
    uint32_t needs[NOOK_LEVEL_NEEDS_MAX]; /**< Into rules. */
    uint32_t need_count;
    double progress;                       /**< [0, 1]: how far it is open, down, or up to speed. */
    double measured;                       /**< Plate: newtons on it. Shade: visibility. */
    double angle;                          /**< Spinner: radians, [0, 2 pi). */
    bool holds;                            /**< Plate, shade: what it wants is so, for less than its seconds perhaps. */
    uint64_t hidden[NOOK_SHADE_RAYS / 64]; /**< Shade: rays that met something when they were cast last. */
    uint32_t next_ray;                     /**< Shade. */
} session_rule;

typedef struct session_player {
    nook_body body;
    double yaw, pitch;                                      /**< Radians. */
    double eye_height;                                      /**< Above the feet. */
    double feet[3];                                         /**< After the last tick. */
    double was_yaw, was_pitch, was_eye_height, was_feet[3]; /**< After the one before. */
    bool grounded, was_grounded, crouched, rising;          /**< rising: from a jump, until it falls again. */
    nook_body ground;                                       /**< What it stands on. */
    double ground_height;                                   /**< Metres. */
    double ground_velocity[3];                              /**< Of what it stands on, there. */
    session_return returned;
} session_player;

typedef struct session_carry {
    uint32_t thing;  /**< Into things, or NOOK_NONE. */
    double turn[4];  /**< Its rotation as seen by the player: from the player's yaw to it. */
    double distance; /**< See nook_session_view.hold_distance. */
    uint32_t stuck_ticks;
    uint32_t parting; /**< Thing that was let go and may still overlap the player, or NOOK_NONE. */
} session_carry;

struct nook_session {
    nook_session_desc desc;
    nook_player_params params;
    nook_physics *physics;
    nook_query *query; /**< Entities with nook_played and nook_transform. The world owns it. */
    session_thing *things;
    uint32_t thing_count;
    session_rule *rules;
    session_player player;
    session_carry carry;
    uint16_t was_buttons;
    nook_session_status status;
    uint64_t ticks, end_tick; /**< end_tick: when it was won or lost. */
    double placed_at;         /**< Seconds that its clips have run for, when nook_session_place was last called. */
    uint32_t looked_at;       /**< Into things, or NOOK_NONE. */
    uint32_t open;            /**< Locks that were open after the last tick. */
    char message[NOOK_MESSAGE_SIZE];
    uint64_t message_until; /**< Tick; UINT64_MAX: for good. */
};

static const double session_gravity = 9.81; /**< Metres per second squared. */

/* ---- session.c ---- */

uint64_t session_mix(uint64_t hash, const void *bytes, size_t size); /**< XXH3 of all so far. */

/* ---- session_things.c ---- */

/** Finds out what has a body. Once in a session's life. @return NOOK_E_NOT_FOUND, NOOK_E_MEMORY */
nook_result session_make_things(nook_session *s);
/** Whether a place is so far outside of a scene's box that nothing can be there but by falling. */
bool session_is_outside(const nook_scene *scene, const double at[3]);
/** Brings back what left the world. */
void session_return_bodies(nook_session *s);
const nook_level_entity *session_entity_of(const nook_session *s, const session_thing *thing); /**< Or NULL. */
uint32_t session_thing_of_body(const nook_session *s, nook_body body);                         /**< Or NOOK_NONE. */
const char *session_thing_name(const nook_session *s, uint32_t thing); /**< Of its node; "" for NOOK_NONE. */
/** Where the middle of its box is now. */
void session_thing_middle(const nook_session *s, const session_thing *thing, double out[3]);

/* ---- session_bodies.c ---- */

/** Gives things their bodies in a new physics, and the world's entities their component. @return NOOK_E_ARG, NOOK_E_MEMORY */
nook_result session_make_bodies(nook_session *s);

/* ---- player.c ---- */

/** At the level's start. @return NOOK_E_FORMAT that is outside of the world; NOOK_E_ARG, NOOK_E_MEMORY */
nook_result session_player_enter(nook_session *s);
/** Looks, crouches, and pushes the body for the next step. @param pressed buttons that went down. @return NOOK_E_MEMORY */
nook_result session_player_move(nook_session *s, const nook_play_input *input, uint16_t pressed);
/** Another body takes over, where the old one is and as fast. @return NOOK_E_MEMORY */
nook_result session_player_set_crouched(nook_session *s, bool crouched);
void session_player_read(nook_session *s); /**< Takes over where the step brought it. */
/** Unit: where the player looks. */
void session_player_forward(const session_player *player, double out[3]);
void session_player_eyes(const session_player *player, double out[3]);

/* ---- carry.c ---- */

/** Takes, lets go, throws, and pulls what is carried to its place in the next step. */
void session_carry_move(nook_session *s, const nook_play_input *input, uint16_t pressed);
void session_carry_drop(nook_session *s); /**< Nothing carried is allowed. */
/** What could be taken now, or NOOK_NONE. @param out_heavy what is too heavy, or NOOK_NONE; NULL is allowed */
uint32_t session_carry_looked_at(nook_session *s, uint32_t *out_heavy);

/* ---- rules.c, locks.c, movers.c ---- */

nook_result
session_make_rules(nook_session *s); /**< Once in a session's life. @return NOOK_E_NOT_FOUND, NOOK_E_MEMORY */
void session_reset_rules(nook_session *s);
bool session_rule_open(const nook_session *s, uint32_t rule);
bool session_needs_met(const nook_session *s, uint32_t rule);
bool session_is_lock(const nook_level_entity *entity);
void session_move_movers(nook_session *s);   /**< Before the step. */
void session_measure_locks(nook_session *s); /**< After it. */
void session_judge(nook_session *s);         /**< Won, lost, and what is said of locks. */
/** Fills the whole of a shade's rays: at the start of a try. */
void session_measure_shade_whole(nook_session *s, uint32_t rule);

/** Says something to the player. @param seconds 0: for good */
void session_say(nook_session *s, double seconds, const char *format, ...) NOOK_PRINTF(3, 4);
