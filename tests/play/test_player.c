#include "engine/core/vector.h"
#include "tests/support/play_room.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const nook_play_input forward = { .forward = 127 };

static void assert_near(double actual, double expected, double tolerance)
{
    if (!(fabs(actual - expected) <= tolerance))
        fail_msg("%.6g is not within %g of %.6g", actual, tolerance, expected);
}

/* Metres per second over the second second: the first is for getting there. */
static double speed_of(const nook_play_input *input)
{
    play_room room = play_room_open("", "start = 0 0 0\n");
    play_room_tick(&room, input, 60);
    nook_session_view before = play_room_look(&room);
    play_room_tick(&room, input, 60);
    nook_session_view after = play_room_look(&room);
    play_room_close(&room);
    return hypot(after.feet[0] - before.feet[0], after.feet[2] - before.feet[2]);
}

static void test_walks_runs_and_creeps_as_fast_as_it_should(void **state)
{
    (void)state;
    const nook_play_input half = { .forward = 64 }, aslant = { .forward = 127, .right = 127 };
    const nook_play_input run = { .forward = 127, .buttons = NOOK_PLAY_RUN };
    const nook_play_input creep = { .forward = 127, .buttons = NOOK_PLAY_CROUCH | NOOK_PLAY_RUN };
    assert_near(speed_of(&forward), 2.2, 0.005);
    assert_near(speed_of(&half), 2.2 * 64 / 127, 0.005);
    assert_near(speed_of(&aslant), 2.2, 0.005);
    assert_near(speed_of(&run), 4.5, 0.005);
    assert_near(speed_of(&creep), 1.2, 0.005);
}

static void test_goes_where_it_looks(void **state)
{
    (void)state;
    play_room room = play_room_open("", "start = 1 0 2\nlook = 0 0\n");
    const nook_play_input left = { .yaw = 16384 }, right = { .right = 127 };
    play_room_tick(&room, &forward, 60);
    nook_session_view view = play_room_look(&room);
    assert_true(view.feet[2] < 0.5); /* yaw 0 looks along -z */
    assert_near(view.feet[0], 1.0, 1e-6);
    play_room_tick(&room, &left, 1);
    assert_near(play_room_look(&room).yaw, 1.5707963, 1e-4);
    play_room_wait(&room, 0.5);
    view = play_room_look(&room);
    play_room_tick(&room, &forward, 60);
    assert_true(play_room_look(&room).feet[0] < view.feet[0] - 1.5); /* to the left of -z is -x */
    play_room_wait(&room, 0.5);
    view = play_room_look(&room);
    play_room_tick(&room, &right, 60);
    assert_true(play_room_look(&room).feet[2] < view.feet[2] - 1.5);
    play_room_close(&room);
}

static void test_never_looks_beyond_straight_up_or_down(void **state)
{
    (void)state;
    play_room room = play_room_open("", "look = 0 -80\n");
    const nook_play_input down = { .pitch = -8000 }, up = { .pitch = 8000 };
    play_room_tick(&room, &down, 10);
    assert_near(play_room_look(&room).pitch, -88.0 * 3.14159265 / 180.0, 1e-6);
    play_room_tick(&room, &up, 10);
    assert_near(play_room_look(&room).pitch, 88.0 * 3.14159265 / 180.0, 1e-6);
    play_room_close(&room);
}

static void test_one_who_begins_looking_straight_up_or_down_has_a_camera(void **state)
{
    (void)state;
    static const char *const looks[] = { "look = 0 90\n", "look = 30 -90\n" };
    for (int i = 0; i < 2; i++) {
        play_room room = play_room_open("", looks[i]);
        assert_near(fabs(play_room_look(&room).pitch), 88.0 * 3.14159265 / 180.0, 1e-6);
        for (int tick = 0; tick < 2; tick++) { /* before the first one too: it is drawn */
            nook_camera camera = nook_session_camera(room.session, 0.5, 1.0);
            for (int column = 0; column < 3; column++)
                assert_near(nook_vector_length(camera.view_from_world.m + 4 * column), 1.0, 1e-9);
            play_room_wait(&room, NOOK_PHYSICS_STEP);
        }
        play_room_close(&room);
    }
}

