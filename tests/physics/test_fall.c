#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <cmocka.h>

static double fallen(double seconds)
{
    return 0.5 * 9.81 * seconds * seconds;
}

static void test_body_falls_as_the_closed_form_says(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body crate = physics_scene_crate(physics, 0.25, 15, 1, 30, 2);
    physics_scene_step(physics, 60);
    double at[3], linear[3], angular[3];
    physics_scene_position(physics, crate, at);
    nook_physics_velocity(physics, crate, linear, angular);
    physics_assert_near(at[0], 1, 1e-12);
    physics_assert_near(at[1], 30 - fallen(60 * NOOK_PHYSICS_STEP), 1e-9);
    physics_assert_near(at[2], 2, 1e-12);
    physics_assert_near(linear[1], -9.81, 1e-9);
    nook_physics_destroy(physics);
}

/* The faster, the more pieces a step is done in: that must not show. */
static void test_thrown_book_flies_a_parabola(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_shape book = physics_scene_box(0.12, 0.02, 0.15);
    nook_body_desc desc = physics_scene_desc(&book, NOOK_BODY_DYNAMIC, 1, 0, 30, 0);
    nook_body body = physics_scene_add(physics, &desc);
    nook_physics_set_velocity(physics, body, (double[3]){ 8, 5, 0 }, (double[3]){ 1, 2, 3 });
    for (int i = 1; i <= 60; i++) {
        double at[3], seconds = i * NOOK_PHYSICS_STEP;
        physics_scene_step(physics, 1);
        physics_scene_position(physics, body, at);
        physics_assert_near(at[0], 8 * seconds, 1e-9);
        physics_assert_near(at[1], 30 + 5 * seconds - fallen(seconds), 1e-9);
    }
    nook_physics_destroy(physics);
}

static void test_pushed_body_flies_as_newton_says(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body crate = physics_scene_crate(physics, 0.25, 15, 0, 30, 0);
    for (int i = 0; i < 60; i++) {
        nook_physics_push(physics, crate, (double[3]){ 30, 15 * 9.81, 0 });
        physics_scene_step(physics, 1);
    }
    double at[3];
    physics_scene_position(physics, crate, at);
    physics_assert_near(at[0], 0.5 * 30 / 15, 1e-9);
    physics_assert_near(at[1], 30, 1e-9);
    nook_physics_destroy(physics);
}

static void test_poses_between_steps_are_interpolated(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body crate = physics_scene_crate(physics, 0.25, 15, 0, 30, 0);
    physics_scene_step(physics, 20);
    physics_assert_near(nook_physics_pose(physics, crate, 0.0).position[1], 30 - fallen(19 * NOOK_PHYSICS_STEP), 1e-9);
    physics_assert_near(nook_physics_pose(physics, crate, 1.0).position[1], 30 - fallen(20 * NOOK_PHYSICS_STEP), 1e-9);
    physics_assert_near(nook_physics_pose(physics, crate, 0.25).position[1],
                        30 - 0.75 * fallen(19 * NOOK_PHYSICS_STEP) - 0.25 * fallen(20 * NOOK_PHYSICS_STEP), 1e-9);
    nook_physics_destroy(physics);
}

static void test_crate_comes_to_rest_on_the_floor(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_floor(physics, 5);
    nook_body crate = physics_scene_crate(physics, 0.25, 15, 0, 0.8, 0);
    physics_scene_step(physics, 180);
    physics_assert_near(physics_scene_height(physics, crate), 0.25, 0.001);
    assert_true(nook_physics_asleep(physics, crate));
    nook_physics_destroy(physics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_body_falls_as_the_closed_form_says),
        cmocka_unit_test(test_thrown_book_flies_a_parabola),
        cmocka_unit_test(test_pushed_body_flies_as_newton_says),
        cmocka_unit_test(test_poses_between_steps_are_interpolated),
        cmocka_unit_test(test_crate_comes_to_rest_on_the_floor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
