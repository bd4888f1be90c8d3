/* A game whose volumes are streamed, drawn frame by frame: what it takes, what is seen, how it ends. */
#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "game/live/live_internal.h"
#include "game/play/play_reload.h"
#include "game/play/play_window.h"
#include "game/stream_volumes.h"
#include "tests/support/file_tree.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include "tests/support/test_gpu.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 48, HEIGHT = 27, PIXELS = WIDTH * HEIGHT, PATH_SIZE = 1024 };

static const double mebibyte = 1024.0 * 1024.0;
static const double frame_seconds = 5.0 / 60.0; /* as many ticks as a frame may have: the game in few pictures */
static const double settle_ms = 60000.0;

typedef float picture[PIXELS];

typedef struct fixture {
    nook_play_window window;
    char cache[PATH_SIZE], settings[PATH_SIZE];
    nook_log_capture log;
} fixture;

/* The engine house's settings without means, which would be of the frames, too, in which volumes were still read; and a line or more. */
static void write_settings(fixture *self, const char *lines)
{
    char path[PATH_SIZE], text[8192];
    nook_file file;
    nook_path_join(path, sizeof path, test_gpu_root(), "content/engine_house/engine_house.settings");
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    int size = snprintf(text, sizeof text, "%.*s%s", (int)file.size, (const char *)file.bytes, lines);
    assert_true(size > 0 && (size_t)size < sizeof text);
    nook_file_free(&file);
    static const char means[] = "\nao.accumulate = ";
    char *number = strstr(text, means);
    assert_non_null(number);
    number[sizeof means - 1] = '1';
    assert_int_equal(nook_file_write(self->settings, text, (size_t)size), NOOK_OK);
}

static nook_result open_game(fixture *self, const char *lines)
{
    char replay[PATH_SIZE];
    nook_path_join(replay, sizeof replay, test_gpu_root(), "content/engine_house/engine_house.replay");
    const nook_play_window_desc desc = { .play = { .root = test_gpu_root(), .replay = replay },
                                         .backend = NOOK_BACKEND_OSMESA,
                                         .no_window = true,
                                         .width = WIDTH,
                                         .height = HEIGHT,
                                         .settings = self->settings,
                                         .cache = self->cache,
                                         .pictures = ".",
                                         .frame_seconds = frame_seconds };
    write_settings(self, lines);
    return nook_play_window_open(test_gpu_root(), &desc, &self->window);
}

static int setup(void **state)
{
    fixture *self = calloc(1, sizeof *self);
    if (!self)
        return -1;
    *state = self;
    nook_scratch_path(self->cache, sizeof self->cache, "cache"); /* all tests': what one has baked the next one reads */
    nook_scratch_path(self->settings, sizeof self->settings, "streamed.settings");
    nook_log_capture_begin(&self->log);
    return 0;
}

static int teardown(void **state)
{
    fixture *self = *state;
    if (self->window.stage.ao)
        nook_play_window_close(&self->window);
    nook_log_capture_end();
    free(self);
    return 0;
}

static bool draw_frame(fixture *self)
{
    bool goes_on;
    assert_int_equal(nook_play_window_frame(&self->window, &goes_on), NOOK_OK);
    return goes_on;
}

static nook_stream_status status_of(const fixture *self)
{
    nook_stream_status status;
    nook_stream_get_status(self->window.stage.stream, &status);
    return status;
}

static bool is_settled(const fixture *self)
{
    return nook_stream_is_settled(self->window.stage.stream);
}

static uint64_t bytes_of_all(fixture *self)
{
    nook_stream_status status;
    assert_int_equal(open_game(self, "volumes.budget = 1000\n"), NOOK_OK);
    nook_stream_get_status(self->window.stage.stream, &status);
    draw_frame(self);
    status = status_of(self);
    assert_true(status.all_fit && status.wanted_bytes > 0);
    nook_play_window_close(&self->window);
    return status.wanted_bytes;
}

static void test_the_recorded_game_never_takes_more_than_the_budget_and_is_won_with_the_same_hash(void **state)
{
    fixture *self = *state;
    char lines[64];
    uint64_t hash = 0, ticks = 0;
    const uint64_t all = bytes_of_all(self);
    double budget = (double)all / mebibyte / 4.0;
    snprintf(lines, sizeof lines, "volumes.budget = %.3f\n", budget);
    for (int run = 0; run < 2; run++) {
        uint32_t frames = 0, with_volumes = 0;
        assert_int_equal(open_game(self, run ? lines : ""), NOOK_OK);
        assert_true(run == (self->window.stage.stream != NULL));
        if (run == 0) { /* how it ends is nothing that pictures change */
            const nook_play_input nothing = { 0 };
            while (!nook_play_is_beyond_end(&self->window.play) && !nook_play_is_free(&self->window.play))
                assert_int_equal(nook_play_tick(&self->window.play, &nothing), NOOK_OK);
        }
        while (run == 1 && draw_frame(self)) {
            nook_stream_status status = status_of(self);
            assert_true((double)status.memory <= budget * mebibyte + 1000.0); /* three digits were written */
            assert_true((double)status.frame_upload <= mebibyte);             /* volumes.upload as it comes */
            assert_false(status.all_fit || status.failed);
            with_volumes += status.resident > 0;
            frames++;
        }
        assert_int_equal(nook_session_look(self->window.play.session).status, NOOK_SESSION_WON);
        if (run == 1) {
            assert_true(self->window.play.ended_hash == hash && self->window.play.ended_at == ticks);
            assert_true(frames > 1000 && with_volumes > frames * 9 / 10);
            assert_true(status_of(self).loads > 0 && status_of(self).wanted_bytes < all);
        }
        hash = self->window.play.ended_hash;
        ticks = self->window.play.ended_at;
        nook_play_window_close(&self->window);
    }
    assert_true(hash != 0);
}

