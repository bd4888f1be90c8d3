#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

/* A person of 1.8 m, whose feet are 0.9 m below its origin. */
static nook_body add_person(nook_physics *physics, double x, double y, double z)
{
    nook_shape person = physics_scene_round(NOOK_SHAPE_CAPSULE, 0.3, 0.6);
    nook_body_desc desc = physics_scene_desc(&person, NOOK_BODY_DYNAMIC, 80, x, y + 0.9, z);
    desc.upright = true;
    desc.friction = 0.0; /* walks by velocity */
    return physics_scene_add(physics, &desc);
}

static void walk(nook_physics *physics, nook_body person, double speed, uint32_t steps)
{
    for (uint32_t i = 0; i < steps; i++) {
        double linear[3], angular[3];
        nook_physics_velocity(physics, person, linear, angular);
        nook_physics_set_velocity(physics, person, (double[3]){ speed, linear[1], 0 }, angular);
        physics_scene_step(physics, 1);
    }
}

static void test_person_stays_upright_whatever_hits_it(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_floor(physics, 10);
    nook_body person = add_person(physics, 0, 0, 0);
    nook_body ball = physics_scene_crate(physics, 0.15, 20, -1, 1.7, 0.1);
    nook_physics_set_velocity(physics, ball, (double[3]){ 8, 0, 0 }, (double[3]){ 0 });
    physics_scene_step(physics, 60);
    nook_pose pose = nook_physics_pose(physics, person, 1.0);
    assert_true(pose.rotation[3] == 1.0);
    assert_true(pose.position[0] > 0.05); /* but it was hit */
    nook_physics_destroy(physics);
}

static void test_person_walks_at_the_speed_it_is_given(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_mesh grid = physics_scene_grid(10, 30);
    nook_body_desc ground = physics_scene_desc(&grid.shape, NOOK_BODY_STATIC, 0, 0, 0, 0);
    physics_scene_add(physics, &ground);
    physics_scene_mesh_free(&grid);
    nook_body person = add_person(physics, -3, 0, 0);
    walk(physics, person, 2.2, 120);
    double at[3];
    physics_scene_position(physics, person, at);
    physics_assert_near(at[0], -3 + 4.4, 0.02);
    physics_assert_near(at[1], 0.9, 0.002);
    physics_assert_near(at[2], 0, 0.01);
    nook_physics_destroy(physics);
}

static void test_ground_tells_the_least_steep_of_what_it_stands_on(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body person = add_person(physics, 0, 0.5, 0);
    double normal[3];
    physics_scene_step(physics, 1);
    assert_false(nook_physics_ground(physics, person, normal)); /* in the air */
    physics_scene_floor(physics, 10);
    nook_shape post = physics_scene_box(0.2, 2, 2);
    nook_body_desc wall = physics_scene_desc(&post, NOOK_BODY_STATIC, 0, 0.5, 2, 0);
    physics_scene_add(physics, &wall);
    physics_scene_step(physics, 40);
    walk(physics, person, 1, 10); /* against the wall */
    assert_true(nook_physics_ground(physics, person, normal));
    physics_assert_near(normal[1], 1, 1e-6);
    nook_physics_destroy(physics);
}

/* A velocity alone brings a capsule up a step that is lower than where its round end begins to be steep. */
static void test_person_walks_up_a_kerb(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_floor(physics, 10);
    physics_scene_mesh step = physics_scene_mesh_box((double[3]){ 2, 0.04, 2 }, 4, false);
    nook_body_desc desc = physics_scene_desc(&step.shape, NOOK_BODY_STATIC, 0, 3, 0.04, 0);
    physics_scene_add(physics, &desc);
    physics_scene_mesh_free(&step);
    nook_body person = add_person(physics, 0, 0, 0);
    walk(physics, person, 2.2, 90);
    double at[3];
    physics_scene_position(physics, person, at);
    physics_assert_near(at[1], 0.98, 0.005);
    nook_physics_destroy(physics);
}

static void test_person_pushes_a_crate_along_and_is_stopped_by_a_wall(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_floor(physics, 10);
    nook_body person = add_person(physics, 0, 0, 0), crate = physics_scene_crate(physics, 0.25, 15, 1, 0.25, 0);
    nook_shape wall = physics_scene_box(0.1, 2, 2);
    nook_body_desc desc = physics_scene_desc(&wall, NOOK_BODY_STATIC, 0, 3, 2, 0);
    physics_scene_add(physics, &desc);
    walk(physics, person, 2.2, 40);
    double at[3];
    physics_scene_position(physics, crate, at);
    assert_true(at[0] > 1.4);
    walk(physics, person, 2.2, 120);
    physics_scene_position(physics, crate, at);
    physics_assert_near(at[0], 2.9 - 0.25, 0.05);
    physics_scene_position(physics, person, at);
    assert_true(at[0] < 2.9 - 0.5 - 0.25);
    nook_physics_destroy(physics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_person_stays_upright_whatever_hits_it),
        cmocka_unit_test(test_person_walks_at_the_speed_it_is_given),
        cmocka_unit_test(test_ground_tells_the_least_steep_of_what_it_stands_on),
        cmocka_unit_test(test_person_walks_up_a_kerb),
        cmocka_unit_test(test_person_pushes_a_crate_along_and_is_stopped_by_a_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
