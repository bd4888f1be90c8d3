/**
 * play_room.h - small levels made by tests, and sessions in them.
 *
 * A room is a floor, 40 m square with its top at y = 0, and boxes: glTF nodes that draw one cube of one metre about its middle.
 */
#pragma once
#include "game/level/level.h"
#include "game/level/level_scene.h"
#include "game/play/session.h"

typedef struct play_room {
    nook_level *level;
    nook_scene *scene;
    nook_game_world *world;
    nook_session *session;
} play_room;

/** A node of a box: its name, where its middle is, its sides, and extras or "". In JSON with ' for ". */
#define PLAY_BOX(name, x, y, z, w, h, d, extras)                                                                   \
    ", { 'name': '" name "', 'mesh': 0, 'translation': [ " #x ", " #y ", " #z " ], 'scale': [ " #w ", " #h ", " #d \
    " ]" extras " }"
/** The extras of a rigid body. */
#define PLAY_BODY(kilograms) ", 'extras': { 'nook_body': true, 'nook_mass': " #kilograms " }"

/** Writes the room's glTF file to the scratch folder. @return its path, valid until the next call */
const char *play_room_write_scene(const char *name, const char *boxes);
/**
 * Opens a session; fails the test when that fails.
 * @param boxes     PLAY_BOX ...; "" for none
 * @param entities  what stands in the level's file behind its scene: lines at its top, then entities
 */
play_room play_room_open(const char *boxes, const char *entities);
/** A session of a level that is there. */
play_room play_room_open_level(const char *path, uint32_t seed);
void play_room_close(play_room *room);

/** Ticks with the same input. */
void play_room_tick(play_room *room, const nook_play_input *input, uint32_t count);
/** Ticks with no input. */
void play_room_wait(play_room *room, double seconds);
/** Plays a pilot's script to its end; fails the test when a step fails. */
void play_room_pilot(play_room *room, const char *script);
/** Where the middle of a body is; fails the test when there is none. */
void play_room_middle(const play_room *room, const char *name, double out[3]);
nook_session_view play_room_look(const play_room *room);
