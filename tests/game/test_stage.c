/* A frame of the program in which GL fails. */
#include "game/compare/camera.h"
#include "game/stage.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

typedef struct fixture {
    nook_stage stage;
    nook_camera camera;
} fixture;

static int set_up(void **state)
{
    static fixture made;
    const char *root = getenv("NOOK_ROOT");
    char scene[4096], label[64];
    snprintf(scene, sizeof scene, "%s/tests/game/data/crate.gltf", root ? root : ".");
    const nook_stage_desc desc = {
        .root = root ? root : ".", .scene_path = scene, .backend = NOOK_BACKEND_OSMESA, .width = 16, .height = 16
    };
    const nook_game_world_desc world = { 16, 0.5, NULL };
    *state = &made;
    return nook_stage_open(&desc, &made.stage) != NOOK_OK || nook_stage_fill(&made.stage, &world) != NOOK_OK ||
           nook_camera_choose(made.stage.scene, NULL, 1.0, &made.camera, label, sizeof label) != NOOK_OK;
}

static int tear_down(void **state)
{
    nook_stage_close(&((fixture *)*state)->stage);
    return 0;
}

static void test_an_error_of_gl_fails_the_frame_it_was_raised_in(void **state)
{
    fixture *f = *state;
    nook_stage *stage = &f->stage;
    assert_int_equal(nook_stage_begin(stage, &f->camera), NOOK_OK);
    assert_int_equal(nook_stage_finish(stage, false, NOOK_VIEW_LIT), NOOK_OK);

    stage->gpu->gl->UseProgram(~0u);
    assert_int_equal(nook_stage_finish(stage, false, NOOK_VIEW_LIT), NOOK_E_DEVICE);
    assert_int_equal(nook_stage_finish(stage, false, NOOK_VIEW_LIT), NOOK_OK); /* told once */
    stage->gpu->gl->UseProgram(~0u);
    assert_int_equal(nook_stage_begin(stage, &f->camera), NOOK_E_DEVICE);
}

/* Mean visibility of the volume technique, and what its volumes take. */
static double mean_visibility(fixture *f, uint64_t *out_volume_bytes)
{
    enum { PIXELS = 16 * 16 };
    float values[PIXELS];
    double sum = 0.0;
    nook_ao_statistics statistics;
    assert_int_equal(nook_ao_set_technique(f->stage.ao, "volume"), NOOK_OK);
    assert_int_equal(nook_ao_set_param(f->stage.ao, "ao.r_max", 0.5), NOOK_OK);
    assert_int_equal(nook_stage_begin(&f->stage, &f->camera), NOOK_OK);
    assert_int_equal(nook_stage_occlude(&f->stage), NOOK_OK);
    nook_ao_texture seen = nook_ao_visibility(f->stage.ao);
    nook_texture texture = { seen.native, GL_TEXTURE_2D, seen.width, seen.height, 1, GL_R32F };
    nook_texture_read(f->stage.gpu, texture, GL_RED, GL_FLOAT, values, sizeof values);
    nook_ao_get_statistics(f->stage.ao, &statistics);
    *out_volume_bytes = statistics.volume_bytes;
    for (int i = 0; i < PIXELS; i++)
        sum += (double)values[i];
    return sum / PIXELS;
}

static void test_a_stage_filled_again_marches_the_new_volumes_and_frees_the_old(void **state)
{
    fixture *f = *state;
    const nook_game_world_desc coarse = { 16, 0.5, NULL }, fine = { 64, 0.5, NULL };
    uint64_t bytes[3];
    double mean[3];
    mean[0] = mean_visibility(f, &bytes[0]);
    assert_int_equal(nook_stage_fill(&f->stage, &fine), NOOK_OK);
    mean[1] = mean_visibility(f, &bytes[1]);
    assert_int_equal(nook_stage_fill(&f->stage, &coarse), NOOK_OK);
    mean[2] = mean_visibility(f, &bytes[2]);
    assert_true(bytes[1] > bytes[0]);
    assert_int_equal(bytes[2], bytes[0]);
    assert_true(mean[0] == mean[2]);
}

static void test_filling_again_keeps_the_exposure(void **state)
{
    fixture *f = *state;
    const nook_game_world_desc world = { 32, 0.5, NULL };
    f->stage.lights.exposure = 3.0f;
    assert_int_equal(nook_stage_fill(&f->stage, &world), NOOK_OK);
    assert_true(f->stage.lights.exposure == 3.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_an_error_of_gl_fails_the_frame_it_was_raised_in, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_stage_filled_again_marches_the_new_volumes_and_frees_the_old, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_filling_again_keeps_the_exposure, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