static void test_jumps_exactly_as_high_as_it_should_and_not_again_in_the_air(void **state)
{
    (void)state;
    const nook_play_input jump = { .buttons = NOOK_PLAY_JUMP }, nothing = { 0 };
    play_room room = play_room_open("", "");
    double highest = 0.0;
    play_room_wait(&room, 0.2);
    for (int i = 0; i < 60; i++) {
        play_room_tick(&room, i == 0 || i == 10 ? &jump : &nothing, 1);
        highest = fmax(highest, play_room_look(&room).feet[1]);
    }
    assert_near(highest, 0.45, 0.001);
    assert_near(play_room_look(&room).feet[1], 0.0, 1e-3);
    assert_true(play_room_look(&room).grounded);
    play_room_close(&room);
}

static void test_stands_where_it_is_put_to_a_tenth_of_a_millimetre(void **state)
{
    (void)state;
    play_room room = play_room_open("", "start = 3 0 -2\n");
    play_room_wait(&room, 5.0);
    nook_session_view view = play_room_look(&room);
    assert_near(view.feet[0], 3.0, 1e-4);
    assert_near(view.feet[1], 0.0, 1e-4);
    assert_near(view.feet[2], -2.0, 1e-4);
    assert_near(view.eyes[1], 1.62, 1e-3);
    play_room_close(&room);
}

static void test_low_steps_are_walked_up_and_high_ones_are_not(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("low", 0, 0.1, -3, 4, 0.2, 2, ", 'extras': { 'nook_body': false }")
                                        PLAY_BOX("high", 0, 0.2, -6, 4, 0.4, 2, ", 'extras': { 'nook_body': false }"),
                                    "");
    play_room_tick(&room, &forward, 70);
    assert_near(play_room_look(&room).feet[1], 0.2, 1e-3);
    play_room_tick(&room, &forward, 180);
    nook_session_view view = play_room_look(&room);
    assert_near(view.feet[1], 0.0, 0.01); /* down again */
    assert_true(view.feet[2] > -5.0 && view.feet[2] < -4.6);
    const nook_play_input jump = { .forward = 127, .buttons = NOOK_PLAY_JUMP };
    play_room_tick(&room, &jump, 1);
    play_room_tick(&room, &forward, 40);
    assert_near(play_room_look(&room).feet[1], 0.4, 1e-2);
    play_room_close(&room);
}

static void test_walls_hold_even_those_who_run(void **state)
{
    (void)state;
    const nook_play_input run = { .forward = 127, .buttons = NOOK_PLAY_RUN };
    play_room room =
        play_room_open(PLAY_BOX("wall", 0, 1.5, -3, 10, 3, 0.05, ", 'extras': { 'nook_body': false }"), "");
    play_room_tick(&room, &run, 300);
    nook_session_view view = play_room_look(&room);
    assert_true(view.feet[2] > -2.975 + 0.28);
    assert_true(view.feet[2] < -2.5);
    assert_near(view.feet[1], 0.0, 0.01);
    play_room_close(&room);
}

static void test_creeps_under_what_is_low_and_rises_only_where_there_is_room(void **state)
{
    (void)state;
    const nook_play_input creep = { .forward = 127, .buttons = NOOK_PLAY_CROUCH };
    play_room room = play_room_open(PLAY_BOX("beam", 0, 1.7, -2, 10, 1, 2, ", 'extras': { 'nook_body': false }"), "");
    play_room_tick(&room, &forward, 120);
    assert_true(play_room_look(&room).feet[2] > -0.8); /* standing it does not fit under 1.2 m */
    play_room_tick(&room, &creep, 90);
    nook_session_view view = play_room_look(&room);
    assert_true(view.crouched && view.feet[2] < -1.0 && view.feet[2] > -3.0);
    play_room_wait(&room, 0.5);
    assert_true(play_room_look(&room).crouched);
    assert_near(play_room_look(&room).eyes[1], 0.97, 0.01);
    play_room_tick(&room, &forward, 180); /* out of there, on its knees */
    view = play_room_look(&room);
    assert_false(view.crouched);
    assert_true(view.feet[2] < -3.0);
    assert_near(view.eyes[1], 1.62, 0.01);
    play_room_close(&room);
}

static void test_pushes_what_is_light_and_not_what_is_heavy(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("light", 0, 0.5, -2, 1, 1, 1, PLAY_BODY(30))
                                        PLAY_BOX("heavy", 5, 0.5, -2, 1, 1, 1, PLAY_BODY(1400)),
                                    "");
    double middle[3];
    play_room_tick(&room, &forward, 120);
    play_room_middle(&room, "light", middle);
    assert_true(middle[2] < -3.0);
    play_room_close(&room);
    room = play_room_open(PLAY_BOX("heavy", 0, 0.5, -2, 1, 1, 1, PLAY_BODY(1400)), "");
    play_room_tick(&room, &forward, 120);
    play_room_middle(&room, "heavy", middle);
    assert_near(middle[2], -2.0, 0.005);
    play_room_close(&room);
}

