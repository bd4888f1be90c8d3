/* Settings of views: remembered, saved, and no longer readable. */
#include "game/live/live_internal.h"
#include "game/settings/settings_file.h"
#include "tests/support/live_room.h"
#include "tests/support/log_capture.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void test_technique_that_is_chosen_again_has_the_parameters_it_had(void **state)
{
    live_room *room = *state;
    live_room_set(room, 0, "volume rays=3");
    live_room_press(room, NOOK_KEY_2);
    live_room_set(room, 0, "ssao samples=9");
    live_room_press(room, NOOK_KEY_1);
    assert_string_equal(nook_live_state(room->live)->views[0].setting, "volume rays=3");
    live_room_press(room, NOOK_KEY_2);
    assert_string_equal(nook_live_state(room->live)->views[0].setting, "ssao samples=9");
}

static void test_setting_that_cannot_be_read_any_more_becomes_its_technique(void **state)
{
    live_room *room = *state;
    nook_log_capture log;
    live_room_set(room, 0, "ssao gone=3");
    nook_log_capture_begin(&log);
    live_room_step(room);
    nook_log_capture_end();
    assert_string_equal(nook_live_state(room->live)->views[0].setting, "ssao");
    live_room_set(room, 0, "splendid");
    nook_log_capture_begin(&log);
    live_room_step(room);
    nook_log_capture_end();
    assert_string_equal(nook_live_state(room->live)->views[0].setting, "volume");
    nook_log_capture_begin(&log);
    live_room_step(room);
    nook_log_capture_end();
    assert_int_equal(log.count, 0); /* said once */
}

static void test_volumes_are_multiplied_while_any_view_of_them_does(void **state)
{
    live_room *room = *state;
    nook_live_views_set_count(nook_live_state(room->live), 2);
    live_room_set(room, 0, "volume");
    live_room_set(room, 1, "gtao");
    assert_false(nook_live_multiplies(room->live));
    live_room_set(room, 1, "volume combine=multiply");
    assert_true(nook_live_multiplies(room->live));
    live_room_set(room, 0, "ssao");
    live_room_set(room, 1, "gtao");
    assert_true(nook_live_multiplies(room->live)); /* nobody marches them: as it was */
    live_room_set(room, 0, "volume");
    assert_false(nook_live_multiplies(room->live));
}

static void test_saved_settings_read_back(void **state)
{
    live_room *room = *state;
    nook_settings_file file;
    live_room_set(room, 0, "gtao slices=3 ao.scale=quarter");
    nook_live_state(room->live)->falloff = 2.0;
    live_room_step(room);
    room->stage.live_scene = true; /* as if it had been filled so */
    assert_int_equal(live_save(room->live), NOOK_OK);
    room->stage.live_scene = false;
    assert_int_equal(nook_settings_file_read(room->settings, &file), NOOK_OK);
    assert_true(file.live);
    char setting[NOOK_SETTING_TEXT_MAX];
    assert_string_equal(nook_setting_print(&file.setting, setting), "gtao slices=3 ao.scale=quarter");
    assert_string_equal(file.falloff, "quadratic");
    assert_non_null(strstr(room->live->note, room->settings));
    snprintf(room->live->settings_path, sizeof room->live->settings_path, "/proc/no such folder/x");
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_result result = live_save(room->live);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        LIVE_ROOM_TEST(test_technique_that_is_chosen_again_has_the_parameters_it_had),
        LIVE_ROOM_TEST(test_setting_that_cannot_be_read_any_more_becomes_its_technique),
        LIVE_ROOM_TEST(test_volumes_are_multiplied_while_any_view_of_them_does),
        LIVE_ROOM_TEST(test_saved_settings_read_back),
    };
    return cmocka_run_group_tests(tests, live_room_open, live_room_close);
}
