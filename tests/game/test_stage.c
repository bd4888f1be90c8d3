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

static void test_an_error_of_gl_fails_the_frame_it_was_raised_in(void **state)
{
    (void)state;
    const char *root = getenv("NOOK_ROOT");
    char scene[4096];
    nook_stage stage;
    nook_camera camera;
    char label[64];
    snprintf(scene, sizeof scene, "%s/tests/game/data/crate.gltf", root ? root : ".");
    const nook_stage_desc desc = {
        .root = root ? root : ".", .scene_path = scene, .backend = NOOK_BACKEND_OSMESA, .width = 16, .height = 16
    };
    assert_int_equal(nook_stage_open(&desc, &stage), NOOK_OK);
    const nook_game_world_desc world = { 16, 0.5, NULL };
    assert_int_equal(nook_stage_fill(&stage, &world), NOOK_OK);
    assert_int_equal(nook_camera_choose(stage.scene, NULL, 1.0, &camera, label, sizeof label), NOOK_OK);
    assert_int_equal(nook_stage_begin(&stage, &camera), NOOK_OK);
    assert_int_equal(nook_stage_finish(&stage, false, NOOK_VIEW_LIT), NOOK_OK);

    stage.gpu->gl->UseProgram(~0u);
    assert_int_equal(nook_stage_finish(&stage, false, NOOK_VIEW_LIT), NOOK_E_DEVICE);
    assert_int_equal(nook_stage_finish(&stage, false, NOOK_VIEW_LIT), NOOK_OK); /* told once */
    stage.gpu->gl->UseProgram(~0u);
    assert_int_equal(nook_stage_begin(&stage, &camera), NOOK_E_DEVICE);
    nook_stage_close(&stage);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_an_error_of_gl_fails_the_frame_it_was_raised_in) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
