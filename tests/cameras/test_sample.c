#include "engine/core/file.h"
#include "game/cameras/glance.h"
#include "game/cameras/places.h"
#include "game/cameras/sample.h"
#include "game/compare/camera.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_glb.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { VIEWS = 12 };
static const double aspect = 16.0 / 9.0;

static nook_scene *load(const char *folder, const char *name)
{
    char path[4096];
    nook_scene *scene;
    const nook_scene_options geometry = { .skip_images = true };
    nook_path_join(path, sizeof path, folder, name);
    assert_int_equal(nook_scene_load(path, &geometry, &scene), NOOK_OK);
    return scene;
}

static nook_scene *load_own(const char *name)
{
    const char *root = getenv("NOOK_ROOT");
    return load(root ? root : ".", name);
}

static nook_scene *load_shared(const char *name)
{
    const char *shared = getenv("NOOK_SHARED");
    if (!shared || !*shared) {
        print_message("NOOK_SHARED is not set\n");
        skip();
    }
    char folder[4096];
    nook_path_join(folder, sizeof folder, shared, "scenes");
    return load(folder, name);
}

static void eye_of(const nook_camera *camera, double out[3])
{
    const double origin[3] = { 0.0, 0.0, 0.0 };
    nook_matrix world_from_view;
    assert_true(nook_matrix_inverse_affine(&camera->view_from_world, &world_from_view));
    nook_matrix_apply_point(&world_from_view, origin, out);
}

static bool is_within(const nook_scene *scene, const double point[3])
{
    for (int i = 0; i < 3; i++) {
        if (point[i] < scene->bounds_min[i] || point[i] > scene->bounds_max[i])
            return false;
    }
    return true;
}

static void must_sample(const nook_scene *scene, uint32_t first, uint32_t count, nook_camera *out)
{
    assert_int_equal(nook_cameras_sample(scene, aspect, first, count, out), NOOK_OK);
}

static void test_the_first_views_of_a_longer_call_are_those_of_a_shorter_one(void **state)
{
    (void)state;
    static const char *const scenes[] = { "tests/game/data/crate.gltf", "content/hall/hall.glb" };
    for (size_t s = 0; s < NOOK_COUNT(scenes); s++) {
        nook_scene *scene = load_own(scenes[s]);
        nook_camera all[2 * VIEWS], again[2 * VIEWS], some[VIEWS];
        must_sample(scene, 0, 2 * VIEWS, all);
        must_sample(scene, 0, 2 * VIEWS, again);
        assert_memory_equal(all, again, sizeof all);
        must_sample(scene, 0, 5, some);
        assert_memory_equal(all, some, 5 * sizeof *some);
        must_sample(scene, VIEWS, VIEWS, some);
        assert_memory_equal(all + VIEWS, some, sizeof some);
        nook_scene_destroy(scene);
    }
}

static void test_no_two_views_are_alike(void **state)
{
    (void)state;
    nook_scene *scene = load_own("content/hall/hall.glb");
    nook_camera views[3 * VIEWS];
    must_sample(scene, 0, 3 * VIEWS, views);
    for (int i = 0; i < 3 * VIEWS; i++) {
        for (int k = 0; k < i; k++) {
            double difference = 0.0;
            for (int m = 0; m < 16; m++)
                difference = fmax(difference, fabs(views[i].view_from_world.m[m] - views[k].view_from_world.m[m]));
            assert_true(difference > 1e-3);
        }
    }
    nook_scene_destroy(scene);
}

static void test_views_of_a_scene_with_cameras_are_around_them_in_turn(void **state)
{
    (void)state;
    nook_scene *scene = load_own("content/hall/hall.glb");
    uint32_t period = nook_cameras_period(scene);
    nook_camera views[2 * VIEWS];
    assert_int_equal(period, 5);
    must_sample(scene, 0, 2 * VIEWS, views);
    for (uint32_t i = 0; i < 2 * VIEWS; i++) {
        nook_camera own = nook_camera_from_scene(nook_camera_at(scene, i % period));
        double eye[3], near[3], distance = 0.0;
        eye_of(&views[i], eye);
        eye_of(&own, near);
        for (int k = 0; k < 3; k++)
            distance += (eye[k] - near[k]) * (eye[k] - near[k]);
        assert_true(sqrt(distance) < 0.07 * nook_scene_diagonal(scene));
        assert_true(views[i].fov_y_radians == own.fov_y_radians);
    }
    nook_scene_destroy(scene);
}

static void test_views_go_around_an_object(void **state)
{
    (void)state;
    nook_scene *scene = load_own("tests/game/data/crate.gltf");
    nook_camera views[4 * VIEWS];
    nook_rays *rays;
    int quadrants[4] = { 0 };
    must_sample(scene, 0, 4 * VIEWS, views);
    assert_int_equal(nook_rays_create(scene, &rays), NOOK_OK);
    for (int i = 0; i < 4 * VIEWS; i++) {
        double eye[3];
        eye_of(&views[i], eye);
        assert_false(is_within(scene, eye));
        quadrants[(eye[0] > 0.0) + 2 * (eye[2] > 0.0)]++;
        assert_true(nook_glance_at(rays, &views[i], aspect, 0.0).geometry > 0.1);
    }
    for (int q = 0; q < 4; q++) /* evenly: a quarter of them each, give or take */
        assert_in_range(quadrants[q], VIEWS / 2, VIEWS * 2);
    nook_rays_destroy(rays);
    nook_scene_destroy(scene);
}

