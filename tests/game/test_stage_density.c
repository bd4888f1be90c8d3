/* A scalar field that a scene names, from its file to the picture. */
#include "engine/asset/scalar_medium.h"
#include "engine/core/file.h"
#include "game/compare/camera.h"
#include "game/measure/scene_hash.h"
#include "game/stage.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_glb.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 16 };

/* A floor of 1 m, seen from 1 m, in a cube of 8 m whose samples are all 64: at `high` that field is opaque along 0.125 of its units,
   which are 4 m. @return the scene's path */
static const char *write_scene(const char *high)
{
    test_glb glb = { 0 };
    char field[256], members[1024];
    int size =
        snprintf(field, sizeof field,
                 "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nspacings: 1 1 1\nencoding: raw\n\n@@@@@@@@");
    test_bytes_write("even.nrrd", field, (size_t)size);
    static const uint32_t indices[] = { 0, 1, 2, 2, 1, 3 };
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    test_glb_add(&glb, indices, sizeof indices);
    snprintf(
        members, sizeof members,
        "'scenes': [ { 'nodes': [ 0, 1, 2 ] } ], 'nodes': [ { 'mesh': 0 }, { 'camera': 0, 'translation': [ 0.5, 0.5, 1 "
        "] }, "
        "{ 'name': 'even', 'translation': [ -3.5, -3.5, -4 ], 'scale': [ 4, 4, 4 ], 'extras': { 'nook_density': "
        "{ 'file': 'even.nrrd', 'window': [ 0, %s ], 'length': 0.125 } } } ], 'cameras': [ { 'type': 'perspective', "
        "'perspective': { 'yfov': 0.5, 'znear': 0.1 } } ], 'meshes': [ { 'primitives': [ { 'attributes': { 'POSITION': "
        "0 }, "
        "'indices': 1 } ] } ], 'accessors': [ " TEST_GLB_QUAD_POSITIONS
        ", { 'bufferView': 1, 'componentType': 5125, 'count': 6, 'type': 'SCALAR' } ]",
        high);
    return test_glb_write(&glb, members);
}

static void open_stage(const char *path, nook_stage *out_stage)
{
    const char *root = getenv("NOOK_ROOT");
    const nook_stage_desc desc = {
        .root = root ? root : ".", .scene_path = path, .backend = NOOK_BACKEND_OSMESA, .width = SIDE, .height = SIDE
    };
    assert_int_equal(nook_stage_open(&desc, out_stage), NOOK_OK);
}

static void fill(nook_stage *stage)
{
    const nook_game_world_desc world = { 16, 0.5, NULL };
    assert_int_equal(nook_stage_fill(stage, &world), NOOK_OK);
}

/* @param camera  NULL: the scene's */
static double mean_visibility_from(nook_stage *stage, const char *technique, const char *camera_text, const char *r_max)
{
    float values[SIDE * SIDE];
    double sum = 0.0;
    char label[64];
    nook_camera camera;
    assert_int_equal(nook_camera_choose(stage->scene, camera_text, 1.0, &camera, label, sizeof label), NOOK_OK);
    assert_int_equal(nook_ao_set_technique(stage->ao, technique), NOOK_OK);
    assert_int_equal(nook_ao_parse_param(stage->ao, "ao.r_max", r_max), NOOK_OK);
    assert_int_equal(nook_ao_parse_param(stage->ao, "ao.falloff", "hard"), NOOK_OK);
    assert_int_equal(nook_stage_begin(stage, &camera), NOOK_OK);
    assert_int_equal(nook_stage_occlude(stage), NOOK_OK);
    nook_texture_read(stage->gpu, nook_stage_visibility(stage), GL_RED, GL_FLOAT, values, sizeof values);
    for (int i = 0; i < SIDE * SIDE; i++)
        sum += (double)values[i];
    return sum / (SIDE * SIDE);
}

static double mean_visibility(nook_stage *stage, const char *technique)
{
    return mean_visibility_from(stage, technique, NULL, "0.5");
}

/* 64 of 128 is opaque by half along 0.125 units, 0.5 m: as far as rays go. */
static void test_a_field_around_a_floor_lets_through_what_its_window_says(void **state)
{
    (void)state;
    nook_stage stage;
    uint32_t count;
    open_stage(write_scene("128"), &stage);
    assert_int_equal(nook_ao_parse_param(stage.ao, "volume.kind", "density"), NOOK_OK);
    fill(&stage);
    assert_true(fabs(mean_visibility(&stage, "volume") - 0.5) < 0.005);
    assert_true(fabs(mean_visibility(&stage, "reference") - 0.5) < 0.02);
    const nook_world_volume *volumes = nook_game_world_volumes(stage.world, &count);
    assert_int_equal(count, 2);
    assert_string_equal(volumes[1].name, "even");
    assert_int_equal(volumes[1].width, 2 + 2); /* none finer than the samples */
    nook_stage_close(&stage);
}

