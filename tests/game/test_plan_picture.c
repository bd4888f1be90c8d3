/* Pictures with a plan and without: what is proven holds pixel by pixel. */
#include "game/compare/camera.h"
#include "game/plan/plan_describe.h"
#include "game/stage.h"
#include "tests/support/test_glb.h"
#include "tests/support/test_gpu.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 48, HEIGHT = 32, PIXELS = WIDTH * HEIGHT, TEXT = 65536 };

typedef struct picture {
    float values[PIXELS];
} picture;

/* ---- Scenes ----------------------------------------------------------------------------------------------------- */

static void write_cube(void)
{
    static const uint16_t faces[36] = { 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                        2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 };
    uint8_t bytes[8 * 12 + sizeof faces];
    for (uint32_t i = 0; i < 8; i++) {
        const float corner[3] = { i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 0.5f : -0.5f };
        memcpy(bytes + i * 12, corner, sizeof corner);
    }
    memcpy(bytes + 96, faces, sizeof faces);
    test_bytes_write("cube.bin", bytes, sizeof bytes);
}

/* A floor of 8 m, and cubes in rows, layers and columns over its middle, so far apart. @return the file's path */
static const char *write_cubes(int rows, int layers, double side, double apart, double lowest)
{
    static char text[TEXT], nodes[TEXT / 2];
    size_t used = 0;
    int count = 0;
    write_cube();
    for (int y = 0; y < layers; y++)
        for (int z = 0; z < rows; z++)
            for (int x = 0; x < rows; x++, count++)
                used += (size_t)snprintf(nodes + used, sizeof nodes - used,
                                         ",{'mesh':0,'scale':[%g,%g,%g],'translation':[%.4f,%.4f,%.4f]}", side, side,
                                         side, apart * (x - 0.5 * (rows - 1)) + 0.013 * y, lowest + apart * y,
                                         apart * (z - 0.5 * (rows - 1)));
    used = (size_t)snprintf(text, sizeof text, "{'asset':{'version':'2.0'},'scene':0,'scenes':[{'nodes':[0");
    for (int i = 0; i < count; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, ",%d", i + 1);
    snprintf(text + used, sizeof text - used,
             "]}],'nodes':[{'mesh':0,'scale':[8,0.1,8],'translation':[0,-0.05,0],'extras':{'nook_body':false}}%s],"
             "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}],"
             "'accessors':[{'bufferView':0,'componentType':5126,'count':8,'type':'VEC3','min':[-0.5,-0.5,-0.5],"
             "'max':[0.5,0.5,0.5]},{'bufferView':1,'componentType':5123,'count':36,'type':'SCALAR'}],"
             "'bufferViews':[{'buffer':0,'byteLength':96},{'buffer':0,'byteOffset':96,'byteLength':72}],"
             "'buffers':[{'uri':'cube.bin','byteLength':168}]}",
             nodes);
    return test_gltf_write("cubes.gltf", text);
}

/* ---- Pictures --------------------------------------------------------------------------------------------------- */

typedef struct shot {
    const char *scene, *camera, *technique;
    uint32_t resolution, rays;
    double r_max;
    nook_plan_params plan;
    const char *later; /* a kind of volume that is asked for when the picture has been taken, or NULL */
} shot;

