#include "game/commands/bench_ecs.h"
#include "game/commands/commands.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include "tests/support/test_gpu.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void test_bench_gives_a_median_between_lowest_and_highest_for_each_step(void **state)
{
    (void)state;
    nook_bench_times times[NOOK_BENCH_STEP_COUNT];
    assert_int_equal(nook_bench_ecs(1000, 4, times), NOOK_OK);
    for (nook_bench_ecs_step step = 0; step < NOOK_BENCH_STEP_COUNT; step++) {
        assert_true(isfinite(times[step].highest));
        assert_true(0 < times[step].lowest);
        assert_true(times[step].lowest <= times[step].median && times[step].median <= times[step].highest);
        for (nook_bench_ecs_step other = 0; other < step; other++)
            assert_string_not_equal(nook_bench_ecs_name(step), nook_bench_ecs_name(other));
    }
}

static void test_bench_refuses_what_it_cannot_time(void **state)
{
    (void)state;
    const nook_app app = { .root = "." };
    assert_int_equal(nook_command_bench(&app, 2, (char *[]){ "bench", "everything", NULL }), NOOK_EXIT_USAGE);
    assert_int_equal(nook_command_bench(&app, 1, (char *[]){ "bench", NULL }), NOOK_EXIT_USAGE);
    assert_int_equal(nook_command_bench(&app, 4, (char *[]){ "bench", "ecs", "--entities", "0", NULL }),
                     NOOK_EXIT_USAGE);
    assert_int_equal(nook_command_bench(&app, 4, (char *[]){ "bench", "ecs", "--entities", "10", NULL }), NOOK_EXIT_OK);
}

static void test_bench_reload_sees_every_file_it_saves(void **state)
{
    (void)state;
    char cache[512], scene[512];
    const nook_app app = { .root = test_gpu_root() }, nowhere = { .root = "no_such_folder" };
    snprintf(scene, sizeof scene, "%s/tests/game/data/crate.gltf", app.root);
    char *arguments[] = { "bench",
                          "reload",
                          scene,
                          "--saves",
                          "1",
                          "--size",
                          "32x18",
                          "--backend",
                          "osmesa",
                          "--cache",
                          nook_scratch_path(cache, sizeof cache, "cache"),
                          NULL };
    assert_int_equal(nook_command_bench(&app, 11, arguments), NOOK_EXIT_OK);
    assert_int_equal(nook_command_bench(&nowhere, 11, arguments), NOOK_EXIT_FAILED);
    arguments[4] = "0";
    assert_int_equal(nook_command_bench(&app, 11, arguments), NOOK_EXIT_USAGE);
}

static void test_bench_times_the_physics_of_a_level(void **state)
{
    (void)state;
    const char *root = getenv("NOOK_ROOT");
    const nook_app app = { .root = root ? root : "." };
    char level[512];
    snprintf(level, sizeof level, "%s/tests/game/data/crate.gltf", app.root);
    assert_int_equal(
        nook_command_bench(&app, 7, (char *[]){ "bench", "physics", level, "--steps", "3", "--crates", "2", NULL }),
        NOOK_EXIT_OK);
    assert_int_equal(nook_command_bench(&app, 4, (char *[]){ "bench", "physics", "--steps", "0", NULL }),
                     NOOK_EXIT_USAGE);
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_command_bench(&app, 3, (char *[]){ "bench", "physics", "no_such.level", NULL }),
                     NOOK_EXIT_FAILED);
    nook_log_capture_end();
    assert_non_null(strstr(log.text, "no_such.level"));
}

static void test_bench_times_few_occluders_and_refuses_settings_that_there_are_not(void **state)
{
    (void)state;
    const nook_app app = { .root = test_gpu_root() };
    char *arguments[] = { "bench",     "occluders", "volume kind=surfel rays=1",
                          "--most",    "4",         "--frames",
                          "1",         "--size",    "16x16",
                          "--backend", "osmesa",    "--pile",
                          "4",         NULL };
    assert_int_equal(nook_command_bench(&app, 13, arguments), NOOK_EXIT_OK);
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_command_bench(&app, 3, (char *[]){ "bench", "occluders", "volume ray=1", NULL }),
                     NOOK_EXIT_USAGE);
    nook_log_capture_end();
    assert_non_null(strstr(log.text, "rays"));
}

static void test_bench_times_what_pixels_reach_and_voxels_cost(void **state)
{
    (void)state;
    char cache[512], scene[512];
    const nook_app app = { .root = test_gpu_root() };
    snprintf(scene, sizeof scene, "%s/tests/game/data/crate.gltf", app.root);
    nook_scratch_path(cache, sizeof cache, "cache");
    char *arguments[] = { "bench", "cost",      scene,    "--frames", "1",   "--size",
                          "24x16", "--backend", "osmesa", "--cache",  cache, NULL };
    assert_int_equal(nook_command_bench(&app, 11, arguments), NOOK_EXIT_OK);
    arguments[4] = "0";
    assert_int_equal(nook_command_bench(&app, 11, arguments), NOOK_EXIT_USAGE);
    arguments[4] = "1", arguments[2] = "no_such.glb";
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_command_bench(&app, 11, arguments), NOOK_EXIT_FAILED);
    nook_log_capture_end();
    assert_non_null(strstr(log.text, "no_such.glb"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bench_gives_a_median_between_lowest_and_highest_for_each_step),
        cmocka_unit_test(test_bench_refuses_what_it_cannot_time),
        cmocka_unit_test(test_bench_reload_sees_every_file_it_saves),
        cmocka_unit_test(test_bench_times_the_physics_of_a_level),
        cmocka_unit_test(test_bench_times_what_pixels_reach_and_voxels_cost),
        cmocka_unit_test(test_bench_times_few_occluders_and_refuses_settings_that_there_are_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
