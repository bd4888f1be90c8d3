#include "engine/core/rotation.h"
#include "tests/support/play_room.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define STILL ", 'extras': { 'nook_body': false }"
#define PLATE PLAY_BOX("plate", 0, 0.025, -2, 1, 0.05, 1, STILL)

static const nook_play_input forward = { .forward = 127 };

static double state_of(const play_room *room, const char *name)
{
    return nook_session_state_of(room->session, name);
}

static void assert_near(double actual, double expected, double tolerance)
{
    if (!(fabs(actual - expected) <= tolerance))
        fail_msg("%.6g is not within %g of %.6g", actual, tolerance, expected);
}

/* ---- Plates ------------------------------------------------------------------------------------------------------ */

/* The plate's state two seconds after a crate of 20 kg fell on it from a millimetre. */
static double state_under_crate(const char *plate, double *out_newtons)
{
    play_room room = play_room_open(PLATE PLAY_BOX("crate", 0, 0.256, -2, 0.4, 0.4, 0.4, PLAY_BODY(20))
                                        PLAY_BOX("gear", 9, 0.1, 9, 0.2, 0.2, 0.2, PLAY_BODY(1)),
                                    plate);
    nook_physics_wake(nook_session_physics(room.session), nook_session_body_of(room.session, "crate"));
    play_room_wait(&room, 2.0);
    double down = state_of(&room, "plate");
    *out_newtons = nook_session_measure_of(room.session, "plate");
    play_room_close(&room);
    return down;
}

static void test_a_plate_feels_weight_and_goes_down_from_its_threshold_on(void **state)
{
    (void)state;
    double newtons;
    assert_true(state_under_crate("[plate plate]\nweight = 20\n", &newtons) == 1.0);
    assert_near(newtons, 20 * 9.81, 2.0);
    assert_true(state_under_crate("[plate plate]\nweight = 21\n", &newtons) == 0.0);
}

static void test_a_plate_takes_only_what_it_accepts(void **state)
{
    (void)state;
    double newtons;
    assert_true(state_under_crate("[plate plate]\nweight = 10\naccepts = crate\n", &newtons) == 1.0);
    assert_true(state_under_crate("[plate plate]\nweight = 10\naccepts = cra*\n", &newtons) == 1.0);
    assert_true(state_under_crate("[plate plate]\nweight = 10\naccepts = gear\n", &newtons) == 0.0);
    assert_near(newtons, 20 * 9.81, 2.0);
}

static void test_a_plate_goes_down_after_its_seconds_and_comes_up_at_once(void **state)
{
    (void)state;
    play_room room = play_room_open(PLATE, "[plate plate]\nweight = 70\nseconds = 1\n");
    play_room_tick(&room, &forward, 50);
    play_room_wait(&room, 0.5);
    double part = state_of(&room, "plate");
    assert_true(part > 0.2 && part < 1.0); /* the player weighs 80 kg */
    play_room_wait(&room, 1.0);
    assert_true(state_of(&room, "plate") == 1.0);
    assert_int_equal(play_room_look(&room).open, 1);
    assert_int_equal(play_room_look(&room).locks, 1);
    play_room_tick(&room, &forward, 60);
    assert_true(state_of(&room, "plate") == 0.0);
    assert_int_equal(play_room_look(&room).open, 0);
    play_room_close(&room);
}

static void test_a_plate_that_wants_a_thing_is_not_held_down_by_the_player(void **state)
{
    (void)state;
    play_room room = play_room_open(PLATE PLAY_BOX("crate", 9, 0.2, 9, 0.4, 0.4, 0.4, PLAY_BODY(20)),
                                    "[plate plate]\nweight = 10\naccepts = crate\n");
    play_room_tick(&room, &forward, 50);
    play_room_wait(&room, 1.0);
    assert_true(nook_session_measure_of(room.session, "plate") > 700.0);
    assert_true(state_of(&room, "plate") == 0.0);
    play_room_close(&room);
}

