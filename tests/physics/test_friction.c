#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <cmocka.h>

/* A slope through the origin that falls by `slope` radians along a direction `heading` radians from x; the box on it has the
   same turn. @return how far the box slid down it in two seconds */
static double slide_down(double slope, double heading, double friction)
{
    nook_physics *physics = physics_scene_create();
    const double about[4] = { 0, sin(heading / 2), 0, cos(heading / 2) },
                 down[4] = { 0, 0, -sin(slope / 2), cos(slope / 2) };
    nook_pose turn = { .rotation = { 0, 0, 0, 1 } }, tilt = turn, below = turn, above = turn;
    memcpy(turn.rotation, about, sizeof about);
    memcpy(tilt.rotation, down, sizeof down);
    nook_pose plane = nook_pose_multiply(&turn, &tilt);
    below.position[1] = -1, above.position[1] = 0.2;
    nook_shape ground = physics_scene_box(20, 1, 20), box = physics_scene_box(0.3, 0.2, 0.25);
    nook_body_desc ground_desc = physics_scene_desc(&ground, NOOK_BODY_STATIC, 0, 0, 0, 0);
    nook_body_desc box_desc = physics_scene_desc(&box, NOOK_BODY_DYNAMIC, 15, 0, 0, 0);
    ground_desc.pose = nook_pose_multiply(&plane, &below);
    box_desc.pose = nook_pose_multiply(&plane, &above);
    ground_desc.friction = box_desc.friction = friction;
    physics_scene_add(physics, &ground_desc);
    nook_body body = physics_scene_add(physics, &box_desc);
    physics_scene_step(physics, 120);
    nook_pose end = nook_physics_pose(physics, body, 1.0), plane_inverse = nook_pose_inverse(&plane);
    nook_pose_apply_point(&plane_inverse, end.position, end.position);
    nook_physics_destroy(physics);
    physics_assert_near(end.position[2], 0, 0.03); /* straight down */
    return end.position[0];
}

static void test_box_stays_on_a_slope_below_its_friction_angle(void **state)
{
    (void)state;
    for (int i = 0; i < 6; i++) /* whichever way the slope falls: friction is a cone */
        physics_assert_near(slide_down(atan(0.6) - 0.02, 0.4 * i, 0.6), 0, 0.002);
}

static void test_box_slides_down_a_slope_above_its_friction_angle(void **state)
{
    (void)state;
    for (int i = 0; i < 6; i++)
        assert_true(slide_down(atan(0.6) + 0.02, 0.4 * i, 0.6) > 0.15);
}

static void test_box_slides_as_fast_as_coulomb_says(void **state)
{
    (void)state;
    const double slope = 0.5, friction = 0.2, seconds = 2.0;
    double expected = 0.5 * 9.81 * (sin(slope) - friction * cos(slope)) * seconds * seconds;
    physics_assert_near(slide_down(slope, 0.3, friction), expected, 0.03 * expected);
}

/* A box that is thrown along the floor. */
static double slide_along(nook_physics *physics, double heading)
{
    nook_shape box = physics_scene_box(0.25, 0.25, 0.25);
    nook_body_desc desc = physics_scene_desc(&box, NOOK_BODY_DYNAMIC, 15, -3, 0.2498, 0.013);
    nook_body body = physics_scene_add(physics, &desc);
    nook_physics_set_velocity(physics, body, (double[3]){ 5 * cos(heading), 0, 5 * sin(heading) }, (double[3]){ 0 });
    double start[3], end[3], highest = 0;
    physics_scene_position(physics, body, start);
    for (int i = 0; i < 100; i++) {
        physics_scene_step(physics, 1);
        highest = fmax(highest, physics_scene_height(physics, body));
    }
    physics_scene_position(physics, body, end);
    physics_assert_near(highest, 0.25, 0.001);
    physics_assert_near(physics_scene_tilt(physics, body), 0, 0.005);
    return hypot(end[0] - start[0], end[2] - start[2]);
}

static void test_box_slides_over_the_edges_of_a_fine_mesh_as_over_a_plane(void **state)
{
    (void)state;
    const double expected = 25 / (2 * 0.6 * 9.81);
    const uint32_t cells[] = { 1, 20, 60, 150 };
    for (int i = 0; i < 4; i++) {
        nook_physics *physics = physics_scene_create();
        physics_scene_mesh grid = physics_scene_grid(8, cells[i]);
        nook_body_desc desc = physics_scene_desc(&grid.shape, NOOK_BODY_STATIC, 0, 0, 0, 0);
        physics_scene_add(physics, &desc);
        physics_scene_mesh_free(&grid);
        physics_assert_near(slide_along(physics, 0.3 * i), expected, 0.03);
        nook_physics_destroy(physics);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_box_stays_on_a_slope_below_its_friction_angle),
        cmocka_unit_test(test_box_slides_down_a_slope_above_its_friction_angle),
        cmocka_unit_test(test_box_slides_as_fast_as_coulomb_says),
        cmocka_unit_test(test_box_slides_over_the_edges_of_a_fine_mesh_as_over_a_plane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
