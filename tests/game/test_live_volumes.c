/* A limb that comes down on a floor darkens it, in the frame in which it does. */
#include "game/live_volumes.h"
#include "tests/support/bone_scene.h"
#include "tests/support/pose_view.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double r_max = 0.4;

/* The arm stands beside a floor, 5 cm above which its forearm comes to lie when it is bent. */
static int set_up_of(void **state, nook_scene *(*load)(const double root[3]))
{
    static pose_view view;
    const double origin[3] = { 0, 0, 0 }, eye[3] = { -0.6, 2.2, 1.0 }, target[3] = { -0.6, 0.85, 0.0 };
    const double floor[2][2] = { { -1.0, -0.3 }, { -0.2, 0.3 } };
    *state = &view;
    return pose_view_open(&view, load(origin), floor, 0.85, eye, target, r_max);
}

static int set_up(void **state)
{
    return set_up_of(state, bone_scene_load);
}

static int set_up_masked(void **state)
{
    return set_up_of(state, bone_scene_load_masked);
}

static int tear_down(void **state)
{
    pose_view_close(*state);
    return 0;
}

/* Of the floor that nothing hides. */
static double mean_of_floor(const pose_view *view)
{
    double sum = 0.0, p[3];
    int count = 0;
    for (int i = 0; i < POSE_VIEW_SIDE * POSE_VIEW_SIDE; i++) {
        if (pose_view_floor_at(view, i, p) && p[0] < -0.3 && fabs(p[2]) < 0.2) {
            sum += (double)view->visibility[i];
            count++;
        }
    }
    assert_true(count > 200);
    return sum / count;
}

static void test_the_floor_darkens_when_a_limb_comes_down_and_brightens_when_it_lifts(void **state)
{
    pose_view *f = *state;
    double last = 2.0;
    pose_view_record(f, "volume", 0.0);
    double open = mean_of_floor(f);
    assert_true(open > 0.97);
    for (int i = 0; i < 4; i++) { /* from 0.8 seconds on, when it comes within reach */
        pose_view_record(f, "volume", i == 0 ? 0.8 : 0.38);
        double now = mean_of_floor(f);
        assert_true(now < last);
        last = now;
    }
    assert_true(last < open - 0.1);
    pose_view_record(f, "volume", -1.94);
    assert_true(fabs(mean_of_floor(f) - open) < 1e-6);
}

static void test_the_reference_sees_the_pose_that_is_drawn(void **state)
{
    pose_view *f = *state;
    nook_game_world_set_traced(f->stage.world, true);
    pose_view_record(f, "reference", 0.0);
    assert_true(mean_of_floor(f) > 0.99);
    pose_view_record(f, "reference", 1.99);
    double truth = mean_of_floor(f);
    pose_view_record(f, "volume", 0.0);
    double volume = mean_of_floor(f);
    if (!(truth < 0.9 && fabs(volume - truth) < 0.04))
        fail_msg("the floor's visibility is %g, by the volume %g", truth, volume);
}

/* How much of the bent forearm's whole shade there is, by a technique. */
static double shade(pose_view *f, const char *technique)
{
    pose_view_record(f, technique, 0.0);
    return 1.0 - mean_of_floor(f);
}

/* Of the forearm two quarters are there, above 0.35 m of the half metre of floor that is looked at. */
static void test_a_mask_that_bends_lets_through_what_its_holes_do(void **state)
{
    pose_view *f = *state;
    static const char *const techniques[] = { "volume", "reference", "hao" };
    nook_game_world_set_traced(f->stage.world, true);
    pose_view_record(f, "volume", 1.99);
    double masked[3], whole[3];
    for (int i = 0; i < 3; i++)
        masked[i] = shade(f, techniques[i]);
    pose_view_close(f);
    assert_int_equal(set_up(state), 0);
    f = *state;
    nook_game_world_set_traced(f->stage.world, true);
    pose_view_record(f, "volume", 1.99);
    for (int i = 0; i < 3; i++) {
        whole[i] = shade(f, techniques[i]);
        print_message("%s: %.4f masked, %.4f whole\n", techniques[i], masked[i], whole[i]);
        assert_true(masked[i] > 0.35 * whole[i] && masked[i] < 0.7 * whole[i]);
    }
    assert_true(fabs(masked[0] - masked[1]) < 0.03);
}

static void test_only_what_has_moved_and_may_be_seen_is_made_anew(void **state)
{
    pose_view *f = *state;
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
        cmocka_unit_test_setup_teardown(test_a_mask_that_bends_lets_through_what_its_holes_do, set_up_masked,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_only_what_has_moved_and_may_be_seen_is_made_anew, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
