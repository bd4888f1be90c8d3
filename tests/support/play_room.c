#include "tests/support/play_room.h"
#include "engine/core/file.h"
#include "game/play/pilot.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include "tests/support/test_glb.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { TEXT_SIZE = 32768, PATH_SIZE = 4096 };

static const float corners[8][3] = { { -0.5f, -0.5f, -0.5f }, { 0.5f, -0.5f, -0.5f }, { -0.5f, 0.5f, -0.5f },
                                     { 0.5f, 0.5f, -0.5f },   { -0.5f, -0.5f, 0.5f }, { 0.5f, -0.5f, 0.5f },
                                     { -0.5f, 0.5f, 0.5f },   { 0.5f, 0.5f, 0.5f } };
static const uint16_t faces[36] = { 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 };

/* How many nodes a list has: every one begins with its name. */
static int count_nodes(const char *text)
{
    int count = 0;
    for (const char *at = strstr(text, "{ 'name'"); at; at = strstr(at + 1, "{ 'name'"))
        count++;
    return count;
}

const char *play_room_write_scene(const char *name, const char *boxes)
{
    static char path[PATH_SIZE];
    char *members = calloc(2, TEXT_SIZE), roots[2048] = "0";
    nook_file file;
    test_glb glb = { 0 };
    assert_non_null(members);
    test_glb_add(&glb, corners, sizeof corners);
    test_glb_add(&glb, faces, sizeof faces);
    for (int i = 1; i <= count_nodes(boxes); i++)
        snprintf(roots + strlen(roots), sizeof roots - strlen(roots), ", %d", i);
    snprintf(
        members, TEXT_SIZE,
        "'scenes': [ { 'nodes': [ %s ] } ], 'nodes': [ { 'name': 'floor', 'mesh': 0, 'translation': [ 0, -0.5, 0 ], "
        "'scale': [ 40, 1, 40 ], 'extras': { 'nook_body': false } }%s ], "
        "'meshes': [ { 'name': 'box', 'primitives': [ { 'attributes': { 'POSITION': 0 }, 'indices': 1 } ] } ], "
        "'accessors': [ { 'bufferView': 0, 'componentType': 5126, 'count': 8, 'type': 'VEC3', "
        "'min': [ -0.5, -0.5, -0.5 ], 'max': [ 0.5, 0.5, 0.5 ] }, "
        "{ 'bufferView': 1, 'componentType': 5123, 'count': 36, 'type': 'SCALAR' } ]",
        roots, boxes);
    assert_int_equal(nook_file_read(test_glb_write(&glb, members), &file), NOOK_OK);
    nook_scratch_path(path, sizeof path, name);
    assert_int_equal(nook_file_write(path, file.bytes, file.size), NOOK_OK);
    nook_file_free(&file);
    free(members);
    return path;
}

play_room play_room_open_level(const char *path, uint32_t seed)
{
    play_room room = { 0 };
    const nook_scene_options geometry = { .skip_images = true };
    assert_int_equal(nook_level_read(path, &room.level), NOOK_OK);
    assert_int_equal(nook_level_scene_load(room.level, &geometry, &room.scene), NOOK_OK);
    assert_int_equal(nook_game_world_create(room.scene, &room.world), NOOK_OK);
    const nook_session_desc desc = { room.level, room.scene, room.world, seed };
    assert_int_equal(nook_session_create(&desc, &room.session), NOOK_OK);
    return room;
}

play_room play_room_open(const char *boxes, const char *entities)
{
    char path[PATH_SIZE], text[TEXT_SIZE];
    play_room_write_scene("room.glb", boxes);
    int size = snprintf(text, sizeof text, "scene = room.glb\n%s", entities);
    nook_scratch_path(path, sizeof path, "room.level");
    assert_int_equal(nook_file_write(path, text, (size_t)size), NOOK_OK);
    return play_room_open_level(path, 0);
}

void play_room_close(play_room *room)
{
    nook_session_destroy(room->session);
    nook_game_world_destroy(room->world);
    nook_scene_destroy(room->scene);
    nook_level_free(room->level);
}

void play_room_tick(play_room *room, const nook_play_input *input, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        assert_int_equal(nook_session_tick(room->session, input), NOOK_OK);
}

void play_room_wait(play_room *room, double seconds)
{
    const nook_play_input nothing = { 0 };
    play_room_tick(room, &nothing, (uint32_t)(seconds / NOOK_PHYSICS_STEP + 0.5));
}

void play_room_pilot(play_room *room, const char *script)
{
    nook_pilot *pilot;
    nook_log_capture log;
    assert_int_equal(nook_pilot_parse("script", script, &pilot), NOOK_OK);
    nook_pilot_status status = NOOK_PILOT_STEERS;
    nook_log_capture_begin(&log);
    while (status == NOOK_PILOT_STEERS) {
        nook_play_input input;
        status = nook_pilot_steer(pilot, room->session, &input);
        if (status == NOOK_PILOT_STEERS)
            play_room_tick(room, &input, 1);
    }
    nook_log_capture_end();
    nook_pilot_destroy(pilot);
    if (status != NOOK_PILOT_DONE)
        fail_msg("%s", log.text);
}

void play_room_middle(const play_room *room, const char *name, double out[3])
{
    if (!nook_session_middle_of(room->session, name, out))
        fail_msg("there is no %s", name);
}

nook_session_view play_room_look(const play_room *room)
{
    return nook_session_look(room->session);
}
