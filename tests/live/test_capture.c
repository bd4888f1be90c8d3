/* Pictures into a folder, and into a video by an ffmpeg that the test has made. */
#include "engine/core/file.h"
#include "game/live/capture.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <setjmp.h>
#include <stb/stb_image.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

enum { WIDTH = 6, HEIGHT = 4, SIZE = WIDTH * HEIGHT * 3 };

static void fill(uint8_t rgb[SIZE], int frame)
{
    for (int i = 0; i < SIZE; i++)
        rgb[i] = (uint8_t)(40 * frame + i);
}

/* A program called ffmpeg, the only one that is found. */
static void install(const char *script)
{
    char folder[4096], path[4200];
    nook_scratch_path(folder, sizeof folder, "bin");
    assert_int_equal(nook_directory_make(folder), NOOK_OK);
    snprintf(path, sizeof path, "%s/ffmpeg", folder);
    remove(path);
    if (script) {
        assert_int_equal(nook_file_write(path, script, strlen(script)), NOOK_OK);
        assert_int_equal(chmod(path, 0755), 0);
    }
    setenv("PATH", folder, 1);
}

static int keep_path(void **state)
{
    const char *path = getenv("PATH");
    *state = strdup(path ? path : "");
    return *state == NULL;
}

static int restore_path(void **state)
{
    setenv("PATH", *state, 1);
    free(*state);
    return 0;
}

static void test_folder_gets_numbered_pictures_that_are_those_given(void **state)
{
    (void)state;
    char folder[4096], path[4200];
    uint8_t rgb[SIZE];
    nook_capture *capture;
    nook_scratch_path(folder, sizeof folder, "frames/of/a/run");
    const nook_capture_desc desc = { folder, WIDTH, HEIGHT, 0.0 };
    assert_int_equal(nook_capture_open(&desc, &capture), NOOK_OK);
    for (int i = 1; i <= 3; i++) {
        fill(rgb, i);
        assert_int_equal(nook_capture_add(capture, rgb), NOOK_OK);
    }
    assert_int_equal(nook_capture_close(capture), NOOK_OK);
    for (int i = 1; i <= 3; i++) {
        int width, height, channels;
        snprintf(path, sizeof path, "%s/frame_%06d.png", folder, i);
        uint8_t *pixels = stbi_load(path, &width, &height, &channels, 3);
        fill(rgb, i);
        assert_non_null(pixels);
        assert_true(width == WIDTH && height == HEIGHT);
        assert_memory_equal(pixels, rgb, SIZE);
        stbi_image_free(pixels);
    }
}

static void test_folder_that_cannot_be_made_is_refused(void **state)
{
    (void)state;
    nook_log_capture log;
    nook_capture *capture = (nook_capture *)&log;
    nook_log_capture_begin(&log);
    nook_result result = nook_capture_open(&(nook_capture_desc){ "/proc/frames", WIDTH, HEIGHT, 0.0 }, &capture);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_IO);
    assert_null(capture);
    assert_int_equal(log.count, 1);
}

static void test_names_of_videos_are_told_by_their_ending(void **state)
{
    (void)state;
    assert_true(nook_capture_is_video("a/b.mp4") && nook_capture_is_video("x.MKV") && nook_capture_is_video("y.webm"));
    assert_false(nook_capture_is_video("frames") || nook_capture_is_video("mp4") ||
                 nook_capture_is_video("a.mp4/frames"));
}

static void test_video_without_ffmpeg_says_what_to_install(void **state)
{
    (void)state;
    char path[4096];
    nook_log_capture log;
    nook_capture *capture;
    install(NULL);
    nook_scratch_path(path, sizeof path, "run.mp4");
    nook_log_capture_begin(&log);
    nook_result result = nook_capture_open(&(nook_capture_desc){ path, WIDTH, HEIGHT, 0.0 }, &capture);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_NOT_FOUND);
    assert_null(capture);
    assert_int_equal(log.count, 1);
    assert_non_null(strstr(log.text, "install the package ffmpeg, or give a folder"));
}

/* Says why not in one line. */
static void must_check(const char *path, nook_result expected)
{
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_capture_check(path), expected);
    nook_log_capture_end();
    assert_int_equal(log.count, expected != NOOK_OK);
}

static void test_what_cannot_be_captured_is_known_before_anything_is_drawn(void **state)
{
    (void)state;
    char path[4096];
    install(NULL);
    must_check("/proc/frames", NOOK_E_IO);
    must_check(nook_scratch_path(path, sizeof path, "made/frames"), NOOK_OK);
    assert_true(nook_directory_exists(path));
    must_check(nook_scratch_path(path, sizeof path, "run.mp4"), NOOK_E_NOT_FOUND);
    install("exit 0");
    must_check(path, NOOK_OK);
    must_check("nowhere/run.mp4", NOOK_E_IO);
}

