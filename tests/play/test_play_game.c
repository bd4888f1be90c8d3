#include "engine/core/file.h"
#include "game/play/play.h"
#include "tests/support/log_capture.h"
#include "tests/support/play_room.h"
#include "tests/support/scratch.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const nook_play_input forward = { .forward = 127 }, nothing = { 0 };

static const char *write_level(const char *rest)
{
    static char path[1024];
    char text[1024];
    play_room_write_scene("played.glb", PLAY_BOX("crate", 2, 0.2, -1.2, 0.4, 0.4, 0.4, PLAY_BODY(15)));
    int size = snprintf(text, sizeof text, "scene = played.glb\n%s", rest);
    nook_scratch_path(path, sizeof path, "played.level");
    assert_int_equal(nook_file_write(path, text, (size_t)size), NOOK_OK);
    return path;
}

static nook_play must_open(const nook_play_desc *desc)
{
    nook_play play;
    assert_int_equal(nook_play_open(desc, &play), NOOK_OK);
    assert_int_equal(nook_play_begin(&play, NULL, NULL), NOOK_OK);
    return play;
}

static void test_inputs_come_from_the_replay_then_the_pilot_then_the_player(void **state)
{
    (void)state;
    char replay[1024], pilot[1024];
    const char *level = write_level("start = 0 0 0\n");
    nook_recording recording = { .seed = 9 };
    snprintf(recording.level, sizeof recording.level, "%s", level);
    for (int i = 0; i < 60; i++)
        assert_int_equal(nook_recording_append(&recording, &forward), NOOK_OK);
    nook_scratch_path(replay, sizeof replay, "in.replay");
    assert_int_equal(nook_recording_write(replay, &recording), NOOK_OK);
    nook_recording_free(&recording);
    nook_scratch_path(pilot, sizeof pilot, "in.pilot");
    assert_int_equal(nook_file_write(pilot, "turn_to 90 0\n", 13), NOOK_OK);

    nook_play play = must_open(&(nook_play_desc){ .root = ".", .replay = replay, .pilot = pilot });
    assert_int_equal(play.seed, 9);
    const nook_play_input left = { .right = -127 };
    for (int i = 0; i < 60; i++)
        assert_int_equal(nook_play_tick(&play, &left), NOOK_OK);
    nook_session_view view = nook_session_look(play.session);
    assert_true(view.feet[2] < -1.5 && fabs(view.feet[0]) < 0.01); /* as recorded */
    assert_false(nook_play_is_free(&play));
    for (int i = 0; i < 120; i++)
        assert_int_equal(nook_play_tick(&play, i < 100 ? &nothing : &left), NOOK_OK);
    assert_true(nook_play_is_free(&play));
    view = nook_session_look(play.session);
    assert_true(fabs(view.yaw - 1.5708) < 0.01); /* as steered */
    assert_true(view.feet[2] > -1.9);            /* and to its left, which is +z, as the player goes */
    assert_int_equal(nook_play_close(&play), NOOK_OK);
    assert_null(play.session);
}

static void test_what_was_played_is_written_when_it_is_closed(void **state)
{
    (void)state;
    char path[1024];
    nook_recording recording;
    const char *level = write_level("start = 0 0 0\n");
    nook_scratch_path(path, sizeof path, "out.replay");
    nook_play play =
        must_open(&(nook_play_desc){ .root = ".", .level = level, .record = path, .seed = 3, .seed_given = true });
    for (int i = 0; i < 50; i++)
        assert_int_equal(nook_play_tick(&play, i < 20 ? &forward : &nothing), NOOK_OK);
    assert_int_equal(nook_play_close(&play), NOOK_OK);
    assert_int_equal(nook_recording_read(path, &recording), NOOK_OK);
    assert_int_equal(recording.tick_count, 50);
    assert_int_equal(recording.seed, 3);
    assert_string_equal(recording.level, level);
    assert_int_equal(recording.inputs[19].forward, 127);
    assert_int_equal(recording.inputs[20].forward, 0);
    nook_recording_free(&recording);
}

