/* Views side by side: each part of the picture is what the whole picture would be there. */
#include "tests/support/test_gpu.h"
#include "tests/support/test_render.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 37, HEIGHT = 23, SIZE = WIDTH * HEIGHT * 3 };

static const nook_view views[] = { NOOK_VIEW_LIT, NOOK_VIEW_NORMAL, NOOK_VIEW_LIGHT, NOOK_VIEW_DEPTH };
static const nook_rectangle parts[] = { { 0, 0, 11, 23 }, { 11, 0, 26, 9 }, { 11, 9, 1, 14 }, { 12, 9, 25, 14 } };

/* A floor, a wall and glass before both. */
static void make(test_picture *picture, test_scene *scene, nook_gpu *gpu)
{
    test_scene_init(scene);
    test_scene_add_level(scene, 4.0f, 0.0f, -1.0f, -4.0f, true);
    test_scene_add_facing(scene, 2.0f, -5.0f);
    uint32_t glass = test_scene_add_facing(scene, 0.7f, -2.0f);
    scene->materials[glass].alpha_mode = NOOK_ALPHA_BLEND;
    scene->materials[glass].base_colour[3] = 0.5f;
    test_picture_create(picture, gpu, scene, WIDTH, HEIGHT);
}

static void test_parts_of_several_views_are_those_of_the_whole_pictures(void **state)
{
    static uint8_t whole[4][SIZE], seen[SIZE];
    test_scene scene;
    test_picture picture;
    make(&picture, &scene, test_gpu_of(state));
    for (size_t i = 0; i < NOOK_COUNT(views); i++) {
        test_picture_render(&picture, views[i]);
        memcpy(whole[i], picture.pixels, SIZE);
    }
    assert_int_equal(nook_frame_begin(picture.renderer, &picture.frame), NOOK_OK);
    for (size_t i = 0; i < NOOK_COUNT(parts); i++)
        nook_frame_finish_part(picture.renderer, &picture.frame, picture.visibility, views[i], parts[i]);
    nook_renderer_read(picture.renderer, seen);
    for (size_t i = 0; i < NOOK_COUNT(parts); i++) {
        for (uint32_t y = parts[i].y; y < parts[i].y + parts[i].height; y++) {
            size_t row = ((size_t)(HEIGHT - 1 - y) * WIDTH + parts[i].x) * 3;
            assert_memory_equal(seen + row, whole[i] + row, parts[i].width * 3);
        }
    }
    test_picture_destroy(&picture);
}

static void test_whole_frame_after_a_part_is_drawn_everywhere(void **state)
{
    static uint8_t before[SIZE];
    test_scene scene;
    test_picture picture;
    make(&picture, &scene, test_gpu_of(state));
    test_picture_render(&picture, NOOK_VIEW_LIT);
    memcpy(before, picture.pixels, SIZE);
    nook_frame_finish_part(picture.renderer, &picture.frame, picture.visibility, NOOK_VIEW_DEPTH, parts[3]);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    assert_memory_equal(picture.pixels, before, SIZE);
    test_picture_destroy(&picture);
}

static void test_shadow_and_gbuffer_in_turn_are_a_begin(void **state)
{
    static uint8_t begun[SIZE], halves[SIZE];
    test_scene scene;
    test_picture picture;
    make(&picture, &scene, test_gpu_of(state));
    test_picture_render(&picture, NOOK_VIEW_SHADOW);
    memcpy(begun, picture.pixels, SIZE);
    picture.lights.sun.direction[0] += 0.3; /* another map in between */
    test_picture_render(&picture, NOOK_VIEW_SHADOW);
    picture.lights = nook_lights_default();
    assert_int_equal(nook_frame_shadow(picture.renderer, &picture.frame), NOOK_OK);
    nook_frame_gbuffer(picture.renderer, &picture.frame);
    nook_frame_finish(picture.renderer, &picture.frame, picture.visibility, NOOK_VIEW_SHADOW);
    nook_renderer_read(picture.renderer, halves);
    assert_memory_equal(halves, begun, SIZE);
    picture.frame.camera.z_near = 0.0;
    assert_int_equal(nook_frame_shadow(picture.renderer, &picture.frame), NOOK_E_ARG);
    test_picture_destroy(&picture);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parts_of_several_views_are_those_of_the_whole_pictures),
        cmocka_unit_test(test_whole_frame_after_a_part_is_drawn_everywhere),
        cmocka_unit_test(test_shadow_and_gbuffer_in_turn_are_a_begin),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
