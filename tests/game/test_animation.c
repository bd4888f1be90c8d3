/* Clips that run in a world, and scenes that stand in one of their poses. */
#include "engine/animation/scene_stand.h"
#include "game/animation.h"
#include "game/moment.h"
#include "game/volumes.h"
#include "game/world.h"
#include "tests/support/bone_scene.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const double origin[3] = { 0, 0, 0 };

/* The systems of an update, without the AO that it submits to. */
static void update(nook_game_world *world)
{
    nook_world *entities = nook_game_world_entities(world);
    assert_int_equal(nook_world_run_phase(entities, NOOK_PHASE_UPDATE), NOOK_OK);
    assert_int_equal(nook_world_run_phase(entities, NOOK_PHASE_PRE_RENDER), NOOK_OK);
}

static void test_time_that_passes_bends_the_arm_and_comes_around(void **state)
{
    (void)state;
    nook_scene *scene = bone_scene_load(origin);
    nook_game_world *world;
    uint32_t version, before;
    assert_int_equal(nook_game_world_create(scene, &world), NOOK_OK);
    update(world);
    const nook_mesh_pose *poses = nook_game_world_poses(world, &before);
    assert_non_null(poses);
    assert_true(before != 0 && poses[0].weights[0] == 0.0f);
    nook_game_world_advance(world, 0.75);
    nook_game_world_advance(world, 0.25);
    update(world);
    nook_game_world_poses(world, &version);
    assert_true(version != before && poses[0].weights[0] == 0.5f);
    nook_game_world_advance(world, 1.5); /* 2.5 of 2 seconds */
    update(world);
    assert_true(fabsf(poses[0].weights[0] - 0.25f) < 1e-6f);
    nook_game_world_advance(world, -2.5);
    update(world);
    assert_true(poses[0].weights[0] == 0.0f);
    nook_game_world_destroy(world);
    nook_scene_destroy(scene);
}

static void test_a_pose_keeps_its_version_while_no_time_passes(void **state)
{
    (void)state;
    nook_scene *scene = bone_scene_load(origin);
    nook_game_world *world;
    uint32_t before, after;
    assert_int_equal(nook_game_world_create(scene, &world), NOOK_OK);
    update(world);
    nook_game_world_poses(world, &before);
    update(world);
    nook_game_world_poses(world, &after);
    assert_int_equal(before, after);
    nook_game_world_destroy(world);
    nook_scene_destroy(scene);
}

static void test_a_scene_without_motion_has_no_poses(void **state)
{
    (void)state;
    nook_scene *scene = bone_scene_load(origin);
    nook_game_world *world;
    uint32_t version;
    assert_int_equal(nook_scene_stand_still(scene, NOOK_NONE, 0.0), NOOK_OK);
    assert_int_equal(nook_game_world_create(scene, &world), NOOK_OK);
    nook_game_world_advance(world, 1.0);
    update(world);
    assert_null(nook_game_world_poses(world, &version));
    assert_int_equal(version, 0);
    nook_game_world_destroy(world);
    nook_scene_destroy(scene);
}

/* ---- Volumes ----------------------------------------------------------------------------------------------------- */

static nook_scene_volumes bake(const nook_scene *scene, nook_log_capture *log)
{
    nook_scene_volumes volumes = { 0 };
    const nook_volumes_desc desc = { .resolution = 32, .r_max = 0.5, .threads = 1 };
    nook_log_capture_begin(log);
    assert_int_equal(nook_volumes_bake(scene, &desc, &volumes), NOOK_OK);
    nook_log_capture_end();
    return volumes;
}

static void test_what_bends_while_it_plays_is_not_baked(void **state)
{
    (void)state;
    nook_log_capture log;
    nook_scene *scene = bone_scene_load(origin);
    nook_scene_volumes volumes = bake(scene, &log);
    assert_int_equal(volumes.volume_count, 0);
    nook_volumes_free(&volumes);
    nook_scene_destroy(scene);
}

static void test_what_stands_in_a_pose_has_the_volume_of_that_pose(void **state)
{
    (void)state;
    nook_log_capture log;
    nook_scene *scene = bone_scene_load(origin);
    const nook_moment moment = { .timed = true, .seconds = 2.0 };
    assert_int_equal(nook_moment_stand_still(scene, &moment), NOOK_OK);
    nook_scene_volumes volumes = bake(scene, &log);
    assert_int_equal(volumes.volume_count, 1);
    /* 1.1 m wide and 2.1 m high, where the arm at rest is 0.2 m and 2 m. */
    const nook_volume_info *info = &volumes.volumes[0].bakes[NOOK_VOLUME_BINARY].info;
    assert_true(fabs(info->voxel_size * (info->width - 2.0) - 1.1) < 2.0 * info->voxel_size);
    assert_true(fabs(info->voxel_size * (info->height - 2.0) - 2.1) < 2.0 * info->voxel_size);
    nook_volumes_free(&volumes);
    nook_scene_destroy(scene);
}

/* ---- Moments ----------------------------------------------------------------------------------------------------- */

static void test_a_clip_that_is_not_there_is_refused_with_the_nearest_name(void **state)
{
    (void)state;
    nook_log_capture log;
    nook_scene *scene = bone_scene_load(origin);
    uint32_t clip = 77;
    nook_log_capture_begin(&log);
    nook_result result = nook_moment_clip(scene, &(nook_moment){ .clip = "bent" }, &clip);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_NOT_FOUND);
    assert_non_null(strstr(log.text, "did you mean bend?"));
    assert_int_equal(clip, 77);
    assert_int_equal(nook_moment_clip(scene, &(nook_moment){ .clip = "bend" }, &clip), NOOK_OK);
    assert_int_equal(clip, 0);
    assert_int_equal(nook_moment_clip(scene, &(nook_moment){ .timed = false }, &clip), NOOK_OK);
    assert_int_equal(clip, NOOK_NONE);
    nook_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_time_that_passes_bends_the_arm_and_comes_around),
        cmocka_unit_test(test_a_pose_keeps_its_version_while_no_time_passes),
        cmocka_unit_test(test_a_scene_without_motion_has_no_poses),
        cmocka_unit_test(test_what_bends_while_it_plays_is_not_baked),
        cmocka_unit_test(test_what_stands_in_a_pose_has_the_volume_of_that_pose),
        cmocka_unit_test(test_a_clip_that_is_not_there_is_refused_with_the_nearest_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