static void test_a_recording_that_cannot_be_written_is_said_before_anything_is_played(void **state)
{
    (void)state;
    nook_log_capture log;
    nook_play play;
    nook_log_capture_begin(&log);
    const nook_play_desc desc = { .root = ".", .level = write_level(""), .record = "nowhere/out.replay" };
    assert_int_equal(nook_play_open(&desc, &play), NOOK_E_IO);
    nook_log_capture_end();
    assert_int_equal(log.errors, 1);
    assert_null(play.level);
}

static void test_a_recording_that_cannot_be_written_any_more_is_said(void **state)
{
    (void)state;
    char folder[1024], path[1100];
    nook_log_capture log;
    nook_scratch_path(folder, sizeof folder, "gone");
    assert_int_equal(nook_directory_make(folder), NOOK_OK);
    nook_path_join(path, sizeof path, folder, "out.replay");
    nook_play play = must_open(&(nook_play_desc){ .root = ".", .level = write_level(""), .record = path });
    assert_int_equal(rmdir(folder), 0);
    nook_log_capture_begin(&log);
    assert_int_equal(nook_play_close(&play), NOOK_E_IO);
    nook_log_capture_end();
    assert_int_equal(log.errors, 1);
    assert_null(play.level);
}

/* A recording of some ticks in a level. @return its path */
static const char *record(const char *level)
{
    static char path[1024];
    nook_scratch_path(path, sizeof path, "of_level.replay");
    nook_play play = must_open(&(nook_play_desc){ .root = ".", .level = level, .record = path });
    for (int i = 0; i < 20; i++)
        assert_int_equal(nook_play_tick(&play, &forward), NOOK_OK);
    assert_int_equal(nook_play_close(&play), NOOK_OK);
    return path;
}

static void test_a_level_is_the_recorded_one_however_its_path_is_written(void **state)
{
    (void)state;
    const char *level = write_level("start = 0 0 0\n"), *replay = record(level), *name = nook_path_name(level);
    char aslant[1100];
    nook_log_capture log;
    snprintf(aslant, sizeof aslant, "%.*s./%s", (int)(name - level), level, name);
    nook_log_capture_begin(&log);
    nook_play play = must_open(&(nook_play_desc){ .root = ".", .level = aslant, .replay = replay });
    assert_int_equal(nook_play_close(&play), NOOK_OK);
    nook_log_capture_end();
    assert_int_equal(log.count, 0);
}

static void test_a_recording_that_lies_beside_its_level_is_played_from_anywhere(void **state)
{
    (void)state;
    nook_recording recording = { .level = "played.level", .seed = 1 };
    char replay[1024];
    write_level("title = beside\n");
    nook_scratch_path(replay, sizeof replay, "beside.replay");
    assert_int_equal(nook_recording_write(replay, &recording), NOOK_OK);
    nook_play play = must_open(&(nook_play_desc){ .root = ".", .replay = replay });
    assert_string_equal(play.level->title, "beside");
    assert_int_equal(nook_play_close(&play), NOOK_OK);
}

static void test_a_replay_in_a_level_that_was_changed_is_warned_of_once(void **state)
{
    (void)state;
    static const char *const changed[] = { "start = 0 0 1\n", "start = 0 0 0\n[body crate]\nmass = 16\n",
                                           "start = 0 0 0\n[goal g]\nat = 0 0 0\nsize = 1 1 1\n" };
    const char *replay = record(write_level("start = 0 0 0\n"));
    nook_log_capture log;
    for (size_t i = 0; i < NOOK_COUNT(changed) + 1; i++) {
        write_level(i < NOOK_COUNT(changed) ? changed[i] : "title = only words\nstart = 0 0 0\n");
        nook_log_capture_begin(&log);
        nook_play play = must_open(&(nook_play_desc){ .root = ".", .replay = replay, .seed = 9, .seed_given = true });
        assert_int_equal(nook_play_close(&play), NOOK_OK);
        nook_log_capture_end();
        assert_int_equal(log.count, i < NOOK_COUNT(changed));
        assert_true(log.count == 0 || strstr(log.text, "is not as it was when the replay was recorded"));
    }
}

