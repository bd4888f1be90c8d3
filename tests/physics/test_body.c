#include "tests/support/log_capture.h"
#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <cmocka.h>

/* ---- what is refused ---- */

static void assert_refused(const nook_body_desc *desc, const char *reason)
{
    nook_physics *physics = physics_scene_create();
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_body body = { 77 };
    assert_int_equal(nook_physics_add(physics, desc, &body), NOOK_E_ARG);
    nook_log_capture_end();
    assert_int_equal(log.count, 1);
    if (!strstr(log.text, reason))
        fail_msg("\"%s\" does not say \"%s\"", log.text, reason);
    assert_int_equal(body.id, 77);
    nook_physics_statistics statistics;
    nook_physics_get_statistics(physics, &statistics);
    assert_int_equal(statistics.bodies, 0);
    physics_scene_step(physics, 1); /* nothing half made is left */
    nook_physics_destroy(physics);
}

static nook_body_desc good(const nook_shape *shape)
{
    return physics_scene_desc(shape, NOOK_BODY_DYNAMIC, 5, 0, 0, 0);
}

static void test_add_refuses_poses_masses_and_surfaces_that_are_none(void **state)
{
    (void)state;
    const nook_shape box = physics_scene_box(1, 1, 1);
    nook_body_desc desc = good(&box);
    desc.pose.position[1] = NAN;
    assert_refused(&desc, "pose");
    desc = good(&box);
    desc.pose.rotation[3] = 1.1;
    assert_refused(&desc, "rotation not unit");
    const double masses[] = { 0, -1, NAN, INFINITY };
    for (int i = 0; i < 4; i++) {
        desc = good(&box);
        desc.mass = masses[i];
        assert_refused(&desc, "kg");
    }
    desc = good(&box);
    desc.friction = -0.1;
    assert_refused(&desc, "friction");
    desc = good(&box);
    desc.restitution = 1.01;
    assert_refused(&desc, "restitution");
    desc = good(&box);
    desc.ghost = true;
    assert_refused(&desc, "ghost");
    desc = good(&box);
    desc.shape_count = 0;
    assert_refused(&desc, "shape");
}

static void test_add_refuses_shapes_that_are_none(void **state)
{
    (void)state;
    nook_shape shape = physics_scene_box(1, 0, 1);
    nook_body_desc desc = good(&shape);
    assert_refused(&desc, "half[1] of a box");
    shape = physics_scene_round(NOOK_SHAPE_CYLINDER, NAN, 1);
    assert_refused(&desc, "half[0] of a cylinder");
    shape = physics_scene_round(NOOK_SHAPE_CAPSULE, 1, -1);
    assert_refused(&desc, "half[1] of a capsule");
    shape = physics_scene_round(NOOK_SHAPE_SPHERE, INFINITY, 0);
    assert_refused(&desc, "half[0] of a sphere");
    shape = physics_scene_box(1, 1, 1);
    shape.body_from_shape.rotation[0] = 2;
    assert_refused(&desc, "body_from_shape");
}

static void test_add_refuses_meshes_that_are_none(void **state)
{
    (void)state;
    physics_scene_mesh grid = physics_scene_grid(1, 2);
    nook_body_desc desc = good(&grid.shape);
    assert_refused(&desc, "mesh cannot be the shape of a dynamic body");
    desc.motion = NOOK_BODY_STATIC;
    grid.shape.index_count = 4;
    assert_refused(&desc, "4 indices");
    grid.shape.index_count = 24;
    grid.indices[5] = 9;
    assert_refused(&desc, "index 5");
    grid.indices[5] = 0;
    grid.positions[7] = NAN;
    assert_refused(&desc, "vertex 2");
    memset(grid.positions, 0, 27 * sizeof(float));
    assert_refused(&desc, "points or lines");
    physics_scene_mesh_free(&grid);
}

/* ---- handles ---- */