static void take(const shot *s, picture *out, uint32_t *out_volumes, uint32_t *out_marched)
{
    char label[64], rays[64];
    nook_stage stage;
    nook_camera camera;
    const nook_stage_desc desc = { .root = test_gpu_root(),
                                   .scene_path = s->scene,
                                   .backend = NOOK_BACKEND_OSMESA,
                                   .width = WIDTH,
                                   .height = HEIGHT };
    const nook_game_world_desc world = { s->resolution, s->r_max, NULL };
    assert_int_equal(nook_stage_open(&desc, &stage), NOOK_OK);
    stage.plan = s->plan;
    snprintf(rays, sizeof rays, "%s.rays", s->technique);
    assert_int_equal(nook_ao_set_technique(stage.ao, s->technique), NOOK_OK);
    assert_int_equal(nook_ao_set_param(stage.ao, "ao.r_max", s->r_max), NOOK_OK);
    assert_int_equal(nook_ao_parse_param(stage.ao, "ao.filter", "none"), NOOK_OK);
    assert_int_equal(nook_ao_set_param(stage.ao, rays, s->rays), NOOK_OK);
    assert_int_equal(nook_stage_fill(&stage, &world), NOOK_OK);
    assert_int_equal(nook_camera_choose(stage.scene, s->camera, (double)WIDTH / HEIGHT, &camera, label, sizeof label),
                     NOOK_OK);
    assert_int_equal(nook_stage_begin(&stage, &camera), NOOK_OK);
    assert_int_equal(nook_stage_occlude(&stage), NOOK_OK);
    nook_texture seen = nook_stage_visibility(&stage);
    nook_texture_read(stage.gpu, seen, GL_RED, GL_FLOAT, out->values, sizeof out->values);
    nook_ao_statistics statistics;
    nook_ao_get_statistics(stage.ao, &statistics);
    *out_marched = statistics.occluders;
    nook_game_world_volumes(stage.world, out_volumes);
    if (s->later) {
        assert_int_equal(nook_ao_parse_param(stage.ao, "volume.kind", s->later), NOOK_OK);
        assert_int_equal(nook_stage_occlude(&stage), NOOK_OK);
        nook_ao_get_statistics(stage.ao, &statistics);
        assert_int_equal(statistics.occluders, *out_marched); /* planned alike */
    }
    nook_stage_close(&stage);
}

/* The plan that the stage makes, for what it promises. */
static nook_plan plan_of(const shot *s)
{
    const nook_volumes_desc desc = { .resolution = s->resolution, .r_max = s->r_max };
    const nook_plan_situation still = { .moves = false };
    nook_scene *scene;
    nook_scene_volumes volumes;
    nook_plan_description description;
    nook_plan plan;
    assert_int_equal(nook_scene_load(s->scene, NULL, &scene), NOOK_OK);
    assert_int_equal(nook_volumes_collect(scene, &desc, &volumes), NOOK_OK);
    assert_int_equal(nook_plan_describe(scene, &volumes, (uint32_t)s->plan.rays, &still, &description), NOOK_OK);
    assert_int_equal(nook_plan_make(&description.scene, &s->plan, &plan), NOOK_OK);
    nook_plan_description_free(&description);
    nook_volumes_free(&volumes);
    nook_scene_destroy(scene);
    return plan;
}

static uint32_t count_left_out(const nook_plan *plan)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < plan->occluder_count; i++)
        count += plan->occluders[i].rule != NOOK_PLAN_KEPT;
    return count;
}

static double largest_difference(const picture *a, const picture *b)
{
    double most = 0.0;
    for (int i = 0; i < PIXELS; i++)
        most = fmax(most, fabs((double)a->values[i] - (double)b->values[i]));
    return most;
}

/* A picture as it comes and as planned: [0] and [1]. */
typedef struct comparison {
    nook_plan plan; /* of the second; nook_plan_free */
    uint32_t left_out, marched[2], volumes[2];
    double difference; /* the largest of a pixel */
} comparison;

static comparison compare(const char *scene, shot planned)
{
    static picture pictures[2];
    char path[1024];
    comparison got;
    snprintf(path, sizeof path, "%s", scene); /* what wrote it may write another */
    planned.scene = path;
    shot plain = planned;
    plain.plan.mode = NOOK_PLAN_OFF;
    got.plan = plan_of(&planned);
    got.left_out = count_left_out(&got.plan);
    take(&plain, &pictures[0], &got.volumes[0], &got.marched[0]);
    take(&planned, &pictures[1], &got.volumes[1], &got.marched[1]);
    got.difference = largest_difference(&pictures[0], &pictures[1]);
    return got;
}

/* ---- Tests ------------------------------------------------------------------------------------------------------ */

static shot cubes_shot(uint32_t rays, float error)
{
    shot s = { .camera = "5,3,5,0,0.6,0,40", .technique = "volume", .resolution = 64, .rays = rays, .r_max = 2.0 };
    s.plan = nook_plan_params_initial();
    s.plan.mode = NOOK_PLAN_ON;
    s.plan.error = error;
    return s;
}

