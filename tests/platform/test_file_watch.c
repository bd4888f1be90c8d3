#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "engine/platform/file_watch.h"
#include "tests/support/file_tree.h"
#include "tests/support/log_capture.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h> /* wants those above first */

enum { TOLD_CAPACITY = 65536 };

typedef struct fixture {
    file_tree tree;
    nook_file_watch *watch;
    nook_log_capture log;
    char told[TOLD_CAPACITY]; /* paths since the last look, each with a space behind it */
} fixture;

static const char *const watched_folders[] = { "shaders", "modules" };

static void keep_path(void *user, const char *path)
{
    fixture *self = user;
    size_t used = strlen(self->told);
    snprintf(self->told + used, sizeof self->told - used, "%s ", path);
}

static void rest(long milliseconds)
{
    const struct timespec pause = { 0, milliseconds * 1000 * 1000 };
    nanosleep(&pause, NULL);
}

/* Polls until changes are told, or `ms` have passed without any. @return how many were told */
static size_t look(fixture *self, double ms)
{
    double end = nook_clock_ms() + ms;
    size_t count;
    self->told[0] = '\0';
    while ((count = nook_file_watch_poll(self->watch, keep_path, self)) == 0 && nook_clock_ms() < end)
        rest(2);
    return count;
}

static void assert_told(fixture *self, const char *expected)
{
    look(self, 5000);
    assert_string_equal(self->told, expected);
}

static void assert_silence(fixture *self)
{
    look(self, 3 * NOOK_FILE_WATCH_SETTLE_MS);
    assert_string_equal(self->told, "");
}

static int setup(void **state)
{
    fixture *self = calloc(1, sizeof *self);
    if (!self)
        return -1;
    *state = self;
    file_tree_begin(&self->tree, "watched");
    file_tree_write(&self->tree, "shaders/a.glsl", "a");
    file_tree_write(&self->tree, "shaders/inner/b.glsl", "b");
    file_tree_write(&self->tree, "modules/ao/params.def", "c");
    file_tree_write(&self->tree, "elsewhere/d.txt", "d");
    nook_log_capture_begin(&self->log);
    const nook_file_watch_desc desc = { .root = self->tree.root, .folders = watched_folders, .folder_count = 2 };
    return nook_file_watch_create(&desc, &self->watch) == NOOK_OK ? 0 : -1;
}

static int teardown(void **state)
{
    fixture *self = *state;
    nook_file_watch_destroy(self->watch);
    nook_log_capture_end();
    free(self);
    return 0;
}

static void move(const file_tree *tree, const char *from, const char *to)
{
    char old_path[1024], new_path[1024];
    file_tree_path(tree, from, old_path, sizeof old_path);
    file_tree_path(tree, to, new_path, sizeof new_path);
    assert_int_equal(rename(old_path, new_path), 0);
}

static void test_nothing_is_told_when_nothing_changes(void **state)
{
    assert_silence(*state);
    assert_true(nook_file_watch_changed_ms(((fixture *)*state)->watch) == 0.0);
}

static void test_file_written_in_place_is_told_once(void **state)
{
    fixture *self = *state;
    double before = nook_clock_ms();
    file_tree_write(&self->tree, "shaders/a.glsl", "first");
    file_tree_write(&self->tree, "shaders/a.glsl", "second");
    assert_told(self, "shaders/a.glsl ");
    assert_true(nook_file_watch_changed_ms(self->watch) >= before - 20.0); /* file systems keep time in ticks */
    assert_true(nook_clock_ms() - nook_file_watch_changed_ms(self->watch) >= NOOK_FILE_WATCH_SETTLE_MS);
    assert_silence(self);
}

static void test_change_that_was_made_long_ago_is_told_at_once(void **state)
{
    fixture *self = *state;
    file_tree_write(&self->tree, "shaders/a.glsl", "x");
    rest(3 * NOOK_FILE_WATCH_SETTLE_MS); /* a long frame */
    self->told[0] = '\0';
    assert_int_equal(nook_file_watch_poll(self->watch, keep_path, self), 1);
    assert_string_equal(self->told, "shaders/a.glsl ");
}

