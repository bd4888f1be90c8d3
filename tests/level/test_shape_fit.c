#include "game/level/shape_fit.h"
#include "tests/support/physics_scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <cmocka.h>

static const double pi = 3.14159265358979323846;
static const double unscaled[3] = { 1, 1, 1 };

enum { POINTS_MAX = 1024 };

/* A mesh is its points here: fitting looks at nothing else. */
typedef struct cloud {
    float points[POINTS_MAX][3];
    uint32_t count;
} cloud;

static void add_point(cloud *c, double x, double y, double z)
{
    assert_true(c->count < POINTS_MAX);
    const float point[3] = { (float)x, (float)y, (float)z };
    memcpy(c->points[c->count++], point, sizeof point);
}

/* A ring about an axis, `at` along it. */
static void add_ring(cloud *c, int axis, double at, double radius, int corners)
{
    for (int i = 0; i < corners; i++) {
        double p[3];
        p[axis] = at;
        p[(axis + 1) % 3] = radius * cos(2 * pi * i / corners);
        p[(axis + 2) % 3] = radius * sin(2 * pi * i / corners);
        add_point(c, p[0], p[1], p[2]);
    }
}

static nook_shape fit_scaled(const cloud *c, const double scale[3], nook_level_shape wanted)
{
    nook_scene *scene;
    nook_shape shape;
    uint32_t indices[POINTS_MAX * 3];
    for (uint32_t i = 0; i < c->count * 3; i++)
        indices[i] = i % 3 == 0 ? i / 3 : (i / 3 + i % 3) % c->count;
    assert_int_equal(nook_scene_from_triangles("cloud", c->points[0], c->count, indices, c->count * 3, &scene),
                     NOOK_OK);
    nook_level_shape_fit(scene, 0, scale, wanted, &shape);
    nook_scene_destroy(scene);
    return shape;
}

static nook_shape fit(const cloud *c)
{
    return fit_scaled(c, unscaled, NOOK_LEVEL_SHAPE_AUTO);
}

static void add_corners(cloud *c, double x, double y, double z)
{
    for (int i = 0; i < 8; i++)
        add_point(c, i & 1 ? x : -x, i & 2 ? y : 0, i & 4 ? z : -z);
}

/* Where a shape's Y axis points in its body. */
static void axis_of(const nook_shape *shape, double out[3])
{
    const double up[3] = { 0, 1, 0 };
    nook_pose_apply_vector(&shape->body_from_shape, up, out);
}

static void test_crate_is_a_box_that_stands_on_its_bottom(void **state)
{
    (void)state;
    cloud c = { .count = 0 };
    add_corners(&c, 0.5, 0.9, 0.4);
    nook_shape shape = fit(&c);
    assert_int_equal(shape.kind, NOOK_SHAPE_BOX);
    physics_assert_near(shape.half[0], 0.5, 1e-6);
    physics_assert_near(shape.half[1], 0.45, 1e-6);
    physics_assert_near(shape.half[2], 0.4, 1e-6);
    physics_assert_near(shape.body_from_shape.position[1], 0.45, 1e-6);
}

static void test_square_post_is_a_box_however_it_is_turned(void **state)
{
    (void)state;
    cloud straight = { .count = 0 }, diamond = { .count = 0 };
    add_corners(&straight, 0.2, 1, 0.2);
    add_ring(&diamond, 1, 0, 0.2, 4);
    add_ring(&diamond, 1, 1, 0.2, 4);
    assert_int_equal(fit(&straight).kind, NOOK_SHAPE_BOX);
    assert_int_equal(fit(&diamond).kind, NOOK_SHAPE_BOX);
}

static void test_drum_is_a_cylinder_about_whichever_axis(void **state)
{
    (void)state;
    for (int axis = 0; axis < 3; axis++) {
        cloud c = { .count = 0 };
        add_ring(&c, axis, 0, 0.29, 24);
        add_ring(&c, axis, 0.88, 0.29, 24);
        nook_shape shape = fit(&c);
        assert_int_equal(shape.kind, NOOK_SHAPE_CYLINDER);
        double at[3];
        axis_of(&shape, at);
        physics_assert_near(fabs(at[axis]), 1, 1e-12);
        physics_assert_near(shape.half[1], 0.44, 1e-6);
        physics_assert_near(shape.body_from_shape.position[axis], 0.44, 1e-6);
        /* between the circle through the corners and the one through the middles of the edges */
        assert_true(shape.half[0] < 0.29 && shape.half[0] > 0.29 * cos(pi / 24));
    }
}

static void test_gear_and_barrel_are_cylinders(void **state)
{
    (void)state;
    cloud gear = { .count = 0 }, barrel = { .count = 0 };
    for (int i = 0; i < 2; i++) {
        add_ring(&gear, 1, 0.1 * i, 0.3, 32);
        add_ring(&gear, 1, 0.1 * i, 0.25, 37); /* between its teeth, and its bore */
        add_ring(&gear, 1, 0.1 * i, 0.08, 16);
        add_ring(&barrel, 1, 0.9 * i, 0.27, 20);
    }
    add_ring(&barrel, 1, 0.45, 0.33, 20);
    assert_int_equal(fit(&gear).kind, NOOK_SHAPE_CYLINDER);
    physics_assert_near(fit(&gear).half[0], 0.3, 0.003);
    assert_int_equal(fit(&barrel).kind, NOOK_SHAPE_CYLINDER);
    physics_assert_near(fit(&barrel).half[0], 0.33, 0.003);
}