static void test_where_no_technique_marches_densities_that_is_said(void **state)
{
    (void)state;
    nook_stage stage;
    nook_log_capture log;
    open_stage(write_scene("128"), &stage);
    nook_log_capture_begin(&log);
    fill(&stage);
    nook_log_capture_end();
    assert_int_equal(log.errors, 0);
    assert_non_null(strstr(log.text, "even: a density is seen by the reference"));
    assert_true(mean_visibility(&stage, "volume") > 0.99); /* binary: only the floor */
    assert_true(fabs(mean_visibility(&stage, "reference") - 0.5) < 0.02);
    assert_int_equal(nook_ao_parse_param(stage.ao, "volume.kind", "density"), NOOK_OK); /* chosen later */
    assert_true(fabs(mean_visibility(&stage, "volume") - 0.5) < 0.005);
    nook_stage_close(&stage);
}

static void test_live_volumes_leave_a_field_to_the_reference(void **state)
{
    (void)state;
    nook_stage stage;
    open_stage(write_scene("128"), &stage);
    stage.live_scene = true;
    fill(&stage);
    assert_true(mean_visibility(&stage, "volume") > 0.99);
    assert_true(fabs(mean_visibility(&stage, "reference") - 0.5) < 0.02);
    nook_stage_close(&stage);
}

static void test_another_window_is_another_scene_to_truths_that_were_kept(void **state)
{
    (void)state;
    nook_scene *one = test_scene_must_load(write_scene("128"));
    nook_scene *same = test_scene_must_load(write_scene("128"));
    nook_scene *other = test_scene_must_load(write_scene("129"));
    assert_true(nook_scene_hash(one) == nook_scene_hash(same));
    assert_true(nook_scene_hash(one) != nook_scene_hash(other));
    nook_scene_destroy(one);
    nook_scene_destroy(same);
    nook_scene_destroy(other);
}

/* What the larger ball of content/soft_balls lets through to the floor's point straight under it, by the formula that its samples are
   made with: cosine-weighted over directions that are `slope` radians off upright. */
static double visibility_under_ball(double r_max)
{
    enum { SLOPES = 200, STEPS = 400 };
    const nook_scalar_transfer transfer = { 0.0, 300.0, 0.1 };
    const double height = 0.6, radius = 0.55, quarter_turn = 1.5707963267948966;
    double sum = 0.0;
    for (int i = 0; i < SLOPES; i++) {
        double slope = quarter_turn * (i + 0.5) / SLOPES, depth = 0.0;
        for (int k = 0; k < STEPS; k++) {
            double along = r_max * (k + 0.5) / STEPS;
            double x = along * sin(slope), y = along * cos(slope) - height;
            double inside = fmax(1.0 - (x * x + y * y) / (radius * radius), 0.0);
            depth += nook_scalar_extinction(&transfer, 255.0 * inside * inside) * r_max / STEPS;
        }
        sum += 2.0 * sin(slope) * cos(slope) * exp(-depth) * quarter_turn / SLOPES;
    }
    return sum;
}

static void test_the_floor_under_a_soft_ball_is_as_dark_as_its_formula_says(void **state)
{
    (void)state;
    static const char under[] = "-0.6,2,0,-0.6,0,-0.001,1";
    const char *root = getenv("NOOK_ROOT");
    char path[1024];
    nook_stage stage;
    nook_path_join(path, sizeof path, root ? root : ".", "content/soft_balls/soft_balls.gltf");
    open_stage(path, &stage);
    assert_int_equal(stage.scene->warning_count, 0);
    assert_int_equal(nook_ao_parse_param(stage.ao, "volume.kind", "density"), NOOK_OK);
    assert_int_equal(nook_ao_parse_param(stage.ao, "volume.rays", "64"), NOOK_OK);
    assert_int_equal(nook_stage_fill(&stage, &(nook_game_world_desc){ 128, 0.6, NULL }), NOOK_OK);
    double expected = visibility_under_ball(0.6);
    assert_true(expected > 0.3 && expected < 0.9); /* there is something to get wrong */
    double seen = mean_visibility_from(&stage, "volume", under, "0.6");
    double truth = mean_visibility_from(&stage, "reference", under, "0.6");
    if (fabs(seen - expected) >= 0.01 || fabs(truth - expected) >= 0.015)
        fail_msg("volume %g, reference %g, formula %g", seen, truth, expected);
    nook_stage_close(&stage);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_field_around_a_floor_lets_through_what_its_window_says),
        cmocka_unit_test(test_where_no_technique_marches_densities_that_is_said),
        cmocka_unit_test(test_live_volumes_leave_a_field_to_the_reference),
        cmocka_unit_test(test_another_window_is_another_scene_to_truths_that_were_kept),
        cmocka_unit_test(test_the_floor_under_a_soft_ball_is_as_dark_as_its_formula_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