static void test_stands_on_a_body_that_rests(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("crate", 0, 0.25, 0, 1, 0.5, 1, PLAY_BODY(60)), "start = 0 0.5 0\n");
    double middle[3];
    play_room_wait(&room, 2.0);
    play_room_middle(&room, "crate", middle);
    assert_near(middle[1], 0.25, 0.003);
    assert_near(play_room_look(&room).feet[1], 0.5, 0.004);
    play_room_close(&room);
}

static void test_a_table_that_turns_takes_along_who_stands_on_it(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("table", 0, 0.05, 0, 3, 0.1, 3, ""),
                                    "start = 1 0.1 0\n[spinner table]\naxis = 0 1 0\nrpm = 10\nshape = box\n");
    play_room_wait(&room, 3.0); /* gets up to speed */
    double angle[2], ticks = 180.0;
    for (int i = 0; i < 2; i++) {
        nook_session_view view = play_room_look(&room);
        assert_near(hypot(view.feet[0], view.feet[2]), 1.0, 0.05);
        angle[i] = atan2(-view.feet[2], view.feet[0]);
        if (i == 0)
            play_room_wait(&room, ticks / 60.0);
    }
    double turned = remainder(angle[1] - angle[0] - 10.0 / 60.0 * 2.0 * 3.14159265 * ticks / 60.0, 2.0 * 3.14159265);
    assert_near(turned, 0.0, 0.05);
    play_room_close(&room);
}

static void test_one_who_falls_out_of_the_world_comes_back(void **state)
{
    (void)state;
    play_room room = play_room_open("", "start = 19 0 0\nlook = -90 0\n");
    play_room_tick(&room, &forward, 60 * 5);
    play_room_wait(&room, 2.0);
    nook_session_view view = play_room_look(&room);
    assert_near(view.feet[0], 19.0, 0.1);
    assert_near(view.feet[1], 0.0, 0.01);
    play_room_close(&room);
}

static void test_the_stairs_of_the_hall_are_climbed_without_a_jump(void **state)
{
    (void)state;
    char path[4096];
    snprintf(path, sizeof path, "%s/content/hall/hall.glb", getenv("NOOK_ROOT") ? getenv("NOOK_ROOT") : ".");
    play_room room = play_room_open_level(path, 1);
    play_room_pilot(&room, "within 30\nwalk_to -10 0.6\nrun_to 4 0\nwalk_to 8 0\nwalk_to 10.9 0\n");
    assert_near(play_room_look(&room).feet[1], 2.275, 0.002);
    play_room_pilot(&room, "walk_to 10.9 3.6\nwalk_to 10.9 4.2\n");
    assert_true(play_room_look(&room).feet[1] > 4.3); /* the gallery */
    play_room_pilot(&room, "walk_to 10.9 0\nwalk_to 5 0\n");
    assert_near(play_room_look(&room).feet[1], 0.0, 0.002);
    play_room_close(&room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_walks_runs_and_creeps_as_fast_as_it_should),
        cmocka_unit_test(test_goes_where_it_looks),
        cmocka_unit_test(test_never_looks_beyond_straight_up_or_down),
        cmocka_unit_test(test_one_who_begins_looking_straight_up_or_down_has_a_camera),
        cmocka_unit_test(test_jumps_exactly_as_high_as_it_should_and_not_again_in_the_air),
        cmocka_unit_test(test_stands_where_it_is_put_to_a_tenth_of_a_millimetre),
        cmocka_unit_test(test_low_steps_are_walked_up_and_high_ones_are_not),
        cmocka_unit_test(test_walls_hold_even_those_who_run),
        cmocka_unit_test(test_creeps_under_what_is_low_and_rises_only_where_there_is_room),
        cmocka_unit_test(test_pushes_what_is_light_and_not_what_is_heavy),
        cmocka_unit_test(test_stands_on_a_body_that_rests),
        cmocka_unit_test(test_a_table_that_turns_takes_along_who_stands_on_it),
        cmocka_unit_test(test_one_who_falls_out_of_the_world_comes_back),
        cmocka_unit_test(test_the_stairs_of_the_hall_are_climbed_without_a_jump),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