/* So many frames; those of a streamed game wait until nothing comes any more. */
static void play_frames(fixture *self, int count, picture out)
{
    double end = nook_clock_ms() + settle_ms;
    for (int i = 0; i < count; i++) {
        draw_frame(self);
        while (self->window.stage.stream && status_of(self).reading > 0 && nook_clock_ms() < end && i > 0)
            if (nook_stage_update(&self->window.stage, &self->window.stage.frame.camera) == NOOK_OK)
                nook_clock_rest(1.0);
    }
    nook_texture_read(self->window.stage.gpu, nook_stage_visibility(&self->window.stage), GL_RED, GL_FLOAT, out,
                      sizeof(picture));
}

static void test_with_room_enough_the_game_is_seen_bit_for_bit_as_without_a_budget(void **state)
{
    enum { FRAMES = 40 };
    fixture *self = *state;
    picture all, streamed;
    assert_int_equal(open_game(self, ""), NOOK_OK);
    assert_null(self->window.stage.stream);
    play_frames(self, FRAMES, all);
    nook_play_window_close(&self->window);
    assert_int_equal(open_game(self, "volumes.budget = 1000\n"), NOOK_OK);
    play_frames(self, FRAMES, streamed);
    assert_true(is_settled(self) && status_of(self).all_fit);
    assert_int_equal(status_of(self).resident, status_of(self).volumes);
    assert_memory_equal(streamed, all, sizeof all);
}

static void test_a_game_that_ends_while_volumes_are_read_leaves_no_file_open(void **state)
{
    fixture *self = *state;
    assert_int_equal(open_game(self, "volumes.budget = 1000\nvolumes.upload = 0.26\n"), NOOK_OK);
    draw_frame(self); /* shaders are read now */
    nook_play_window_close(&self->window);
    int before = file_tree_open_files();
    for (int frames = 0; frames < 4; frames++) {
        assert_int_equal(open_game(self, "volumes.budget = 1000\nvolumes.upload = 0.26\n"), NOOK_OK);
        for (int i = 0; i < frames; i++)
            draw_frame(self);
        assert_true(frames == 0 || status_of(self).waiting > 0);
        nook_play_window_close(&self->window);
        assert_int_equal(file_tree_open_files(), before);
    }
}

static void test_a_budget_that_is_saved_while_one_plays_holds_from_the_next_frame_on(void **state)
{
    fixture *self = *state;
    picture seen;
    double end = nook_clock_ms() + settle_ms;
    assert_int_equal(open_game(self, "volumes.budget = 1000\n"), NOOK_OK);
    nook_play_watch(&self->window);
    play_frames(self, 20, seen);
    const uint64_t before = status_of(self).resident_bytes;
    double less = (double)before / mebibyte / 3.0;
    char lines[64];
    snprintf(lines, sizeof lines, "volumes.budget = %.3f\n", less);
    write_settings(self, lines);
    while (status_of(self).all_fit && nook_clock_ms() < end)
        draw_frame(self);
    assert_true((double)status_of(self).memory <= less * mebibyte + 1000.0);
    write_settings(self, "volumes.budget = little\n"); /* told, and the one before stays */
    while (self->log.errors == 0 && nook_clock_ms() < end)
        draw_frame(self);
    assert_non_null(strstr(nook_settings_reload_error(self->window.settings_watch), "volumes.budget = little"));
    assert_true((double)status_of(self).memory <= less * mebibyte + 1000.0);
    write_settings(self, ""); /* no bounds any more */
    while (!status_of(self).all_fit && nook_clock_ms() < end)
        draw_frame(self);
    play_frames(self, 10, seen);
    assert_true(status_of(self).resident_bytes == before && status_of(self).budget == 0);
}

