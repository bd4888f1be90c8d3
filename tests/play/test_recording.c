#include "engine/core/file.h"
#include "game/play/recording.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { PATH_BYTES = 4096 };
#define HEADER "nook recording 1\nlevel a/b c.level\nseed 7\n"

static const char *write_bytes(const void *text, size_t size)
{
    static char path[PATH_BYTES];
    nook_scratch_path(path, sizeof path, "a.replay");
    assert_int_equal(nook_file_write(path, text, size), NOOK_OK);
    return path;
}

static void must_refuse_as(const char *text, nook_result code, const char *reason)
{
    nook_log_capture log;
    nook_recording recording, before;
    memset(&recording, 7, sizeof recording);
    before = recording;
    const char *path = write_bytes(text, strlen(text));
    nook_log_capture_begin(&log);
    nook_result result = nook_recording_read(path, &recording);
    nook_log_capture_end();
    if (result != code || log.errors != 1 || !strstr(log.text, reason))
        fail_msg("expected %d and '%s', got %d: %s", code, reason, result, log.text);
    assert_memory_equal(&recording, &before, sizeof recording);
}

static void must_refuse(const char *text, const char *reason)
{
    must_refuse_as(text, NOOK_E_FORMAT, reason);
}

static void test_what_is_written_reads_back_the_same(void **state)
{
    (void)state;
    nook_recording out = { .level = "content/some level.level", .seed = 4294967295u }, in;
    char path[PATH_BYTES];
    for (int i = 0; i < 20000; i++) { /* runs, jumps and the ends of every range */
        const nook_play_input input = { .right = (int8_t)(i % 255 - 127),
                                        .forward = (int8_t)(i / 1000 % 2 ? 127 : -127),
                                        .buttons = (uint16_t)(i / 500 * 13),
                                        .yaw = (int16_t)(i / 700 % 3 == 0 ? -32768 : i % 32767),
                                        .pitch = (int16_t)(i / 900 % 2 ? 32767 : 0) };
        const nook_play_input plain = { .forward = 127 };
        assert_int_equal(nook_recording_append(&out, i / 100 % 2 ? &plain : &input), NOOK_OK);
    }
    nook_scratch_path(path, sizeof path, "b.replay");
    assert_int_equal(nook_recording_write(path, &out), NOOK_OK);
    assert_int_equal(nook_recording_read(path, &in), NOOK_OK);
    assert_string_equal(in.level, out.level);
    assert_int_equal(in.seed, out.seed);
    assert_int_equal(in.tick_count, out.tick_count);
    assert_memory_equal(in.inputs, out.inputs, out.tick_count * sizeof *out.inputs);
    nook_recording_free(&out);
    nook_recording_free(&in);
    assert_null(in.inputs);
    assert_int_equal(in.tick_count, 0);
}

static void test_paths_with_blanks_and_hashes_and_the_origin_are_read_back(void **state)
{
    (void)state;
    char path[PATH_BYTES];
    nook_recording out = { .level = "my levels #2/a b # c.level", .seed = 1, .origin = 0x00fedcba98765432u }, in;
    const nook_play_input nothing = { 0 };
    assert_int_equal(nook_recording_append(&out, &nothing), NOOK_OK);
    nook_scratch_path(path, sizeof path, "d.replay");
    assert_int_equal(nook_recording_write(path, &out), NOOK_OK);
    assert_int_equal(nook_recording_read(path, &in), NOOK_OK);
    assert_string_equal(in.level, out.level);
    assert_true(in.origin == out.origin);
    assert_int_equal(in.tick_count, 1);
    nook_recording_free(&out);
    nook_recording_free(&in);
}

static void test_an_hour_of_standing_is_one_line(void **state)
{
    (void)state;
    nook_recording out = { .level = "a.level", .seed = 1 };
    const nook_play_input nothing = { 0 };
    char path[PATH_BYTES];
    nook_file file;
    for (int i = 0; i < 216000; i++)
        assert_int_equal(nook_recording_append(&out, &nothing), NOOK_OK);
    nook_scratch_path(path, sizeof path, "c.replay");
    assert_int_equal(nook_recording_write(path, &out), NOOK_OK);
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    assert_string_equal((const char *)file.bytes, "nook recording 1\nlevel a.level\nseed 1\n216000 0 0 0 0 0\n");
    nook_file_free(&file);
    nook_recording_free(&out);
}

