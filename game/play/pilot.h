/**
 * pilot.h - plays by a script: steps that become inputs tick by tick, from what a session shows and nothing else. It makes the
 * recordings that ship with levels, and steers in tests.
 *
 * A script is text, a step a line, # to the end of the line is a comment. Metres, seconds, degrees.
 *
 *   walk_to X Z             straight there, until within 0.1; run_to is faster
 *   look_at NAME | X Y Z    turns until it looks there
 *   turn_to YAW PITCH       turns until it looks that way; yaw 0 is along -z, + to the left
 *   take NAME               goes near, looks at it, takes it
 *   place_at X Y Z          carries it there, until its middle is within 0.06, and lets go; low_y is enough: it is put down
 *   spin DEGREES            turns what is carried about the upright, to the left
 *   drop, throw             lets go of what is carried
 *   jump, restart           once
 *   crouch, stand           from here on
 *   wait SECONDS            does nothing
 *   wait_for NAME [STATE]   until that entity is open, or at least at STATE
 *   within SECONDS          time for each of the following steps; 20 at first
 *
 * A step that takes longer than its time fails, and the pilot with it.
 */
#pragma once
#include "engine/core/result.h"
#include "game/play/play_input.h"
#include "game/play/session.h"

typedef struct nook_pilot nook_pilot;

typedef enum nook_pilot_status { NOOK_PILOT_STEERS, NOOK_PILOT_DONE, NOOK_PILOT_FAILED } nook_pilot_status;

/** @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_FORMAT (file:line: what is wrong), NOOK_E_MEMORY; *out_pilot is NULL then */
nook_result nook_pilot_read(const char *path, nook_pilot **out_pilot);
/** The same of a text. @param name  for messages */
nook_result nook_pilot_parse(const char *name, const char *text, nook_pilot **out_pilot);
void nook_pilot_destroy(nook_pilot *pilot); /**< NULL is allowed. */

/**
 * The next tick's input. Logs one line when a step fails: file:line, what it was and how far it came.
 * @return whether there is more to do after it; once it is done or has failed, out_input is nothing
 */
nook_pilot_status nook_pilot_steer(nook_pilot *pilot, const nook_session *session, nook_play_input *out_input);
