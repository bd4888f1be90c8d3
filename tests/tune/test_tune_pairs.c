#include "game/compare/camera.h"
#include "game/tune/tune_pairs.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static nook_camera look(double x, double y, double z, double yaw)
{
    const double eye[3] = { x, y, z }, target[3] = { x - sin(yaw), y, z - cos(yaw) };
    nook_camera camera;
    assert_int_equal(nook_camera_look(eye, target, 1.0, 0.1, &camera), NOOK_OK);
    return camera;
}

static bool is_one_of(const nook_camera *camera, const nook_camera *views, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (memcmp(camera, &views[i], sizeof *camera) == 0)
            return true;
    }
    return false;
}

static void test_near_views_go_to_different_sets(void **state)
{
    (void)state;
    nook_camera views[8], first[4], second[4];
    for (uint32_t i = 0; i < 8; i++) /* four places, each seen twice, the second time from a little beside */
        views[i] = look(10.0 * (i % 4) + (i >= 4), 1.0, 0.0, 0.1 * i);
    nook_tune_pair_views(views, 8, 40.0, first, second);
    for (uint32_t i = 0; i < 4; i++) {
        assert_memory_equal(&first[i], &views[i % 2 ? i + 4 : i], sizeof *first);
        assert_memory_equal(&second[i], &views[i % 2 ? i : i + 4], sizeof *second);
    }
}

static void test_where_a_view_looks_counts_too(void **state)
{
    (void)state;
    const nook_camera views[4] = { look(0, 0, 0, 0.0), look(0.5, 0, 0, 3.1), look(2, 0, 0, 0.1), look(2, 0, 0, 3.0) };
    nook_camera first[2], second[2];
    nook_tune_pair_views(views, 4, 40.0, first, second);
    assert_memory_equal(&second[0], &views[2], sizeof *second);
}

static void test_every_view_is_in_one_set_once(void **state)
{
    (void)state;
    enum { COUNT = 64 };
    nook_camera views[COUNT], first[COUNT / 2], second[COUNT / 2];
    for (uint32_t i = 0; i < COUNT; i++)
        views[i] = look(fmod(i * 7.31, 11.0), fmod(i * 1.7, 3.0), fmod(i * 3.77, 13.0), i * 0.83);
    nook_tune_pair_views(views, COUNT, 17.0, first, second);
    for (uint32_t i = 0; i < COUNT; i++)
        assert_int_equal(is_one_of(&views[i], first, COUNT / 2) + is_one_of(&views[i], second, COUNT / 2), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_near_views_go_to_different_sets),
        cmocka_unit_test(test_where_a_view_looks_counts_too),
        cmocka_unit_test(test_every_view_is_in_one_set_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
