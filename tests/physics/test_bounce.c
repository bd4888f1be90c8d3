#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

/* How high a ball comes that falls from 2 m on the floor, as a part of that. */
static double bounce(double restitution)
{
    const double radius = 0.1, drop = 2.0;
    nook_physics *physics = physics_scene_create();
    physics_scene_floor(physics, 5);
    nook_shape ball = physics_scene_round(NOOK_SHAPE_SPHERE, radius, 0);
    nook_body_desc desc = physics_scene_desc(&ball, NOOK_BODY_DYNAMIC, 2, 0, radius + drop, 0);
    desc.restitution = restitution;
    nook_body body = physics_scene_add(physics, &desc);
    physics_scene_step(physics, 42); /* it meets the floor after 0.64 s, in step 39 */
    double highest = 0;
    for (int i = 0; i < 60; i++) {
        physics_scene_step(physics, 1);
        highest = fmax(highest, physics_scene_height(physics, body) - radius);
    }
    nook_physics_destroy(physics);
    return highest / drop;
}

static void test_restitution_of_one_gives_all_of_the_height_back(void **state)
{
    (void)state;
    physics_assert_near(bounce(1.0), 1.0, 0.05); /* a step's gravity is 0.08 m/s of 6.3 */
}

static void test_restitution_of_a_half_gives_a_quarter_of_the_height_back(void **state)
{
    (void)state;
    physics_assert_near(bounce(0.5), 0.25, 0.02);
}

static void test_restitution_of_zero_gives_nothing_back(void **state)
{
    (void)state;
    physics_assert_near(bounce(0.0), 0.0, 0.005);
}

static void test_bouncing_comes_to_an_end(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_floor(physics, 5);
    nook_shape box = physics_scene_box(0.2, 0.2, 0.2);
    nook_body_desc desc = physics_scene_desc(&box, NOOK_BODY_DYNAMIC, 10, 0, 1.2, 0);
    desc.restitution = 0.4;
    nook_body body = physics_scene_add(physics, &desc);
    physics_scene_step(physics, 300);
    assert_true(nook_physics_asleep(physics, body));
    physics_assert_near(physics_scene_height(physics, body), 0.2, 0.001);
    nook_physics_destroy(physics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_restitution_of_one_gives_all_of_the_height_back),
        cmocka_unit_test(test_restitution_of_a_half_gives_a_quarter_of_the_height_back),
        cmocka_unit_test(test_restitution_of_zero_gives_nothing_back),
        cmocka_unit_test(test_bouncing_comes_to_an_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