static void test_comments_blanks_and_hexadecimals_are_read(void **state)
{
    (void)state;
    nook_recording in;
    const char *text = "# by hand\nnook recording 1\n# of\n  level a/b c.level  \nseed 7 # any\n\n  2  -1 127\t0x2 -35 "
                       "9 # look\r\n1 0 0 10 0 0";
    assert_int_equal(nook_recording_read(write_bytes(text, strlen(text)), &in), NOOK_OK);
    assert_int_equal(in.tick_count, 3);
    assert_string_equal(in.level, "a/b c.level");
    assert_true(in.inputs[1].right == -1 && in.inputs[1].forward == 127 && in.inputs[1].buttons == 2);
    assert_true(in.inputs[1].yaw == -35 && in.inputs[1].pitch == 9 && in.inputs[2].buttons == 10);
    nook_recording_free(&in);
}

static void test_a_recording_without_ticks_is_one(void **state)
{
    (void)state;
    nook_recording in;
    assert_int_equal(nook_recording_read(write_bytes(HEADER, strlen(HEADER)), &in), NOOK_OK);
    assert_int_equal(in.tick_count, 0);
    nook_recording_free(&in);
}

static void test_other_files_and_versions_are_refused(void **state)
{
    (void)state;
    must_refuse("", "no recording of a game");
    must_refuse("technique = volume\n", "no recording of a game");
    must_refuse("nook recording\n", "no recording of a game");
    must_refuse("nook recording one\n", "no recording of a game");
    must_refuse_as("nook recording 2\nlevel a\nseed 1\n", NOOK_E_VERSION, "version 2, this build plays 1");
}

static void test_broken_headers_are_refused_with_their_line(void **state)
{
    (void)state;
    must_refuse("nook recording 1\n", "give level PATH");
    must_refuse("nook recording 1\nlevel\n", "a.replay:2: give level PATH");
    must_refuse("nook recording 1\nseed 1\n", "a.replay:2: give level PATH");
    must_refuse("nook recording 1\nlevel a\n", "give seed N");
    must_refuse("nook recording 1\nlevel a\nseed x\n", "a.replay:3: give seed N");
    must_refuse("nook recording 1\nlevel a\nseed -1\n", "a.replay:3: give seed N");
    must_refuse("nook recording 1\nlevel a\nseed 4294967296\n", "a.replay:3: give seed N");
    must_refuse("nook recording 1\nlevel a\nseed 1.5\n", "a.replay:3: give seed N");
    must_refuse(HEADER "origin 12\n", "a.replay:4: give origin and 16 digits");
    must_refuse(HEADER "origin 00112233445566zz\n", "a.replay:4: give origin and 16 digits");
    must_refuse(HEADER "origin 0011223344556677 8\n", "a.replay:4: give origin and 16 digits");
    must_refuse(HEADER "1 0 0 0 0 0\norigin 0011223344556677\n", "a.replay:5: give origin and 16 digits");
}

static void test_broken_runs_are_refused_with_their_line(void **state)
{
    (void)state;
    static const char *const runs[] = { "1 0 0 0 0",     "1 0 0 0 0 0 0",   "x 0 0 0 0 0",          "0 0 0 0 0 0",
                                        "-1 0 0 0 0 0",  "1 128 0 0 0 0",   "1 0 -128 0 0 0",       "1 0 0 65536 0 0",
                                        "1 0 0 -1 0 0",  "1 0 0 0 32768 0", "1 0 0 0 0 -32769",     "1 0 0 0 0 0x",
                                        "1 0.5 0 0 0 0", "1,0 0 0 0 0",     "99999999999 0 0 0 0 0" };
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        char text[256];
        snprintf(text, sizeof text, HEADER "3 0 0 0 0 0\n%s\n", runs[i]);
        must_refuse(text, "a.replay:5: give TICKS RIGHT FORWARD BUTTONS YAW PITCH");
    }
    must_refuse(HEADER "800000 0 0 0 0 0\n800000 0 0 0 0 0\n", "a.replay:5: longer than");
}

static void test_files_that_are_not_there_are_said(void **state)
{
    (void)state;
    nook_recording recording = { .tick_count = 0 };
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_recording_read("nowhere/none.replay", &recording), NOOK_E_NOT_FOUND);
    assert_int_equal(nook_recording_write("nowhere/none.replay", &recording), NOOK_E_IO);
    nook_log_capture_end();
    assert_int_equal(log.errors, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_written_reads_back_the_same),
        cmocka_unit_test(test_paths_with_blanks_and_hashes_and_the_origin_are_read_back),
        cmocka_unit_test(test_an_hour_of_standing_is_one_line),
        cmocka_unit_test(test_comments_blanks_and_hexadecimals_are_read),
        cmocka_unit_test(test_a_recording_without_ticks_is_one),
        cmocka_unit_test(test_other_files_and_versions_are_refused),
        cmocka_unit_test(test_broken_headers_are_refused_with_their_line),
        cmocka_unit_test(test_broken_runs_are_refused_with_their_line),
        cmocka_unit_test(test_files_that_are_not_there_are_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
