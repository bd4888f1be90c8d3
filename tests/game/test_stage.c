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

static void choose_kind(fixture *f, const char *kind)
{
    assert_int_equal(nook_ao_parse_param(f->stage.ao, "volume.kind", kind), NOOK_OK);
}

static void test_kinds_of_volumes_are_baked_when_they_are_marched_and_no_others(void **state)
{
    fixture *f = *state;
    uint64_t bytes;
    nook_game_world *world = f->stage.world;
    assert_int_equal(nook_game_world_kinds(world), NOOK_VOLUME_BIT(NOOK_VOLUME_BINARY));
    double binary = mean_visibility(f, &bytes);
    assert_int_equal(nook_game_world_kinds(world), NOOK_VOLUME_BIT(NOOK_VOLUME_BINARY));
    choose_kind(f, "surfel");
    double surfel = mean_visibility(f, &bytes);
    assert_true(surfel < 1.0 && surfel != binary && bytes > 0);
    uint32_t both = NOOK_VOLUME_BIT(NOOK_VOLUME_BINARY) | NOOK_VOLUME_BIT(NOOK_VOLUME_SURFEL), count;
    assert_int_equal(nook_game_world_kinds(world), both);
    const nook_world_volume *volumes = nook_game_world_volumes(world, &count);
    for (uint32_t i = 0; i < count; i++)
        assert_true(nook_world_volume_sum(&volumes[i], both).bytes > nook_world_volume_sum(&volumes[i], 1).bytes);
    choose_kind(f, "binary");
    assert_true(mean_visibility(f, &bytes) == binary);

    const nook_game_world_desc desc = { 16, 0.5, NULL };
    choose_kind(f, "surfel");
    assert_int_equal(nook_stage_fill(&f->stage, &desc), NOOK_OK); /* filled with what is marched now */
    assert_int_equal(nook_game_world_kinds(f->stage.world), NOOK_VOLUME_BIT(NOOK_VOLUME_SURFEL));
    assert_true(mean_visibility(f, &bytes) == surfel);
}

static nook_result refuse(void *user, uint32_t kinds)
{
    *(uint32_t *)user = kinds;
    return NOOK_E_MEMORY;
}

static void test_a_record_fails_when_volumes_that_it_marches_cannot_be_had(void **state)
{
    fixture *f = *state;
    uint32_t asked = 0;
    uint64_t bytes;
    mean_visibility(f, &bytes);
    nook_ao_set_supply(f->stage.ao, refuse, &asked);
    assert_int_equal(nook_stage_occlude(&f->stage), NOOK_OK);
    assert_int_equal(asked, 0); /* nothing is missing */
    choose_kind(f, "surfel");
    assert_int_equal(nook_stage_occlude(&f->stage), NOOK_E_MEMORY);
    assert_int_equal(asked, NOOK_VOLUME_BIT(NOOK_VOLUME_SURFEL));
    nook_ao_set_supply(f->stage.ao, NULL, NULL);
    assert_int_equal(nook_stage_occlude(&f->stage), NOOK_OK); /* left out, when nobody can be asked */
}

static void test_filling_again_keeps_the_exposure(void **state)
{
    fixture *f = *state;
    const nook_game_world_desc world = { 32, 0.5, NULL };
    f->stage.lights.exposure = 3.0f;
    assert_int_equal(nook_stage_fill(&f->stage, &world), NOOK_OK);
    assert_true(f->stage.lights.exposure == 3.0f);
}

static uint32_t traced(const fixture *f)
{
    nook_ao_statistics statistics;
    nook_ao_get_statistics(f->stage.ao, &statistics);
    return statistics.traced;
}

static void test_settling_makes_all_means_whole_whatever_was_drawn_before(void **state)
{
    enum { PIXELS = 16 * 16 };
    static float first[PIXELS], again[PIXELS];
    fixture *f = *state;
    nook_stage *stage = &f->stage;
    assert_int_equal(nook_ao_set_technique(stage->ao, "volume"), NOOK_OK);
    assert_int_equal(nook_ao_set_param(stage->ao, "ao.accumulate", 3.0), NOOK_OK);
    assert_int_equal(nook_ao_set_param(stage->ao, "ao.reuse", 2.0), NOOK_OK);
    assert_int_equal(nook_stage_begin(stage, &f->camera), NOOK_OK);
    for (int before = 1; before <= 2; before++) {
        for (int i = 0; i < before; i++)
            assert_int_equal(nook_stage_occlude(stage), NOOK_OK);
        assert_int_equal(nook_stage_settle(stage), NOOK_OK);
        nook_texture_read(stage->gpu, nook_stage_visibility(stage), GL_RED, GL_FLOAT, before == 1 ? first : again,
                          sizeof first);
        assert_int_equal(nook_stage_occlude(stage), NOOK_OK);
        assert_int_equal(traced(f), 0);
    }
    assert_memory_equal(first, again, sizeof first);
    nook_stage_begin_means(stage);
    assert_int_equal(nook_stage_occlude(stage), NOOK_OK);
    assert_true(traced(f) > 0 && traced(f) != UINT32_MAX);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_an_error_of_gl_fails_the_frame_it_was_raised_in, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_stage_filled_again_marches_the_new_volumes_and_frees_the_old, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_kinds_of_volumes_are_baked_when_they_are_marched_and_no_others, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_a_record_fails_when_volumes_that_it_marches_cannot_be_had, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_settling_makes_all_means_whole_whatever_was_drawn_before, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_filling_again_keeps_the_exposure, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