/* ---- Shades ------------------------------------------------------------------------------------------------------ */

/* What a stone of 20 cm sees of the sky, with boxes around it. */
static double visibility_with(const char *boxes)
{
    char all[4096];
    snprintf(all, sizeof all, "%s%s", PLAY_BOX("stone", 0, 0.1, -5, 0.2, 0.2, 0.2, STILL), boxes);
    play_room room = play_room_open(all, "[shade stone]\nvisibility = 0.5\nreach = 30\n");
    play_room_wait(&room, 0.5);
    double visibility = nook_session_measure_of(room.session, "stone");
    assert_true(state_of(&room, "stone") == (visibility <= 0.5 ? 1.0 : 0.0));
    play_room_close(&room);
    return visibility;
}

/* Lambert's view factor of a rectangle, a x b, seen from `height` below its corner. */
static double corner_factor(double a, double b, double height)
{
    double x = a / height, y = b / height, p = sqrt(1.0 + x * x), q = sqrt(1.0 + y * y);
    return (x / p * atan(y / p) + y / q * atan(x / q)) / (2.0 * 3.14159265358979);
}

static void test_a_shade_on_an_open_floor_sees_all_of_the_sky(void **state)
{
    (void)state;
    assert_true(visibility_with("") == 1.0);
}

static void test_a_shade_under_a_box_sees_what_lambert_says(void **state)
{
    (void)state;
    const double noise = 0.012; /* of 256 rays of a low discrepancy along an edge */
    double low = visibility_with(PLAY_BOX("roof", 0, 1.2, -5, 2, 1, 2, STILL));
    assert_near(low, 1.0 - 4.0 * corner_factor(1.0, 1.0, 0.5 - 0.001), noise);
    double high = visibility_with(PLAY_BOX("roof", 0, 2.2, -5, 3, 1, 1, STILL));
    assert_near(high, 1.0 - 4.0 * corner_factor(1.5, 0.5, 1.5 - 0.001), noise);
    double aside = visibility_with(PLAY_BOX("roof", 1, 2.2, -5, 2, 1, 2, STILL)); /* half of it overhead */
    assert_near(aside, 1.0 - 2.0 * corner_factor(2.0, 1.0, 1.5 - 0.001), noise);
}

static void test_walls_that_touch_the_sky_leave_a_shade_what_lambert_says(void **state)
{
    (void)state; /* an endless wall of height h at distance d hides half of sine squared of what it rises to */
    double seen = visibility_with(PLAY_BOX("wall", 1.0, 0.7, -5, 1, 1.4, 30, STILL));
    double rise = atan2(1.4 - 0.2, 0.5), hidden = 0.5 * (1.0 - cos(rise));
    assert_near(seen, 1.0 - hidden, 0.015);
}

static void test_a_shade_counts_only_what_is_within_its_reach(void **state)
{
    (void)state;
    play_room room =
        play_room_open(PLAY_BOX("stone", 0, 0.1, -5, 0.2, 0.2, 0.2, STILL) PLAY_BOX("roof", 0, 3, -5, 10, 1, 10, STILL),
                       "[shade stone]\nvisibility = 0.5\nreach = 2\n");
    assert_true(nook_session_measure_of(room.session, "stone") == 1.0);
    play_room_close(&room);
}

static void test_a_shade_opens_when_its_night_is_built(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("stone", 0, 0.1, -2, 0.2, 0.2, 0.2, STILL)
                                        PLAY_BOX("crate", 1.5, 0.2, -2, 0.4, 0.4, 0.4, PLAY_BODY(10)),
                                    "[shade stone]\nvisibility = 0.3\nreach = 1.5\nseconds = 0.5\n");
    assert_true(state_of(&room, "stone") == 0.0);
    play_room_pilot(&room, "take crate\nplace_at 0 0.42 -2\nwait_for stone\n");
    assert_true(nook_session_measure_of(room.session, "stone") < 0.05);
    play_room_close(&room);
}

