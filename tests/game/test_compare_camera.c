#include "game/compare/camera.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static nook_scene_camera cameras[] = {
    { .name = (char *)"flat", .fov_y_radians = 1.0, .z_near = 0.1, .perspective = false },
    { .name = (char *)"door", .fov_y_radians = 0.9, .z_near = 0.1, .perspective = true },
    { .name = (char *)"roof", .fov_y_radians = 0.7, .z_near = 0.1, .perspective = true },
};

static nook_scene make_scene(uint32_t camera_count)
{
    for (size_t i = 0; i < NOOK_COUNT(cameras); i++)
        cameras[i].world_from_view = nook_matrix_translation((double)i, 0.0, 0.0);
    return (nook_scene){ .path = (char *)"room.glb",
                         .cameras = cameras,
                         .camera_count = camera_count,
                         .bounds_min = { -3.0, 0.0, -2.0 },
                         .bounds_max = { 3.0, 4.0, 2.0 } };
}

static void assert_near(double value, double truth)
{
    if (!(fabs(value - truth) <= 1e-9))
        fail_msg("%.17g is not %.17g", value, truth);
}

static void assert_sees(const nook_camera *camera, double x, double y, double z, double view_x, double view_y,
                        double view_z)
{
    const double world[3] = { x, y, z };
    double view[3];
    nook_matrix_apply_point(&camera->view_from_world, world, view);
    assert_near(view[0], view_x);
    assert_near(view[1], view_y);
    assert_near(view[2], view_z);
}

static nook_result choose(const nook_scene *scene, const char *text, nook_camera *camera, char label[64])
{
    return nook_camera_choose(scene, text, 1.5, camera, label, 64);
}

static void test_the_first_camera_with_perspective_is_taken_when_none_is_named(void **state)
{
    (void)state;
    nook_scene scene = make_scene(3);
    nook_camera camera;
    char label[64];
    assert_int_equal(choose(&scene, NULL, &camera, label), NOOK_OK);
    assert_string_equal(label, "door");
    assert_true(camera.fov_y_radians == 0.9);
}

static void test_a_camera_is_found_by_its_name(void **state)
{
    (void)state;
    nook_scene scene = make_scene(3);
    nook_camera camera;
    char label[64];
    assert_int_equal(choose(&scene, "roof", &camera, label), NOOK_OK);
    assert_string_equal(label, "roof");
    assert_sees(&camera, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0);
}

static void test_an_unknown_name_is_refused_with_the_names_there_are(void **state)
{
    (void)state;
    nook_scene scene = make_scene(3);
    nook_camera camera;
    char label[64];
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(choose(&scene, "cellar", &camera, label), NOOK_E_NOT_FOUND);
    assert_int_equal(log.count, 1);
    assert_non_null(strstr(log.text, "'door', 'roof'"));
    assert_null(strstr(log.text, "flat")); /* cannot be used */
    scene.camera_count = 0;
    assert_int_equal(choose(&scene, "cellar", &camera, label), NOOK_E_NOT_FOUND);
    assert_non_null(strstr(log.text, "room.glb has no cameras"));
    nook_log_capture_end();
}

static void test_seven_numbers_are_eye_target_and_angle(void **state)
{
    (void)state;
    nook_scene scene = make_scene(3);
    nook_camera camera;
    char label[64];
    assert_int_equal(choose(&scene, "1,2,3,1,2,-7,90", &camera, label), NOOK_OK);
    assert_near(camera.fov_y_radians, acos(0.0));
    assert_true(camera.z_near > 0.0 && camera.z_near < 0.01);
    assert_sees(&camera, 1, 2, 3, 0, 0, 0);
    assert_sees(&camera, 1, 2, -7, 0, 0, -10);
    assert_sees(&camera, 1, 3, 3, 0, 1, 0);
}

static void test_numbers_that_are_no_view_are_refused(void **state)
{
    (void)state;
    nook_scene scene = make_scene(3);
    static const char *const wrong[] = { "1,2,3",
                                         "1,2,3,4,5,6,7,8",
                                         "1,2,3,1,2,3,60",
                                         "0,0,0,0,0,1,0",
                                         "0,0,0,0,0,1,180",
                                         "0,0,0,0,0,1,nan",
                                         "0,0,0,inf,0,1,60",
                                         "0,0,0,0,0,1,60 ",
                                         "0,0,0,,0,1,60",
                                         "",
                                         "0,0,0,0,0,1e200,60" };
    nook_log_capture log;
    nook_log_capture_begin(&log);
    for (size_t i = 0; i < NOOK_COUNT(wrong); i++) {
        nook_camera camera = { .z_near = 42.0 };
        char label[64] = "untouched";
        if (choose(&scene, wrong[i], &camera, label) == NOOK_OK)
            fail_msg("'%s' was taken", wrong[i]);
        assert_true(camera.z_near == 42.0);
        assert_string_equal(label, "untouched");
    }
    assert_int_equal(log.count, NOOK_COUNT(wrong));
    nook_log_capture_end();
}

static void test_straight_down_is_a_view_like_any_other(void **state)
{
    (void)state;
    nook_scene scene = make_scene(0);
    nook_camera camera;
    char label[64];
    assert_int_equal(choose(&scene, "0,5,0,0,1,0,60", &camera, label), NOOK_OK);
    assert_sees(&camera, 0, 1, 0, 0, 0, -4);
    assert_near(fabs(nook_matrix_determinant3(&camera.view_from_world)), 1.0);
}

static void test_without_cameras_the_whole_scene_is_seen_from_outside(void **state)
{
    (void)state;
    nook_scene scene = make_scene(0);
    nook_camera camera;
    char label[64];
    assert_int_equal(choose(&scene, NULL, &camera, label), NOOK_OK);
    assert_string_equal(label, "automatic");
    double half_y = tan(0.5 * camera.fov_y_radians);
    for (int corner = 0; corner < 8; corner++) {
        double world[3], view[3];
        for (int i = 0; i < 3; i++)
            world[i] = corner >> i & 1 ? scene.bounds_max[i] : scene.bounds_min[i];
        nook_matrix_apply_point(&camera.view_from_world, world, view);
        assert_true(-view[2] > camera.z_near);
        assert_true(fabs(view[1] / view[2]) <= half_y && fabs(view[0] / view[2]) <= half_y * 1.5);
    }
}

static void test_diagonal_of_a_scene_with_nothing_in_it_is_one(void **state)
{
    (void)state;
    nook_scene scene = make_scene(0);
    assert_near(nook_scene_diagonal(&scene), sqrt(36.0 + 16.0 + 16.0));
    scene.bounds_max[1] = -1.0;
    assert_near(nook_scene_diagonal(&scene), 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_first_camera_with_perspective_is_taken_when_none_is_named),
        cmocka_unit_test(test_a_camera_is_found_by_its_name),
        cmocka_unit_test(test_an_unknown_name_is_refused_with_the_names_there_are),
        cmocka_unit_test(test_seven_numbers_are_eye_target_and_angle),
        cmocka_unit_test(test_numbers_that_are_no_view_are_refused),
        cmocka_unit_test(test_straight_down_is_a_view_like_any_other),
        cmocka_unit_test(test_without_cameras_the_whole_scene_is_seen_from_outside),
        cmocka_unit_test(test_diagonal_of_a_scene_with_nothing_in_it_is_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
