#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

static const nook_body nobody[2] = { { 0 }, { 0 } };

static nook_body add_static(nook_physics *physics, const nook_shape *shape, double x, double y, double z)
{
    nook_body_desc desc = physics_scene_desc(shape, NOOK_BODY_STATIC, 0, x, y, z);
    return physics_scene_add(physics, &desc);
}

static void assert_hit(nook_physics *physics, const double origin[3], const double direction[3], double distance,
                       const double normal[3])
{
    nook_ray_hit hit;
    assert_true(nook_physics_ray(physics, origin, direction, 100, nobody, &hit));
    physics_assert_near(hit.distance, distance, 1e-6);
    for (int i = 0; i < 3; i++)
        physics_assert_near(hit.normal[i], normal[i], 1e-6);
}

/* Down on a shape at the origin from 5 m above (x, z), which must be hit at height y with this normal. */
static void assert_hit_from_above(const nook_shape *shape, double x, double z, double y, const double normal[3])
{
    nook_physics *physics = physics_scene_create();
    add_static(physics, shape, 0, 0, 0);
    assert_hit(physics, (double[3]){ x, 5, z }, (double[3]){ 0, -1, 0 }, 5 - y, normal);
    nook_physics_destroy(physics);
}

static void test_ray_meets_every_shape_where_it_is(void **state)
{
    (void)state;
    const double up[3] = { 0, 1, 0 };
    const nook_shape box = physics_scene_box(0.5, 0.3, 0.4), drum = physics_scene_round(NOOK_SHAPE_CYLINDER, 0.3, 0.45);
    const nook_shape ball = physics_scene_round(NOOK_SHAPE_SPHERE, 0.5, 0);
    const nook_shape person = physics_scene_round(NOOK_SHAPE_CAPSULE, 0.5, 0.6);
    physics_scene_mesh mesh = physics_scene_mesh_box((double[3]){ 0.5, 0.3, 0.4 }, 3, false);
    assert_hit_from_above(&box, 0.1, 0.2, 0.3, up);
    assert_hit_from_above(&drum, 0.1, 0.2, 0.45, up);
    assert_hit_from_above(&ball, 0.3, 0, 0.4, (double[3]){ 0.6, 0.8, 0 });
    assert_hit_from_above(&person, 0.3, 0, 1.0, (double[3]){ 0.6, 0.8, 0 });
    assert_hit_from_above(&mesh.shape, 0.1, 0.2, 0.3, up);
    physics_scene_mesh_free(&mesh);
}

static void test_ray_gives_the_nearest_of_all(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_shape box = physics_scene_box(0.2, 0.2, 0.2);
    nook_body near = { 0 };
    for (int i = 5; i > 0; i--)
        near = add_static(physics, &box, i, 0, 0);
    nook_ray_hit hit;
    assert_true(nook_physics_ray(physics, (double[3]){ 0 }, (double[3]){ 1, 0, 0 }, 100, nobody, &hit));
    assert_int_equal(hit.body.id, near.id);
    physics_assert_near(hit.distance, 0.8, 1e-9);
    nook_physics_destroy(physics);
}

static void test_ray_ends_at_its_length(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_shape box = physics_scene_box(0.5, 0.5, 0.5);
    add_static(physics, &box, 3, 0, 0);
    nook_ray_hit hit = { .distance = -1 };
    const double origin[3] = { 0 }, direction[3] = { 1, 0, 0 };
    assert_false(nook_physics_ray(physics, origin, direction, 2.49, nobody, &hit));
    assert_true(hit.distance == -1); /* untouched */
    assert_true(nook_physics_ray(physics, origin, direction, 2.51, nobody, &hit));
    nook_physics_destroy(physics);
}

static void test_ray_looks_through_two_bodies(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_shape box = physics_scene_box(0.2, 0.2, 0.2);
    nook_body boxes[3];
    for (int i = 0; i < 3; i++)
        boxes[i] = add_static(physics, &box, i + 1, 0, 0);
    nook_ray_hit hit;
    assert_true(nook_physics_ray(physics, (double[3]){ 0 }, (double[3]){ 1, 0, 0 }, 100, boxes, &hit));
    assert_int_equal(hit.body.id, boxes[2].id);
    nook_physics_destroy(physics);
}