static void test_how_long_a_change_is_held_back_is_known(void **state)
{
    fixture *self = *state;
    assert_true(nook_file_watch_settling_ms(self->watch) == 0.0);
    self->told[0] = '\0';
    size_t told = 0;
    double left = 0.0;
    for (int i = 0; i < 100 && told == 0 && left <= 0.0; i++) { /* a machine that sleeps in between tells it at once */
        file_tree_write(&self->tree, "shaders/a.glsl", "x");
        told = nook_file_watch_poll(self->watch, keep_path, self);
        left = nook_file_watch_settling_ms(self->watch);
        assert_true(left <= NOOK_FILE_WATCH_SETTLE_MS);
        assert_int_equal(told > 0, left <= 0.0);
    }
    nook_clock_rest(left);
    if (told == 0)
        assert_int_equal(nook_file_watch_poll(self->watch, keep_path, self), 1);
    assert_string_equal(self->told, "shaders/a.glsl ");
    assert_true(nook_file_watch_settling_ms(self->watch) == 0.0);
}

static void test_file_renamed_over_is_told_every_time(void **state)
{
    fixture *self = *state;
    for (int i = 0; i < 3; i++) {
        file_tree_replace(&self->tree, "shaders/inner/b.glsl", "new");
        assert_told(self, "shaders/inner/b.glsl shaders/inner/b.glsl.new ");
    }
}

static void test_file_that_comes_and_goes_is_told(void **state)
{
    fixture *self = *state;
    file_tree_write(&self->tree, "modules/ao/new.def", "new");
    assert_told(self, "modules/ao/new.def ");
    file_tree_remove(&self->tree, "modules/ao/new.def");
    assert_told(self, "modules/ao/new.def ");
}

static void test_files_saved_together_are_told_together_and_sorted(void **state)
{
    fixture *self = *state;
    file_tree_write(&self->tree, "shaders/inner/b.glsl", "x");
    file_tree_write(&self->tree, "modules/ao/params.def", "x");
    file_tree_write(&self->tree, "shaders/a.glsl", "x");
    file_tree_write(&self->tree, "shaders/inner/b.glsl", "y");
    assert_told(self, "modules/ao/params.def shaders/a.glsl shaders/inner/b.glsl ");
}

static void test_folder_that_is_not_of_the_description_is_not_watched(void **state)
{
    fixture *self = *state;
    file_tree_write(&self->tree, "elsewhere/d.txt", "x");
    file_tree_write(&self->tree, "beside.txt", "x");
    assert_silence(self);
}

static void test_folder_made_later_is_watched_with_what_it_holds(void **state)
{
    fixture *self = *state;
    file_tree_write(&self->tree, "shaders/later/deep/e.glsl", "e");
    assert_told(self, "shaders/later/deep/e.glsl ");
    file_tree_write(&self->tree, "shaders/later/deep/e.glsl", "x");
    assert_told(self, "shaders/later/deep/e.glsl ");
    assert_int_equal(nook_file_watch_folder_count(self->watch), 6);
}

static void test_folder_moved_in_is_told_with_its_files_and_moved_out_itself(void **state)
{
    fixture *self = *state;
    move(&self->tree, "elsewhere", "shaders/moved");
    assert_told(self, "shaders/moved/d.txt ");
    move(&self->tree, "shaders/moved", "elsewhere");
    assert_told(self, "shaders/moved ");
    file_tree_write(&self->tree, "elsewhere/d.txt", "x");
    assert_silence(self);
    assert_int_equal(nook_file_watch_folder_count(self->watch), 4);
}

static void test_folder_renamed_is_told_under_both_names(void **state)
{
    fixture *self = *state;
    move(&self->tree, "shaders/inner", "shaders/outer");
    assert_told(self, "shaders/inner shaders/outer/b.glsl ");
    file_tree_write(&self->tree, "shaders/outer/b.glsl", "x");
    assert_told(self, "shaders/outer/b.glsl ");
}

static void test_folder_deleted_is_told_and_watched_again_when_it_is_back(void **state)
{
    fixture *self = *state;
    file_tree_remove(&self->tree, "shaders/inner");
    assert_told(self, "shaders/inner shaders/inner/b.glsl ");
    file_tree_write(&self->tree, "shaders/inner/b.glsl", "x");
    assert_told(self, "shaders/inner/b.glsl ");
    file_tree_write(&self->tree, "shaders/inner/b.glsl", "y");
    assert_told(self, "shaders/inner/b.glsl ");
}

static void test_folder_of_the_description_may_go_and_come_back(void **state)
{
    fixture *self = *state;
    file_tree_remove(&self->tree, "modules");
    look(self, 5000);
    assert_non_null(strstr(self->told, "modules "));
    file_tree_write(&self->tree, "modules/ao/params.def", "x");
    assert_told(self, "modules/ao/params.def ");
    file_tree_write(&self->tree, "modules/ao/params.def", "y");
    assert_told(self, "modules/ao/params.def ");
    assert_int_equal(self->log.count, 0);
}

