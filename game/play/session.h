/**
 * session.h - a level being played: bodies, the player, and the rules. No GL, no files, no clock: input in, state out.
 *
 *   create -> every 1/60 s: tick -> every frame: place -> draw the world -> destroy
 *
 * The session owns the physics and works on the entities of a game world (game/world.h), to which it adds a component;
 * everything that darkens, is drawn and moves is one entity there. Same level, seed and inputs: same state, bit for bit.
 *
 * Restart   (input, or nook_session_restart) throws the physics away and makes all of it anew from level and scene: from any
 *           state it gives that of a fresh session. What nook_session_physics gave before is gone then.
 * Reload    of the game's code: a session is numbers, handles and pointers to what level, scene, world and physics own; it
 *           has no pointer to a function or a literal, and no ECS system. It goes on as long as its types are the same, which
 *           engine/module compares; else make a new one of the same desc.
 */
#pragma once
#include "engine/physics/physics.h"
#include "engine/render/renderer.h"
#include "game/level/level.h"
#include "game/play/play_input.h"
#include "game/world.h"

typedef struct nook_session nook_session;

/** The component of every entity that has a body. */
typedef struct nook_played {
    nook_body body;
    uint32_t entity; /**< Into level->entities: the one that says what it is; NOOK_NONE for none. */
} nook_played;

typedef struct nook_session_desc {
    const nook_level *level; /**< Outlives the session. */
    const nook_scene *scene; /**< Made of the level by nook_level_scene_load; outlives it. */
    nook_game_world *world;  /**< Of that scene; outlives it. */
    uint32_t seed;           /**< Of the physics and of the bodies' first millimetre. */
} nook_session_desc;

typedef enum nook_session_status { NOOK_SESSION_PLAYING, NOOK_SESSION_WON, NOOK_SESSION_LOST } nook_session_status;

/** @return NOOK_E_NOT_FOUND an entity whose node the scene lacks (level:line); NOOK_E_FORMAT a start outside of the world; NOOK_E_ARG,
 * NOOK_E_MEMORY; NULL then */
nook_result nook_session_create(const nook_session_desc *desc, nook_session **out_session);
void nook_session_destroy(nook_session *session); /**< NULL is allowed. */
/** As it was when it was created. @return NOOK_E_MEMORY, NOOK_E_ARG; destroy it then */
nook_result nook_session_restart(nook_session *session);

/**
 * Goes on where a session of the same level as it was before left off, by the names of things: where bodies are that the new level
 * has where the old one had them, the player, time, and how far what opens has opened. What is carried is let go.
 * @param session  new, no tick done @return NOOK_E_MEMORY
 */
nook_result nook_session_carry_over(nook_session *session, const nook_session *from);

/**
 * One step of NOOK_PHYSICS_STEP. After the end the world goes on, the rules do not. One that asks for a restart does only that.
 * @return NOOK_E_RANGE, NOOK_E_MEMORY
 */
nook_result nook_session_tick(nook_session *session, const nook_play_input *input);
/** Writes every moving entity's nook_transform between the last two ticks. @param alpha [0, 1] */
void nook_session_place(nook_session *session, double alpha);
/** The player's eyes. @param fov_y_radians of the result */
nook_camera nook_session_camera(const nook_session *session, double alpha, double fov_y_radians);

/** For the screen, the log and tests. Texts belong to the session and hold until the next tick. */
typedef struct nook_session_view {
    nook_session_status status;
    uint64_t ticks;        /**< Since the start of this try. */
    double seconds_left;   /**< Of the level's; 0 when it has no end. */
    uint32_t locks, open;  /**< Plates and shades, and how many of them hold. */
    const char *message;   /**< What the player should know now; "": nothing. */
    const char *looked_at; /**< Node under the crosshair that can be taken; "": none. */
    const char *carried;   /**< Its node; "": none. */
    double feet[3];        /**< Of the player, metres. */
    double eyes[3];        /**< The same. */
    double yaw, pitch;     /**< Radians; 0 looks along -z, + to the left, + up. */
    bool grounded, crouched;
    double hold_distance; /**< Level way from the eyes to where the middle of what is carried belongs; 0: nothing is. */
    double hold_below;    /**< How much lower that is than where the eyes look at that distance. */
} nook_session_view;
nook_session_view nook_session_look(const nook_session *session);

/** State of one of the level's plates, shades, movers, spinners, goals: 0 to 1. @return -1 no such entity */
double nook_session_state_of(const nook_session *session, const char *entity);
/** What a lock feels: a plate the newtons on it, a shade the part of the sky it sees, [0, 1]. @return -1 no such entity */
double nook_session_measure_of(const nook_session *session, const char *entity);
/** @param name  of an entity or of a node. @return {0} when there is none */
nook_body nook_session_body_of(const nook_session *session, const char *name);
/** Where the middle of a body's box is. @return false: no such body; the output is untouched then */
bool nook_session_middle_of(const nook_session *session, const char *name, double out_middle[3]);
nook_physics *nook_session_physics(nook_session *session);
/**
 * Of what it was made: the level's rules, the bodies and the player's abilities; not the seed. Inputs that were recorded in a session
 * of another origin end otherwise. The shapes of meshes that stand still count by their boxes.
 */
uint64_t nook_session_origin(const nook_session *session);
/** Of physics, player and rules. */
uint64_t nook_session_hash(const nook_session *session);
