/* Panels and messages over the picture. */
#include "tests/support/live_room.h"
#include "tests/support/log_capture.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Drags every part of the panel to the right until the setting of the view differs. @return whether it ever did */
static bool drag_a_slider(live_room *room)
{
    char before[NOOK_SETTING_TEXT_MAX];
    nook_live_view *view = &nook_live_state(room->live)->views[0];
    memcpy(before, view->setting, sizeof before);
    for (double y = 110.0; y < LIVE_ROOM_HEIGHT; y += 7.0) {
        room->input.mouse_x = LIVE_ROOM_WIDTH - 340.0, room->input.mouse_y = y;
        live_room_step(room);
        room->input.mouse_down[0] = true;
        live_room_step(room);
        room->input.mouse_x += 60.0;
        live_room_step(room);
        room->input.mouse_x += 20.0;
        live_room_step(room);
        room->input.mouse_down[0] = false;
        live_room_step(room);
        live_room_step(room);
        if (strcmp(before, view->setting) != 0)
            return true;
    }
    return false;
}

static void test_slider_of_the_panel_changes_a_parameter_and_undo_takes_it_back(void **state)
{
    live_room *room = *state;
    nook_live_view *view = &nook_live_state(room->live)->views[0];
    live_room_set(room, 0, "ssao samples=4");
    live_room_press(room, NOOK_KEY_F2);
    live_room_step(room);
    assert_true(nook_live_wants_pointer(room->live));
    assert_true(drag_a_slider(room));
    assert_false(room->rest.mouse_down[0]);
    nook_setting changed;
    assert_int_equal(nook_setting_parse("the panel", view->setting, &changed), NOOK_OK);
    char after[NOOK_SETTING_TEXT_MAX];
    memcpy(after, view->setting, sizeof after);
    room->input.down[NOOK_KEY_CONTROL] = true;
    live_room_press(room, NOOK_KEY_Z);
    assert_string_equal(view->setting, "ssao samples=4");
    live_room_press(room, NOOK_KEY_Y);
    assert_string_equal(view->setting, after);
    room->input.down[NOOK_KEY_CONTROL] = false;
}

static void test_mouse_over_a_panel_is_not_the_host_s(void **state)
{
    live_room *room = *state;
    live_room_press(room, NOOK_KEY_F2);
    room->input.mouse_x = LIVE_ROOM_WIDTH - 100.0, room->input.mouse_y = 60.0;
    live_room_step(room);
    room->input.mouse_pressed[0] = true, room->input.scroll = 1.0;
    live_room_step(room);
    assert_true(!room->rest.mouse_pressed[0] && room->rest.scroll == 0.0);
    room->input.scroll = 0.0;
    live_room_press(room, NOOK_KEY_F2);
    room->input.mouse_down[0] = true;
    live_room_step(room);
    assert_true(room->rest.mouse_down[0]);
    assert_false(nook_live_wants_pointer(room->live));
}

static bool has_red(const live_room *room)
{
    int red = 0;
    for (size_t i = 0; i < (size_t)LIVE_ROOM_WIDTH * 100; i++)
        red += room->picture[i * 3] > 200 && room->picture[i * 3 + 1] < 140 && room->picture[i * 3 + 2] < 140;
    return red > 10;
}

static void test_messages_stay_until_they_are_taken_back(void **state)
{
    live_room *room = *state;
    uint8_t *before = malloc(LIVE_ROOM_SIZE);
    live_room_step(room);
    live_room_picture(room);
    memcpy(before, room->picture, LIVE_ROOM_SIZE);
    nook_live_message(room->live, "shaders", "shaders/ao/volume.comp.glsl:12: error: no such thing");
    nook_live_message(room->live, "game", "crashed in its first frame");
    live_room_step(room);
    live_room_step(room);
    live_room_picture(room);
    assert_true(has_red(room));
    nook_live_message(room->live, "shaders", "");
    nook_live_message(room->live, "game", "");
    live_room_step(room);
    live_room_picture(room);
    assert_memory_equal(room->picture, before, LIVE_ROOM_SIZE);
    for (int i = 0; i < 3 * NOOK_LIVE_MESSAGES_MAX; i++) { /* more senders than there is room for */
        char from[32];
        snprintf(from, sizeof from, "sender %d", i);
        nook_live_message(room->live, from, "text");
    }
    live_room_step(room);
    free(before);
}

static void test_long_messages_are_broken_into_lines_that_the_window_holds(void **state)
{
    live_room *room = *state;
    uint8_t *before = malloc(LIVE_ROOM_SIZE);
    live_room_step(room);
    live_room_picture(room);
    memcpy(before, room->picture, LIVE_ROOM_SIZE);
    nook_live_message(room->live, "shaders",
                      "shaders/render/a_shader_of_some_length.glsl:12: error: there is no function of that name which "
                      "takes a matrix and two vectors");
    for (int i = 0; i < 4; i++)
        live_room_step(room);
    live_room_picture(room);
    assert_true(has_red(room));
    for (size_t y = 0; y < LIVE_ROOM_HEIGHT; y++) { /* nothing of it reaches the edges */
        const size_t row = y * LIVE_ROOM_WIDTH * 3, right = row + (LIVE_ROOM_WIDTH - 6) * 3;
        assert_memory_equal(room->picture + row, before + row, 6 * 3);
        assert_memory_equal(room->picture + right, before + right, 6 * 3);
    }
    free(before);
}