static void test_ray_finds_ghosts_that_nothing_touches(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_shape box = physics_scene_box(1, 0.1, 1);
    nook_body_desc desc = physics_scene_desc(&box, NOOK_BODY_KINEMATIC, 0, 0, 0, 0);
    desc.ghost = true;
    nook_body ghost = physics_scene_add(physics, &desc), crate = physics_scene_crate(physics, 0.2, 5, 0, 0.3, 0);
    const nook_body ignored[2] = { crate };
    nook_ray_hit hit;
    assert_true(nook_physics_ray(physics, (double[3]){ 0, 5, 0 }, (double[3]){ 0, -1, 0 }, 100, ignored, &hit));
    assert_int_equal(hit.body.id, ghost.id);
    physics_scene_step(physics, 60);
    assert_true(physics_scene_height(physics, crate) < -4);
    nook_physics_destroy(physics);
}

static void test_ray_meets_a_mesh_from_both_sides(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_mesh grid = physics_scene_grid(2, 3);
    add_static(physics, &grid.shape, 0, 1, 0);
    physics_scene_mesh_free(&grid);
    assert_hit(physics, (double[3]){ 0.3, 3, 0.1 }, (double[3]){ 0, -1, 0 }, 2, (double[3]){ 0, 1, 0 });
    assert_hit(physics, (double[3]){ 0.3, 0, 0.1 }, (double[3]){ 0, 1, 0 }, 1, (double[3]){ 0, -1, 0 });
    nook_physics_destroy(physics);
}

static void test_ray_that_begins_in_a_body_meets_it_from_within(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_shape box = physics_scene_box(0.5, 0.5, 0.5);
    add_static(physics, &box, 0, 0, 0);
    assert_hit(physics, (double[3]){ 0.1, 0, 0 }, (double[3]){ 1, 0, 0 }, 0.4, (double[3]){ -1, 0, 0 });
    nook_physics_destroy(physics);
}

static void test_ray_follows_a_body_that_moved(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body crate = physics_scene_crate(physics, 0.25, 15, 0, 50, 0);
    physics_scene_step(physics, 60);
    double height = physics_scene_height(physics, crate);
    assert_hit(physics, (double[3]){ 0, height + 2, 0 }, (double[3]){ 0, -1, 0 }, 1.75, (double[3]){ 0, 1, 0 });
    nook_physics_destroy(physics);
}

/* ---- overlaps ---- */

typedef struct found_bodies {
    uint32_t ids[8], count;
} found_bodies;

static void note(void *user, nook_body body)
{
    found_bodies *found = user;
    assert_true(found->count < 8);
    found->ids[found->count++] = body.id;
}

static void test_overlap_finds_each_body_that_touches_a_box_once(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    physics_scene_mesh grid = physics_scene_grid(2, 4);
    nook_body ground = add_static(physics, &grid.shape, 0, 0, 0);
    physics_scene_mesh_free(&grid);
    nook_shape parts[2] = { physics_scene_box(0.1, 0.1, 0.1), physics_scene_box(0.1, 0.1, 0.1) };
    parts[1].body_from_shape.position[1] = 0.15;
    nook_body_desc desc = physics_scene_desc(parts, NOOK_BODY_DYNAMIC, 5, 0, 0.4, 0);
    desc.shape_count = 2;
    nook_body pair = physics_scene_add(physics, &desc);
    physics_scene_crate(physics, 0.1, 5, 1, 1, 0);
    found_bodies all = { .count = 0 }, high = { .count = 0 };
    nook_physics_overlap(physics, (double[3]){ -0.2, -0.2, -0.2 }, (double[3]){ 0.2, 0.7, 0.2 }, note, &all);
    assert_int_equal(all.count, 2);
    assert_int_equal(all.ids[0], ground.id);
    assert_int_equal(all.ids[1], pair.id);
    nook_physics_overlap(physics, (double[3]){ -0.2, 1.3, -0.2 }, (double[3]){ 0.2, 2, 0.2 }, note, &high);
    assert_int_equal(high.count, 0);
    nook_physics_destroy(physics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ray_meets_every_shape_where_it_is),
        cmocka_unit_test(test_ray_gives_the_nearest_of_all),
        cmocka_unit_test(test_ray_ends_at_its_length),
        cmocka_unit_test(test_ray_looks_through_two_bodies),
        cmocka_unit_test(test_ray_finds_ghosts_that_nothing_touches),
        cmocka_unit_test(test_ray_meets_a_mesh_from_both_sides),
        cmocka_unit_test(test_ray_that_begins_in_a_body_meets_it_from_within),
        cmocka_unit_test(test_ray_follows_a_body_that_moved),
        cmocka_unit_test(test_overlap_finds_each_body_that_touches_a_box_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