static const char *hall_path(void)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/content/hall/hall.glb", test_gpu_root());
    return path;
}

static void test_many_small_bodies_change_no_pixel_of_so_many_rays_by_more_than_the_bound(void **state)
{
    (void)state;
    shot s = cubes_shot(128, 0.1f);
    s.plan.rays = 128;
    s.later = "surfel";
    comparison got = compare(write_cubes(9, 2, 0.02, 0.8, 0.9), s);
    assert_true(got.left_out > 20);
    assert_int_equal(got.marched[0], 163);
    assert_int_equal(got.marched[1], 163 - got.left_out);
    assert_true(got.plan.bound <= 0.1 + 1e-6);
    assert_true(got.difference > 0.0); /* it is seen that they are gone */
    assert_true(got.difference <= got.plan.bound + 1e-6);
    nook_plan_free(&got.plan);
}

static void test_a_body_of_some_size_takes_of_the_integral_what_its_bound_says_and_not_a_fifth_of_it_only(void **state)
{
    (void)state;
    comparison got = compare(write_cubes(1, 1, 0.2, 1.0, 1.0), cubes_shot(1024, 1.0f));
    assert_int_equal(got.left_out, 1);
    assert_int_equal(got.volumes[1], got.volumes[0]); /* the reference keeps its triangles */
    assert_int_equal(got.marched[1], got.marched[0] - 1);
    assert_true(got.difference <= got.plan.bound);
    assert_true(got.difference > 0.2 * got.plan.bound);
    nook_plan_free(&got.plan);
}

static void test_truth_is_never_planned(void **state)
{
    (void)state;
    shot s = cubes_shot(16, 1.0f);
    s.technique = "reference";
    comparison got = compare(write_cubes(3, 1, 0.2, 1.0, 1.0), s);
    assert_true(got.left_out > 0);
    assert_true(got.difference == 0.0);
    nook_plan_free(&got.plan);
}

static void test_the_demo_hall_is_within_the_bound(void **state)
{
    (void)state;
    shot s = cubes_shot(8, 0.01f);
    s.camera = "crates";
    s.r_max = 3.0;
    comparison got = compare(hall_path(), s);
    assert_true(got.difference <= got.plan.bound);
    assert_int_equal(got.volumes[1], got.volumes[0] - 1); /* both kinds of drum are one mesh in two colours */
    assert_true(got.plan.bytes < got.plan.bytes_before);
    nook_plan_free(&got.plan);
}

/* Other voxels of the same triangles: close, and not the same. */
static void test_walls_of_the_hall_in_volumes_of_their_own_look_alike(void **state)
{
    (void)state;
    static picture whole, split;
    uint32_t marched[2], volumes[2];
    shot s = cubes_shot(32, 0.0f);
    s.scene = hall_path();
    s.camera = "hall";
    s.resolution = 128;
    s.r_max = 3.0;
    s.plan.mode = NOOK_PLAN_OFF;
    take(&s, &whole, &volumes[0], &marched[0]);
    s.plan.mode = NOOK_PLAN_MEASURED;
    s.plan.level_error = 0.0f;
    s.plan.split = 0.0f;
    s.later = "surfel";
    take(&s, &split, &volumes[1], &marched[1]);
    assert_true(marched[1] > marched[0]);
    double sum = 0.0;
    for (int i = 0; i < PIXELS; i++)
        sum += pow((double)whole.values[i] - (double)split.values[i], 2.0);
    assert_true(sqrt(sum / PIXELS) < 0.05);
    assert_true(sum > 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_many_small_bodies_change_no_pixel_of_so_many_rays_by_more_than_the_bound),
        cmocka_unit_test(test_a_body_of_some_size_takes_of_the_integral_what_its_bound_says_and_not_a_fifth_of_it_only),
        cmocka_unit_test(test_truth_is_never_planned),
        cmocka_unit_test(test_the_demo_hall_is_within_the_bound),
        cmocka_unit_test(test_walls_of_the_hall_in_volumes_of_their_own_look_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
