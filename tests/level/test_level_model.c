#include "game/level/level_scene.h"
#include "tests/support/log_capture.h"
#include "tests/support/play_room.h"
#include "tests/support/test_glb.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *hall(void)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/content/hall/hall.glb", getenv("NOOK_ROOT") ? getenv("NOOK_ROOT") : ".");
    return path;
}

/* Boxes without a floor below them: the room's own is left out. */
static const char *write_boxes(const char *nodes, const char *roots)
{
    static const float corners[8][3] = { { -0.5f, -0.5f, -0.5f }, { 0.5f, -0.5f, -0.5f }, { -0.5f, 0.5f, -0.5f },
                                         { 0.5f, 0.5f, -0.5f },   { -0.5f, -0.5f, 0.5f }, { 0.5f, -0.5f, 0.5f },
                                         { -0.5f, 0.5f, 0.5f },   { 0.5f, 0.5f, 0.5f } };
    static const uint16_t faces[36] = { 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                        2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 };
    char members[4096];
    test_glb glb = { 0 };
    test_glb_add(&glb, corners, sizeof corners);
    test_glb_add(&glb, faces, sizeof faces);
    snprintf(members, sizeof members,
             "'scenes': [ { 'nodes': [ %s ] } ], 'nodes': [ %s ], "
             "'meshes': [ { 'primitives': [ { 'attributes': { 'POSITION': 0 }, 'indices': 1 } ] }, "
             "{ 'primitives': [ { 'attributes': { 'POSITION': 0 }, 'indices': 1 } ] } ], "
             "'accessors': [ { 'bufferView': 0, 'componentType': 5126, 'count': 8, 'type': 'VEC3', "
             "'min': [ -0.5, -0.5, -0.5 ], 'max': [ 0.5, 0.5, 0.5 ] }, "
             "{ 'bufferView': 1, 'componentType': 5123, 'count': 36, 'type': 'SCALAR' } ]",
             roots, nodes);
    return test_glb_write(&glb, members);
}

static void test_a_building_is_entered_where_there_is_room(void **state)
{
    (void)state;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    play_room room = play_room_open_level(hall(), 1);
    nook_log_capture_end();
    assert_int_equal(log.count, 0); /* it has a floor of its own */
    assert_true(room.level->ground_half == 0.0 && room.level->loose_longest == 0.0);
    assert_string_equal(room.level->title, "hall.glb");
    double start[3];
    memcpy(start, room.level->start, sizeof start);
    play_room_wait(&room, 2.0);
    nook_session_view view = play_room_look(&room);
    assert_true(view.grounded);
    for (int k = 0; k < 3; k++)
        assert_true(fabs(view.feet[k] - start[k]) < 0.01);
    const nook_play_input forward = { .forward = 127 };
    play_room_tick(&room, &forward, 60);
    assert_true(hypot(play_room_look(&room).feet[0] - start[0], play_room_look(&room).feet[2] - start[2]) > 1.5);
    play_room_close(&room);
}

static void test_a_thing_without_ground_gets_one_and_says_so(void **state)
{
    (void)state;
    nook_log_capture log;
    const char *path = write_boxes("{ 'name': 'thing', 'mesh': 0, 'translation': [ 0, 5, 0 ] }", "0");
    nook_log_capture_begin(&log);
    play_room room = play_room_open_level(path, 1);
    nook_log_capture_end();
    assert_int_equal(log.count, 1);
    assert_int_equal(log.level, NOOK_LOG_INFO);
    assert_non_null(strstr(log.text, "a ground was put there"));
    assert_true(room.level->ground_half > 5.0);
    assert_true(room.level->ground[1] == 4.5);
    play_room_wait(&room, 2.0);
    nook_session_view view = play_room_look(&room);
    double middle[3];
    play_room_middle(&room, "thing", middle);
    assert_true(view.grounded && fabs(view.feet[1] - 4.5) < 0.01);
    assert_true(fabs(middle[1] - 5.0) < 0.005);
    assert_true(nook_physics_mass(nook_session_physics(room.session), nook_session_body_of(room.session, "thing")) >
                0.0);
    assert_true(view.feet[2] > 1.0); /* before it, and looking at it */
    assert_true(fabs(view.yaw) < 1e-9);
    play_room_close(&room);
}

