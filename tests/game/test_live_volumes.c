/* A limb that comes down on a floor darkens it, in the frame in which it does. */
#include "engine/animation/scene_stand.h"
#include "engine/asset/scene_join.h"
#include "game/live_volumes.h"
#include "game/stage.h"
#include "tests/support/bone_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 64 };

static const double r_max = 0.4;

typedef struct fixture {
    nook_stage stage;
    nook_camera camera;
    float depth[SIDE * SIDE], visibility[SIDE * SIDE];
} fixture;

/* The arm stands beside a floor, 5 cm above which its forearm comes to lie when it is bent. */
static nook_scene *arm_and_floor(void)
{
    static const double origin[3] = { 0, 0, 0 };
    static const float corners[4][3] = {
        { -1.0f, 0.85f, -0.3f }, { -0.2f, 0.85f, -0.3f }, { -1.0f, 0.85f, 0.3f }, { -0.2f, 0.85f, 0.3f }
    };
    static const uint32_t indices[6] = { 0, 2, 1, 1, 2, 3 };
    nook_scene_part parts[2] = { { bone_scene_load(origin), true }, { NULL, true } };
    nook_scene *joined;
    assert_int_equal(nook_scene_from_triangles("floor", corners[0], 4, indices, 6, &parts[1].scene), NOOK_OK);
    assert_int_equal(nook_scene_join("arm and floor", parts, 2, NULL, 0, &joined), NOOK_OK);
    nook_scene_destroy(parts[0].scene);
    nook_scene_destroy(parts[1].scene);
    assert_int_equal(nook_scene_stand(joined, NOOK_NONE, 0.0), NOOK_OK);
    return joined;
}

static int set_up(void **state)
{
    static fixture made;
    const char *root = getenv("NOOK_ROOT");
    const double eye[3] = { -0.6, 2.2, 1.0 }, target[3] = { -0.6, 0.85, 0.0 }, up[3] = { 0, 1, 0 };
    const nook_stage_desc desc = { .root = root ? root : ".",
                                   .scene = arm_and_floor(),
                                   .backend = NOOK_BACKEND_OSMESA,
                                   .width = SIDE,
                                   .height = SIDE,
                                   .plays = true };
    const nook_game_world_desc world = { 64, r_max, NULL };
    made.camera = (nook_camera){ nook_matrix_look_at(eye, target, up), 0.8, 0.01 };
    *state = &made;
    return nook_stage_open(&desc, &made.stage) != NOOK_OK || nook_stage_fill(&made.stage, &world) != NOOK_OK ||
           nook_ao_set_param(made.stage.ao, "ao.r_max", r_max) != NOOK_OK ||
           nook_ao_set_param(made.stage.ao, "reference.rays", 256) != NOOK_OK;
}

static int tear_down(void **state)
{
    nook_stage_close(&((fixture *)*state)->stage);
    return 0;
}

static void record(fixture *f, const char *technique, double advance)
{
    nook_stage *stage = &f->stage;
    nook_game_world_advance(stage->world, advance);
    assert_int_equal(nook_ao_set_technique(stage->ao, technique), NOOK_OK);
    assert_int_equal(nook_stage_begin(stage, &f->camera), NOOK_OK);
    assert_int_equal(nook_stage_occlude(stage), NOOK_OK);
    nook_texture_read(stage->gpu, nook_renderer_gbuffer(stage->renderer).depth, GL_DEPTH_COMPONENT, GL_FLOAT, f->depth,
                      sizeof f->depth);
    nook_texture_read(stage->gpu, nook_stage_visibility(stage), GL_RED, GL_FLOAT, f->visibility, sizeof f->visibility);
}

