/** ao_room.h - a small room for what one record knows of the one before: bodies that can move, a camera that can. */
#pragma once
#include "tests/support/ao_screen.h"

enum { AO_ROOM_WIDTH = 67, AO_ROOM_HEIGHT = 45, AO_ROOM_MESHES = 3 };

/** The view, and the bodies of its room: a box that moves, one that stands, a floor. Occluder i is of mesh i % AO_ROOM_MESHES. */
typedef struct ao_room {
    nook_fixture_view *view;
    nook_fixture_mesh meshes[AO_ROOM_MESHES];
} ao_room;

/** For cmocka: *state is an ao_room, seen from (0, 0), 2 rays, filter tile, r_max 0.45. */
int ao_room_setup(void **state);
int ao_room_teardown(void **state);

/** The camera, so far beside where it is at first. */
void ao_room_look(ao_room *r, double x, double y);
/** The G-buffer of the bodies where their occluders are. */
void ao_room_draw(ao_room *r);