static void test_where_no_node_is_a_body_small_ones_are_and_large_ones_are_not(void **state)
{
    (void)state;
    const char *path = write_boxes("{ 'name': 'small', 'mesh': 0, 'translation': [ 0, 1, 0 ] }, "
                                   "{ 'name': 'large', 'mesh': 1, 'translation': [ 20, 3, 0 ], 'scale': [ 6, 6, 6 ] }",
                                   "0, 1");
    nook_log_capture log;
    nook_log_capture_begin(&log);
    play_room room = play_room_open_level(path, 1);
    nook_log_capture_end();
    const nook_physics *physics = nook_session_physics(room.session);
    assert_true(nook_physics_mass(physics, nook_session_body_of(room.session, "small")) > 0.0);
    assert_true(nook_physics_mass(physics, nook_session_body_of(room.session, "large")) == 0.0);
    play_room_close(&room);
}

static void test_where_the_file_names_bodies_only_those_are(void **state)
{
    (void)state;
    const char *path =
        write_boxes("{ 'name': 'still', 'mesh': 0 }, { 'name': 'body', 'mesh': 1, 'translation': [ 3, 0, 0 ], "
                    "'extras': { 'nook_body': true } }",
                    "0, 1");
    nook_log_capture log;
    nook_log_capture_begin(&log);
    play_room room = play_room_open_level(path, 1);
    nook_log_capture_end();
    const nook_physics *physics = nook_session_physics(room.session);
    assert_true(nook_physics_mass(physics, nook_session_body_of(room.session, "body")) > 0.0);
    assert_true(nook_physics_mass(physics, nook_session_body_of(room.session, "still")) == 0.0);
    play_room_close(&room);
}

static void test_what_a_file_warns_of_is_said_once_though_it_is_read_twice(void **state)
{
    (void)state;
    nook_log_capture log;
    test_glb glb = { 0 };
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    const char *path = test_glb_write(&glb, TEST_GLB_ONE_NODE
                                      ", 'meshes': [ { 'primitives': [ { 'attributes': { 'POSITION': 0 } } ] } ], "
                                      "'accessors': [ { 'bufferView': 0, 'componentType': 5126, 'count': 3, "
                                      "'type': 'VEC3', 'min': [ 0, 0, 0 ], 'max': [ 1, 2, 0 ] } ]");
    nook_log_capture_begin(&log);
    play_room room = play_room_open_level(path, 1);
    nook_log_capture_end();
    assert_int_equal(log.count, 2); /* that, and the ground */
    assert_int_equal(log.errors, 0);
    play_room_close(&room);
}

static void test_a_file_without_triangles_is_refused(void **state)
{
    (void)state;
    nook_level *level;
    nook_log_capture log;
    const char *path = test_gltf_write("empty.gltf", "{ 'asset': { 'version': '2.0' } }");
    nook_log_capture_begin(&log);
    assert_int_equal(nook_level_read(path, &level), NOOK_E_FORMAT);
    nook_log_capture_end();
    assert_null(level);
    assert_int_equal(log.errors, 1);
    assert_int_equal(log.count, 2); /* its warning stays its own */
    assert_non_null(strstr(log.text, "nothing to play in"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_building_is_entered_where_there_is_room),
        cmocka_unit_test(test_a_thing_without_ground_gets_one_and_says_so),
        cmocka_unit_test(test_where_no_node_is_a_body_small_ones_are_and_large_ones_are_not),
        cmocka_unit_test(test_where_the_file_names_bodies_only_those_are),
        cmocka_unit_test(test_what_a_file_warns_of_is_said_once_though_it_is_read_twice),
        cmocka_unit_test(test_a_file_without_triangles_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