static void test_folder_made_anew_at_once_is_watched(void **state)
{
    fixture *self = *state;
    for (int i = 0; i < 2; i++) {
        file_tree_remove(&self->tree, "shaders/inner");
        file_tree_write(&self->tree, "shaders/inner/b.glsl", "x");
        look(self, 5000);
        assert_non_null(strstr(self->told, "shaders/inner/b.glsl "));
        file_tree_write(&self->tree, "shaders/inner/b.glsl", "y");
        assert_told(self, "shaders/inner/b.glsl ");
        file_tree_remove(&self->tree, "modules");
        file_tree_write(&self->tree, "modules/ao/params.def", "x");
        look(self, 5000);
        assert_non_null(strstr(self->told, "modules/ao/params.def "));
        file_tree_write(&self->tree, "modules/ao/params.def", "y");
        assert_told(self, "modules/ao/params.def ");
    }
}

static void test_folder_touched_or_given_other_rights_is_no_change(void **state)
{
    fixture *self = *state;
    char path[1024];
    assert_int_equal(chmod(file_tree_path(&self->tree, "shaders/inner", path, sizeof path), 0700), 0);
    assert_int_equal(chmod(file_tree_path(&self->tree, "shaders", path, sizeof path), 0700), 0);
    assert_silence(self);
}

static void test_file_named_as_its_folder_is_a_file(void **state)
{
    fixture *self = *state;
    file_tree_write(&self->tree, "shaders/inner/inner", "x");
    assert_told(self, "shaders/inner/inner ");
    file_tree_remove(&self->tree, "shaders/inner/inner");
    assert_told(self, "shaders/inner/inner ");
}

static void test_hidden_folders_and_links_to_folders_are_left_out(void **state)
{
    fixture *self = *state;
    char path[1024];
    file_tree_write(&self->tree, "shaders/.git/index", "x");
    assert_int_equal(symlink("../elsewhere", file_tree_path(&self->tree, "shaders/link", path, sizeof path)), 0);
    assert_told(self, "shaders/link "); /* the link is new; what it leads to is not looked at */
    file_tree_write(&self->tree, "shaders/.git/index", "y");
    file_tree_write(&self->tree, "elsewhere/d.txt", "y");
    assert_silence(self);
}

static void test_flat_watch_sees_its_folder_only(void **state)
{
    fixture *self = *state;
    nook_file_watch_destroy(self->watch);
    const nook_file_watch_desc desc = { .root = self->tree.root, .flat = true };
    assert_int_equal(nook_file_watch_create(&desc, &self->watch), NOOK_OK);
    assert_int_equal(nook_file_watch_folder_count(self->watch), 1);
    file_tree_write(&self->tree, "shaders/a.glsl", "x");
    file_tree_write(&self->tree, "new/a.glsl", "x");
    file_tree_write(&self->tree, "beside.txt", "x");
    assert_told(self, "beside.txt ");
}

static void test_changes_without_end_are_told_all_the_same(void **state)
{
    fixture *self = *state;
    double start = nook_clock_ms();
    size_t count = 0;
    self->told[0] = '\0';
    while (count == 0 && nook_clock_ms() - start < 5000) {
        file_tree_write(&self->tree, "shaders/a.glsl", "x");
        count = nook_file_watch_poll(self->watch, keep_path, self);
        rest(5);
    }
    assert_string_equal(self->told, "shaders/a.glsl ");
    assert_true(nook_clock_ms() - start >= NOOK_FILE_WATCH_LONGEST_MS);
}

static void test_a_thousand_changes_leak_neither_files_nor_memory(void **state)
{
    fixture *self = *state;
    int open_files = file_tree_open_files();
    long resident = 0;
    for (int i = 0; i < 1000; i++) {
        file_tree_replace(&self->tree, "shaders/a.glsl", "x");
        if (i % 4 == 0) /* each of these takes the kernel milliseconds */
            file_tree_write(&self->tree, "shaders/sub/f.glsl", "x");
        nook_file_watch_poll(self->watch, keep_path, self);
        if (i % 4 == 0)
            file_tree_remove(&self->tree, "shaders/sub");
        nook_file_watch_poll(self->watch, keep_path, self);
        if (i == 200)
            resident = file_tree_resident_kb();
    }
    look(self, 5000);
    assert_int_equal(file_tree_open_files(), open_files);
    assert_int_equal(nook_file_watch_folder_count(self->watch), 4);
    assert_true(file_tree_resident_kb() - resident < 1024);
    file_tree_write(&self->tree, "shaders/inner/b.glsl", "x");
    look(self, 5000);
    assert_non_null(strstr(self->told, "shaders/inner/b.glsl "));
}