/* ---- Movers and spinners ----------------------------------------------------------------------------------------- */

static nook_pose pose_of(const play_room *room, const char *name)
{
    return nook_physics_pose(nook_session_physics(room->session), nook_session_body_of(room->session, name), 1.0);
}

static void assert_pose(const nook_pose *pose, const double position[3], const double degrees[3])
{
    double q[4], difference = 0.0;
    nook_rotation_from_degrees(degrees, q);
    for (int k = 0; k < 4; k++)
        difference += pose->rotation[k] * q[k];
    assert_near(fabs(difference), 1.0, 1e-14);
    for (int k = 0; k < 3; k++)
        assert_near(pose->position[k], position[k], 1e-14);
}

static void test_a_mover_ends_exactly_where_it_should_and_goes_back(void **state)
{
    (void)state;
    const char *entities = "[plate plate]\nweight = 70\n[mover door]\nslide = 0 1.5 0.25\nswing = 0 -100 0\n"
                           "seconds = 1\nneeds = plate\n";
    const double shut[3] = { 3, 1, -2 }, open[3] = { 3, 2.5, -1.75 }, straight[3] = { 0, 0, 0 },
                 swung[3] = { 0, -100, 0 };
    play_room room = play_room_open(PLATE PLAY_BOX("door", 3, 1, -2, 1, 2, 0.1, ""), entities);
    play_room_wait(&room, 1.0);
    nook_pose pose = pose_of(&room, "door");
    assert_pose(&pose, shut, straight);
    play_room_tick(&room, &forward, 52);
    play_room_wait(&room, 0.5);
    assert_true(state_of(&room, "door") > 0.1 && state_of(&room, "door") < 1.0);
    play_room_wait(&room, 1.5);
    assert_true(state_of(&room, "door") == 1.0);
    pose = pose_of(&room, "door");
    assert_pose(&pose, open, swung);
    play_room_tick(&room, &forward, 60);
    play_room_wait(&room, 1.5);
    assert_true(state_of(&room, "door") == 0.0);
    pose = pose_of(&room, "door");
    assert_pose(&pose, shut, straight);
    play_room_close(&room);
}

/* How far the entities are when the player, who weighs 80 kg, has stood on the plate until it was down, and two seconds after he left it. */
static void leave_plate(const char *entities, const char *const names[2], double out_on[2], double out_off[2])
{
    play_room room = play_room_open(PLATE PLAY_BOX("door", 3, 1, -2, 1, 2, 0.1, ""), entities);
    play_room_tick(&room, &forward, 52);
    play_room_wait(&room, 0.5);
    for (int i = 0; i < 2; i++)
        out_on[i] = state_of(&room, names[i]);
    play_room_tick(&room, &forward, 60);
    play_room_wait(&room, 2.0);
    for (int i = 0; i < 2; i++)
        out_off[i] = state_of(&room, names[i]);
    assert_true(nook_session_measure_of(room.session, "plate") == 0.0);
    assert_int_equal(nook_session_restart(room.session), NOOK_OK);
    assert_true(state_of(&room, names[0]) == 0.0 && state_of(&room, names[1]) == 0.0);
    play_room_close(&room);
}

