#include "engine/core/file.h"
#include "game/compare/output.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

/* A folder of the scratch folder, made. */
static const char *make_folder(const char *name)
{
    static char path[512];
    nook_scratch_path(path, sizeof path, name);
    assert_int_equal(nook_output_prepare(path), NOOK_OK);
    return path;
}

static void write_text(const char *path, const char *text)
{
    assert_int_equal(nook_file_write(path, text, strlen(text)), NOOK_OK);
}

static void stage(const nook_output *output, const char *name, const char *text)
{
    char path[NOOK_OUTPUT_PATH_MAX];
    write_text(nook_output_path(output, name, path), text);
}

static bool holds(const char *folder, const char *name, const char *text)
{
    char path[NOOK_OUTPUT_PATH_MAX];
    nook_file file;
    nook_path_join(path, sizeof path, folder, name);
    if (!nook_file_exists(path) || nook_file_read(path, &file) != NOOK_OK)
        return false;
    bool same = strcmp((const char *)file.bytes, text) == 0;
    nook_file_free(&file);
    return same;
}

static bool is_png(void *user, const char *name)
{
    (void)user;
    return strcmp(nook_path_extension(name), ".png") == 0;
}

static void test_files_appear_at_the_commit_only(void **state)
{
    (void)state;
    const char *folder = make_folder("appear");
    nook_output output;
    assert_int_equal(nook_output_open(folder, &output), NOOK_OK);
    char staging[NOOK_OUTPUT_PATH_MAX];
    snprintf(staging, sizeof staging, "%s", output.staging);
    stage(&output, "a.png", "a");
    stage(&output, "index", "i");
    assert_false(holds(folder, "a.png", "a"));
    assert_int_equal(nook_output_commit(&output, "index", NULL, NULL), NOOK_OK);
    assert_true(holds(folder, "a.png", "a"));
    assert_true(holds(folder, "index", "i"));
    assert_false(nook_directory_exists(staging));
}

static void test_discard_leaves_the_folder_as_it_was(void **state)
{
    (void)state;
    const char *folder = make_folder("discard");
    nook_output output;
    assert_int_equal(nook_output_open(folder, &output), NOOK_OK);
    char staging[NOOK_OUTPUT_PATH_MAX];
    snprintf(staging, sizeof staging, "%s", output.staging);
    stage(&output, "a.png", "a");
    nook_output_discard(&output);
    assert_false(holds(folder, "a.png", "a"));
    assert_false(nook_directory_exists(staging));
}

static void commit(const char *folder, const char *name, const char *text)
{
    nook_output output;
    assert_int_equal(nook_output_open(folder, &output), NOOK_OK);
    stage(&output, name, text);
    stage(&output, "index", text);
    assert_int_equal(nook_output_commit(&output, "index", is_png, NULL), NOOK_OK);
}

static void test_files_of_the_run_before_are_removed_and_others_are_not(void **state)
{
    (void)state;
    const char *folder = make_folder("again");
    char other[512];
    write_text(nook_path_join(other, sizeof other, folder, "other.png"), "theirs");
    commit(folder, "a.png", "first");
    assert_true(holds(folder, "other.png", "theirs")); /* no index: no run of ours was here */
    write_text(nook_path_join(other, sizeof other, folder, "other.txt"), "theirs");
    commit(folder, "b.png", "second");
    assert_false(holds(folder, "a.png", "first"));
    assert_true(holds(folder, "b.png", "second"));
    assert_true(holds(folder, "index", "second"));
    assert_true(holds(folder, "other.txt", "theirs"));
}

static void test_directory_in_the_way_changes_nothing(void **state)
{
    (void)state;
    const char *folder = make_folder("in_the_way");
    commit(folder, "a.png", "first");
    char directory[512];
    assert_int_equal(mkdir(nook_path_join(directory, sizeof directory, folder, "b.png"), 0700), 0);
    nook_output output;
    assert_int_equal(nook_output_open(folder, &output), NOOK_OK);
    stage(&output, "a.png", "second");
    stage(&output, "b.png", "second");
    stage(&output, "index", "second");
    nook_log_capture said;
    nook_log_capture_begin(&said);
    nook_result result = nook_output_commit(&output, "index", is_png, NULL);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_IO);
    assert_int_equal(said.errors, 1);
    assert_non_null(strstr(said.text, "b.png"));
    assert_true(holds(folder, "a.png", "first"));
    assert_true(holds(folder, "index", "first"));
    rmdir(directory);
}

/* A process that is told to end while it writes. @return its status */
static int run_interrupted(const char *folder)
{
    pid_t child = fork();
    if (child == 0) {
        nook_output output;
        if (nook_output_open(folder, &output) != NOOK_OK)
            _exit(1);
        bool before = nook_output_interrupted();
        char path[NOOK_OUTPUT_PATH_MAX];
        if (nook_file_write(nook_output_path(&output, "a.png", path), "a", 1) != NOOK_OK)
            _exit(2);
        raise(SIGINT);
        if (before || !nook_output_interrupted())
            _exit(3);
        nook_output_discard(&output);
        _exit(4); /* the signal should have ended it */
    }
    int status = 0;
    assert_true(child > 0);
    assert_int_equal(waitpid(child, &status, 0), child);
    return status;
}

static void test_interrupted_process_cleans_up_and_then_ends_by_its_signal(void **state)
{
    (void)state;
    const char *folder = make_folder("interrupted");
    int status = run_interrupted(folder);
    assert_true(WIFSIGNALED(status));
    assert_int_equal(WTERMSIG(status), SIGINT);
    assert_int_equal(rmdir(folder), 0); /* empty */
}

static void test_folder_that_cannot_be_written_is_refused(void **state)
{
    (void)state;
    nook_output output = { .folder = "untouched" };
    nook_log_capture said;
    nook_log_capture_begin(&said);
    nook_result prepared = nook_output_prepare("/proc/nook"), opened = nook_output_open("/proc", &output);
    nook_log_capture_end();
    assert_int_equal(prepared, NOOK_E_IO);
    assert_int_equal(opened, NOOK_E_IO);
    assert_int_equal(said.errors, 2);
    assert_string_equal(output.folder, "untouched");
    nook_log_capture_begin(&said);
    prepared = nook_output_prepare("/proc");
    nook_log_capture_end();
    assert_int_equal(prepared, NOOK_E_IO);
    assert_non_null(strstr(said.text, "/proc: no file can be made in it"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_files_appear_at_the_commit_only),
        cmocka_unit_test(test_discard_leaves_the_folder_as_it_was),
        cmocka_unit_test(test_files_of_the_run_before_are_removed_and_others_are_not),
        cmocka_unit_test(test_directory_in_the_way_changes_nothing),
        cmocka_unit_test(test_interrupted_process_cleans_up_and_then_ends_by_its_signal),
        cmocka_unit_test(test_folder_that_cannot_be_written_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
