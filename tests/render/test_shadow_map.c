/* The shadow map that is kept and mended against one that is drawn from nothing. */
#include "tests/support/test_gpu.h"
#include "tests/support/test_render.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOVERS = 4, FIRST_MOVER = 2, SIZE = 96 };

static const nook_lights slanted_sun = {
    .sun = { .direction = { 0.4, -1, 0.2 }, .colour = { 3, 3, 3 } },
    .exposure = 1.0f,
};

/** A floor, a roof high above it that bounds the map, and squares that move between them. */
static void make_scene(test_scene *scene)
{
    test_scene_init(scene);
    test_scene_add_level(scene, 6.0f, 0, -1, -6, true);
    test_scene_add_level(scene, 0.5f, 0, 5, -6, false);
    for (int i = 0; i < MOVERS; i++)
        test_scene_add_level(scene, 0.3f + 0.1f * (float)i, 0, 0, 0, true);
}

static void make_picture(void **state, const test_scene *scene, const nook_draw *draws, test_picture *out)
{
    test_picture_create(out, test_gpu_of(state), scene, SIZE, SIZE);
    out->lights = slanted_sun;
    for (uint32_t i = FIRST_MOVER; i < scene->scene.mesh_count; i++)
        out->draws[i].moves = true;
    if (draws)
        memcpy(out->draws, draws, scene->scene.mesh_count * sizeof *draws);
}

static double random_between(uint32_t *seed, double low, double high)
{
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (*seed >> 8) / 16777216.0;
}

static nook_matrix somewhere(uint32_t *seed)
{
    double x = random_between(seed, -3.0, 3.0), y = random_between(seed, -0.5, 3.0);
    return nook_matrix_translation(x, y, random_between(seed, -8.0, -4.0));
}

/** Both the map and the picture, bit for bit, against a renderer that has seen nothing before. */
static void assert_as_from_nothing(void **state, const test_scene *scene, test_picture *kept)
{
    static const nook_view views[] = { NOOK_VIEW_SHADOW_MAP, NOOK_VIEW_SHADOW };
    test_picture fresh;
    make_picture(state, scene, kept->draws, &fresh);
    fresh.lights = kept->lights;
    for (size_t i = 0; i < NOOK_COUNT(views); i++) {
        test_picture_render(kept, views[i]);
        test_picture_render(&fresh, views[i]);
        assert_memory_equal(kept->pixels, fresh.pixels, SIZE * SIZE * 3);
    }
    test_picture_destroy(&fresh);
}

static void test_a_map_that_is_mended_is_the_map_drawn_from_nothing_bit_for_bit(void **state)
{
    test_scene scene;
    test_picture picture;
    uint32_t seed = 11;
    make_scene(&scene);
    make_picture(state, &scene, NULL, &picture);
    for (uint32_t i = FIRST_MOVER; i < FIRST_MOVER + MOVERS; i++)
        picture.draws[i].world_from_local = somewhere(&seed);
    for (uint32_t frame = 0; frame < 24; frame++) {
        for (uint32_t i = FIRST_MOVER; i < FIRST_MOVER + MOVERS; i++) {
            if (random_between(&seed, 0.0, 1.0) < 0.5) /* some stay */
                picture.draws[i].world_from_local = somewhere(&seed);
        }
        assert_as_from_nothing(state, &scene, &picture);
    }
    test_picture_destroy(&picture);
}

static void test_a_map_is_drawn_anew_when_what_never_moves_does_or_the_sun_turns(void **state)
{
    test_scene scene;
    test_picture picture;
    uint32_t seed = 5;
    make_scene(&scene);
    make_picture(state, &scene, NULL, &picture);
    for (uint32_t step = 0; step < 4; step++) {
        picture.draws[FIRST_MOVER].world_from_local = somewhere(&seed);
        assert_as_from_nothing(state, &scene, &picture);
        if (step == 1)
            picture.draws[1].world_from_local = nook_matrix_translation(1.0, 0, 0.5);
        if (step == 2)
            picture.lights.sun.direction[0] = -0.3;
        assert_as_from_nothing(state, &scene, &picture);
    }
    test_picture_destroy(&picture);
}

static void test_what_leaves_the_map_gets_a_larger_one_and_comes_back_into_it(void **state)
{
    test_scene scene;
    test_picture picture;
    const uint32_t largest = FIRST_MOVER + MOVERS - 1;
    make_scene(&scene);
    make_picture(state, &scene, NULL, &picture);
    picture.lights.sun.direction[0] = picture.lights.sun.direction[2] = 0.0;
    for (uint32_t i = FIRST_MOVER; i < FIRST_MOVER + MOVERS; i++)
        picture.draws[i].world_from_local = nook_matrix_translation(0, 0, -4);
    assert_as_from_nothing(state, &scene, &picture);
    picture.draws[largest].world_from_local = nook_matrix_translation(0, 30, -4);
    assert_as_from_nothing(state, &scene, &picture);
    picture.draws[largest].world_from_local = nook_matrix_translation(2, 0, -6);
    test_picture_render(&picture, NOOK_VIEW_SHADOW);
    /* The floor under it: 90 degrees, camera at the origin, the floor 1 m below. */
    uint32_t x = (uint32_t)((0.5 + 0.5 * 2.0 / 6.0) * SIZE), y = (uint32_t)((0.5 + 0.5 / 6.0) * SIZE);
    assert_int_equal(test_picture_at(&picture, x, y)[0], 0);
    assert_int_equal(test_picture_at(&picture, SIZE - x, y)[0], 255);
    test_picture_destroy(&picture);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_map_that_is_mended_is_the_map_drawn_from_nothing_bit_for_bit),
        cmocka_unit_test(test_a_map_is_drawn_anew_when_what_never_moves_does_or_the_sun_turns),
        cmocka_unit_test(test_what_leaves_the_map_gets_a_larger_one_and_comes_back_into_it),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
