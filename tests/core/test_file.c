#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/result.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <dirent.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cmocka.h>

enum { CAPACITY = 4096 };

static nook_log_capture logged;

static int begin(void **state)
{
    (void)state;
    nook_log_capture_begin(&logged);
    return 0;
}

static int end(void **state)
{
    (void)state;
    nook_log_capture_end();
    return 0;
}

static void assert_content(const char *path, const char *text)
{
    nook_file file;
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    assert_int_equal(file.size, strlen(text));
    assert_string_equal((const char *)file.bytes, text); /* relies on the zero byte behind the content */
    nook_file_free(&file);
    assert_null(file.bytes);
}

static int count_entries(const char *folder)
{
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    int count = 0;
    while (readdir(directory))
        count++;
    closedir(directory);
    return count - 2; /* "." and ".." */
}

static void test_file_read_gives_back_what_was_written(void **state)
{
    (void)state;
    char path[CAPACITY];
    nook_scratch_path(path, sizeof path, "hello.txt");
    assert_int_equal(nook_file_write(path, "hello", 5), NOOK_OK);
    assert_content(path, "hello");
    assert_int_equal(nook_file_write(path, "", 0), NOOK_OK);
    assert_content(path, "");
}

static void check_read_refused(const char *path, nook_result expected, const char *words)
{
    uint8_t byte = 0;
    nook_file file = { &byte, 77 };
    int before = logged.count;
    assert_int_equal(nook_file_read(path, &file), expected);
    assert_ptr_equal(file.bytes, &byte);
    assert_int_equal(file.size, 77);
    assert_int_equal(logged.count, before + 1);
    assert_non_null(strstr(logged.text, path));
    assert_non_null(strstr(logged.text, words));
}

static void test_file_read_refuses_what_is_missing(void **state)
{
    (void)state;
    char path[CAPACITY], below[CAPACITY];
    check_read_refused(nook_scratch_path(path, sizeof path, "none.txt"), NOOK_E_NOT_FOUND, "no such file");
    nook_scratch_path(path, sizeof path, "plain.txt");
    assert_int_equal(nook_file_write(path, "x", 1), NOOK_OK);
    check_read_refused(nook_path_join(below, sizeof below, path, "inside"), NOOK_E_NOT_FOUND, "no such file");
}

static void test_file_read_refuses_a_directory(void **state)
{
    (void)state;
    char path[CAPACITY];
    nook_scratch_path(path, sizeof path, "folder");
    assert_int_equal(nook_directory_make(path), NOOK_OK);
    check_read_refused(path, NOOK_E_IO, "directory");
}

static void test_file_read_refuses_a_pipe_without_waiting(void **state)
{
    (void)state;
    char path[CAPACITY];
    nook_scratch_path(path, sizeof path, "pipe");
    assert_int_equal(mkfifo(path, 0600), 0);
    check_read_refused(path, NOOK_E_IO, "not a regular file");
}

static void test_file_write_replaces_an_older_file_and_leaves_nothing_beside_it(void **state)
{
    (void)state;
    char folder[CAPACITY], path[CAPACITY];
    nook_scratch_path(folder, sizeof folder, "replace");
    assert_int_equal(nook_directory_make(folder), NOOK_OK);
    nook_path_join(path, sizeof path, folder, "file");
    assert_int_equal(nook_file_write(path, "older and longer", 16), NOOK_OK);
    assert_int_equal(nook_file_write(path, "new", 3), NOOK_OK);
    assert_content(path, "new");
    assert_int_equal(count_entries(folder), 1);
}

/* How files may grow, and what happens to those that write beyond. */
typedef struct room {
    struct rlimit limit;
    void (*handler)(int);
} room;

/* In any file. @return how it was */
static room leave_room_for_1000_bytes(void)
{
    room usual;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &usual.limit), 0);
    const struct rlimit tight = { .rlim_cur = 1000, .rlim_max = usual.limit.rlim_max };
    usual.handler = signal(SIGXFSZ, SIG_IGN); /* then writing beyond the limit is an error, not a signal */
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &tight), 0);
    return usual;
}

static void give_room_back(const room *usual)
{
    setrlimit(RLIMIT_FSIZE, &usual->limit);
    signal(SIGXFSZ, usual->handler);
}

