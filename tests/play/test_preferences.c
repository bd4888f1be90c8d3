#include "engine/core/file.h"
#include "game/play/preferences.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h> /* wants those above first */

static const char *scratch(char out[1024])
{
    return nook_scratch_path(out, 1024, "preferences.txt");
}

static void test_what_is_written_is_read_back(void **state)
{
    (void)state;
    char path[1024];
    nook_preferences written, read;
    nook_preferences_reset(&written);
    written.mouse_speed = 0.31f;
    written.invert_y = 1;
    written.picture_scale = 2;
    assert_true(nook_preferences_write(scratch(path), &written));
    nook_preferences_read(path, &read);
    assert_memory_equal(&read, &written, sizeof read);
}

static void test_no_file_gives_the_initial_values_in_silence(void **state)
{
    (void)state;
    nook_log_capture log;
    nook_preferences initial, read;
    nook_preferences_reset(&initial);
    nook_log_capture_begin(&log);
    nook_preferences_read("/nowhere/preferences.txt", &read);
    nook_log_capture_end();
    assert_memory_equal(&read, &initial, sizeof read);
    assert_int_equal(log.count, 0);
}

static void test_a_damaged_file_costs_its_bad_lines_only(void **state)
{
    (void)state;
    char path[1024];
    const char text[] = "mouse_speed = 0.5\nnonsense\nfield_of_view = 9000\nlegs = 3\ninvert_y = yes\n";
    nook_log_capture log;
    nook_preferences initial, read;
    nook_preferences_reset(&initial);
    assert_int_equal(nook_file_write(scratch(path), text, strlen(text)), NOOK_OK);
    nook_log_capture_begin(&log);
    nook_preferences_read(path, &read);
    nook_log_capture_end();
    assert_true(read.mouse_speed == 0.5f && read.invert_y == 1);
    assert_true(read.field_of_view == initial.field_of_view);
    assert_true(log.count >= 3);
}

static void test_what_cannot_be_kept_is_one_warning_and_no_failure(void **state)
{
    (void)state;
    nook_log_capture log;
    nook_preferences preferences;
    nook_preferences_reset(&preferences);
    nook_log_capture_begin(&log);
    assert_false(nook_preferences_write("/nowhere/preferences.txt", &preferences));
    nook_log_capture_end();
    assert_true(log.count == 1 && log.errors == 0);
    assert_non_null(strstr(log.text, "/nowhere/preferences.txt: cannot write: No such file or directory"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_written_is_read_back),
        cmocka_unit_test(test_no_file_gives_the_initial_values_in_silence),
        cmocka_unit_test(test_a_damaged_file_costs_its_bad_lines_only),
        cmocka_unit_test(test_what_cannot_be_kept_is_one_warning_and_no_failure),
    };
    return cmocka_run_group_tests_name("preferences", tests, NULL, NULL);
}
