/* A scene whose bodies are voxelised together as they move, instead of being baked one by one. */
#include "game/compare/camera.h"
#include "game/stage.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 48, PIXELS = SIDE * SIDE };

static const double r_max = 0.5;

typedef struct fixture {
    nook_stage stage;
    nook_camera camera;
    float visibility[PIXELS];
} fixture;

static void fill(fixture *f, bool live)
{
    const nook_game_world_desc world = { 64, r_max, NULL };
    f->stage.live_scene = live;
    assert_int_equal(nook_stage_fill(&f->stage, &world), NOOK_OK);
}

static int set_up(void **state)
{
    static fixture made;
    const char *root = getenv("NOOK_ROOT");
    char scene[4096], label[64];
    snprintf(scene, sizeof scene, "%s/tests/game/data/crate.gltf", root ? root : ".");
    const nook_stage_desc desc = {
        .root = root ? root : ".", .scene_path = scene, .backend = NOOK_BACKEND_OSMESA, .width = SIDE, .height = SIDE
    };
    *state = &made;
    return nook_stage_open(&desc, &made.stage) != NOOK_OK ||
           nook_camera_choose(made.stage.scene, NULL, 1.0, &made.camera, label, sizeof label) != NOOK_OK ||
           nook_ao_set_technique(made.stage.ao, "volume") != NOOK_OK ||
           nook_ao_set_param(made.stage.ao, "ao.r_max", r_max) != NOOK_OK;
}

static int tear_down(void **state)
{
    nook_stage_close(&((fixture *)*state)->stage);
    return 0;
}

static double record(fixture *f)
{
    double sum = 0.0;
    assert_int_equal(nook_stage_begin(&f->stage, &f->camera), NOOK_OK);
    assert_int_equal(nook_stage_occlude(&f->stage), NOOK_OK);
    nook_texture_read(f->stage.gpu, nook_stage_visibility(&f->stage), GL_RED, GL_FLOAT, f->visibility,
                      sizeof f->visibility);
    for (int i = 0; i < PIXELS; i++)
        sum += (double)f->visibility[i];
    return sum / PIXELS;
}

/* Lifts the first body that moves. */
static void lift(fixture *f, double by)
{
    nook_stage *stage = &f->stage;
    for (uint32_t i = 0; i < stage->scene->node_count; i++) {
        if (!stage->scene->nodes[i].moving || stage->scene->nodes[i].mesh == NOOK_NONE)
            continue;
        nook_entity entity = nook_game_world_entity_of_node(stage->world, i);
        nook_transform *transform = nook_entity_find(nook_game_world_entities(stage->world), entity,
                                                     nook_game_world_components(stage->world)->transform);
        transform->world_from_local[13] = stage->scene->nodes[i].world_from_local.m[13] + by;
        return;
    }
    fail_msg("nothing moves");
}

static void test_a_scene_voxelised_as_it_is_darkens_like_a_baked_one(void **state)
{
    fixture *f = *state;
    static float baked[PIXELS];
    fill(f, false);
    double baked_mean = record(f), square = 0.0;
    memcpy(baked, f->visibility, sizeof baked);
    fill(f, true);
    double live_mean = record(f);
    assert_true(nook_game_world_live_scene(f->stage.world)->voxelized);
    for (int i = 0; i < PIXELS; i++)
        square += ((double)f->visibility[i] - (double)baked[i]) * ((double)f->visibility[i] - (double)baked[i]);
    print_message("mean %.4f baked, %.4f live, RMS difference %.4f\n", baked_mean, live_mean, sqrt(square / PIXELS));
    assert_true(baked_mean < 0.99);
    assert_true(fabs(live_mean - baked_mean) < 0.02);
    assert_true(sqrt(square / PIXELS) < 0.05);
}

static void test_it_is_made_anew_when_a_body_has_moved_and_only_then(void **state)
{
    fixture *f = *state;
    static float before[PIXELS], lifted[PIXELS];
    fill(f, true);
    const nook_live_scene *live = nook_game_world_live_scene(f->stage.world);
    record(f);
    memcpy(before, f->visibility, sizeof before);
    record(f);
    assert_false(live->voxelized);
    assert_memory_equal(f->visibility, before, sizeof before);
    lift(f, 0.2);
    record(f);
    assert_true(live->voxelized);
    memcpy(lifted, f->visibility, sizeof lifted);
    assert_memory_not_equal(lifted, before, sizeof before);
    lift(f, 0.0);
    record(f);
    assert_true(live->voxelized);
    assert_memory_equal(f->visibility, before, sizeof before);
}

static void test_kinds_that_nobody_voxelises_on_the_gpu_are_refused_in_one_line(void **state)
{
    fixture *f = *state;
    const nook_game_world_desc world = { 64, r_max, NULL };
    nook_log_capture log;
    f->stage.live_scene = true;
    assert_int_equal(nook_ao_parse_param(f->stage.ao, "volume.kind", "surfel"), NOOK_OK);
    nook_log_capture_begin(&log);
    assert_int_equal(nook_stage_fill(&f->stage, &world), NOOK_E_ARG);
    nook_log_capture_end();
    assert_int_equal(log.count, 1);
    assert_non_null(strstr(log.text, "take volume.kind = binary, or volumes = baked"));
}

/* Half of the side from -0.1 to 1 is no float; the nearest one is longer. */
static void test_as_many_voxels_as_there_may_be_hold_a_side_that_is_no_float(void **state)
{
    fixture *f = *state;
    static const float corners[3][3] = { { -0.1f, 0.0f, 0.0f }, { 1.0f, 0.0f, 0.0f }, { 0.0f, 0.0f, 0.5f } };
    static const uint32_t indices[3] = { 0, 1, 2 };
    nook_scene *scene;
    nook_live_scene live;
    assert_int_equal(nook_scene_from_triangles("side", corners[0], 3, indices, 3, &scene), NOOK_OK);
    assert_int_equal(nook_live_scene_create(f->stage.ao, scene, NOOK_AO_LIVE_SIDE_MAX, &live), NOOK_OK);
    assert_int_equal(live.size[0], NOOK_AO_LIVE_SIDE_MAX);
    nook_live_scene_destroy(f->stage.ao, &live);
    nook_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_a_scene_voxelised_as_it_is_darkens_like_a_baked_one, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_it_is_made_anew_when_a_body_has_moved_and_only_then, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_as_many_voxels_as_there_may_be_hold_a_side_that_is_no_float, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_kinds_that_nobody_voxelises_on_the_gpu_are_refused_in_one_line, set_up,
                                        tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
