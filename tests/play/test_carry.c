#include "tests/support/play_room.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static const nook_play_input take = { .buttons = NOOK_PLAY_TAKE }, throw = { .buttons = NOOK_PLAY_THROW };

/* A crate of that many kilograms at arm's length, and one who looks at it. */
#define CRATE(kilograms) PLAY_BOX("crate", 0, 0.2, -1.2, 0.4, 0.4, 0.4, PLAY_BODY(kilograms))
#define LOOKS_AT_IT "look = 0 -50\n"

static double distance_to_middle(const play_room *room, const char *name, const double from[3])
{
    double middle[3];
    play_room_middle(room, name, middle);
    return hypot(hypot(middle[0] - from[0], middle[1] - from[1]), middle[2] - from[2]);
}

static void test_what_is_looked_at_is_named_taken_and_let_go(void **state)
{
    (void)state;
    play_room room = play_room_open(CRATE(15), LOOKS_AT_IT);
    play_room_wait(&room, 0.1);
    assert_string_equal(play_room_look(&room).looked_at, "crate");
    assert_string_equal(play_room_look(&room).carried, "");
    assert_true(play_room_look(&room).hold_distance == 0.0);
    play_room_tick(&room, &take, 1);
    assert_string_equal(play_room_look(&room).carried, "crate");
    assert_string_equal(play_room_look(&room).looked_at, "");
    assert_true(play_room_look(&room).hold_distance >= 0.7);
    play_room_tick(&room, &take, 30); /* held down: pressed once */
    assert_string_equal(play_room_look(&room).carried, "crate");
    play_room_wait(&room, 0.1);
    play_room_tick(&room, &take, 1);
    assert_string_equal(play_room_look(&room).carried, "");
    play_room_close(&room);
}

static void test_what_is_carried_comes_to_where_the_view_says(void **state)
{
    (void)state;
    play_room room = play_room_open(CRATE(35), LOOKS_AT_IT);
    play_room_tick(&room, &take, 1);
    play_room_pilot(&room, "turn_to 90 -10\nwait 1.5\n");
    nook_session_view view = play_room_look(&room);
    const double place[3] = { view.eyes[0] - view.hold_distance,
                              view.eyes[1] + view.hold_distance * tan(view.pitch) - view.hold_below, view.eyes[2] };
    assert_true(distance_to_middle(&room, "crate", place) < 0.03);
    play_room_close(&room);
}

static void test_what_is_carried_keeps_its_heading_to_the_player(void **state)
{
    (void)state;
    play_room room = play_room_open(CRATE(15), LOOKS_AT_IT);
    play_room_tick(&room, &take, 1);
    play_room_pilot(&room, "turn_to 0 -10\nwait 1\nturn_to 60 -10\nwait 1\n");
    nook_pose pose =
        nook_physics_pose(nook_session_physics(room.session), nook_session_body_of(room.session, "crate"), 1.0);
    double yaw = 2.0 * atan2(pose.rotation[1], pose.rotation[3]) * 180.0 / 3.14159265;
    assert_true(fabs(remainder(yaw - 60.0, 360.0)) < 1.0);
    play_room_pilot(&room, "spin -45\nwait 1\n"); /* the crate, not the head */
    pose = nook_physics_pose(nook_session_physics(room.session), nook_session_body_of(room.session, "crate"), 1.0);
    yaw = 2.0 * atan2(pose.rotation[1], pose.rotation[3]) * 180.0 / 3.14159265;
    assert_true(fabs(remainder(yaw - 15.0, 360.0)) < 1.0);
    assert_true(fabs(play_room_look(&room).yaw * 180.0 / 3.14159265 - 60.0) < 0.3);
    play_room_close(&room);
}

static void test_what_is_too_heavy_stays_and_says_so(void **state)
{
    (void)state;
    play_room room = play_room_open(CRATE(36), LOOKS_AT_IT);
    play_room_wait(&room, 0.1);
    assert_string_equal(play_room_look(&room).looked_at, "");
    play_room_tick(&room, &take, 1);
    assert_string_equal(play_room_look(&room).carried, "");
    assert_non_null(strstr(play_room_look(&room).message, "36 kg"));
    play_room_wait(&room, 4.0);
    assert_string_equal(play_room_look(&room).message, "");
    play_room_close(&room);
}

static void test_what_is_out_of_reach_or_stands_still_is_not_taken(void **state)
{
    (void)state;
    play_room room =
        play_room_open(PLAY_BOX("far", 0, 0.2, -3.2, 0.4, 0.4, 0.4, PLAY_BODY(5))
                           PLAY_BOX("rock", 1.2, 0.2, 0, 0.4, 0.4, 0.4, ", 'extras': { 'nook_body': false }"),
                       "");
    play_room_pilot(&room, "look_at far\nwait 0.1\n");
    assert_string_equal(play_room_look(&room).looked_at, "");
    play_room_tick(&room, &take, 1);
    assert_string_equal(play_room_look(&room).carried, "");
    play_room_pilot(&room, "look_at rock\nwait 0.1\n");
    play_room_tick(&room, &take, 1);
    assert_string_equal(play_room_look(&room).carried, "");
    play_room_close(&room);
}

static void test_nobody_lifts_what_they_stand_on(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("board", 0, 0.05, 0, 2, 0.1, 2, PLAY_BODY(20)), "start = 0 0.1 0\n");
    play_room_pilot(&room, "turn_to 0 -80\nwait 0.1\n");
    assert_string_equal(play_room_look(&room).looked_at, "");
    play_room_tick(&room, &take, 1);
    assert_string_equal(play_room_look(&room).carried, "");
    play_room_close(&room);
}

