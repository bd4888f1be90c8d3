/* Pictures that a key takes, and frames that are captured. */
#include "engine/core/file.h"
#include "game/live/live_internal.h"
#include "game/settings/settings_file.h"
#include "tests/support/live_room.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <setjmp.h>
#include <stb/stb_image.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void test_key_writes_a_picture_and_what_made_it(void **state)
{
    live_room *room = *state;
    char png[4200], text[4200];
    nook_settings_file file;
    nook_live_views_set_count(nook_live_state(room->live), 2);
    live_room_set(room, 0, "volume rays=5 ao.scale=half");
    live_room_set(room, 1, "ssao samples=7");
    for (int i = 1; i <= 2; i++) {
        live_room_press(room, NOOK_KEY_F12);
        live_room_picture(room);
        snprintf(png, sizeof png, "%s/nook_%04d.png", room->pictures, i);
        snprintf(text, sizeof text, "%s/nook_%04d.settings", room->pictures, i);
        int width = 0, height = 0, channels = 0;
        uint8_t *pixels = stbi_load(png, &width, &height, &channels, 3);
        assert_true(pixels && width == LIVE_ROOM_WIDTH && height == LIVE_ROOM_HEIGHT);
        if (i == 1)
            assert_memory_equal(pixels, room->picture, LIVE_ROOM_SIZE); /* later there is a note in it */
        stbi_image_free(pixels);
    }
    assert_int_equal(nook_settings_file_read(text, &file), NOOK_OK);
    char setting[NOOK_SETTING_TEXT_MAX];
    assert_string_equal(nook_setting_print(&file.setting, setting), "volume rays=5 ao.scale=half");
    assert_true(file.r_max == nook_live_state(room->live)->r_max);
    nook_file whole;
    assert_int_equal(nook_file_read(text, &whole), NOOK_OK);
    assert_non_null(strstr((char *)whole.bytes, "ssao samples=7"));
    assert_non_null(strstr((char *)whole.bytes, "--camera "));
    assert_non_null(strstr((char *)whole.bytes, "level of the test"));
    nook_file_free(&whole);
}

static void test_picture_that_cannot_be_written_is_said_and_the_frames_go_on(void **state)
{
    live_room *room = *state;
    nook_log_capture log;
    snprintf(room->live->pictures, sizeof room->live->pictures, "/proc/no such folder");
    nook_log_capture_begin(&log);
    live_room_press(room, NOOK_KEY_F12);
    nook_log_capture_end();
    assert_int_equal(log.count, 1);
    assert_non_null(strstr(room->live->note, "could not be written"));
    live_room_step(room);
}

static void test_captured_frames_are_what_is_seen(void **state)
{
    live_room *room = *state;
    char folder[4096], png[4200];
    nook_scratch_path(folder, sizeof folder, "captured");
    live_room_step(room);
    assert_int_equal(nook_live_capture(room->live, &(nook_capture_desc){ .path = folder }), NOOK_OK);
    live_room_step(room);
    live_room_press(room, NOOK_KEY_2);
    live_room_picture(room);
    assert_int_equal(nook_live_capture_end(room->live), NOOK_OK);
    live_room_step(room);
    int width = 0, height = 0, channels = 0;
    snprintf(png, sizeof png, "%s/frame_000002.png", folder);
    uint8_t *pixels = stbi_load(png, &width, &height, &channels, 3);
    assert_non_null(pixels);
    assert_memory_equal(pixels, room->picture, LIVE_ROOM_SIZE);
    stbi_image_free(pixels);
    snprintf(png, sizeof png, "%s/frame_000003.png", folder);
    assert_false(nook_file_exists(png));
}

static void test_capture_that_fails_is_said_once_and_tells_so_at_its_end(void **state)
{
    live_room *room = *state;
    char folder[4096], taken[4200];
    nook_log_capture log;
    nook_scratch_path(folder, sizeof folder, "capture_fails");
    snprintf(taken, sizeof taken, "%s/frame_000002.png", folder);
    assert_int_equal(nook_directory_make(taken), NOOK_OK); /* where the second picture should go */
    assert_int_equal(nook_live_capture(room->live, &(nook_capture_desc){ .path = folder }), NOOK_OK);
    nook_log_capture_begin(&log);
    live_room_press(room, NOOK_KEY_2);
    assert_false(nook_live_capture_failed(room->live));
    live_room_press(room, NOOK_KEY_1);
    assert_true(nook_live_capture_failed(room->live));
    live_room_press(room, NOOK_KEY_2); /* frames go on */
    nook_log_capture_end();
    assert_int_equal(log.count, 1);
    assert_non_null(strstr(log.text, "frame_000002.png"));
    assert_int_equal(nook_live_capture_end(room->live), NOOK_E_IO);
    assert_int_equal(nook_live_capture_end(room->live), NOOK_OK); /* of none */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        LIVE_ROOM_TEST(test_key_writes_a_picture_and_what_made_it),
        LIVE_ROOM_TEST(test_picture_that_cannot_be_written_is_said_and_the_frames_go_on),
        LIVE_ROOM_TEST(test_captured_frames_are_what_is_seen),
        LIVE_ROOM_TEST(test_capture_that_fails_is_said_once_and_tells_so_at_its_end),
    };
    return cmocka_run_group_tests(tests, live_room_open, live_room_close);
}
