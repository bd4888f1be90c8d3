#include "engine/core/file.h"
#include "game/settings/settings_file.h"
#include "game/techniques.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

enum { PATH_BYTES = 4096 };

static const char *write_text(char path[PATH_BYTES], const void *text, size_t size)
{
    nook_scratch_path(path, PATH_BYTES, "settings.txt");
    assert_int_equal(nook_file_write(path, text, size), NOOK_OK);
    return path;
}

static void must_refuse_bytes(const void *text, size_t size, const char *line, const char *reason)
{
    char path[PATH_BYTES], place[64];
    nook_log_capture log;
    nook_settings_file file, before;
    memset(&file, 7, sizeof file);
    before = file;
    write_text(path, text, size);
    nook_log_capture_begin(&log);
    nook_result result = nook_settings_file_read(path, &file);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_FORMAT);
    assert_int_equal(log.count, 1);
    snprintf(place, sizeof place, "settings.txt:%s", line);
    if (!strstr(log.text, place) || !strstr(log.text, reason))
        fail_msg("expected %s and %s in: %s", place, reason, log.text);
    assert_memory_equal(&file, &before, sizeof file);
}

static void must_refuse(const char *text, const char *line, const char *reason)
{
    must_refuse_bytes(text, strlen(text), line, reason);
}

static void test_a_file_is_read(void **state)
{
    (void)state;
    char path[PATH_BYTES], text[NOOK_SETTING_TEXT_MAX];
    nook_settings_file file;
    const char *lines = "# made by hand\n\n  technique = volume # the best\r\nresolution=128\n\trays = 4\n"
                        "ao.scale = half\nr_max = 0.75\nfalloff = linear";
    assert_int_equal(nook_settings_file_read(write_text(path, lines, strlen(lines)), &file), NOOK_OK);
    assert_string_equal(nook_setting_print(&file.setting, text), "volume rays=4 ao.scale=half resolution=128");
    assert_true(file.r_max == 0.75);
    assert_string_equal(file.falloff, "linear");
}

static void test_r_max_and_falloff_need_not_be_given(void **state)
{
    (void)state;
    char path[PATH_BYTES];
    nook_settings_file file;
    assert_int_equal(nook_settings_file_read(write_text(path, "technique = ssao", 16), &file), NOOK_OK);
    assert_string_equal(file.setting.technique->name, "ssao");
    assert_true(file.r_max == 0.0);
    assert_string_equal(file.falloff, "");
}

static void test_what_is_written_reads_back_the_same(void **state)
{
    (void)state;
    char path[PATH_BYTES], text[NOOK_SETTING_TEXT_MAX], again_text[NOOK_SETTING_TEXT_MAX];
    nook_settings_file file = { .r_max = 1.0 / 3.0, .falloff = "wendland" }, again;
    assert_int_equal(nook_setting_parse("here", "hsao steps=3 bias=0.1 ao.filter=disc", &file.setting), NOOK_OK);
    nook_scratch_path(path, sizeof path, "written.txt");
    assert_int_equal(nook_settings_file_write(path, &file, "two lines\n\nwith = one between"), NOOK_OK);
    assert_int_equal(nook_settings_file_read(path, &again), NOOK_OK);
    assert_string_equal(nook_setting_print(&again.setting, again_text), nook_setting_print(&file.setting, text));
    assert_true(again.r_max == file.r_max);
    assert_string_equal(again.falloff, file.falloff);
}

static void test_volumes_are_baked_unless_a_file_wants_them_live(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        bool live;
    } files[] = { { "technique = volume\n", false },
                  { "technique = volume\nvolumes = baked\n", false },
                  { "technique = volume\nvolumes = live\n", true } };
    char path[PATH_BYTES];
    nook_settings_file file, again;
    for (size_t i = 0; i < NOOK_COUNT(files); i++) {
        write_text(path, files[i].text, strlen(files[i].text));
        assert_int_equal(nook_settings_file_read(path, &file), NOOK_OK);
        assert_true(file.live == files[i].live);
        assert_int_equal(nook_settings_file_write(path, &file, NULL), NOOK_OK);
        assert_int_equal(nook_settings_file_read(path, &again), NOOK_OK);
        assert_true(again.live == files[i].live);
    }
    must_refuse("technique = volume\nvolumes = dead\n", "2", "baked or live");
}

static void test_a_budget_of_volumes_is_read_and_written(void **state)
{
    (void)state;
    static const char text[] = "technique = volume\nvolumes.budget = 12.5\nvolumes.upload = 2\n";
    char path[PATH_BYTES];
    nook_settings_file file, again;
    assert_int_equal(nook_settings_file_read(write_text(path, text, strlen(text)), &file), NOOK_OK);
    assert_true(file.stream.budget == 12.5f && file.stream.upload == 2.0f);
    assert_true(file.stream.hysteresis == nook_stream_params_initial().hysteresis);
    assert_int_equal(nook_settings_file_write(path, &file, NULL), NOOK_OK);
    assert_int_equal(nook_settings_file_read(path, &again), NOOK_OK);
    assert_memory_equal(&again.stream, &file.stream, sizeof file.stream);
    assert_int_equal(nook_settings_file_read(write_text(path, text, 19), &file), NOOK_OK);
    assert_true(file.stream.budget == 0.0f);
}