static void test_file_write_that_runs_out_of_room_keeps_the_old_file(void **state)
{
    (void)state;
    char folder[CAPACITY], path[CAPACITY];
    nook_scratch_path(folder, sizeof folder, "full");
    assert_int_equal(nook_directory_make(folder), NOOK_OK);
    nook_path_join(path, sizeof path, folder, "file");
    assert_int_equal(nook_file_write(path, "old", 3), NOOK_OK);

    static const char big[65536];
    room usual = leave_room_for_1000_bytes();
    nook_result result = nook_file_write(path, big, sizeof big);
    give_room_back(&usual);

    assert_int_equal(result, NOOK_E_IO);
    assert_non_null(strstr(logged.text, "cannot write"));
    assert_content(path, "old");
    assert_int_equal(count_entries(folder), 1);
}

static nook_result print_numbers(const void *user, FILE *stream)
{
    fprintf(stream, "%d and %d\n", ((const int *)user)[0], ((const int *)user)[1]);
    return NOOK_OK;
}

static nook_result give_up(const void *user, FILE *stream)
{
    print_numbers(user, stream);
    return nook_fail(NOOK_E_FORMAT, "these are not it");
}

static nook_result print_much(const void *user, FILE *stream)
{
    for (int i = 0; i < 1000; i++)
        print_numbers(user, stream);
    return NOOK_OK;
}

static void test_a_text_that_breaks_off_is_in_no_file(void **state)
{
    (void)state;
    static const int numbers[] = { 7, 8 }, others[] = { 1, 2 };
    char folder[CAPACITY], path[CAPACITY];
    nook_scratch_path(folder, sizeof folder, "text");
    assert_int_equal(nook_directory_make(folder), NOOK_OK);
    nook_path_join(path, sizeof path, folder, "numbers.txt");
    assert_int_equal(nook_file_write_text(path, print_numbers, numbers), NOOK_OK);
    assert_content(path, "7 and 8\n");
    assert_int_equal(nook_file_write_text(path, give_up, others), NOOK_E_FORMAT);
    assert_string_equal(logged.text, "these are not it");
    assert_content(path, "7 and 8\n");

    room usual = leave_room_for_1000_bytes();
    nook_result result = nook_file_write_text(path, print_much, others);
    give_room_back(&usual);
    assert_int_equal(result, NOOK_E_IO);
    assert_non_null(strstr(logged.text, "cannot write"));
    assert_content(path, "7 and 8\n");
    assert_int_equal(count_entries(folder), 1);
}

static void test_file_write_over_a_directory_fails_and_leaves_it(void **state)
{
    (void)state;
    char folder[CAPACITY], path[CAPACITY];
    nook_scratch_path(folder, sizeof folder, "over");
    nook_path_join(path, sizeof path, folder, "taken");
    assert_int_equal(nook_directory_make(path), NOOK_OK);
    assert_int_equal(nook_file_write(path, "x", 1), NOOK_E_IO);
    assert_true(nook_directory_exists(path));
    assert_int_equal(count_entries(folder), 1);
}

static void test_file_write_refuses_what_is_no_regular_file_and_leaves_it(void **state)
{
    (void)state;
    char path[CAPACITY];
    struct stat info;
    nook_scratch_path(path, sizeof path, "a_pipe_in_the_way");
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_int_equal(nook_file_write(path, "x", 1), NOOK_E_IO);
    assert_int_equal(nook_file_probe(path), NOOK_E_IO);
    assert_true(lstat(path, &info) == 0 && S_ISFIFO(info.st_mode));
}

static void test_file_write_through_a_link_writes_what_it_leads_to(void **state)
{
    (void)state;
    char folder[CAPACITY], target[CAPACITY], link[CAPACITY];
    struct stat info;
    nook_scratch_path(folder, sizeof folder, "elsewhere");
    assert_int_equal(nook_directory_make(folder), NOOK_OK);
    nook_path_join(target, sizeof target, folder, "target");
    assert_int_equal(nook_file_write(target, "old", 3), NOOK_OK);
    nook_scratch_path(link, sizeof link, "link");
    assert_int_equal(symlink(target, link), 0);
    assert_int_equal(nook_file_write(link, "new", 3), NOOK_OK);
    assert_content(target, "new");
    assert_true(lstat(link, &info) == 0 && S_ISLNK(info.st_mode));
    assert_int_equal(count_entries(folder), 1);
}

static void test_file_write_into_a_missing_folder_fails(void **state)
{
    (void)state;
    char path[CAPACITY];
    assert_int_equal(nook_file_write(nook_scratch_path(path, sizeof path, "no/such/folder"), "x", 1), NOOK_E_IO);
    assert_non_null(strstr(logged.text, path));
}