static void test_ball_is_a_sphere(void **state)
{
    (void)state;
    cloud c = { .count = 0 };
    for (int i = 0; i <= 12; i++)
        add_ring(&c, 1, 0.5 - 0.5 * cos(pi * i / 12), 0.5 * sin(pi * i / 12), 24);
    nook_shape shape = fit(&c);
    assert_int_equal(shape.kind, NOOK_SHAPE_SPHERE);
    physics_assert_near(shape.half[0], 0.5, 0.006);
    physics_assert_near(shape.body_from_shape.position[1], 0.5, 1e-6);
}

static void test_egg_is_a_cylinder_and_a_cube_is_no_ball(void **state)
{
    (void)state;
    cloud egg = { .count = 0 }, cube = { .count = 0 };
    for (int i = 0; i <= 12; i++)
        add_ring(&egg, 1, 0.7 - 0.7 * cos(pi * i / 12), 0.5 * sin(pi * i / 12), 24);
    add_corners(&cube, 0.5, 1, 0.5);
    assert_int_equal(fit(&egg).kind, NOOK_SHAPE_CYLINDER);
    assert_int_equal(fit(&cube).kind, NOOK_SHAPE_BOX);
}

static void test_scale_makes_a_drum_oval_and_moves_its_middle(void **state)
{
    (void)state;
    cloud c = { .count = 0 };
    add_ring(&c, 1, 0, 0.3, 32);
    add_ring(&c, 1, 1, 0.3, 32);
    nook_shape twice = fit_scaled(&c, (double[3]){ 2, 2, 2 }, NOOK_LEVEL_SHAPE_AUTO);
    assert_int_equal(twice.kind, NOOK_SHAPE_CYLINDER);
    physics_assert_near(twice.half[0], 0.6, 0.002);
    physics_assert_near(twice.body_from_shape.position[1], 1, 1e-6);
    nook_shape oval = fit_scaled(&c, (double[3]){ 1.3, 1, 1 }, NOOK_LEVEL_SHAPE_AUTO);
    assert_int_equal(oval.kind, NOOK_SHAPE_BOX);
    physics_assert_near(oval.half[0], 0.39, 1e-6);
    nook_shape mirrored = fit_scaled(&c, (double[3]){ 1, -1, 1 }, NOOK_LEVEL_SHAPE_AUTO);
    physics_assert_near(mirrored.body_from_shape.position[1], -0.5, 1e-6);
}

static void test_wanted_shapes_are_taken(void **state)
{
    (void)state;
    cloud drum = { .count = 0 }, crate = { .count = 0 };
    add_ring(&drum, 1, 0, 0.3, 32);
    add_ring(&drum, 1, 1, 0.3, 32);
    add_corners(&crate, 0.5, 2, 0.5);
    assert_int_equal(fit_scaled(&drum, unscaled, NOOK_LEVEL_SHAPE_BOX).kind, NOOK_SHAPE_BOX);
    assert_int_equal(fit_scaled(&drum, unscaled, NOOK_LEVEL_SHAPE_SPHERE).kind, NOOK_SHAPE_SPHERE);
    nook_shape shape = fit_scaled(&crate, unscaled, NOOK_LEVEL_SHAPE_CYLINDER);
    double at[3];
    axis_of(&shape, at);
    assert_int_equal(shape.kind, NOOK_SHAPE_CYLINDER);
    physics_assert_near(at[1], 1, 1e-12);
    physics_assert_near(shape.half[1], 1, 1e-6);
}

/* What has no thickness would be refused by the physics. */
static void test_flat_sheet_is_given_a_thickness(void **state)
{
    (void)state;
    cloud c = { .count = 0 };
    for (int i = 0; i < 4; i++)
        add_point(&c, i & 1, 0, i & 2);
    nook_shape shape = fit(&c);
    assert_int_equal(shape.kind, NOOK_SHAPE_BOX);
    assert_true(shape.half[1] > 0);
    nook_physics *physics = physics_scene_create();
    nook_body_desc desc = physics_scene_desc(&shape, NOOK_BODY_DYNAMIC, 1, 0, 0, 0);
    physics_scene_add(physics, &desc);
    nook_physics_destroy(physics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_crate_is_a_box_that_stands_on_its_bottom),
        cmocka_unit_test(test_square_post_is_a_box_however_it_is_turned),
        cmocka_unit_test(test_drum_is_a_cylinder_about_whichever_axis),
        cmocka_unit_test(test_gear_and_barrel_are_cylinders),
        cmocka_unit_test(test_ball_is_a_sphere),
        cmocka_unit_test(test_egg_is_a_cylinder_and_a_cube_is_no_ball),
        cmocka_unit_test(test_scale_makes_a_drum_oval_and_moves_its_middle),
        cmocka_unit_test(test_wanted_shapes_are_taken),
        cmocka_unit_test(test_flat_sheet_is_given_a_thickness),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
