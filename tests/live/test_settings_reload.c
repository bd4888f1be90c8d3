/* A settings file that is saved again and again. */
#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "game/live/settings_reload.h"
#include "modules/ao/technique.h"
#include "tests/support/file_tree.h"
#include "tests/support/log_capture.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

typedef struct fixture {
    file_tree tree;
    char path[1024];
    nook_settings_reload *reload;
    nook_log_capture log;
} fixture;

static int setup(void **state)
{
    static fixture self;
    file_tree_begin(&self.tree, "saved");
    file_tree_write(&self.tree, "one.settings", "technique = volume\n");
    file_tree_path(&self.tree, "one.settings", self.path, sizeof self.path);
    nook_log_capture_begin(&self.log);
    *state = &self;
    return nook_settings_reload_create(self.path, &self.reload) == NOOK_OK ? 0 : -1;
}

static int teardown(void **state)
{
    fixture *self = *state;
    nook_settings_reload_destroy(self->reload);
    nook_log_capture_end();
    return 0;
}

static bool poll_until(fixture *self, nook_settings_file *out)
{
    double end = nook_clock_ms() + 5000.0;
    bool read = false;
    while (!(read = nook_settings_reload_poll(self->reload, out)) && !*nook_settings_reload_error(self->reload) &&
           nook_clock_ms() < end)
        nook_clock_rest(2.0);
    return read;
}

static void test_a_file_that_is_saved_is_read_a_wrong_one_is_said_and_a_mended_one_is_read(void **state)
{
    fixture *self = *state;
    nook_settings_file file;
    assert_false(nook_settings_reload_poll(self->reload, &file));
    file_tree_replace(&self->tree, "one.settings", "technique = gtao\n");
    assert_true(poll_until(self, &file));
    assert_string_equal(file.setting.technique->name, "gtao");
    file_tree_write(&self->tree, "one.settings", "technique = gtao\nslice = 3\n");
    assert_false(poll_until(self, &file));
    assert_non_null(strstr(nook_settings_reload_error(self->reload), "one.settings:2"));
    file_tree_write(&self->tree, "one.settings", "technique = gtao\nslices = 3\n");
    nook_clock_rest(100.0); /* what is wrong stands there until then */
    assert_true(nook_settings_reload_poll(self->reload, &file));
    assert_string_equal(nook_settings_reload_error(self->reload), "");
}

static void test_a_file_that_is_asked_for_is_read_in_the_next_poll_and_once(void **state)
{
    fixture *self = *state;
    nook_settings_file file;
    nook_settings_reload_ask(self->reload);
    assert_true(nook_settings_reload_poll(self->reload, &file));
    assert_false(nook_settings_reload_poll(self->reload, &file));
}

static void test_a_thousand_saves_leak_neither_memory_nor_files(void **state)
{
    enum { SAVES = 1000, WARM = 200 };
    fixture *self = *state;
    nook_settings_file file;
    const int open_files = file_tree_open_files();
    long resident = 0;
    for (int i = 0; i < SAVES; i++) {
        char text[64];
        snprintf(text, sizeof text, "technique = volume\nrays = %d\n",
                 i % 7 == 0 ? -1 : 2 + i % 2); /* some are wrong */
        if (i % 3 == 0)
            file_tree_replace(&self->tree, "one.settings", text);
        else
            file_tree_write(&self->tree, "one.settings", text);
        nook_settings_reload_ask(self->reload); /* a file that settles would take 25 s for all */
        assert_int_equal(nook_settings_reload_poll(self->reload, &file), i % 7 != 0);
        if (i == WARM)
            resident = file_tree_resident_kb();
    }
    assert_int_equal(file_tree_open_files(), open_files);
    assert_true(file_tree_resident_kb() - resident < 256);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_a_file_that_is_saved_is_read_a_wrong_one_is_said_and_a_mended_one_is_read),
        TEST(test_a_file_that_is_asked_for_is_read_in_the_next_poll_and_once),
        TEST(test_a_thousand_saves_leak_neither_memory_nor_files),
    };
    return cmocka_run_group_tests_name("settings that are saved", tests, NULL, NULL);
}