static void test_the_tick_of_the_end_and_its_hash_are_kept_until_a_restart(void **state)
{
    (void)state;
    const nook_play_input restart = { .buttons = NOOK_PLAY_RESTART };
    nook_play play = must_open(&(nook_play_desc){ .root = ".", .level = write_level("seconds = 1\n") });
    uint64_t hash = 0;
    for (int i = 1; i <= 90; i++) {
        assert_int_equal(nook_play_tick(&play, &nothing), NOOK_OK);
        hash = i == 60 ? nook_session_hash(play.session) : hash;
    }
    assert_int_equal(play.ended_at, 60);
    assert_true(play.ended_hash == hash && hash != nook_session_hash(play.session)); /* the world goes on */
    assert_int_equal(nook_play_tick(&play, &restart), NOOK_OK);
    assert_int_equal(play.ended_at, 0);
    assert_int_equal(nook_play_close(&play), NOOK_OK);
}

static void test_a_level_that_changes_on_disk_is_gone_on_in(void **state)
{
    (void)state;
    nook_log_capture log;
    nook_level *level;
    nook_scene *scene;
    nook_game_world *world;
    char path[1024];
    nook_scratch_path(path, sizeof path, "cut.replay");
    nook_play play = must_open(&(nook_play_desc){ .root = ".", .level = write_level("title = old\n"), .record = path });
    for (int i = 0; i < 30; i++)
        assert_int_equal(nook_play_tick(&play, &forward), NOOK_OK);
    nook_session_view before = nook_session_look(play.session);

    write_level("titel = broken\n");
    nook_log_capture_begin(&log);
    assert_int_equal(nook_play_read_again(&play, true, &level, &scene), NOOK_E_FORMAT);
    nook_log_capture_end();
    assert_null(level);
    assert_null(scene);
    assert_int_equal(log.errors, 1);
    assert_string_equal(play.level->title, "old");

    write_level("title = new\nseconds = 100\n");
    assert_int_equal(nook_play_read_again(&play, true, &level, &scene), NOOK_OK);
    assert_int_equal(nook_game_world_create(scene, &world), NOOK_OK);
    nook_log_capture_begin(&log);
    assert_int_equal(nook_play_go_on(&play, level, scene, world), NOOK_OK);
    nook_log_capture_end();
    assert_int_equal(log.level, NOOK_LOG_WARNING); /* the recording ends */
    assert_string_equal(play.level->title, "new");
    nook_session_view after = nook_session_look(play.session);
    assert_memory_equal(before.feet, after.feet, sizeof before.feet);
    assert_true(after.ticks == 30 && after.seconds_left > 99.0);
    for (int i = 0; i < 30; i++)
        assert_int_equal(nook_play_tick(&play, &forward), NOOK_OK);
    assert_int_equal(play.recording.tick_count, 30);
    assert_true(nook_session_look(play.session).feet[2] < before.feet[2] - 0.9);

    nook_scene *next_scene;
    nook_game_world *next_world;
    assert_int_equal(nook_play_read_again(&play, true, &level, &next_scene), NOOK_OK);
    assert_int_equal(nook_game_world_create(next_scene, &next_world), NOOK_OK);
    nook_log_capture_begin(&log);
    assert_int_equal(nook_play_go_on(&play, level, next_scene, next_world), NOOK_OK);
    nook_log_capture_end();
    assert_int_equal(log.count, 0); /* it ended before */
    assert_int_equal(nook_play_close(&play), NOOK_OK);
    nook_game_world_destroy(next_world);
    nook_scene_destroy(next_scene);
    nook_game_world_destroy(world);
    nook_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_inputs_come_from_the_replay_then_the_pilot_then_the_player),
        cmocka_unit_test(test_what_was_played_is_written_when_it_is_closed),
        cmocka_unit_test(test_a_recording_that_cannot_be_written_is_said_before_anything_is_played),
        cmocka_unit_test(test_a_recording_that_cannot_be_written_any_more_is_said),
        cmocka_unit_test(test_a_level_is_the_recorded_one_however_its_path_is_written),
        cmocka_unit_test(test_a_recording_that_lies_beside_its_level_is_played_from_anywhere),
        cmocka_unit_test(test_a_replay_in_a_level_that_was_changed_is_warned_of_once),
        cmocka_unit_test(test_the_tick_of_the_end_and_its_hash_are_kept_until_a_restart),
        cmocka_unit_test(test_a_level_that_changes_on_disk_is_gone_on_in),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
