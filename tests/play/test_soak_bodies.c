/* A crate on the floor of a room, 40 m square: shoved over its edge, and put below it. */
#include "game/play/soak_bodies.h"
#include "tests/support/log_capture.h"
#include "tests/support/play_room.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const nook_play_input nothing = { 0 };

static play_room open_room(void)
{
    return play_room_open(PLAY_BOX("crate", 19, 0.25, 0, 0.5, 0.5, 0.5, PLAY_BODY(15)), "start = 0 0 0\n");
}

/* Ticks until something has left, or so many seconds are over. */
static void watch(play_room *room, nook_soak_bodies *bodies, const nook_play_input *input, double seconds)
{
    const uint32_t before = bodies->through + bodies->over_an_edge;
    for (double t = 0.0; t < seconds && bodies->through + bodies->over_an_edge == before; t += NOOK_PHYSICS_STEP) {
        play_room_tick(room, input, 1);
        assert_int_equal(nook_soak_bodies_look(bodies, room->session), NOOK_OK);
    }
}

static void shove(play_room *room, double x)
{
    const double linear[3] = { x, 0, 0 }, still[3] = { 0, 0, 0 };
    nook_physics_set_velocity(nook_session_physics(room->session), nook_session_body_of(room->session, "crate"), linear,
                              still);
}

static void put(play_room *room, double y)
{
    nook_pose pose = nook_pose_identity();
    pose.position[1] = y;
    nook_physics_set_pose(nook_session_physics(room->session), nook_session_body_of(room->session, "crate"), &pose);
    nook_physics_wake(nook_session_physics(room->session), nook_session_body_of(room->session, "crate"));
}

static void test_a_body_that_falls_over_an_edge_is_counted_and_said_where(void **state)
{
    (void)state;
    play_room room = open_room();
    nook_soak_bodies bodies = { 0 };
    nook_log_capture log;
    nook_log_capture_begin(&log);
    watch(&room, &bodies, &nothing, 0.1);
    shove(&room, 12.0);
    watch(&room, &bodies, &nothing, 10.0);
    nook_log_capture_end();
    assert_true(bodies.over_an_edge == 1 && bodies.through == 0);
    assert_string_equal(bodies.last, "crate");
    assert_true(bodies.last_at[0] > 20.0 && bodies.last_at[1] < -1.0); /* beside the floor, and below it */
    assert_int_equal(log.count, 0);
    double middle[3];
    play_room_middle(&room, "crate", middle);
    assert_true(fabs(middle[0] - 19.0) < 0.1); /* brought back */
    watch(&room, &bodies, &nothing, 1.0);
    assert_true(bodies.over_an_edge == 1); /* the way back is none of its ways */
    nook_soak_bodies_free(&bodies);
    play_room_close(&room);
}

static void test_a_body_that_went_through_the_floor_is_a_fault_and_is_said(void **state)
{
    (void)state;
    play_room room = open_room();
    nook_soak_bodies bodies = { 0 };
    nook_log_capture log;
    nook_log_capture_begin(&log);
    put(&room, 1.0);
    watch(&room, &bodies, &nothing, 0.1);
    put(&room, -3.0);
    watch(&room, &bodies, &nothing, 10.0);
    nook_log_capture_end();
    assert_true(bodies.through == 1 && bodies.over_an_edge == 0);
    assert_true(log.count == 1 && log.level == NOOK_LOG_WARNING);
    assert_non_null(strstr(log.text, "crate went through floor and left the world at 0.00 -"));
    shove(&room, 12.0); /* from where it was brought back to: what it did before counts no more */
    watch(&room, &bodies, &nothing, 10.0);
    assert_true(bodies.through == 1 && bodies.over_an_edge == 1);
    nook_soak_bodies_free(&bodies);
    play_room_close(&room);
}

static void test_what_moves_is_nothing_that_can_be_gone_through(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("crate", 19, 0.25, 0, 0.5, 0.5, 0.5, PLAY_BODY(15))
                                        PLAY_BOX("light", 19.45, 0.15, 0, 0.3, 0.3, 0.3, PLAY_BODY(1)),
                                    "start = 0 0 0\n");
    nook_soak_bodies bodies = { 0 };
    watch(&room, &bodies, &nothing, 0.1);
    shove(&room, 12.0);
    watch(&room, &bodies, &nothing, 10.0);
    watch(&room, &bodies, &nothing, 10.0);
    assert_true(bodies.over_an_edge == 2 && bodies.through == 0);
    nook_soak_bodies_free(&bodies);
    play_room_close(&room);
}

static void test_a_player_who_walks_over_the_edge_is_counted_and_a_new_try_is_no_way(void **state)
{
    (void)state;
    const nook_play_input run = { .forward = 127, .buttons = NOOK_PLAY_RUN };
    const nook_play_input restart = { .buttons = NOOK_PLAY_RESTART };
    play_room room = play_room_open("", "start = 0 0 -19\n");
    nook_soak_bodies bodies = { 0 };
    watch(&room, &bodies, &run, 10.0);
    assert_true(bodies.over_an_edge == 1 && bodies.through == 0);
    assert_string_equal(bodies.last, "the player");
    watch(&room, &bodies, &run, 0.5);
    watch(&room, &bodies, &restart, 0.01); /* back to the start, across everything */
    watch(&room, &bodies, &run, 10.0);
    assert_true(bodies.over_an_edge == 2 && bodies.through == 0);
    nook_soak_bodies_free(&bodies);
    play_room_close(&room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_body_that_falls_over_an_edge_is_counted_and_said_where),
        cmocka_unit_test(test_a_body_that_went_through_the_floor_is_a_fault_and_is_said),
        cmocka_unit_test(test_what_moves_is_nothing_that_can_be_gone_through),
        cmocka_unit_test(test_a_player_who_walks_over_the_edge_is_counted_and_a_new_try_is_no_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