static void test_what_latches_stays_open_until_the_next_try(void **state)
{
    (void)state;
    const char *const names[2] = { "plate", "door" };
    double on[2], off[2];
    leave_plate("[plate plate]\nweight = 70\n[mover door]\nslide = 0 1 0\nseconds = 1\nneeds = plate\n", names, on,
                off);
    assert_true(on[0] == 1.0 && on[1] > 0.0 && on[1] < 1.0);
    assert_true(off[0] == 0.0 && off[1] == 0.0);
    leave_plate("[plate plate]\nweight = 70\nlatch = yes\n[mover door]\nslide = 0 1 0\nseconds = 1\nneeds = plate\n",
                names, on, off);
    assert_true(off[0] == 1.0 && off[1] == 1.0);
    leave_plate("[plate plate]\nweight = 70\nlatch = no\n[mover door]\nslide = 0 1 0\nseconds = 1\nneeds = plate\n"
                "latch = yes\n",
                names, on, off);
    assert_true(on[1] > 0.0 && on[1] < 1.0); /* on its way: it goes on */
    assert_true(off[0] == 0.0 && off[1] == 1.0);
    leave_plate("[plate plate]\nweight = 70\n[spinner door]\naxis = 0 1 0\nrpm = 4\nneeds = plate\nlatch = yes\n",
                names, on, off);
    assert_true(off[0] == 0.0 && off[1] > on[1]);
}

static void test_a_lock_that_latches_must_hold_for_its_seconds_first(void **state)
{
    (void)state;
    play_room room = play_room_open(PLATE, "[plate plate]\nweight = 70\nseconds = 2\nlatch = yes\n");
    play_room_tick(&room, &forward, 50);
    play_room_wait(&room, 0.5);
    assert_true(state_of(&room, "plate") > 0.1 && state_of(&room, "plate") < 1.0);
    play_room_tick(&room, &forward, 60);
    assert_true(state_of(&room, "plate") == 0.0);
    play_room_close(&room);
}

static void test_a_mover_takes_its_seconds(void **state)
{
    (void)state;
    play_room room =
        play_room_open(PLAY_BOX("door", 3, 1, -2, 1, 2, 0.1, ""), "[mover door]\nslide = 0 1 0\nseconds = 2\n");
    int ticks = 0;
    for (; state_of(&room, "door") < 1.0; ticks++)
        play_room_wait(&room, NOOK_PHYSICS_STEP);
    assert_in_range(ticks, 119, 121);
    play_room_close(&room);
}

static void test_a_spinner_turns_as_often_as_it_should(void **state)
{
    (void)state;
    play_room room =
        play_room_open(PLAY_BOX("wheel", 3, 1, -2, 1, 1, 0.1, ""), "[spinner wheel]\naxis = 0 0 2\nrpm = 40\n");
    play_room_wait(&room, 4.0);
    assert_true(state_of(&room, "wheel") == 1.0);
    nook_pose before = pose_of(&room, "wheel");
    play_room_wait(&room, 0.25); /* a sixth of a turn: 60 degrees */
    nook_pose after = pose_of(&room, "wheel");
    double rate[3];
    nook_pose_turn_rate(before.rotation, after.rotation, 0.25, rate);
    assert_near(rate[2], 40.0 / 60.0 * 2.0 * 3.14159265358979, 1e-9);
    assert_near(rate[0], 0.0, 1e-9);
    play_room_wait(&room, 60.0); /* 40 turns */
    nook_pose later = pose_of(&room, "wheel");
    nook_pose_turn_rate(after.rotation, later.rotation, 1.0, rate);
    assert_near(rate[2], 0.0, 1e-9);
    play_room_close(&room);
}

static void test_a_spinner_waits_for_what_it_needs(void **state)
{
    (void)state;
    play_room room =
        play_room_open(PLATE PLAY_BOX("wheel", 3, 1, -2, 1, 1, 0.1, ""),
                       "[plate plate]\nweight = 70\n[spinner wheel]\naxis = 0 0 1\nrpm = 40\nneeds = plate\n");
    nook_pose before = pose_of(&room, "wheel");
    play_room_wait(&room, 1.0);
    nook_pose after = pose_of(&room, "wheel");
    assert_memory_equal(&before, &after, sizeof before);
    play_room_tick(&room, &forward, 52);
    play_room_wait(&room, 1.0);
    assert_true(state_of(&room, "wheel") > 0.2);
    play_room_close(&room);
}