/* The floor's pixels that nothing hides, by the distance to it. */
static double mean_of_floor(const fixture *f)
{
    double sum = 0.0, up = tan(0.5 * f->camera.fov_y_radians);
    nook_matrix world_from_view;
    int count = 0;
    nook_matrix_inverse_affine(&f->camera.view_from_world, &world_from_view);
    for (int i = 0; i < SIDE * SIDE; i++) {
        double z = f->depth[i] > 0.0f ? f->camera.z_near / (double)f->depth[i] : 0.0;
        double p[3] = { ((i % SIDE + 0.5) / SIDE * 2.0 - 1.0) * up * z, ((i / SIDE + 0.5) / SIDE * 2.0 - 1.0) * up * z,
                        -z };
        nook_matrix_apply_point(&world_from_view, p, p);
        if (f->depth[i] > 0.0f && fabs(p[1] - 0.85) < 1e-4 && p[0] < -0.3 && fabs(p[2]) < 0.2) {
            sum += (double)f->visibility[i];
            count++;
        }
    }
    assert_true(count > 200);
    return sum / count;
}

static void test_the_floor_darkens_when_a_limb_comes_down_and_brightens_when_it_lifts(void **state)
{
    fixture *f = *state;
    double last = 2.0;
    record(f, "volume", 0.0);
    double open = mean_of_floor(f);
    assert_true(open > 0.97);
    for (int i = 0; i < 4; i++) { /* from 0.8 seconds on, when it comes within reach */
        record(f, "volume", i == 0 ? 0.8 : 0.38);
        double now = mean_of_floor(f);
        assert_true(now < last);
        last = now;
    }
    assert_true(last < open - 0.1);
    record(f, "volume", -1.94);
    assert_true(fabs(mean_of_floor(f) - open) < 1e-6);
}

static void test_the_reference_sees_the_pose_that_is_drawn(void **state)
{
    fixture *f = *state;
    nook_game_world_set_traced(f->stage.world, true);
    record(f, "reference", 0.0);
    assert_true(mean_of_floor(f) > 0.99);
    record(f, "reference", 1.99);
    double truth = mean_of_floor(f);
    record(f, "volume", 0.0);
    double volume = mean_of_floor(f);
    if (!(truth < 0.9 && fabs(volume - truth) < 0.04))
        fail_msg("the floor's visibility is %g, by the volume %g", truth, volume);
}

static void test_only_what_has_moved_and_may_be_seen_is_made_anew(void **state)
{
    fixture *f = *state;
    nook_stage *stage = &f->stage;
    nook_scene_pose *pose;
    nook_live_volumes volumes;
    const double eye[3] = { -0.6, 2.2, 5.0 }, away[3] = { -0.6, 3.0, 9.0 }, up[3] = { 0, 1, 0 };
    const nook_camera backwards = { nook_matrix_look_at(eye, away, up), 0.8, 0.01 };
    assert_int_equal(nook_scene_pose_create(stage->scene, &pose), NOOK_OK);
    assert_int_equal(nook_live_volumes_create(stage->ao, pose, r_max, &volumes), NOOK_OK);
    assert_int_equal(volumes.count, 1);
    const struct {
        const nook_camera *camera;
        uint32_t version, made;
    } frames[] = { { &f->camera, 1, 1 }, { &f->camera, 1, 0 }, { &backwards, 2, 0 }, { &f->camera, 2, 1 } };
    for (size_t i = 0; i < NOOK_COUNT(frames); i++) {
        assert_int_equal(nook_live_volumes_voxelize(&volumes, stage->ao, pose, frames[i].version, stage->render_scene,
                                                    frames[i].camera, 1.0),
                         NOOK_OK);
        assert_int_equal(volumes.voxelized, frames[i].made);
    }
    nook_live_volumes_destroy(stage->ao, &volumes);
    nook_scene_pose_destroy(pose);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_the_floor_darkens_when_a_limb_comes_down_and_brightens_when_it_lifts,
                                        set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_the_reference_sees_the_pose_that_is_drawn, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_only_what_has_moved_and_may_be_seen_is_made_anew, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
