/* A settings file brought up to date keeps what people have written into it. */
#include "engine/core/file.h"
#include "game/settings/settings_file.h"
#include "game/techniques.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { PATH_BYTES = 4096 };

static void write_text(char path[PATH_BYTES], const char *text)
{
    nook_scratch_path(path, PATH_BYTES, "updated.settings");
    assert_int_equal(nook_file_write(path, text, strlen(text)), NOOK_OK);
}

static void expect_text(const char *path, const char *expected)
{
    nook_file bytes;
    assert_int_equal(nook_file_read(path, &bytes), NOOK_OK);
    assert_string_equal((const char *)bytes.bytes, expected);
    nook_file_free(&bytes);
}

/** Brings `text` up to date with changes "name value name value ... NULL", and it reads back as what it was brought to. */
static void expect_update(const char *text, const char *const *changes, const char *expected)
{
    char path[PATH_BYTES], wanted[NOOK_SETTING_TEXT_MAX], found[NOOK_SETTING_TEXT_MAX];
    nook_settings_file file;
    write_text(path, text);
    assert_int_equal(nook_settings_file_read(path, &file), NOOK_OK);
    for (; *changes; changes += 2)
        assert_int_equal(nook_setting_assign("test", &file.setting, changes[0], changes[1]), NOOK_OK);
    assert_int_equal(nook_settings_file_update(path, &file), NOOK_OK);
    expect_text(path, expected);
    nook_setting_print(&file.setting, wanted);
    assert_int_equal(nook_settings_file_read(path, &file), NOOK_OK);
    assert_string_equal(nook_setting_print(&file.setting, found), wanted);
}

static const char house[] =
    "\xef\xbb\xbf# the house\r\n\r\n  technique=volume   # the best\r\n"
    "rays   =  4 # four; rays = 5\n# ao.scale = full\nao.scale\t= half\n\nsteps = 96 # as it comes\n"
    "r_max = 0.750\nfalloff = linear\nvolumes.budget = 4";

static void test_nothing_changes_where_nothing_has_changed(void **state)
{
    (void)state;
    expect_update(house, (const char *[]){ NULL }, house);
}

static void test_only_the_values_that_have_changed_are_written(void **state)
{
    (void)state;
    expect_update(house, (const char *[]){ "rays", "16", "steps", "128", NULL },
                  "\xef\xbb\xbf# the house\r\n\r\n  technique=volume   # the best\r\n"
                  "rays   =  16 # four; rays = 5\n# ao.scale = full\nao.scale\t= half\n\nsteps = 128 # as it comes\n"
                  "r_max = 0.750\nfalloff = linear\nvolumes.budget = 4");
}

static void test_what_is_new_is_added_and_what_is_as_it_comes_again_is_taken_out(void **state)
{
    (void)state;
    expect_update(house, (const char *[]){ "ao.scale", "full", "ao.reuse", "4", "resolution", "64", NULL },
                  "\xef\xbb\xbf# the house\r\n\r\n  technique=volume   # the best\r\n"
                  "rays   =  4 # four; rays = 5\n# ao.scale = full\n\nsteps = 96 # as it comes\n"
                  "r_max = 0.750\nfalloff = linear\nvolumes.budget = 4\nresolution = 64\nao.reuse = 4\n");
}

static void test_another_technique_takes_its_own_parameters_with_it(void **state)
{
    (void)state;
    char path[PATH_BYTES];
    nook_settings_file file;
    write_text(path, "# one\ntechnique = volume\nrays = 4\nsteps = 96\nao.scale = half # of all\nresolution = 64\n");
    assert_int_equal(nook_settings_file_read(path, &file), NOOK_OK);
    file.setting = nook_setting_initial(nook_technique_find("gtao"));
    assert_int_equal(nook_setting_assign("test", &file.setting, "slices", "3"), NOOK_OK);
    assert_int_equal(nook_setting_assign("test", &file.setting, "ao.scale", "half"), NOOK_OK);
    assert_int_equal(nook_settings_file_update(path, &file), NOOK_OK);
    assert_int_equal(nook_settings_file_read(path, &file), NOOK_OK);
    assert_string_equal(file.setting.technique->name, "gtao");
    nook_file bytes;
    assert_int_equal(nook_file_read(path, &bytes), NOOK_OK);
    assert_non_null(strstr((const char *)bytes.bytes, "# one\ntechnique = gtao\nao.scale = half # of all\n"));
    assert_null(strstr((const char *)bytes.bytes, "rays"));
    assert_null(strstr((const char *)bytes.bytes, "steps = 96"));
    assert_null(strstr((const char *)bytes.bytes, "resolution"));
    nook_file_free(&bytes);
}

static void test_a_file_that_is_not_there_is_written(void **state)
{
    (void)state;
    char path[PATH_BYTES];
    nook_settings_file file = { .setting = nook_setting_initial(nook_technique_find("ssao")) };
    nook_scratch_path(path, sizeof path, "new.settings");
    unlink(path);
    assert_int_equal(nook_settings_file_update(path, &file), NOOK_OK);
    expect_text(path, "technique = ssao\n");
}

static void test_a_file_that_cannot_be_read_is_not_written_over(void **state)
{
    (void)state;
    char path[PATH_BYTES];
    nook_log_capture log;
    nook_settings_file file = { .setting = nook_setting_initial(nook_technique_find("ssao")) };
    write_text(path, "technique = volume\nrayz = 4 # half way through\n");
    nook_log_capture_begin(&log);
    nook_result result = nook_settings_file_update(path, &file);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_FORMAT);
    assert_non_null(strstr(log.text, "updated.settings:2"));
    assert_int_equal(log.count, 1);
    expect_text(path, "technique = volume\nrayz = 4 # half way through\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_changes_where_nothing_has_changed),
        cmocka_unit_test(test_only_the_values_that_have_changed_are_written),
        cmocka_unit_test(test_what_is_new_is_added_and_what_is_as_it_comes_again_is_taken_out),
        cmocka_unit_test(test_another_technique_takes_its_own_parameters_with_it),
        cmocka_unit_test(test_a_file_that_is_not_there_is_written),
        cmocka_unit_test(test_a_file_that_cannot_be_read_is_not_written_over),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
