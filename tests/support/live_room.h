/**
 * live_room.h - views on a running picture without a window (game/live), for tests: made-up keys and mice, pictures of what is seen.
 *
 * One stage a program, with a crate on a floor; views of their own for each test, at first one, which is quick. What it draws with
 * goes to the scratch folder. All of it fails the test when something cannot be done.
 */
#pragma once
#include "game/compare/camera.h"
#include "game/live/live.h"

enum { LIVE_ROOM_WIDTH = 480, LIVE_ROOM_HEIGHT = 300, LIVE_ROOM_SIZE = LIVE_ROOM_WIDTH * LIVE_ROOM_HEIGHT * 3 };

typedef struct live_room {
    nook_stage stage;
    nook_camera camera;
    nook_live *live;
    nook_input input;                    /**< Of the next step. */
    nook_input rest;                     /**< What the last step has left of it for the host. */
    char settings[4096], pictures[4096]; /**< Where those are written. */
    uint8_t picture[LIVE_ROOM_SIZE];     /**< The last one: RGB, top row first. */
} live_room;

/** For cmocka: around all tests of a program, and around each. */
int live_room_open(void **state);
/** The same with another scene. @param path  from the repository's root */
int live_room_open_scene(void **state, const char *path);
int live_room_close(void **state);
int live_room_set_up(void **state);
int live_room_tear_down(void **state);
#define LIVE_ROOM_TEST(name) cmocka_unit_test_setup_teardown(name, live_room_set_up, live_room_tear_down)

/** Makes a text the setting of a view. */
void live_room_set(live_room *room, uint32_t view, const char *text);
/** A frame with the input as it is; keys and clicks are short. */
void live_room_step(live_room *room);
/** The same with a key that is pressed. */
void live_room_press(live_room *room, nook_key key);
/** Takes a picture of what is seen. */
void live_room_picture(live_room *room);