static void test_file_probe_says_whether_a_file_can_be_written_and_leaves_nothing(void **state)
{
    (void)state;
    char path[CAPACITY], folder[CAPACITY], probe[CAPACITY + 16];
    nook_log_capture log;
    nook_scratch_path(path, sizeof path, "probed.txt");
    nook_scratch_path(folder, sizeof folder, "probed_folder");
    assert_int_equal(nook_directory_make(folder), NOOK_OK);
    assert_int_equal(nook_file_probe(path), NOOK_OK);
    assert_false(nook_file_exists(path));
    snprintf(probe, sizeof probe, "%s.probe", path);
    assert_false(nook_file_exists(probe));
    nook_log_capture_begin(&log);
    assert_int_equal(nook_file_probe(folder), NOOK_E_IO);
    assert_int_equal(nook_file_probe(strcat(folder, "/none/x")), NOOK_E_IO);
    nook_log_capture_end();
    assert_int_equal(log.errors, 2);
}

static void test_directory_make_makes_parents_and_accepts_what_is_there(void **state)
{
    (void)state;
    char path[CAPACITY];
    nook_scratch_path(path, sizeof path, "a/b/c");
    assert_false(nook_directory_exists(path));
    assert_int_equal(nook_directory_make(path), NOOK_OK);
    assert_int_equal(nook_directory_make(path), NOOK_OK);
    assert_true(nook_directory_exists(path));
    assert_false(nook_file_exists(path));
}

static void test_directory_make_refuses_a_file_in_the_way(void **state)
{
    (void)state;
    char path[CAPACITY], below[CAPACITY];
    nook_scratch_path(path, sizeof path, "way");
    assert_int_equal(nook_file_write(path, "x", 1), NOOK_OK);
    assert_int_equal(nook_directory_make(path), NOOK_E_IO);
    assert_int_equal(nook_directory_make(nook_path_join(below, sizeof below, path, "inside")), NOOK_E_IO);
    assert_int_equal(nook_directory_make(""), NOOK_E_IO);
    assert_content(path, "x");
}

static void test_path_join_puts_one_separator(void **state)
{
    (void)state;
    char out[16];
    assert_string_equal(nook_path_join(out, sizeof out, "a", "b"), "a/b");
    assert_string_equal(nook_path_join(out, sizeof out, "a/", "b"), "a/b");
    assert_string_equal(nook_path_join(out, sizeof out, "", "b"), "b");
    assert_string_equal(nook_path_join(out, 4, "abc", "d"), "abc");
}

static void test_path_name_and_extension_are_the_last_parts(void **state)
{
    (void)state;
    assert_string_equal(nook_path_name("a/b.c/d.glb"), "d.glb");
    assert_string_equal(nook_path_name("d.glb"), "d.glb");
    assert_string_equal(nook_path_extension("a/b.c/d.tar.GLB"), ".GLB");
    assert_string_equal(nook_path_extension("a/b.c/d"), "");
    assert_string_equal(nook_path_extension("a/.hidden"), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_file_read_gives_back_what_was_written),
        cmocka_unit_test(test_file_read_refuses_what_is_missing),
        cmocka_unit_test(test_file_read_refuses_a_directory),
        cmocka_unit_test(test_file_read_refuses_a_pipe_without_waiting),
        cmocka_unit_test(test_file_write_replaces_an_older_file_and_leaves_nothing_beside_it),
        cmocka_unit_test(test_file_write_that_runs_out_of_room_keeps_the_old_file),
        cmocka_unit_test(test_a_text_that_breaks_off_is_in_no_file),
        cmocka_unit_test(test_file_write_over_a_directory_fails_and_leaves_it),
        cmocka_unit_test(test_file_write_refuses_what_is_no_regular_file_and_leaves_it),
        cmocka_unit_test(test_file_write_through_a_link_writes_what_it_leads_to),
        cmocka_unit_test(test_file_write_into_a_missing_folder_fails),
        cmocka_unit_test(test_file_probe_says_whether_a_file_can_be_written_and_leaves_nothing),
        cmocka_unit_test(test_directory_make_makes_parents_and_accepts_what_is_there),
        cmocka_unit_test(test_directory_make_refuses_a_file_in_the_way),
        cmocka_unit_test(test_path_join_puts_one_separator),
        cmocka_unit_test(test_path_name_and_extension_are_the_last_parts),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
