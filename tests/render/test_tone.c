/* The short ways from light to a picture against the long ones: roots for the power of sRGB, one pass for two, lights written out
   for a loop. */
#include "tests/support/test_gpu.h"
#include "tests/support/test_render.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { STEPS = 65536, SIZE = 64 };

static double srgb(double c)
{
    return c > 0.0031308 ? 1.055 * pow(c, 1.0 / 2.4) - 0.055 : c * 12.92;
}

static void test_srgb_is_never_off_by_a_quarter_of_a_step_of_eight_bits(void **state)
{
    float *in = malloc(STEPS * sizeof *in), *out = malloc(STEPS * sizeof *out);
    for (int i = 0; i < STEPS; i++) { /* even in what is seen: many of the dark ones */
        double x = i / (STEPS - 1.0);
        in[i] = (float)(x * x * x);
    }
    test_gpu_map(test_gpu_of(state), "tests/render/tone.comp.glsl", in, sizeof *in, out, sizeof *out, STEPS);
    assert_true(out[0] == 0.0f);
    for (int i = 0; i < STEPS; i++) {
        if (!(fabs(out[i] - srgb(in[i])) < 1.0 / 1020.0))
            fail_msg("sRGB of %.8g is %.6f, not %.6f", in[i], out[i], srgb(in[i]));
    }
    free(in);
    free(out);
}

/** A floor and a ball's worth of colours: a glossy wall behind, lights of three colours, a sun and a sky. */
static void make_room(void **state, test_scene *scene, test_picture *picture)
{
    test_scene_init(scene);
    test_scene_add_level(scene, 3.0f, 0, -1, -3, true);
    uint32_t wall = test_scene_add_facing(scene, 2.0f, -4.0f);
    uint32_t pane = test_scene_add_facing(scene, 0.5f, -2.0f);
    scene->materials[wall].roughness = 0.3f;
    scene->materials[pane].base_colour[3] = 0.0f; /* clear: seen through, but drawn when it blends */
    scene->materials[pane].alpha_mode = NOOK_ALPHA_BLEND;
    test_picture_create(picture, test_gpu_of(state), scene, SIZE, SIZE);
    picture->lights = (nook_lights){ .sun = { .direction = { 0.3, -1, -0.5 }, .colour = { 0.4f, 0.3f, 0.2f } },
                                     .point_count = 3,
                                     .ambient_top = { 0.1f, 0.15f, 0.2f },
                                     .exposure = 1.0f };
    for (uint32_t i = 0; i < 3; i++) {
        nook_point_light *light = &picture->lights.points[i];
        *light = (nook_point_light){ .position = { 2.0 * i - 2.0, 0.5, -2.5 }, .range = 4.0f };
        light->colour[i] = 2.0f;
    }
}

static int worst_difference(const uint8_t *a, const uint8_t *b)
{
    int worst = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE * 3; i++)
        worst = abs(a[i] - b[i]) > worst ? abs(a[i] - b[i]) : worst;
    return worst;
}

/** The first picture is rendered, the second was kept: they show the same, which is not nothing. */
static void expect_same_picture(test_picture *picture, const uint8_t *kept)
{
    test_picture_render(picture, NOOK_VIEW_LIT);
    int most = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE * 3; i++)
        most = kept[i] > most ? kept[i] : most;
    assert_true(most > 150);
    assert_true(worst_difference(picture->pixels, kept) <= 1);
}

static void test_light_and_tone_in_one_pass_are_those_of_two(void **state)
{
    test_scene scene;
    test_picture picture;
    uint8_t kept[SIZE * SIZE * 3];
    make_room(state, &scene, &picture);
    test_picture_render(&picture, NOOK_VIEW_LIT); /* the pane blends: the light is kept for it */
    memcpy(kept, picture.pixels, sizeof kept);
    picture.frame.draw_count = 2;
    expect_same_picture(&picture, kept);
    test_picture_destroy(&picture);
}

static void test_lights_written_out_light_as_those_of_a_loop(void **state)
{
    test_scene scene;
    test_picture picture;
    uint8_t kept[SIZE * SIZE * 3];
    make_room(state, &scene, &picture);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    memcpy(kept, picture.pixels, sizeof kept);
    picture.lights.point_count = 20; /* black ones behind them: too many to write out */
    expect_same_picture(&picture, kept);
    picture.lights.point_count = 3;
    picture.lights.points[2].direction[1] = -1.0; /* a spot so wide that it shines everywhere */
    picture.lights.points[2].cos_inner = -1.0f;
    picture.lights.points[2].cos_outer = -2.0f;
    expect_same_picture(&picture, kept);
    test_picture_destroy(&picture);
}

/* Or the loop, which shows the same, would stand in for it unseen. */
static void test_lights_handed_on_by_vertices_compile_for_every_number_that_is_written_out(void **state)
{
    for (unsigned count = 0; count <= 8; count++) {
        char defines[256];
        int length =
            snprintf(defines, sizeof defines, "#define TO_IMAGE\n#define BY_VERTEX %u\n#define EACH_POINT(f)", count);
        for (unsigned i = 0; i < count; i++)
            length += snprintf(defines + length, sizeof defines - (size_t)length, " f(%u);", i);
        snprintf(defines + length, sizeof defines - (size_t)length, "\n");
        nook_program program;
        assert_int_equal(nook_program_raster(test_gpu_of(state), "shaders/render/lighting.vert.glsl",
                                             "shaders/render/lighting.frag.glsl", defines, &program),
                         NOOK_OK);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_srgb_is_never_off_by_a_quarter_of_a_step_of_eight_bits),
        cmocka_unit_test(test_light_and_tone_in_one_pass_are_those_of_two),
        cmocka_unit_test(test_lights_written_out_light_as_those_of_a_loop),
        cmocka_unit_test(test_lights_handed_on_by_vertices_compile_for_every_number_that_is_written_out),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
