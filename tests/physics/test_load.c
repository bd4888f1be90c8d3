#include "tests/support/physics_scene.h"
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

static const double g = 9.81;

static nook_body add_plate(nook_physics *physics, nook_body_motion motion)
{
    nook_shape plate = physics_scene_round(NOOK_SHAPE_CYLINDER, 0.5, 0.04);
    nook_body_desc desc = physics_scene_desc(&plate, motion, 0, 0, 0.04, 0);
    return physics_scene_add(physics, &desc);
}

static void check_weighs(nook_body_motion motion)
{
    nook_physics *physics = physics_scene_create();
    nook_body plate = add_plate(physics, motion);
    assert_true(nook_physics_load(physics, plate) == 0.0);
    nook_body crate = physics_scene_crate(physics, 0.2, 15, 0.1, 0.29, 0.05);
    physics_scene_step(physics, 20);
    assert_false(nook_physics_asleep(physics, crate));
    physics_assert_near(nook_physics_load(physics, plate), 15 * g, 0.01 * 15 * g);
    physics_scene_step(physics, 120);
    assert_true(nook_physics_asleep(physics, crate)); /* its weight stays */
    physics_assert_near(nook_physics_load(physics, plate), 15 * g, 0.01 * 15 * g);
    physics_assert_near(nook_physics_load(physics, crate), 0, 1e-6); /* nothing lies on the crate */
    nook_physics_remove(physics, crate);
    assert_true(nook_physics_load(physics, plate) == 0.0);
    nook_physics_destroy(physics);
}

static void test_static_plate_feels_what_lies_on_it_awake_and_asleep(void **state)
{
    (void)state;
    check_weighs(NOOK_BODY_STATIC);
}

static void test_kinematic_plate_feels_what_lies_on_it_awake_and_asleep(void **state)
{
    (void)state;
    check_weighs(NOOK_BODY_KINEMATIC);
}

static void test_stack_weighs_on_each_of_its_bodies(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body plate = add_plate(physics, NOOK_BODY_KINEMATIC), crates[3];
    for (int i = 0; i < 3; i++)
        crates[i] = physics_scene_crate(physics, 0.2, 10 + i, 0, 0.28 + 0.4 * i, 0);
    physics_scene_step(physics, 200);
    physics_assert_near(nook_physics_load(physics, plate), 33 * g, 0.01 * 33 * g);
    physics_assert_near(nook_physics_load(physics, crates[0]), 23 * g, 0.01 * 23 * g);
    physics_assert_near(nook_physics_load(physics, crates[1]), 12 * g, 0.01 * 12 * g);
    nook_physics_destroy(physics);
}

static void test_sleeper_and_walker_weigh_together(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body plate = add_plate(physics, NOOK_BODY_KINEMATIC);
    nook_body crate = physics_scene_crate(physics, 0.1, 15, -0.3, 0.18, 0);
    physics_scene_step(physics, 120);
    assert_true(nook_physics_asleep(physics, crate));
    nook_shape person = physics_scene_round(NOOK_SHAPE_CAPSULE, 0.2, 0.5);
    nook_body_desc desc = physics_scene_desc(&person, NOOK_BODY_DYNAMIC, 80, 0.25, 0.79, 0);
    desc.upright = true;
    nook_body walker = physics_scene_add(physics, &desc);
    for (int i = 0; i < 60; i++) {
        nook_physics_push(physics, walker, (double[3]){ 0 });
        physics_scene_step(physics, 1);
    }
    assert_true(nook_physics_asleep(physics, crate));
    assert_false(nook_physics_asleep(physics, walker));
    physics_assert_near(nook_physics_load(physics, plate), 95 * g, 0.01 * 95 * g);
    nook_physics_destroy(physics);
}

static void test_stack_put_to_sleep_weighs_and_stays_to_the_last_bit(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body plate = add_plate(physics, NOOK_BODY_KINEMATIC), crates[3];
    for (int i = 0; i < 3; i++) { /* with a tenth of a millimetre between them, as files have it */
        crates[i] = physics_scene_crate(physics, 0.2, 10, 0, 0.2799 + 0.3999 * i, 0);
        nook_physics_sleep(physics, crates[i]);
        assert_true(nook_physics_asleep(physics, crates[i]));
    }
    physics_scene_step(physics, 100);
    for (int i = 0; i < 3; i++) {
        assert_true(nook_physics_asleep(physics, crates[i]));
        physics_assert_near(physics_scene_height(physics, crates[i]), 0.2799 + 0.3999 * i, 1e-12);
    }
    physics_assert_near(nook_physics_load(physics, plate), 30 * g, 0.02 * 30 * g);
    nook_physics_remove(physics, crates[0]);
    physics_scene_step(physics, 60);
    assert_true(physics_scene_height(physics, crates[2]) < 0.9);
    nook_physics_destroy(physics);
}

static void test_push_from_above_is_felt(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body plate = add_plate(physics, NOOK_BODY_STATIC);
    nook_body crate = physics_scene_crate(physics, 0.2, 15, 0, 0.28, 0);
    for (int i = 0; i < 60; i++) {
        nook_physics_push(physics, crate, (double[3]){ 0, -100, 0 });
        physics_scene_step(physics, 1);
    }
    physics_assert_near(nook_physics_load(physics, plate), 15 * g + 100, 3);
    nook_physics_destroy(physics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_static_plate_feels_what_lies_on_it_awake_and_asleep),
        cmocka_unit_test(test_kinematic_plate_feels_what_lies_on_it_awake_and_asleep),
        cmocka_unit_test(test_stack_weighs_on_each_of_its_bodies),
        cmocka_unit_test(test_sleeper_and_walker_weigh_together),
        cmocka_unit_test(test_stack_put_to_sleep_weighs_and_stays_to_the_last_bit),
        cmocka_unit_test(test_push_from_above_is_felt),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