static void test_watches_made_and_destroyed_leave_no_open_file(void **state)
{
    fixture *self = *state;
    const nook_file_watch_desc desc = { .root = self->tree.root };
    int open_files = file_tree_open_files();
    for (int i = 0; i < 100; i++) {
        nook_file_watch *watch = NULL;
        assert_int_equal(nook_file_watch_create(&desc, &watch), NOOK_OK);
        nook_file_watch_destroy(watch);
    }
    assert_int_equal(file_tree_open_files(), open_files);
}

static void test_missing_folder_is_refused(void **state)
{
    fixture *self = *state;
    static const char *const folders[] = { "shaders", "nothing" };
    nook_file_watch *watch = self->watch;
    const nook_file_watch_desc desc = { .root = self->tree.root, .folders = folders, .folder_count = 2 };
    int open_files = file_tree_open_files();
    assert_int_equal(nook_file_watch_create(&desc, &watch), NOOK_E_NOT_FOUND);
    assert_null(watch);
    assert_non_null(strstr(self->log.text, "watched/nothing: no such folder to watch"));
    assert_int_equal(self->log.count, 1);
    assert_int_equal(file_tree_open_files(), open_files);
}

static void test_file_in_place_of_a_folder_is_refused(void **state)
{
    fixture *self = *state;
    static const char *const folders[] = { "shaders/a.glsl" };
    nook_file_watch *watch = NULL;
    const nook_file_watch_desc desc = { .root = self->tree.root, .folders = folders, .folder_count = 1 };
    assert_int_equal(nook_file_watch_create(&desc, &watch), NOOK_E_NOT_FOUND);
    assert_non_null(strstr(self->log.text, "a.glsl: no such folder to watch"));
}

static void test_limit_of_open_files_is_named(void **state)
{
    fixture *self = *state;
    struct rlimit limit, none;
    nook_file_watch *watch = NULL;
    const nook_file_watch_desc desc = { .root = self->tree.root };
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &limit), 0);
    none = limit;
    none.rlim_cur = 3;
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &none), 0);
    nook_result result = nook_file_watch_create(&desc, &watch);
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &limit), 0);
    assert_int_equal(result, NOOK_E_MEMORY);
    assert_null(watch);
    assert_non_null(strstr(self->log.text, "ulimit -n"));
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_nothing_is_told_when_nothing_changes),
        TEST(test_file_written_in_place_is_told_once),
        TEST(test_change_that_was_made_long_ago_is_told_at_once),
        TEST(test_how_long_a_change_is_held_back_is_known),
        TEST(test_file_renamed_over_is_told_every_time),
        TEST(test_file_that_comes_and_goes_is_told),
        TEST(test_files_saved_together_are_told_together_and_sorted),
        TEST(test_folder_that_is_not_of_the_description_is_not_watched),
        TEST(test_folder_made_later_is_watched_with_what_it_holds),
        TEST(test_folder_moved_in_is_told_with_its_files_and_moved_out_itself),
        TEST(test_folder_renamed_is_told_under_both_names),
        TEST(test_folder_deleted_is_told_and_watched_again_when_it_is_back),
        TEST(test_folder_of_the_description_may_go_and_come_back),
        TEST(test_folder_made_anew_at_once_is_watched),
        TEST(test_folder_touched_or_given_other_rights_is_no_change),
        TEST(test_file_named_as_its_folder_is_a_file),
        TEST(test_hidden_folders_and_links_to_folders_are_left_out),
        TEST(test_flat_watch_sees_its_folder_only),
        TEST(test_changes_without_end_are_told_all_the_same),
        TEST(test_a_thousand_changes_leak_neither_files_nor_memory),
        TEST(test_watches_made_and_destroyed_leave_no_open_file),
        TEST(test_missing_folder_is_refused),
        TEST(test_file_in_place_of_a_folder_is_refused),
        TEST(test_limit_of_open_files_is_named),
    };
    return cmocka_run_group_tests_name("file watch", tests, NULL, NULL);
}