/* Metres per second just after a throw straight ahead. */
static double throw_speed(const char *boxes)
{
    double linear[3], angular[3];
    play_room room = play_room_open(boxes, LOOKS_AT_IT);
    play_room_tick(&room, &take, 1);
    play_room_pilot(&room, "turn_to 0 0\nwait 1\n");
    play_room_tick(&room, &throw, 1);
    nook_physics_velocity(nook_session_physics(room.session), nook_session_body_of(room.session, "crate"), linear,
                          angular);
    assert_string_equal(play_room_look(&room).carried, "");
    play_room_close(&room);
    return -linear[2];
}

static void test_light_things_are_thrown_fast_and_heavy_ones_by_what_arms_can_give(void **state)
{
    (void)state;
    assert_true(fabs(throw_speed(CRATE(5)) - 8.0) < 0.05);
    assert_true(fabs(throw_speed(CRATE(30)) - 110.0 / 30.0) < 0.05);
}

static void test_what_gets_stuck_slips_out_of_the_hands(void **state)
{
    (void)state;
    play_room room = play_room_open(
        CRATE(15) PLAY_BOX("wall", 0, 0.5, -2.5, 6, 1, 0.2, ", 'extras': { 'nook_body': false }"), LOOKS_AT_IT);
    play_room_tick(&room, &take, 1);
    play_room_pilot(&room, "turn_to 0 -45\nwait 0.5\n");
    const nook_play_input back = { .forward = -127 };
    play_room_pilot(&room, "walk_to 0 -1\nwait 1\n"); /* against the wall: the arms give in */
    assert_string_equal(play_room_look(&room).carried, "crate");
    nook_pose behind = { { 0, 0.5, -4 }, { 0, 0, 0, 1 } };
    nook_physics_set_pose(nook_session_physics(room.session), nook_session_body_of(room.session, "crate"), &behind);
    play_room_tick(&room, &back, 30);
    assert_string_equal(play_room_look(&room).carried, "");
    play_room_close(&room);
}

static void test_what_is_carried_does_not_pass_walls(void **state)
{
    (void)state;
    play_room room = play_room_open(
        CRATE(15) PLAY_BOX("wall", 0, 1.5, -3, 8, 3, 0.1, ", 'extras': { 'nook_body': false }"), LOOKS_AT_IT);
    double middle[3];
    play_room_tick(&room, &take, 1);
    play_room_pilot(&room, "turn_to 0 -10\nwait 1\n");
    const nook_play_input run = { .forward = 127, .buttons = NOOK_PLAY_RUN };
    for (int i = 0; i < 240; i++) {
        play_room_tick(&room, &run, 1);
        play_room_middle(&room, "crate", middle);
        assert_true(middle[2] > -2.95 + 0.2 - 0.03); /* a run into it may dent it for a moment */
    }
    play_room_wait(&room, 0.5);
    play_room_middle(&room, "crate", middle);
    assert_true(middle[2] > -2.95 + 0.2 - 0.003);
    assert_true(play_room_look(&room).feet[2] > -2.95 + 0.28);
    play_room_close(&room);
}

static void test_crates_are_stacked(void **state)
{
    (void)state;
    play_room room =
        play_room_open(CRATE(15) PLAY_BOX("other", 2, 0.2, -1.2, 0.4, 0.4, 0.4, PLAY_BODY(15)), LOOKS_AT_IT);
    double middle[3];
    play_room_pilot(&room, "take other\nplace_at 0 0.6 -1.2\nwait 2\n");
    play_room_middle(&room, "other", middle);
    assert_true(fabs(middle[1] - 0.6) < 0.01);
    assert_true(hypot(middle[0], middle[2] + 1.2) < 0.08);
    assert_true(nook_physics_asleep(nook_session_physics(room.session), nook_session_body_of(room.session, "other")));
    play_room_close(&room);
}

static void test_a_body_thrown_out_of_the_world_comes_back_to_rest_where_it_began(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("crate", 18.6, 0.2, 0, 0.4, 0.4, 0.4, PLAY_BODY(5)),
                                    "start = 17.4 0 0\nlook = -90 -50\n");
    double middle[3];
    play_room_tick(&room, &take, 1);
    play_room_pilot(&room, "turn_to -90 20\nwait 1\n");
    play_room_tick(&room, &throw, 1);
    play_room_wait(&room, 1.0);
    play_room_middle(&room, "crate", middle);
    assert_true(middle[0] > 20.0); /* over the edge */
    play_room_wait(&room, 5.0);
    play_room_middle(&room, "crate", middle);
    assert_true(fabs(middle[0] - 18.6) < 0.01 && fabs(middle[1] - 0.2) < 0.01 && fabs(middle[2]) < 0.01);
    play_room_close(&room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_looked_at_is_named_taken_and_let_go),
        cmocka_unit_test(test_what_is_carried_comes_to_where_the_view_says),
        cmocka_unit_test(test_what_is_carried_keeps_its_heading_to_the_player),
        cmocka_unit_test(test_what_is_too_heavy_stays_and_says_so),
        cmocka_unit_test(test_what_is_out_of_reach_or_stands_still_is_not_taken),
        cmocka_unit_test(test_nobody_lifts_what_they_stand_on),
        cmocka_unit_test(test_light_things_are_thrown_fast_and_heavy_ones_by_what_arms_can_give),
        cmocka_unit_test(test_what_gets_stuck_slips_out_of_the_hands),
        cmocka_unit_test(test_what_is_carried_does_not_pass_walls),
        cmocka_unit_test(test_crates_are_stacked),
        cmocka_unit_test(test_a_body_thrown_out_of_the_world_comes_back_to_rest_where_it_began),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
