#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

static nook_body add_kinematic(nook_physics *physics, const nook_shape *shape, double x, double y, double z)
{
    nook_body_desc desc = physics_scene_desc(shape, NOOK_BODY_KINEMATIC, 0, x, y, z);
    return physics_scene_add(physics, &desc);
}

static nook_pose turned_about_y(double x, double y, double z, double radians)
{
    return (nook_pose){ .position = { x, y, z }, .rotation = { 0, sin(radians / 2), 0, cos(radians / 2) } };
}

static void test_moved_body_is_exactly_where_it_was_sent(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_shape box = physics_scene_box(1, 1, 0.1);
    nook_body gate = add_kinematic(physics, &box, 0, 0, 0);
    nook_pose target = turned_about_y(0.3, 0.1, -0.2, 0.4), before = nook_physics_pose(physics, gate, 1.0);
    nook_physics_move(physics, gate, &target);
    physics_scene_step(physics, 1);
    nook_pose now = nook_physics_pose(physics, gate, 1.0), was = nook_physics_pose(physics, gate, 0.0);
    for (int i = 0; i < 3; i++) {
        assert_true(now.position[i] == target.position[i]);
        assert_true(was.position[i] == before.position[i]);
    }
    physics_scene_step(physics, 10); /* and stays there without further orders */
    now = nook_physics_pose(physics, gate, 1.0);
    assert_true(now.position[0] == target.position[0]);
    nook_physics_destroy(physics);
}

static void test_box_turns_with_the_turntable_on_which_it_stands(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_shape disc = physics_scene_round(NOOK_SHAPE_CYLINDER, 1, 0.1);
    nook_body table = add_kinematic(physics, &disc, 0, -0.1, 0);
    nook_body crate = physics_scene_crate(physics, 0.2, 15, 0.5, 0.2, 0);
    physics_scene_step(physics, 90);
    assert_true(nook_physics_asleep(physics, crate)); /* it is woken by the table */
    const double rate = 1.0;
    for (int i = 1; i <= 120; i++) {
        nook_pose target = turned_about_y(0, -0.1, 0, rate * i * NOOK_PHYSICS_STEP);
        nook_physics_move(physics, table, &target);
        physics_scene_step(physics, 1);
    }
    double at[3], linear[3], angular[3];
    physics_scene_position(physics, crate, at);
    nook_physics_velocity(physics, crate, linear, angular);
    physics_assert_near(atan2(-at[2], at[0]), 2 * rate, 0.05);
    physics_assert_near(hypot(at[0], at[2]), 0.5, 0.02);
    physics_assert_near(angular[1], rate, 0.03);
    nook_physics_destroy(physics);
}

static void test_closing_gate_pushes_a_crate(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_floor(physics, 5);
    nook_shape leaf = physics_scene_box(0.65, 0.9, 0.05);
    leaf.body_from_shape.position[0] = 0.65; /* hinged at its origin */
    nook_body gate = add_kinematic(physics, &leaf, 0, 0.95, 0);
    nook_body crate = physics_scene_crate(physics, 0.25, 15, 0.9, 0.25, -0.6);
    for (int i = 1; i <= 90; i++) {
        nook_pose target = turned_about_y(0, 0.95, 0, 1.5 * i / 90);
        nook_physics_move(physics, gate, &target);
        physics_scene_step(physics, 1);
    }
    double at[3];
    physics_scene_position(physics, crate, at);
    assert_true(at[0] < 0.5 && at[2] < -0.8); /* swept along */
    physics_assert_near(at[1], 0.25, 0.005);
    physics_assert_near(physics_scene_tilt(physics, crate), 0, 0.02);
    nook_physics_destroy(physics);
}

static void test_lift_carries_a_crate_up_and_down(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_shape platform = physics_scene_box(1, 0.05, 1);
    nook_body lift = add_kinematic(physics, &platform, 0, 0, 0),
              crate = physics_scene_crate(physics, 0.2, 15, 0, 0.25, 0);
    double worst = 0;
    for (int i = 1; i <= 360; i++) {
        nook_pose target = turned_about_y(0, 0.5 - 0.5 * cos(i * 0.0174533), 0, 0);
        nook_physics_move(physics, lift, &target);
        physics_scene_step(physics, 1);
        worst = fmax(worst, fabs(physics_scene_height(physics, crate) - physics_scene_height(physics, lift) - 0.25));
    }
    assert_true(worst < 0.003);
    nook_physics_destroy(physics);
}

static void test_body_falls_when_what_it_slept_on_moves_away(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_shape shelf = physics_scene_box(0.5, 0.05, 0.5);
    nook_body kinematic = add_kinematic(physics, &shelf, 0, 1, 0),
              crate = physics_scene_crate(physics, 0.2, 15, 0, 1.25, 0);
    physics_scene_step(physics, 90);
    assert_true(nook_physics_asleep(physics, crate));
    nook_pose away = turned_about_y(5, 1, 0, 0);
    nook_physics_set_pose(physics, kinematic, &away);
    physics_scene_step(physics, 30);
    assert_true(physics_scene_height(physics, crate) < 0.5);
    nook_physics_destroy(physics);
}

static void test_mesh_that_is_moved_pushes(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_floor(physics, 5);
    physics_scene_mesh mesh = physics_scene_mesh_box((double[3]){ 0.05, 0.5, 1 }, 2, false);
    nook_body wall = add_kinematic(physics, &mesh.shape, 0, 0.55, 0);
    physics_scene_mesh_free(&mesh);
    nook_body crate = physics_scene_crate(physics, 0.25, 15, 0.4, 0.25, 0);
    for (int i = 1; i <= 60; i++) {
        nook_pose target = turned_about_y(i / 60.0, 0.55, 0, 0);
        nook_physics_move(physics, wall, &target);
        physics_scene_step(physics, 1);
    }
    double at[3];
    physics_scene_position(physics, crate, at);
    physics_assert_near(at[0], 1.3, 0.02);
    nook_physics_destroy(physics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_moved_body_is_exactly_where_it_was_sent),
        cmocka_unit_test(test_box_turns_with_the_turntable_on_which_it_stands),
        cmocka_unit_test(test_closing_gate_pushes_a_crate),
        cmocka_unit_test(test_lift_carries_a_crate_up_and_down),
        cmocka_unit_test(test_body_falls_when_what_it_slept_on_moves_away),
        cmocka_unit_test(test_mesh_that_is_moved_pushes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
