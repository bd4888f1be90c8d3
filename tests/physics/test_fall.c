#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <cmocka.h>

/* A step is done in two pieces, or more for what is fast. In each the solver changes the velocity first and moves with the new
   one, which is g t h / 2 deeper than g t^2 / 2 after t seconds of pieces of h. */
static double fallen(uint32_t steps)
{
    double piece = NOOK_PHYSICS_STEP / 2, seconds = steps * NOOK_PHYSICS_STEP;
    return 9.81 * seconds * (seconds + piece) / 2;
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
    physics_assert_near(at[1], 30 - fallen(60), 1e-9);
    physics_assert_near(at[1], 30 - 9.81 / 2, 0.05);
    physics_assert_near(at[2], 2, 1e-12);
    physics_assert_near(linear[1], -9.81, 1e-9);
    nook_physics_destroy(physics);
}

static void test_poses_between_steps_are_interpolated(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body crate = physics_scene_crate(physics, 0.25, 15, 0, 30, 0);
    physics_scene_step(physics, 20);
    physics_assert_near(nook_physics_pose(physics, crate, 0.0).position[1], 30 - fallen(19), 1e-9);
    physics_assert_near(nook_physics_pose(physics, crate, 1.0).position[1], 30 - fallen(20), 1e-9);
    physics_assert_near(nook_physics_pose(physics, crate, 0.25).position[1], 30 - 0.75 * fallen(19) - 0.25 * fallen(20),
                        1e-9);
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
        cmocka_unit_test(test_poses_between_steps_are_interpolated),
        cmocka_unit_test(test_crate_comes_to_rest_on_the_floor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