static void test_stale_handles_do_nothing(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body gone = physics_scene_crate(physics, 0.2, 5, 0, 0, 0);
    nook_physics_remove(physics, gone);
    nook_physics_remove(physics, gone);
    nook_body other = physics_scene_crate(physics, 0.2, 5, 0, 0, 0);
    assert_int_not_equal(gone.id, other.id);
    const nook_body stale[2] = { gone, { 0 } };
    for (int i = 0; i < 2; i++) {
        double linear[3], angular[3], normal[3];
        const nook_pose pose = { .position = { 5, 5, 5 }, .rotation = { 0, 0, 0, 1 } };
        nook_physics_set_pose(physics, stale[i], &pose);
        nook_physics_move(physics, stale[i], &pose);
        nook_physics_push(physics, stale[i], (double[3]){ 1, 1, 1 });
        nook_physics_set_velocity(physics, stale[i], (double[3]){ 1, 1, 1 }, (double[3]){ 1, 1, 1 });
        nook_physics_ignore(physics, stale[i], other);
        nook_physics_wake(physics, stale[i]);
        nook_physics_velocity(physics, stale[i], linear, angular);
        assert_true(linear[0] == 0 && angular[0] == 0);
        assert_false(nook_physics_alive(physics, stale[i]));
        assert_false(nook_physics_asleep(physics, stale[i]));
        assert_false(nook_physics_ground(physics, stale[i], normal));
        assert_true(nook_physics_user(physics, stale[i]) == 0);
        assert_true(nook_physics_mass(physics, stale[i]) == 0);
        assert_true(nook_physics_load(physics, stale[i]) == 0);
        assert_true(nook_physics_pose(physics, stale[i], 1.0).rotation[3] == 1);
    }
    double at[3];
    physics_scene_position(physics, other, at);
    assert_true(at[0] == 0);
    nook_physics_destroy(physics);
}

static void test_body_gives_back_what_it_was_given(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    const nook_shape box = physics_scene_box(1, 1, 1);
    nook_body_desc desc = good(&box);
    desc.user = 0x123456789abcdef0u;
    nook_body body = physics_scene_add(physics, &desc);
    desc.motion = NOOK_BODY_STATIC;
    nook_body still = physics_scene_add(physics, &desc);
    assert_true(nook_physics_user(physics, body) == 0x123456789abcdef0u);
    assert_true(nook_physics_mass(physics, body) == 5);
    assert_true(nook_physics_mass(physics, still) == 0);
    assert_true(nook_physics_alive(physics, body));
    nook_physics_destroy(physics);
}

static void test_bodies_are_listed_in_the_order_they_were_added(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body added[3], listed[3] = { { 0 } };
    for (int i = 0; i < 3; i++)
        added[i] = physics_scene_crate(physics, 0.2, 5, i, 0, 0);
    nook_physics_remove(physics, added[1]);
    assert_int_equal(nook_physics_bodies(physics, NULL, 0), 2);
    assert_int_equal(nook_physics_bodies(physics, listed, 1), 2);
    assert_int_equal(listed[0].id, added[0].id);
    assert_int_equal(listed[1].id, 0);
    assert_int_equal(nook_physics_bodies(physics, listed, 3), 2);
    assert_int_equal(listed[1].id, added[2].id);
    nook_physics_destroy(physics);
}

static void test_destroy_takes_null(void **state)
{
    (void)state;
    nook_physics_destroy(NULL);
}

/* ---- masses ---- */

/* A hammer: a heavy head at x = 1 and a shaft from there to the origin, of one density. */
static nook_body add_hammer(nook_physics *physics, double height)
{
    nook_shape parts[2] = { physics_scene_box(0.2, 0.2, 0.2), physics_scene_box(0.4, 0.05, 0.05) };
    parts[0].body_from_shape.position[0] = 1.0;
    parts[1].body_from_shape.position[0] = 0.4;
    nook_body_desc desc = physics_scene_desc(parts, NOOK_BODY_DYNAMIC, 10, 0, height, 0);
    desc.shape_count = 2;
    return physics_scene_add(physics, &desc);
}

static void test_body_turns_about_its_centre_of_mass_not_its_origin(void **state)
{
    (void)state;
    const double head = 0.064, shaft = 0.008, centre = (head * 1.0 + shaft * 0.4) / (head + shaft);
    nook_physics *physics = physics_scene_create();
    nook_body hammer = add_hammer(physics, 100);
    nook_physics_set_velocity(physics, hammer, (double[3]){ 0 }, (double[3]){ 0, 3, 0 });
    for (int i = 0; i < 60; i++) {
        physics_scene_step(physics, 1);
        nook_pose pose = nook_physics_pose(physics, hammer, 1.0);
        double middle[3] = { centre, 0, 0 };
        nook_pose_apply_point(&pose, middle, middle);
        physics_assert_near(middle[0], centre, 1e-9);
        physics_assert_near(middle[2], 0, 1e-9);
    }
    nook_physics_destroy(physics);
}