static void test_what_the_panels_save_keeps_the_budget(void **state)
{
    fixture *self = *state;
    nook_settings_file saved;
    assert_int_equal(open_game(self, "volumes.budget = 12.5\nvolumes.upload = 0.5\n"), NOOK_OK);
    draw_frame(self);
    assert_int_equal(live_save(self->window.live), NOOK_OK);
    assert_int_equal(nook_settings_file_read(self->settings, &saved), NOOK_OK);
    assert_true(saved.stream.budget == 12.5f && saved.stream.upload == 0.5f && !saved.live);
    nook_play_window_close(&self->window);
    assert_int_equal(open_game(self, "volumes = live\n"), NOOK_OK);
    draw_frame(self);
    assert_int_equal(live_save(self->window.live), NOOK_OK);
    assert_int_equal(nook_settings_file_read(self->settings, &saved), NOOK_OK);
    assert_true(saved.live);
}

static void test_a_budget_that_holds_next_to_nothing_is_no_reason_to_end(void **state)
{
    fixture *self = *state;
    picture seen;
    assert_int_equal(open_game(self, "volumes.budget = 0.0001\n"), NOOK_OK);
    int before = self->log.count;
    play_frames(self, 10, seen);
    assert_int_equal(self->log.count, before + 1);
    assert_non_null(strstr(self->log.text, "volumes.budget = 0.0001 MiB holds none of the 28 volumes"));
    assert_true(status_of(self).memory <= 105);
    assert_int_equal(status_of(self).resident, 0);
    for (int i = 0; i < PIXELS; i++)
        assert_true(seen[i] == 1.0f);
    double least = 0.0, all = 0.0;
    char lines[64];
    assert_int_equal(sscanf(strstr(self->log.text, "needs "), "needs %lf, all at their finest %lf", &least, &all), 2);
    assert_true(least > 0.0001 && least < 0.01 && all > 1.0 && all < 2.0);
    nook_play_window_close(&self->window);
    snprintf(lines, sizeof lines, "volumes.budget = %.4f\n", least); /* as little as it asks for is enough */
    assert_int_equal(open_game(self, lines), NOOK_OK);
    play_frames(self, 10, seen);
    assert_int_equal(status_of(self).resident, 1);
    nook_play_window_close(&self->window);
    snprintf(lines, sizeof lines, "volumes.budget = %.4f\n", all);
    assert_int_equal(open_game(self, lines), NOOK_OK);
    play_frames(self, 10, seen);
    assert_true(status_of(self).all_fit);
}

static void test_a_plan_streams_what_it_has_kept(void **state)
{
    fixture *self = *state;
    picture all, streamed;
    assert_int_equal(open_game(self, "plan = on\n"), NOOK_OK);
    play_frames(self, 10, all);
    nook_play_window_close(&self->window);
    assert_int_equal(open_game(self, "plan = on\nvolumes.budget = 1000\n"), NOOK_OK);
    play_frames(self, 10, streamed);
    assert_true(is_settled(self) && status_of(self).resident > 0);
    assert_memory_equal(streamed, all, sizeof all);
}

static void test_live_volumes_have_no_budget_and_one_line_says_so(void **state)
{
    fixture *self = *state;
    assert_int_equal(open_game(self, "volumes = live\nvolumes.budget = 1\n"), NOOK_OK);
    assert_null(self->window.stage.stream);
    assert_non_null(strstr(self->log.text, "volumes.budget does nothing"));
    draw_frame(self);
}

static void test_a_budget_that_is_no_number_is_refused_in_one_line(void **state)
{
    fixture *self = *state;
    static const char *const lines[][2] = { { "volumes.budget = -1\n", "volumes.budget" },
                                            { "volumes.budget = much\n", "volumes.budget" },
                                            { "volumes.budget = nan\n", "volumes.budget" },
                                            { "volumes.budgets = 3\n", "budget" } };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        int before = self->log.errors;
        assert_true(open_game(self, lines[i][0]) != NOOK_OK);
        assert_int_equal(self->log.errors, before + 1);
        assert_non_null(strstr(self->log.text, lines[i][1]));
        assert_non_null(strstr(self->log.text, "streamed.settings:")); /* and the line's number */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_a_budget_that_is_no_number_is_refused_in_one_line, setup, teardown),
        cmocka_unit_test_setup_teardown(test_with_room_enough_the_game_is_seen_bit_for_bit_as_without_a_budget, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(
            test_the_recorded_game_never_takes_more_than_the_budget_and_is_won_with_the_same_hash, setup, teardown),
        cmocka_unit_test_setup_teardown(test_a_game_that_ends_while_volumes_are_read_leaves_no_file_open, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(test_a_budget_that_is_saved_while_one_plays_holds_from_the_next_frame_on, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(test_what_the_panels_save_keeps_the_budget, setup, teardown),
        cmocka_unit_test_setup_teardown(test_a_budget_that_holds_next_to_nothing_is_no_reason_to_end, setup, teardown),
        cmocka_unit_test_setup_teardown(test_a_plan_streams_what_it_has_kept, setup, teardown),
        cmocka_unit_test_setup_teardown(test_live_volumes_have_no_budget_and_one_line_says_so, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
