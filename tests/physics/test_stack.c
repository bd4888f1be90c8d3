#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

enum { CRATES = 5 };

static void add_stack(nook_physics *physics, nook_body crates[CRATES])
{
    for (int i = 0; i < CRATES; i++)
        crates[i] = physics_scene_crate(physics, 0.25, 15, 0.01 * (i % 2), 0.25 + 0.5 * i, 0.005 * (i % 3));
}

static void assert_stack_stands(const nook_physics *physics, const nook_body crates[CRATES], double creep)
{
    for (int i = 0; i < CRATES; i++) {
        double at[3];
        physics_scene_position(physics, crates[i], at);
        physics_assert_near(at[0], 0.01 * (i % 2), creep);
        physics_assert_near(at[1], 0.25 + 0.5 * i, 0.002);
        physics_assert_near(at[2], 0.005 * (i % 3), creep);
        physics_assert_near(physics_scene_tilt(physics, crates[i]), 0, 0.004);
    }
}

static uint32_t steps_to_sleep(nook_physics *physics, nook_body body)
{
    uint32_t steps = 0;
    for (; steps < 600 && !nook_physics_asleep(physics, body); steps++)
        physics_scene_step(physics, 1);
    return steps;
}

static void stand(nook_physics *physics)
{
    nook_body crates[CRATES];
    add_stack(physics, crates);
    uint32_t steps = steps_to_sleep(physics, crates[4]);
    assert_in_range(steps, 1, 120);
    physics_scene_step(physics, 1800);
    assert_stack_stands(physics, crates, 0.002);
    for (int i = 0; i < CRATES; i++)
        assert_true(nook_physics_asleep(physics, crates[i]));
}

static void test_stack_of_five_stands_and_sleeps_on_a_box(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_floor(physics, 5);
    stand(physics);
    nook_physics_destroy(physics);
}

static void test_stack_of_five_stands_and_sleeps_on_a_mesh(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_mesh grid = physics_scene_grid(5, 50);
    nook_body_desc desc = physics_scene_desc(&grid.shape, NOOK_BODY_STATIC, 0, 0, 0, 0);
    physics_scene_add(physics, &desc);
    physics_scene_mesh_free(&grid);
    stand(physics);
    nook_physics_destroy(physics);
}

/* Half a minute with somebody who leans on the lowest: solvers that iterate creep, but not visibly. */
static void test_stack_of_five_stands_for_thirty_seconds_awake(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body crates[CRATES];
    physics_scene_floor(physics, 5);
    add_stack(physics, crates);
    for (int i = 0; i < 1800; i++) {
        nook_physics_wake(physics, crates[0]);
        physics_scene_step(physics, 1);
    }
    assert_false(nook_physics_asleep(physics, crates[4]));
    assert_stack_stands(physics, crates, 0.01);
    nook_physics_destroy(physics);
}

static void test_what_rested_on_a_body_falls_when_it_is_removed(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body crates[CRATES];
    physics_scene_floor(physics, 5);
    add_stack(physics, crates);
    steps_to_sleep(physics, crates[4]);
    nook_physics_remove(physics, crates[2]);
    assert_false(nook_physics_alive(physics, crates[2]));
    physics_scene_step(physics, 120);
    physics_assert_near(physics_scene_height(physics, crates[4]), 0.25 + 0.5 * 3, 0.01);
    nook_physics_destroy(physics);
}

static void test_crate_that_is_hit_wakes_with_all_that_it_touches(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body crates[CRATES];
    physics_scene_floor(physics, 5);
    add_stack(physics, crates);
    steps_to_sleep(physics, crates[4]);
    nook_body ball = physics_scene_crate(physics, 0.1, 5, -1, 1.25, 0);
    nook_physics_set_velocity(physics, ball, (double[3]){ 6, 0, 0 }, (double[3]){ 0 });
    double lowest = physics_scene_height(physics, crates[0]);
    for (int i = 0; i < 30; i++) {
        physics_scene_step(physics, 1);
        lowest = fmin(lowest, physics_scene_height(physics, crates[0]));
    }
    for (int i = 0; i < CRATES; i++)
        assert_false(nook_physics_asleep(physics, crates[i]));
    physics_assert_near(lowest, 0.25, 0.002); /* who is woken has its floor at once */
    nook_physics_destroy(physics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stack_of_five_stands_and_sleeps_on_a_box),
        cmocka_unit_test(test_stack_of_five_stands_and_sleeps_on_a_mesh),
        cmocka_unit_test(test_stack_of_five_stands_for_thirty_seconds_awake),
        cmocka_unit_test(test_what_rested_on_a_body_falls_when_it_is_removed),
        cmocka_unit_test(test_crate_that_is_hit_wakes_with_all_that_it_touches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
