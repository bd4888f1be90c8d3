/* Made-up keys and mice: what the views take, and what is left for the host. */
#include "tests/support/live_room.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void test_number_keys_choose_the_technique_of_the_active_view(void **state)
{
    live_room *room = *state;
    nook_live_views *views = nook_live_state(room->live);
    live_room_press(room, NOOK_KEY_PLUS);
    assert_int_equal(views->count, 2);
    room->input.mouse_x = 0.75 * LIVE_ROOM_WIDTH, room->input.mouse_dx = 1.0;
    live_room_step(room);
    assert_int_equal(views->active, 1);
    live_room_press(room, NOOK_KEY_2);
    assert_memory_equal(views->views[1].setting, "ssao", 4);
    assert_memory_equal(views->views[0].setting, "volume", 6);
    live_room_press(room, NOOK_KEY_0);
    assert_true(views->views[1].open && !views->views[0].open);
    live_room_press(room, NOOK_KEY_9); /* there is none */
    assert_true(views->views[1].open);
    live_room_press(room, NOOK_KEY_TAB);
    assert_int_equal(views->active, 0);
    live_room_press(room, NOOK_KEY_5);
    assert_memory_equal(views->views[0].setting, "gtao", 4);
    live_room_press(room, NOOK_KEY_MINUS);
    assert_int_equal(views->count, 1);
}

static void test_keys_that_are_used_are_taken_from_the_host_and_others_are_not(void **state)
{
    live_room *room = *state;
    room->input.down[NOOK_KEY_W] = room->input.pressed[NOOK_KEY_SPACE] = true;
    room->input.down[NOOK_KEY_TAB] = room->input.pressed[NOOK_KEY_TAB] = true;
    room->input.mouse_down[0] = true, room->input.mouse_dx = 4.0;
    live_room_step(room);
    assert_true(room->rest.down[NOOK_KEY_W] && room->rest.pressed[NOOK_KEY_SPACE]);
    assert_false(room->rest.down[NOOK_KEY_TAB] || room->rest.pressed[NOOK_KEY_TAB]);
    assert_true(room->rest.mouse_down[0] && room->rest.mouse_dx == 4.0);
}

static void test_border_follows_the_mouse_and_the_host_gets_nothing_of_it(void **state)
{
    live_room *room = *state;
    nook_live_views *views = nook_live_state(room->live);
    nook_live_views_set_count(views, 2);
    room->input.mouse_x = 0.5 * LIVE_ROOM_WIDTH + 3.0;
    room->input.mouse_down[0] = room->input.mouse_pressed[0] = true;
    live_room_step(room);
    assert_false(room->rest.mouse_down[0]);
    room->input.mouse_x = 0.7 * LIVE_ROOM_WIDTH, room->input.mouse_dx = 0.2 * LIVE_ROOM_WIDTH;
    live_room_step(room);
    assert_true(views->splits[0] == 0.7 && room->rest.mouse_dx == 0.0);
    room->input.mouse_down[0] = false;
    live_room_step(room);
    room->input.mouse_x = 0.2 * LIVE_ROOM_WIDTH;
    live_room_step(room);
    assert_true(views->splits[0] == 0.7);
}

static void test_captured_mouse_moves_no_borders(void **state)
{
    live_room *room = *state;
    nook_live_views *views = nook_live_state(room->live);
    nook_live_views_set_count(views, 2);
    room->input.mouse_x = 0.5 * LIVE_ROOM_WIDTH;
    room->input.mouse_down[0] = room->input.mouse_pressed[0] = true;
    nook_live_input(room->live, &room->input, false, &room->rest);
    room->input.mouse_x = 0.2 * LIVE_ROOM_WIDTH, room->input.mouse_dx = -10.0;
    nook_live_input(room->live, &room->input, false, &room->rest);
    assert_true(views->splits[0] == 0.5 && room->rest.mouse_dx == -10.0 && room->rest.mouse_down[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        LIVE_ROOM_TEST(test_number_keys_choose_the_technique_of_the_active_view),
        LIVE_ROOM_TEST(test_keys_that_are_used_are_taken_from_the_host_and_others_are_not),
        LIVE_ROOM_TEST(test_border_follows_the_mouse_and_the_host_gets_nothing_of_it),
        LIVE_ROOM_TEST(test_captured_mouse_moves_no_borders),
    };
    return cmocka_run_group_tests(tests, live_room_open, live_room_close);
}