static void test_body_lies_where_its_shapes_touch_the_ground(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_floor(physics, 5);
    nook_body hammer = add_hammer(physics, 0.4);
    physics_scene_step(physics, 300);
    assert_true(nook_physics_asleep(physics, hammer));
    nook_pose pose = nook_physics_pose(physics, hammer, 1.0);
    double end[3] = { 0, 0, 0 };
    nook_pose_apply_point(&pose, end, end);
    physics_assert_near(end[1], 0.2, 0.01); /* the head is so wide that the shaft stays up */
    nook_physics_destroy(physics);
}

/* ---- pairs ---- */

static void test_ignored_pair_passes_through_each_other_until_taken_back(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body ground = physics_scene_floor(physics, 5);
    nook_body falls = physics_scene_crate(physics, 0.2, 5, 0, 0.5, 0),
              stays = physics_scene_crate(physics, 0.2, 5, 2, 0.5, 0);
    nook_physics_ignore(physics, falls, ground);
    physics_scene_step(physics, 90);
    assert_true(physics_scene_height(physics, falls) < -3);
    physics_assert_near(physics_scene_height(physics, stays), 0.2, 0.001);
    nook_pose back = { .position = { 0, 0.5, 0 }, .rotation = { 0, 0, 0, 1 } };
    nook_physics_set_pose(physics, falls, &back);
    nook_physics_ignore(physics, falls, (nook_body){ 0 });
    physics_scene_step(physics, 90);
    physics_assert_near(physics_scene_height(physics, falls), 0.2, 0.001);
    nook_physics_destroy(physics);
}

static void test_set_pose_leaves_nothing_to_interpolate(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body crate = physics_scene_crate(physics, 0.2, 5, 0, 10, 0);
    physics_scene_step(physics, 30);
    nook_pose pose = { .position = { 7, 3, 1 }, .rotation = { 0, 0.6, 0, 0.8 } };
    nook_physics_set_pose(physics, crate, &pose);
    for (int i = 0; i <= 2; i++) {
        physics_assert_near(nook_physics_pose(physics, crate, 0.5 * i).position[0], 7, 1e-12);
        physics_assert_near(nook_physics_pose(physics, crate, 0.5 * i).rotation[1], 0.6, 1e-12);
    }
    double linear[3], angular[3];
    nook_physics_velocity(physics, crate, linear, angular);
    assert_true(linear[1] == 0);
    nook_physics_destroy(physics);
}

static void test_push_lasts_one_step(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body crate = physics_scene_crate(physics, 0.2, 5, 0, 10, 0);
    double linear[3], angular[3];
    nook_physics_push(physics, crate, (double[3]){ 30, 0, 0 });
    nook_physics_push(physics, crate, (double[3]){ 20, 0, 0 }); /* they add up */
    physics_scene_step(physics, 5);
    nook_physics_velocity(physics, crate, linear, angular);
    physics_assert_near(linear[0], 50.0 / 5 * NOOK_PHYSICS_STEP, 1e-9);
    nook_physics_destroy(physics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_add_refuses_poses_masses_and_surfaces_that_are_none),
        cmocka_unit_test(test_add_refuses_shapes_that_are_none),
        cmocka_unit_test(test_add_refuses_meshes_that_are_none),
        cmocka_unit_test(test_stale_handles_do_nothing),
        cmocka_unit_test(test_body_gives_back_what_it_was_given),
        cmocka_unit_test(test_bodies_are_listed_in_the_order_they_were_added),
        cmocka_unit_test(test_destroy_takes_null),
        cmocka_unit_test(test_body_turns_about_its_centre_of_mass_not_its_origin),
        cmocka_unit_test(test_body_lies_where_its_shapes_touch_the_ground),
        cmocka_unit_test(test_ignored_pair_passes_through_each_other_until_taken_back),
        cmocka_unit_test(test_set_pose_leaves_nothing_to_interpolate),
        cmocka_unit_test(test_push_lasts_one_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
