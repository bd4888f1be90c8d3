#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

static const double quarter = 1.57079632679489661923;

static void add_ground(nook_physics *physics, uint32_t cells)
{
    if (cells == 0) {
        physics_scene_floor(physics, 20);
        return;
    }
    physics_scene_mesh grid = physics_scene_grid(20, cells);
    nook_body_desc desc = physics_scene_desc(&grid.shape, NOOK_BODY_STATIC, 0, 0, 0, 0);
    physics_scene_add(physics, &desc);
    physics_scene_mesh_free(&grid);
}

/* A body of a shape with its middle at (x, y, z), which lies along z when `lying`. */
static nook_body add(nook_physics *physics, const nook_shape *shape, bool lying, double x, double y, double z)
{
    nook_body_desc desc = physics_scene_desc(shape, NOOK_BODY_DYNAMIC, 30, x, y, z);
    if (lying)
        desc.pose = (nook_pose){ .position = { x, y, z }, .rotation = { sin(quarter / 2), 0, 0, cos(quarter / 2) } };
    return physics_scene_add(physics, &desc);
}

/* Both come to rest within 1.5 s where they were put, to a millimetre. */
static void assert_stands(const nook_shape *lower, bool lower_lies, double lower_y, const nook_shape *upper,
                          bool upper_lies, double upper_y)
{
    const uint32_t grounds[] = { 0, 1, 200 };
    for (int i = 0; i < 3; i++) {
        nook_physics *physics = physics_scene_create();
        add_ground(physics, grounds[i]);
        nook_body below = add(physics, lower, lower_lies, 0.01, lower_y, 0.02);
        nook_body above = add(physics, upper, upper_lies, 0, upper_y, 0);
        physics_scene_step(physics, 90);
        assert_true(nook_physics_asleep(physics, below) && nook_physics_asleep(physics, above));
        double at[3];
        physics_scene_position(physics, above, at);
        physics_assert_near(at[0], 0, 0.001);
        physics_assert_near(at[1], upper_y, 0.001);
        physics_assert_near(at[2], 0, 0.001);
        physics_assert_near(physics_scene_height(physics, below), lower_y, 0.001);
        physics_assert_near(physics_scene_tilt(physics, above), upper_lies ? quarter : 0, 0.002);
        nook_physics_destroy(physics);
    }
}

static void test_drums_stand_and_lie_on_crates_and_on_each_other(void **state)
{
    (void)state;
    const nook_shape drum = physics_scene_round(NOOK_SHAPE_CYLINDER, 0.29, 0.44);
    const nook_shape gear = physics_scene_round(NOOK_SHAPE_CYLINDER, 0.29, 0.05);
    const nook_shape crate = physics_scene_box(0.25, 0.25, 0.25), chest = physics_scene_box(0.5, 0.45, 0.5);
    assert_stands(&chest, false, 0.45, &drum, false, 0.9 + 0.44);
    assert_stands(&chest, false, 0.45, &drum, true, 0.9 + 0.29);
    assert_stands(&drum, false, 0.44, &crate, false, 0.88 + 0.25);
    assert_stands(&drum, false, 0.44, &drum, false, 0.88 + 0.44);
    assert_stands(&drum, false, 0.44, &drum, true, 0.88 + 0.29);
    assert_stands(&gear, false, 0.05, &gear, false, 0.15);
    assert_stands(&crate, false, 0.25, &gear, false, 0.55);
}

static void test_drum_rolls_straight_and_level_over_a_mesh(void **state)
{
    (void)state;
    const nook_shape drum = physics_scene_round(NOOK_SHAPE_CYLINDER, 0.29, 0.44);
    const uint32_t grounds[] = { 0, 1, 200 };
    for (int i = 0; i < 3; i++) {
        nook_physics *physics = physics_scene_create();
        add_ground(physics, grounds[i]);
        nook_body body = add(physics, &drum, true, -5, 0.29, 0.031);
        physics_scene_step(physics, 2);
        nook_physics_set_velocity(physics, body, (double[3]){ 2, 0, 0 }, (double[3]){ 0, 0, -2 / 0.29 });
        double highest = 0, lowest = 1;
        for (int s = 0; s < 180; s++) {
            physics_scene_step(physics, 1);
            highest = fmax(highest, physics_scene_height(physics, body));
            lowest = fmin(lowest, physics_scene_height(physics, body));
        }
        double at[3];
        physics_scene_position(physics, body, at);
        physics_assert_near(highest, 0.29, 0.001);
        physics_assert_near(lowest, 0.29, 0.001);
        physics_assert_near(at[2], 0.031, 0.02);
        assert_true(at[0] > -0.5 && at[0] < 0.5); /* 4.5 to 5.5 of 6 m: resistance takes some */
        nook_physics_destroy(physics);
    }
}

static void test_rolling_comes_to_rest(void **state)
{
    (void)state;
    const nook_shape drum = physics_scene_round(NOOK_SHAPE_CYLINDER, 0.29, 0.44);
    nook_physics *physics = physics_scene_create();
    add_ground(physics, 20);
    nook_body body = add(physics, &drum, true, 0, 0.29, 0);
    nook_physics_set_velocity(physics, body, (double[3]){ 0.5, 0, 0 }, (double[3]){ 0, 0, -0.5 / 0.29 });
    physics_scene_step(physics, 420);
    assert_true(nook_physics_asleep(physics, body));
    nook_physics_destroy(physics);
}

static void test_lying_drums_touch_along_their_sides(void **state)
{
    (void)state;
    const nook_shape drum = physics_scene_round(NOOK_SHAPE_CYLINDER, 0.29, 0.44);
    nook_physics *physics = physics_scene_create();
    add_ground(physics, 0);
    nook_body still = add(physics, &drum, true, 0, 0.29, 0), rolls = add(physics, &drum, true, -1, 0.29, 0.1);
    nook_physics_set_velocity(physics, rolls, (double[3]){ 1, 0, 0 }, (double[3]){ 0, 0, -1 / 0.29 });
    double nearest = 1;
    for (int s = 0; s < 120; s++) {
        double a[3], b[3];
        physics_scene_step(physics, 1);
        physics_scene_position(physics, still, a);
        physics_scene_position(physics, rolls, b);
        nearest = fmin(nearest, a[0] - b[0]);
    }
    physics_assert_near(nearest, 0.58, 0.01);
    double at[3];
    physics_scene_position(physics, still, at);
    assert_true(at[0] > 0.1); /* pushed on */
    physics_assert_near(at[2], 0, 0.01);
    nook_physics_destroy(physics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_drums_stand_and_lie_on_crates_and_on_each_other),
        cmocka_unit_test(test_drum_rolls_straight_and_level_over_a_mesh),
        cmocka_unit_test(test_rolling_comes_to_rest),
        cmocka_unit_test(test_lying_drums_touch_along_their_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