/* ---- The end ----------------------------------------------------------------------------------------------------- */

static const char goal_entities[] =
    "task = Go there\nwon = Well done\nlost = Too late\nseconds = 10\n"
    "[plate plate]\nweight = 70\n[goal there]\nat = 0 1 -6\nsize = 2 2 2\nneeds = plate\n";

static void test_a_goal_counts_only_when_its_needs_are_met(void **state)
{
    (void)state;
    play_room room = play_room_open(PLATE PLAY_BOX("weight", 0, 0.3, -2, 0.4, 0.4, 0.4, PLAY_BODY(90)), goal_entities);
    assert_string_equal(play_room_look(&room).message, "Go there");
    play_room_pilot(&room, "walk_to 1.5 -2\nwalk_to 0 -6\n");
    assert_int_equal(play_room_look(&room).status, NOOK_SESSION_WON); /* the weight lies on the plate */
    assert_string_equal(play_room_look(&room).message, "Well done");
    assert_true(state_of(&room, "there") == 1.0);
    play_room_close(&room);

    room = play_room_open(PLATE, goal_entities);
    play_room_pilot(&room, "walk_to 1.5 -2\nwalk_to 0 -6\nwait 1\n");
    assert_int_equal(play_room_look(&room).status, NOOK_SESSION_PLAYING);
    assert_true(state_of(&room, "there") == 0.0);
    play_room_close(&room);
}

static void test_time_runs_out_and_the_rules_stop_then(void **state)
{
    (void)state;
    play_room room = play_room_open(PLATE PLAY_BOX("weight", 0, 0.3, -2, 0.4, 0.4, 0.4, PLAY_BODY(90)), goal_entities);
    play_room_wait(&room, 9.9);
    assert_int_equal(play_room_look(&room).status, NOOK_SESSION_PLAYING);
    assert_near(play_room_look(&room).seconds_left, 0.1, 0.02);
    play_room_wait(&room, 0.2);
    assert_int_equal(play_room_look(&room).status, NOOK_SESSION_LOST);
    assert_string_equal(play_room_look(&room).message, "Too late");
    play_room_pilot(&room, "walk_to 1.5 -2\nwalk_to 0 -6\n"); /* the world goes on */
    assert_int_equal(play_room_look(&room).status, NOOK_SESSION_LOST);
    assert_true(play_room_look(&room).seconds_left == 0.0);
    play_room_close(&room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_plate_feels_weight_and_goes_down_from_its_threshold_on),
        cmocka_unit_test(test_a_plate_takes_only_what_it_accepts),
        cmocka_unit_test(test_a_plate_goes_down_after_its_seconds_and_comes_up_at_once),
        cmocka_unit_test(test_a_plate_that_wants_a_thing_is_not_held_down_by_the_player),
        cmocka_unit_test(test_a_shade_on_an_open_floor_sees_all_of_the_sky),
        cmocka_unit_test(test_a_shade_under_a_box_sees_what_lambert_says),
        cmocka_unit_test(test_walls_that_touch_the_sky_leave_a_shade_what_lambert_says),
        cmocka_unit_test(test_a_shade_counts_only_what_is_within_its_reach),
        cmocka_unit_test(test_a_shade_opens_when_its_night_is_built),
        cmocka_unit_test(test_a_mover_ends_exactly_where_it_should_and_goes_back),
        cmocka_unit_test(test_what_latches_stays_open_until_the_next_try),
        cmocka_unit_test(test_a_lock_that_latches_must_hold_for_its_seconds_first),
        cmocka_unit_test(test_a_mover_takes_its_seconds),
        cmocka_unit_test(test_a_spinner_turns_as_often_as_it_should),
        cmocka_unit_test(test_a_spinner_waits_for_what_it_needs),
        cmocka_unit_test(test_a_goal_counts_only_when_its_needs_are_met),
        cmocka_unit_test(test_time_runs_out_and_the_rules_stop_then),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
