#include "game/play/pilot.h"
#include "tests/support/log_capture.h"
#include "tests/support/play_room.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void must_refuse(const char *text, const char *reason)
{
    nook_pilot *pilot;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_result result = nook_pilot_parse("a.pilot", text, &pilot);
    nook_log_capture_end();
    if (result != NOOK_E_FORMAT || log.errors != 1 || !strstr(log.text, reason))
        fail_msg("expected '%s', got %d: %s", reason, result, log.text);
    assert_null(pilot);
}

static void test_steps_that_are_none_are_refused_with_their_line(void **state)
{
    (void)state;
    must_refuse("wait 1\nwalkto 1 2\n", "a.pilot:2: there is no step walkto; did you mean walk_to?");
    must_refuse("qwertz\n", "a.pilot:1: there is no step qwertz");
    must_refuse("walk_to 1\n", "give walk_to X Z");
    must_refuse("walk_to 1 2 3\n", "give walk_to X Z");
    must_refuse("walk_to a b\n", "give walk_to X Z");
    must_refuse("take\n", "give take NAME");
    must_refuse("take a 1\n", "give take NAME");
    must_refuse("look_at 1 2\n", "give look_at NAME, or look_at X Y Z");
    must_refuse("look_at\n", "give look_at NAME");
    must_refuse("place_at 1 2\n", "give place_at X Y Z");
    must_refuse("wait\n", "give wait SECONDS");
    must_refuse("wait_for a b\n", "give wait_for NAME [STATE]");
    must_refuse("drop it\n", "give drop");
    must_refuse("within 0\n", "give within SECONDS");
    must_refuse("within 2 3\n", "give within SECONDS");
    must_refuse("walk_to 1 2 3 4 5 6\n", "so many words");
}

static void test_a_script_that_is_not_there_is_said(void **state)
{
    (void)state;
    nook_pilot *pilot;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_pilot_read("nowhere/none.pilot", &pilot), NOOK_E_NOT_FOUND);
    nook_log_capture_end();
    assert_null(pilot);
    assert_int_equal(log.errors, 1);
}

static void test_a_step_that_takes_too_long_fails_and_says_where_it_is(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("wall", 0, 1.5, -3, 10, 3, 0.2, ", 'extras': { 'nook_body': false }"), "");
    nook_pilot *pilot;
    nook_play_input input;
    nook_log_capture log;
    assert_int_equal(nook_pilot_parse("a.pilot", "wait 0.1\nwithin 2\nwalk_to 0 -6\nwait 1\n", &pilot), NOOK_OK);
    nook_log_capture_begin(&log);
    int ticks = 0;
    while (nook_pilot_steer(pilot, room.session, &input) == NOOK_PILOT_STEERS) {
        play_room_tick(&room, &input, 1);
        ticks++;
    }
    nook_log_capture_end();
    assert_in_range(ticks, 124, 130);
    assert_int_equal(log.errors, 1);
    assert_non_null(strstr(log.text, "a.pilot:3: walk_to 0 -6: not done within 2 s; at 0.00 0.0"));
    assert_int_equal(nook_pilot_steer(pilot, room.session, &input), NOOK_PILOT_FAILED);
    assert_int_equal(input.forward, 0);
    nook_pilot_destroy(pilot);
    play_room_close(&room);
}

static void test_ways_end_where_they_should_and_looks_where_they_should(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("crate", 3, 0.2, -3, 0.4, 0.4, 0.4, PLAY_BODY(5)), "");
    play_room_pilot(&room, "walk_to 2 1\n");
    nook_session_view view = play_room_look(&room);
    assert_true(hypot(view.feet[0] - 2.0, view.feet[2] - 1.0) < 0.12);
    play_room_pilot(&room, "run_to -5 1\n");
    view = play_room_look(&room);
    assert_true(hypot(view.feet[0] + 5.0, view.feet[2] - 1.0) < 0.12);
    play_room_pilot(&room, "wait 1\nlook_at crate\n");
    view = play_room_look(&room);
    double to[3] = { 3.0 - view.eyes[0], 0.2 - view.eyes[1], -3.0 - view.eyes[2] };
    assert_true(fabs(view.yaw - atan2(-to[0], -to[2])) < 0.005);
    assert_true(fabs(view.pitch - atan2(to[1], hypot(to[0], to[2]))) < 0.005);
    play_room_pilot(&room, "turn_to 45 -30\n");
    view = play_room_look(&room);
    assert_true(fabs(view.yaw * 180 / 3.14159265 - 45) < 0.3 && fabs(view.pitch * 180 / 3.14159265 + 30) < 0.3);
    play_room_close(&room);
}

static void test_things_are_put_where_they_should_be(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("crate", 3, 0.2, -3, 0.4, 0.4, 0.4, PLAY_BODY(30)), "");
    double middle[3];
    play_room_pilot(&room, "take crate\nplace_at -2 0.2 1\nwait 1\n");
    play_room_middle(&room, "crate", middle);
    assert_true(hypot(middle[0] + 2.0, middle[2] - 1.0) < 0.08);
    assert_true(fabs(middle[1] - 0.2) < 0.003);
    play_room_close(&room);
}

static void test_presses_last_one_tick_and_postures_stay(void **state)
{
    (void)state;
    play_room room = play_room_open("", "");
    nook_pilot *pilot;
    nook_play_input input;
    uint32_t jumps = 0, crouches = 0, restarts = 0, ticks = 0;
    assert_int_equal(nook_pilot_parse("a", "jump\ncrouch\nwait 0.5\nstand\nwait 0.5\nrestart\n", &pilot), NOOK_OK);
    while (nook_pilot_steer(pilot, room.session, &input) == NOOK_PILOT_STEERS) {
        jumps += (input.buttons & NOOK_PLAY_JUMP) != 0;
        crouches += (input.buttons & NOOK_PLAY_CROUCH) != 0;
        restarts += (input.buttons & NOOK_PLAY_RESTART) != 0;
        play_room_tick(&room, &input, 1);
        ticks++;
    }
    assert_int_equal(jumps, 1);
    assert_int_equal(restarts, 1);
    assert_in_range(crouches, 30, 33);
    assert_in_range(ticks, 60, 70);
    nook_pilot_destroy(pilot);
    play_room_close(&room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_steps_that_are_none_are_refused_with_their_line),
        cmocka_unit_test(test_a_script_that_is_not_there_is_said),
        cmocka_unit_test(test_a_step_that_takes_too_long_fails_and_says_where_it_is),
        cmocka_unit_test(test_ways_end_where_they_should_and_looks_where_they_should),
        cmocka_unit_test(test_things_are_put_where_they_should_be),
        cmocka_unit_test(test_presses_last_one_tick_and_postures_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