/* Closed buildings: from within, from before no wall's nose, and never where only the inside of a double wall is seen. */
static void check_rooms(const char *name)
{
    nook_scene *scene = load_shared(name);
    double diagonal = nook_scene_diagonal(scene);
    nook_camera views[4 * VIEWS];
    nook_rays *rays;
    must_sample(scene, 0, 4 * VIEWS, views);
    assert_int_equal(nook_rays_create(scene, &rays), NOOK_OK);
    for (int i = 0; i < 4 * VIEWS; i++) {
        double eye[3];
        eye_of(&views[i], eye);
        assert_true(is_within(scene, eye));
        nook_glance seen = nook_glance_at(rays, &views[i], aspect, 0.02 * diagonal);
        assert_true(seen.geometry > 0.6);
        assert_true(seen.backs < 0.05);
        assert_true(seen.near < 0.05);
        assert_true(seen.median > 0.05 * diagonal);
    }
    nook_rays_destroy(rays);
    nook_scene_destroy(scene);
}

static void test_views_of_sponza_are_from_inside(void **state)
{
    (void)state;
    check_rooms("meshes/sponza_crytek_geometry.glb");
}

static void test_views_of_the_hangar_are_from_inside(void **state)
{
    (void)state;
    check_rooms("scenes/composed_hangar.glb");
}

static void test_rays_meet_what_the_slow_ones_meet(void **state)
{
    (void)state;
    nook_scene *scene = load_own("tests/game/data/crate.gltf");
    nook_rays *rays;
    assert_int_equal(nook_rays_create(scene, &rays), NOOK_OK);
    int hits = 0;
    for (int i = 0; i < 400; i++) {
        const double from[3] = { 2.0 * cos(i), 0.3 + 0.01 * i, 2.0 * sin(i) };
        const double along[3] = { -cos(i + 0.1 * (i % 7)), -0.3 * (i % 3), -sin(i - 0.05 * (i % 5)) };
        nook_view_hit fast = nook_rays_cast(rays, from, along), slow = nook_scene_cast(scene, from, along);
        assert_int_equal(isfinite(fast.distance), isfinite(slow.distance));
        if (!isfinite(slow.distance))
            continue;
        hits++;
        assert_true(fabs(fast.distance - slow.distance) < 1e-4);
        assert_int_equal(fast.front, slow.front);
        const double before[3] = { from[0] + along[0] * 0.99 * slow.distance, from[1] + along[1] * 0.99 * slow.distance,
                                   from[2] + along[2] * 0.99 * slow.distance };
        const double behind[3] = { from[0] + along[0] * 1.01 * slow.distance, from[1] + along[1] * 1.01 * slow.distance,
                                   from[2] + along[2] * 1.01 * slow.distance };
        assert_true(nook_rays_see(rays, from, before));
        assert_false(nook_rays_see(rays, from, behind));
    }
    assert_true(hits > 100);
    nook_rays_destroy(rays);
    nook_scene_destroy(scene);
}

/* A floor and a camera on it that looks at the sky. */
static void test_a_camera_that_sees_nothing_has_no_views(void **state)
{
    (void)state;
    static const float corners[] = { -1, 0, -1, 1, 0, -1, -1, 0, 1, 1, 1, 1 };
    test_glb glb = { 0 };
    test_glb_add(&glb, corners, sizeof corners);
    nook_scene *scene = test_glb_must_load(
        &glb,
        "'scenes': [ { 'nodes': [ 0, 1 ] } ], 'nodes': [ { 'mesh': 0 }, { 'camera': 0, 'translation': [ 0, 0.9, 0 ], "
        "'rotation': [ 0.7071068, 0, 0, 0.7071068 ] } ], 'meshes': [ { 'primitives': [ { 'attributes': { 'POSITION': 0 "
        "}, "
        "'mode': 5 } ] } ], 'cameras': [ { 'type': 'perspective', 'perspective': { 'yfov': 0.5, 'znear': 0.1 } } ], "
        "'accessors': [ " TEST_GLB_QUAD_POSITIONS " ]");
    nook_camera view, before;
    nook_log_capture log;
    memset(&view, 7, sizeof view);
    before = view;
    nook_log_capture_begin(&log);
    nook_result result = nook_cameras_sample(scene, aspect, 0, 1, &view);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_NOT_FOUND);
    assert_int_equal(log.count, 1);
    assert_non_null(strstr(log.text, "give the scene a camera"));
    assert_memory_equal(&view, &before, sizeof view);
    nook_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_first_views_of_a_longer_call_are_those_of_a_shorter_one),
        cmocka_unit_test(test_no_two_views_are_alike),
        cmocka_unit_test(test_views_of_a_scene_with_cameras_are_around_them_in_turn),
        cmocka_unit_test(test_views_go_around_an_object),
        cmocka_unit_test(test_views_of_sponza_are_from_inside),
        cmocka_unit_test(test_views_of_the_hangar_are_from_inside),
        cmocka_unit_test(test_rays_meet_what_the_slow_ones_meet),
        cmocka_unit_test(test_a_camera_that_sees_nothing_has_no_views),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
