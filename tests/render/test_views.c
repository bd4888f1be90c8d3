#include "tests/support/test_gpu.h"
#include "tests/support/test_render.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void test_occlusion_map_view_shows_the_texture_and_nothing_else(void **state)
{
    uint8_t texel[4] = { 51, 200, 100, 255 };
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 1.0f, -2.0f);
    scene.images[0] = (nook_image){ .name = "occlusion", .pixels = texel, .width = 1, .height = 1 };
    scene.scene.image_count = 1;
    scene.materials[0].occlusion_image = 0;
    test_picture_create(&picture, test_gpu_of(state), &scene, 16, 16);
    test_picture_render(&picture, NOOK_VIEW_OCCLUSION_MAP);
    for (int i = 0; i < 3; i++)
        assert_int_equal(test_picture_at(&picture, 8, 8)[i], 51);
    assert_int_equal(test_picture_at(&picture, 0, 0)[0], 0); /* nothing is drawn there */
    test_picture_destroy(&picture);
}

/* What the light view shows of a radiance: docs/rendering.md. */
static int logarithmic(double radiance)
{
    return (int)(fmin(fmax((log2(radiance) + 10.0) / 16.0, 0.0), 1.0) * 255.0 + 0.5);
}

static void test_light_view_tells_radiances_apart_that_the_picture_shows_white(void **state)
{
    static const float radiances[] = { 0.0004f, 0.002f, 0.25f, 1.0f, 8.0f, 32.0f, 100.0f };
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 4.0f, -2.0f);
    for (size_t i = 0; i < NOOK_COUNT(radiances); i++) {
        memcpy(scene.materials[0].emissive, (float[3]){ radiances[i], radiances[i], radiances[i] }, 12);
        test_picture_create(&picture, test_gpu_of(state), &scene, 4, 4);
        picture.lights = (nook_lights){ .exposure = 1.0f };
        test_picture_render(&picture, NOOK_VIEW_LIGHT);
        assert_true(abs(test_picture_at(&picture, 2, 2)[0] - logarithmic(radiances[i])) <= 1);
        test_picture_destroy(&picture);
    }
}

static void test_shadow_map_view_shows_casters_nearer_the_sun_brighter(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_level(&scene, 2.0f, 0, -1, -3, true);
    test_scene_add_level(&scene, 0.5f, 0, 1, -3, false); /* in the middle of the map, nearest the sun */
    test_picture_create(&picture, test_gpu_of(state), &scene, 96, 64);
    picture.lights.sun = (nook_sun){ .direction = { 0, -1, 0 }, .colour = { 1, 1, 1 } };
    test_picture_render(&picture, NOOK_VIEW_SHADOW_MAP);
    int roof = test_picture_at(&picture, 48, 32)[0], floor = test_picture_at(&picture, 24, 32)[0];
    assert_true(roof > 250 && floor < 10);
    assert_int_equal(test_picture_at(&picture, 10, 32)[0], 64); /* beside the square */
    picture.lights.sun = (nook_sun){ .direction = { 0, -1, 0 } };
    test_picture_render(&picture, NOOK_VIEW_SHADOW_MAP);
    assert_int_equal(test_picture_at(&picture, 48, 32)[0], 0);
    test_picture_destroy(&picture);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_occlusion_map_view_shows_the_texture_and_nothing_else),
        cmocka_unit_test(test_light_view_tells_radiances_apart_that_the_picture_shows_white),
        cmocka_unit_test(test_shadow_map_view_shows_casters_nearer_the_sun_brighter),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