static void test_a_plan_is_read_and_written(void **state)
{
    (void)state;
    static const char text[] = "technique = volume\nplan = measured\nplan.error = 0.02\nplan.memory = 1.5\n";
    char path[PATH_BYTES];
    nook_settings_file file, again;
    nook_file bytes;
    assert_int_equal(nook_settings_file_read(write_text(path, text, strlen(text)), &file), NOOK_OK);
    assert_int_equal(file.plan.mode, NOOK_PLAN_MEASURED);
    assert_true(file.plan.error == 0.02f && file.plan.memory == 1.5f);
    assert_true(file.plan.level_error == nook_plan_params_initial().level_error);
    assert_int_equal(nook_settings_file_write(path, &file, NULL), NOOK_OK);
    assert_int_equal(nook_file_read(path, &bytes), NOOK_OK);
    assert_int_equal(bytes.size, strlen(text));
    assert_memory_equal(bytes.bytes, text, bytes.size);
    nook_file_free(&bytes);
    assert_int_equal(nook_settings_file_read(path, &again), NOOK_OK);
    assert_memory_equal(&again.plan, &file.plan, sizeof file.plan);
}

static void test_every_technique_as_it_comes_is_one_line(void **state)
{
    (void)state;
    size_t count;
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    for (size_t i = 0; i < count; i++) {
        char path[PATH_BYTES], expected[128];
        nook_settings_file file = { .setting = nook_setting_initial(techniques[i]) };
        nook_file bytes;
        nook_scratch_path(path, sizeof path, "initial.txt");
        assert_int_equal(nook_settings_file_write(path, &file, NULL), NOOK_OK);
        assert_int_equal(nook_file_read(path, &bytes), NOOK_OK);
        snprintf(expected, sizeof expected, "technique = %s\n", techniques[i]->name);
        assert_string_equal((const char *)bytes.bytes, expected);
        nook_file_free(&bytes);
    }
}

static void test_wrong_files_are_refused_with_their_line(void **state)
{
    (void)state;
    must_refuse("", "", "names no technique");
    must_refuse("# nothing\n", "", "names no technique");
    must_refuse("rays = 4\n", "1", "before the technique");
    must_refuse("technique = volum\n", "1", "did you mean volume?");
    must_refuse("technique = volume\nrays = 0\n", "2", "volume.rays");
    must_refuse("technique = volume\n# \nrayz = 4\n", "3", "did you mean rays?");
    must_refuse("technique = volume\nrays\n", "2", "name = value");
    must_refuse("technique = volume\nrays =\n", "2", "name = value");
    must_refuse("technique = volume\n= 4\n", "2", "name = value");
    must_refuse("technique = volume\nrays = 4 8\n", "2", "name = value");
    must_refuse("technique = volume\nrays = 4\nrays = 4\n", "3", "twice");
    must_refuse("technique = volume\ntechnique = ssao\n", "2", "twice");
    must_refuse("technique = volume\nr_max = 0\n", "2", "r_max");
    must_refuse("technique = volume\nr_max = far\n", "2", "not a number");
    must_refuse("technique = volume\nfalloff = soft\n", "2", "choose one of");
    must_refuse("technique = ssao\nresolution = 64\n", "2", "reads no volumes");
    must_refuse("technique = volume\nplan = yes\n", "2", "choose one of");
    must_refuse("technique = volume\nplan.error = 2\n", "2", "plan.error");
    must_refuse("technique = volume\nplan.eror = 0.1\n", "2", "there are plan.mode, plan.error");
}

static void test_what_is_no_text_is_refused(void **state)
{
    (void)state;
    char longest[1000];
    memset(longest, 'x', sizeof longest);
    must_refuse_bytes(longest, sizeof longest, "1", "no settings file");
    must_refuse_bytes("technique = volume\n\0\0\0", 22, "2", "no settings file");
}

static void test_a_comment_may_be_long(void **state)
{
    (void)state;
    char path[PATH_BYTES], text[2000];
    nook_settings_file file;
    memset(text, '-', sizeof text);
    text[0] = '#';
    memcpy(text + sizeof text - 17, "\ntechnique = hsao", 17);
    assert_int_equal(nook_settings_file_read(write_text(path, text, sizeof text), &file), NOOK_OK);
    assert_string_equal(file.setting.technique->name, "hsao");
}

static void test_files_that_are_not_there_are_refused(void **state)
{
    (void)state;
    char path[PATH_BYTES];
    nook_log_capture log;
    nook_settings_file file = { .setting = nook_setting_initial(nook_technique_find("ssao")) };
    nook_scratch_path(path, sizeof path, "no/such/file.txt");
    nook_log_capture_begin(&log);
    nook_result read = nook_settings_file_read(path, &file);
    nook_result written = nook_settings_file_write(path, &file, NULL);
    nook_log_capture_end();
    assert_int_equal(read, NOOK_E_NOT_FOUND);
    assert_int_equal(written, NOOK_E_IO);
    assert_int_equal(log.errors, 2);
    assert_false(nook_file_exists(path));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_file_is_read),
        cmocka_unit_test(test_r_max_and_falloff_need_not_be_given),
        cmocka_unit_test(test_what_is_written_reads_back_the_same),
        cmocka_unit_test(test_volumes_are_baked_unless_a_file_wants_them_live),
        cmocka_unit_test(test_a_budget_of_volumes_is_read_and_written),
        cmocka_unit_test(test_a_plan_is_read_and_written),
        cmocka_unit_test(test_every_technique_as_it_comes_is_one_line),
        cmocka_unit_test(test_wrong_files_are_refused_with_their_line),
        cmocka_unit_test(test_what_is_no_text_is_refused),
        cmocka_unit_test(test_a_comment_may_be_long),
        cmocka_unit_test(test_files_that_are_not_there_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