static void test_names_of_narrow_views_take_more_lines_and_stay_in_them(void **state)
{
    live_room *room = *state;
    nook_live_views_set_count(nook_live_state(room->live), 3);
    for (int i = 0; i < 3; i++)
        nook_live_state(room->live)->views[i].mode = NOOK_LIVE_VISIBILITY;
    live_room_step(room);
    nook_live_overlay(room->live);
    double wide = nook_live_names_bottom(room->live, LIVE_ROOM_WIDTH);
    assert_true(wide > 10.0 && wide < 30.0);
    assert_true(nook_live_names_bottom(room->live, 10.0) == 0.0); /* they stand at the right */
    room->input.width = 240;                                      /* of the window: 80 pixels for each view */
    live_room_step(room);
    nook_live_overlay(room->live);
    assert_true(nook_live_names_bottom(room->live, 80.0) > wide + 10.0);
    assert_true(nook_live_names_bottom(room->live, 1.0) == 0.0);
}

static void test_what_a_host_writes_lies_over_borders(void **state)
{
    live_room *room = *state;
    const nook_overlay_colour white = { 255, 255, 255, 255 };
    const double low[2] = { 230.0, 140.0 }, high[2] = { 250.0, 160.0 };
    nook_live_views_set_count(nook_live_state(room->live), 2);
    nook_live_input(room->live, &room->input, true, &room->rest);
    nook_overlay_rectangle(nook_live_overlay(room->live), low, high, white);
    assert_int_equal(nook_live_draw(room->live, &room->camera), NOOK_OK);
    live_room_picture(room);
    const uint8_t *below = room->picture + (170 * LIVE_ROOM_WIDTH + LIVE_ROOM_WIDTH / 2) * 3;
    const uint8_t *on = room->picture + (150 * LIVE_ROOM_WIDTH + LIVE_ROOM_WIDTH / 2) * 3;
    assert_in_range(below[2], 0, 60); /* lit by the mouse */
    assert_int_equal(on[2], 255);
}

static void test_size_of_the_window_may_differ_from_the_picture_s(void **state)
{
    live_room *room = *state;
    uint8_t *large = malloc((size_t)4 * LIVE_ROOM_SIZE);
    room->input.width = 2 * LIVE_ROOM_WIDTH, room->input.height = 2 * LIVE_ROOM_HEIGHT;
    live_room_press(room, NOOK_KEY_F2);
    live_room_step(room);
    assert_int_equal(nook_live_picture(room->live, 2 * LIVE_ROOM_WIDTH, 2 * LIVE_ROOM_HEIGHT, large), NOOK_OK);
    free(large);
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_result result = nook_live_picture(room->live, 0, 5, room->picture);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_RANGE);
}

/* How many pixels of a part are darker than the scene is there. */
static int count_dark(const live_room *room, uint32_t left, uint32_t right)
{
    int dark = 0;
    for (uint32_t y = 60; y < 250; y++) {
        for (uint32_t x = left; x < right; x++)
            dark += room->picture[((size_t)y * LIVE_ROOM_WIDTH + x) * 3] < 60;
    }
    return dark;
}

static void test_times_have_a_panel_of_their_own_only_where_there_is_room(void **state)
{
    live_room *room = *state;
    live_room_step(room);
    live_room_picture(room);
    int before = count_dark(room, 0, 100);
    live_room_press(room, NOOK_KEY_F2);
    live_room_step(room);
    live_room_step(room);
    live_room_picture(room);
    assert_true(count_dark(room, 120, LIVE_ROOM_WIDTH) > 20000);
    assert_true(abs(count_dark(room, 0, 100) - before) < 500);
    room->input.width = 2 * LIVE_ROOM_WIDTH; /* of the window: the picture is shown twice as wide */
    uint8_t *wide = malloc((size_t)2 * LIVE_ROOM_SIZE);
    live_room_step(room);
    live_room_step(room);
    assert_int_equal(nook_live_picture(room->live, 2 * LIVE_ROOM_WIDTH, LIVE_ROOM_HEIGHT, wide), NOOK_OK);
    int dark = 0;
    for (uint32_t y = 60; y < 250; y++) {
        for (uint32_t x = 20; x < 300; x++)
            dark += wide[((size_t)y * 2 * LIVE_ROOM_WIDTH + x) * 3] < 60;
    }
    assert_true(dark > 30000);
    free(wide);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        LIVE_ROOM_TEST(test_slider_of_the_panel_changes_a_parameter_and_undo_takes_it_back),
        LIVE_ROOM_TEST(test_mouse_over_a_panel_is_not_the_host_s),
        LIVE_ROOM_TEST(test_messages_stay_until_they_are_taken_back),
        LIVE_ROOM_TEST(test_long_messages_are_broken_into_lines_that_the_window_holds),
        LIVE_ROOM_TEST(test_names_of_narrow_views_take_more_lines_and_stay_in_them),
        LIVE_ROOM_TEST(test_what_a_host_writes_lies_over_borders),
        LIVE_ROOM_TEST(test_size_of_the_window_may_differ_from_the_picture_s),
        LIVE_ROOM_TEST(test_times_have_a_panel_of_their_own_only_where_there_is_room),
    };
    return cmocka_run_group_tests(tests, live_room_open, live_room_close);
}