static void test_ffmpeg_gets_every_picture_and_how_they_are(void **state)
{
    (void)state;
    char path[4096], script[8400];
    uint8_t rgb[SIZE];
    nook_capture *capture;
    nook_file seen;
    nook_scratch_path(path, sizeof path, "run.mp4");
    /* Keeps what it is given as the video, and its words beside it. */
    snprintf(script, sizeof script, "#!/bin/sh\necho \"$@\" >%s.words\n/bin/cat >%s\n", path, path);
    install(script);
    assert_int_equal(nook_capture_open(&(nook_capture_desc){ path, WIDTH, HEIGHT, 25.0 }, &capture), NOOK_OK);
    for (int i = 1; i <= 3; i++) {
        fill(rgb, i);
        assert_int_equal(nook_capture_add(capture, rgb), NOOK_OK);
    }
    assert_int_equal(nook_capture_close(capture), NOOK_OK);
    assert_int_equal(nook_file_read(path, &seen), NOOK_OK);
    assert_int_equal(seen.size, 3 * SIZE);
    for (int i = 1; i <= 3; i++) {
        fill(rgb, i);
        assert_memory_equal(seen.bytes + (size_t)(i - 1) * SIZE, rgb, SIZE);
    }
    nook_file_free(&seen);
    strcat(path, ".words");
    assert_int_equal(nook_file_read(path, &seen), NOOK_OK);
    assert_non_null(strstr((char *)seen.bytes, "-f rawvideo"));
    assert_non_null(strstr((char *)seen.bytes, "-s 6x4"));
    assert_non_null(strstr((char *)seen.bytes, "-r 25"));
    assert_non_null(strstr((char *)seen.bytes, "-xerror")); /* without, ffmpeg ends with 0 on a full disk */
    strcpy(strrchr(path, '.'), "\n");                       /* without ".words": the last word */
    snprintf(script, sizeof script, " file:%s", path);
    assert_non_null(strstr((char *)seen.bytes, script));
    nook_file_free(&seen);
}

static void test_an_interrupt_of_our_process_group_does_not_reach_ffmpeg(void **state)
{
    (void)state;
    char path[4096], script[8400];
    uint8_t rgb[SIZE] = { 0 };
    nook_capture *capture;
    nook_file seen;
    int process, group;
    nook_scratch_path(path, sizeof path, "group.mp4");
    snprintf(script, sizeof script, "#!/bin/sh\nread line </proc/$$/stat\necho \"$line\" >%s\n/bin/cat >/dev/null\n",
             path);
    install(script);
    assert_int_equal(nook_capture_open(&(nook_capture_desc){ path, WIDTH, HEIGHT, 0.0 }, &capture), NOOK_OK);
    assert_int_equal(nook_capture_add(capture, rgb), NOOK_OK);
    assert_int_equal(nook_capture_close(capture), NOOK_OK);
    assert_int_equal(nook_file_read(path, &seen), NOOK_OK);
    assert_int_equal(sscanf((char *)seen.bytes, "%d (%*[^)]) %*c %*d %d", &process, &group), 2);
    assert_int_equal(group, process);
    nook_file_free(&seen);
}

static void test_ffmpeg_that_dies_fails_the_capture_and_nothing_else(void **state)
{
    (void)state;
    char path[4096];
    uint8_t *rgb = calloc(300 * 300, 3);
    nook_log_capture log;
    nook_capture *capture;
    install("#!/bin/sh\nexit 3\n");
    nook_scratch_path(path, sizeof path, "dead.mp4");
    assert_int_equal(nook_capture_open(&(nook_capture_desc){ path, 300, 300, 0.0 }, &capture), NOOK_OK);
    nook_log_capture_begin(&log);
    nook_result result = NOOK_OK;
    for (int i = 0; i < 100 && result == NOOK_OK; i++) /* the first ones may still fit into the pipe */
        result = nook_capture_add(capture, rgb);
    assert_int_equal(result, NOOK_E_IO);
    assert_int_equal(nook_capture_add(capture, rgb), NOOK_E_IO);
    assert_int_equal(nook_capture_close(capture), NOOK_E_IO);
    nook_log_capture_end();
    assert_int_equal(log.count, 1);
    free(rgb);
}

static void test_ffmpeg_that_fails_at_the_end_is_told_at_the_close(void **state)
{
    (void)state;
    char path[4096];
    uint8_t rgb[SIZE] = { 0 };
    nook_log_capture log;
    nook_capture *capture;
    install("#!/bin/sh\n/bin/cat >/dev/null\nexit 1\n");
    nook_scratch_path(path, sizeof path, "late.mp4");
    assert_int_equal(nook_capture_open(&(nook_capture_desc){ path, WIDTH, HEIGHT, 0.0 }, &capture), NOOK_OK);
    assert_int_equal(nook_capture_add(capture, rgb), NOOK_OK);
    nook_log_capture_begin(&log);
    nook_result result = nook_capture_close(capture);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_IO);
    assert_int_equal(log.count, 1);
    assert_int_equal(nook_capture_close(NULL), NOOK_OK);
}

int main(void)
{
#define WITH_PATH(name) cmocka_unit_test_setup_teardown(name, keep_path, restore_path)
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_folder_gets_numbered_pictures_that_are_those_given),
        cmocka_unit_test(test_folder_that_cannot_be_made_is_refused),
        cmocka_unit_test(test_names_of_videos_are_told_by_their_ending),
        WITH_PATH(test_video_without_ffmpeg_says_what_to_install),
        WITH_PATH(test_what_cannot_be_captured_is_known_before_anything_is_drawn),
        WITH_PATH(test_ffmpeg_gets_every_picture_and_how_they_are),
        WITH_PATH(test_an_interrupt_of_our_process_group_does_not_reach_ffmpeg),
        WITH_PATH(test_ffmpeg_that_dies_fails_the_capture_and_nothing_else),
        WITH_PATH(test_ffmpeg_that_fails_at_the_end_is_told_at_the_close),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
