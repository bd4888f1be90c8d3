#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <cmocka.h>

enum { BODIES = 200, STEPS = 2000 };

static const double half[3] = { 5, 4, 5 };

/* A simple generator: the same everywhere (Knuth's MMIX). @return [-1, 1] */
static double next(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / (double)(1ull << 52) - 1.0;
}

static nook_shape shape_of(int i)
{
    switch (i % 5) {
    case 0:
        return physics_scene_box(0.25, 0.18, 0.21);
    case 1:
        return physics_scene_round(NOOK_SHAPE_CYLINDER, 0.25, 0.35);
    case 2:
        return physics_scene_round(NOOK_SHAPE_SPHERE, 0.15, 0);
    case 3:
        return physics_scene_box(0.12, 0.02, 0.15); /* a book */
    default:
        return physics_scene_round(NOOK_SHAPE_CYLINDER, 0.25, 0.04); /* a gear */
    }
}

static void throw_in(nook_physics *physics, int i, uint64_t *random)
{
    nook_shape shape = shape_of(i);
    nook_body_desc desc = physics_scene_desc(&shape, NOOK_BODY_DYNAMIC, 2 + i % 20, -4 + 1.1 * (i % 8),
                                             -3 + 1.4 * (i / 64), -4 + 1.1 * (i / 8 % 8));
    desc.restitution = 0.3;
    double *q = desc.pose.rotation, length = 0;
    for (int k = 0; k < 4; k++)
        q[k] = next(random), length += q[k] * q[k];
    for (int k = 0; k < 4; k++)
        q[k] /= sqrt(length);
    nook_body body = physics_scene_add(physics, &desc);
    double linear[3], angular[3];
    for (int k = 0; k < 3; k++)
        linear[k] = 15 * next(random), angular[k] = 15 * next(random);
    nook_physics_set_velocity(physics, body, linear, angular);
}

static void assert_inside(const nook_physics *physics, uint32_t first)
{
    for (uint32_t i = 0; i < BODIES; i++) {
        double at[3];
        physics_scene_position(physics, (nook_body){ first + i }, at);
        for (int k = 0; k < 3; k++)
            if (!(fabs(at[k]) < half[k])) /* also for NaN */
                fail_msg("body %u is at %g %g %g", i, at[0], at[1], at[2]);
    }
}

static void test_two_hundred_bodies_thrown_about_stay_in_a_room_of_triangles(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_mesh room = physics_scene_mesh_box(half, 10, true);
    nook_body_desc desc = physics_scene_desc(&room.shape, NOOK_BODY_STATIC, 0, 0, 0, 0);
    nook_body walls = physics_scene_add(physics, &desc);
    physics_scene_mesh_free(&room);
    uint64_t random = 1;
    for (int i = 0; i < BODIES; i++)
        throw_in(physics, i, &random);
    for (int i = 0; i < STEPS; i += 50) {
        physics_scene_step(physics, 50);
        assert_inside(physics, walls.id + 1);
    }
    nook_physics_statistics statistics;
    nook_physics_get_statistics(physics, &statistics);
    print_message("%u of %u still awake after %d steps\n", statistics.awake, statistics.dynamic, STEPS);
    assert_true(statistics.awake < BODIES / 4);
    nook_physics_destroy(physics);
}

/* Of all shapes, each turned another way, thrown at a wall 5 cm thick. @return how many are behind it */
static int thrown_through(double speed)
{
    int through = 0;
    uint64_t random = 3;
    for (int i = 0; i < 20; i++) {
        nook_physics *physics = physics_scene_create();
        physics_scene_mesh wall = physics_scene_mesh_box((double[3]){ 0.025, 3, 3 }, 4, false);
        nook_body_desc wall_desc = physics_scene_desc(&wall.shape, NOOK_BODY_STATIC, 0, 0, 0, 0);
        physics_scene_add(physics, &wall_desc);
        physics_scene_mesh_free(&wall);
        nook_shape shape = shape_of(i);
        nook_body_desc desc = physics_scene_desc(&shape, NOOK_BODY_DYNAMIC, 15, -1.2 - 0.017 * i, 0, 0);
        desc.pose.rotation[0] = sin(next(&random)), desc.pose.rotation[3] = sqrt(1 - pow(desc.pose.rotation[0], 2));
        nook_body body = physics_scene_add(physics, &desc);
        nook_physics_set_velocity(physics, body, (double[3]){ speed, 2, 0 }, (double[3]){ 0 });
        physics_scene_step(physics, 30);
        double at[3];
        physics_scene_position(physics, body, at);
        through += at[0] > -0.025;
        nook_physics_destroy(physics);
    }
    return through;
}

static void test_nothing_is_thrown_through_a_thin_wall(void **state)
{
    (void)state;
    assert_int_equal(thrown_through(5), 0);
    assert_int_equal(thrown_through(10), 0);
    assert_int_equal(thrown_through(40), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_hundred_bodies_thrown_about_stay_in_a_room_of_triangles),
        cmocka_unit_test(test_nothing_is_thrown_through_a_thin_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
