/**
 * soak_bodies.h - bodies that leave the world of a game, and how: over an edge where the level is open, or through what stands still.
 *
 * The first is the level's doing: who throws things on a floor without walls finds them beside it. The second nobody may see. So the
 * way that the middle of each body goes is held against what stands still, tick by tick, from when it last lay still.
 */
#pragma once
#include "engine/core/result.h"
#include "game/play/session.h"

typedef struct nook_soak_path nook_soak_path;

/** Members are for reading; zeroed before the first tick, given to nook_soak_bodies_free after the last. */
typedef struct nook_soak_bodies {
    uint32_t over_an_edge;           /**< Bodies that left, and had gone through nothing. */
    uint32_t through;                /**< Those that had: each is a warning in the log. */
    char last[NOOK_LEVEL_NAME_SIZE]; /**< Of what left last: its node, or "the player"; "": nothing did. */
    double last_at[3];               /**< Where it was then, metres. */
    nook_soak_path *paths;           /**< Of the session's things, and the player's. */
    uint32_t path_count;
    uint64_t ticks; /**< Of the session, when it was looked at last. */
} nook_soak_bodies;

/** After each tick of the same session. A try that began anew is seen by its ticks. @return NOOK_E_MEMORY */
nook_result nook_soak_bodies_look(nook_soak_bodies *bodies, const nook_session *session);
void nook_soak_bodies_free(nook_soak_bodies *bodies);
