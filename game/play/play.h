/**
 * play.h - a game from its files to its end, with or without a window: level, scene, session, and where its inputs come from.
 *
 *   open -> (take_scene: a stage makes a world of it) -> begin -> every 1/60 s: tick -> close
 *
 * A tick takes its input from the replay while there is some, else from the pilot while it steers, else from the player.
 */
#pragma once
#include "game/level/level.h"
#include "game/play/pilot.h"
#include "game/play/recording.h"
#include "game/play/session.h"

typedef struct nook_play_desc {
    const char *root;  /**< The folder of Nook's sources: levels are looked for in it too. */
    const char *level; /**< .level, .glb or .gltf; NULL: the replay's, else the engine house. */
    uint32_t seed;     /**< Used when seed_given; else the replay's, else 1. */
    bool seed_given;
    const char *record; /**< Where to write the inputs when it is closed; NULL: nowhere. */
    const char *replay; /**< A recording; NULL: none. */
    const char *pilot;  /**< A script; NULL: none. */
    bool skip_images;   /**< Nothing will be drawn. */
} nook_play_desc;

/** Members are for reading; zeroed is closed. */
typedef struct nook_play {
    nook_level *level;
    nook_scene *scene;          /**< NULL once it was taken. */
    nook_game_world *own_world; /**< Of a game that nobody draws; else NULL. */
    nook_session *session;      /**< NULL until it begins. */
    nook_recording recording;   /**< Of what was played so far. */
    bool recording_ended;       /**< The level has changed since. */
    char record_path[1024];     /**< "": nowhere. */
    nook_recording replay;
    size_t replayed; /**< Ticks of it that were taken. */
    nook_pilot *pilot;
    nook_pilot_status pilot_status; /**< NOOK_PILOT_DONE when there is none. */
    uint32_t seed;
    uint64_t ended_at;   /**< Tick of the try at which it was won or lost; 0: it is not. */
    uint64_t ended_hash; /**< Of the state after that tick. */
} nook_play;

/**
 * Reads all files, and looks whether the recording can be written. @return why not, logged in one line: NOOK_E_NOT_FOUND, NOOK_E_IO,
 * NOOK_E_FORMAT, NOOK_E_VERSION, NOOK_E_MEMORY; NOOK_E_ARG the replay is of another level; *out_play is zero then
 */
nook_result nook_play_open(const nook_play_desc *desc, nook_play *out_play);
/** The scene, which is the caller's from now on and must outlive the play. Once. */
nook_scene *nook_play_take_scene(nook_play *play);
/**
 * Makes the session. @param scene, world  the scene that was taken and its world, which outlive the play; both NULL: its own
 * @return as nook_session_create
 */
nook_result nook_play_begin(nook_play *play, const nook_scene *scene, nook_game_world *world);
/** One step. @param from_player taken when neither replay nor pilot gives one. @return as nook_session_tick; NOOK_E_MEMORY */
nook_result nook_play_tick(nook_play *play, const nook_play_input *from_player);
/**
 * The level's files as they are now, aside: for one that was changed while it is played. @return as nook_play_open; the outputs are
 * NULL then and the game goes on as it was
 */
nook_result nook_play_read_again(const nook_play *play, bool skip_images, nook_level **out_level,
                                 nook_scene **out_scene);
/**
 * Goes on in what nook_play_read_again gave: see nook_session_carry_over. The recording ends: what follows would not play back.
 * @param level         taken over, also on failure
 * @param scene, world  that scene and a world of it, which outlive the play @return as nook_session_create; it goes on as it was then
 */
nook_result nook_play_go_on(nook_play *play, nook_level *level, const nook_scene *scene, nook_game_world *world);
/** Whether nothing but the player would give the next input. */
bool nook_play_is_free(const nook_play *play);
/** Whether it can be won or lost: it has goals, or a time. */
bool nook_play_can_end(const nook_level *level);
/** Whether it was won or lost 2 s ago: time to see what that looks like, for who plays without a window. */
bool nook_play_is_beyond_end(const nook_play *play);
/**
 * One line on standard output: won, lost, ended (where nothing can be won) or undecided, after how many ticks, and the hash of the
 * state after that tick: however long the world goes on after a win, its line stays the same.
 */
void nook_play_print_end(const nook_play *play);
/** Writes the recording, if one is asked for, and frees everything. @return NOOK_E_IO, NOOK_E_MEMORY: not written; closed it is */
nook_result nook_play_close(nook_play *play);

/**
 * Plays a begun game without a window, as fast as it goes: to the end of the replay or the pilot, or 2 s beyond the end of the
 * game, whichever is first; with neither, to the level's time limit. Ends in order while a Ctrl-C is held (game/interrupt.h).
 * Prints how it ended.
 * @param out_orderly  won or lost, ended where the level has neither, or played to the end of the replay
 * @return as nook_play_tick; NOOK_E_ARG nothing drives it and it would never end
 */
nook_result nook_play_headless(nook_play *play, bool *out_orderly);
