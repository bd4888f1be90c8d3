/* A quick frame against an exact one: the same depth bit for bit, normals within what neighbouring pixels tell, the same
   materials but for the filter of their images. */
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

enum { SIZE = 64 };

static const uint8_t checkers[4 * 4] = { 250, 20, 20, 255, 20, 250, 20, 255, 20, 20, 250, 255, 200, 200, 200, 255 };

/** A tilted plane with an image, a floor and a wall; the wall's draw is mirrored. */
static void make(void **state, test_scene *scene, test_picture *picture)
{
    test_scene_init(scene);
    uint32_t tilted =
        test_scene_add_quad(scene, (float[3]){ -2, -2, -6 }, (float[3]){ 3, 0, 1 }, (float[3]){ 0, 4, 1 });
    test_scene_add_level(scene, 3.0f, 0, -1, -4, true);
    uint32_t wall = test_scene_add_facing(scene, 1.0f, -5.0f);
    scene->images[0] = (nook_image){ .width = 2, .height = 2, .pixels = (uint8_t *)(uintptr_t)checkers };
    scene->scene.image_count = 1;
    scene->materials[tilted].base_colour_image = 0;
    test_picture_create(picture, test_gpu_of(state), scene, SIZE, SIZE);
    picture->draws[wall].world_from_local = nook_matrix_translation(1.5, 0.0, 0.0);
    picture->draws[wall].world_from_local.m[0] = -1.0;
}

static double angle_between(const double a[3], const double b[3])
{
    return acos(fmin(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], 1.0));
}

static void test_quick_frame_has_the_depth_and_nearly_the_normals_of_an_exact_one(void **state)
{
    test_scene scene;
    test_picture picture;
    float depth[SIZE * SIZE];
    double normals[SIZE * SIZE][3];
    uint32_t seen = 0;
    make(state, &scene, &picture);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    nook_gbuffer g = nook_renderer_gbuffer(picture.renderer);
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        depth[i] = test_picture_depth(&picture, i % SIZE, i / SIZE);
        test_picture_normal(&picture, g.geometric_normal, i % SIZE, i / SIZE, normals[i]);
    }
    picture.frame.quick = true;
    test_picture_render(&picture, NOOK_VIEW_LIT);
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        double normal[3];
        assert_true(test_picture_depth(&picture, i % SIZE, i / SIZE) == depth[i]);
        test_picture_normal(&picture, g.geometric_normal, i % SIZE, i / SIZE, normal);
        seen += depth[i] > 0.0f;
        if (depth[i] > 0.0f && !(angle_between(normal, normals[i]) < 1e-3))
            fail_msg("pixel %u, %u: the quick normal is off by %.2g", i % SIZE, i / SIZE,
                     angle_between(normal, normals[i]));
    }
    assert_true(seen > SIZE * SIZE / 4);
    test_picture_destroy(&picture);
}

static void test_quick_frame_shows_the_materials_and_leaves_the_exact_one_as_it_was(void **state)
{
    test_scene scene;
    test_picture picture;
    uint8_t exact[SIZE * SIZE * 3];
    make(state, &scene, &picture);
    test_picture_render(&picture, NOOK_VIEW_BASE_COLOUR);
    memcpy(exact, picture.pixels, sizeof exact);
    picture.frame.quick = true;
    test_picture_render(&picture, NOOK_VIEW_BASE_COLOUR);
    double off = 0.0, colour = 0.0;
    for (size_t i = 0; i < sizeof exact; i++) {
        off += abs(picture.pixels[i] - exact[i]) / (double)sizeof exact;
        colour += exact[i] / (double)sizeof exact;
    }
    assert_true(colour > 20.0);
    assert_true(off < 0.05 * colour); /* magnified, both filters are the same */
    picture.frame.quick = false;
    test_picture_render(&picture, NOOK_VIEW_BASE_COLOUR);
    assert_memory_equal(picture.pixels, exact, sizeof exact);
    test_picture_destroy(&picture);
}

/** In [-1, 1), always the same. */
static float next_number(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (float)(*seed >> 8) / 8388608.0f - 1.0f;
}

/**
 * Planes at all angles, edge-on ones and slivers among them, through each other and behind the eye.
 * @param texel  of their normal image; NULL: they have none
 */
static void make_shards(void **state, test_scene *scene, test_picture *picture, uint32_t seed, const uint8_t *texel)
{
    test_scene_init(scene);
    if (texel) {
        scene->images[0] = (nook_image){ .width = 1, .height = 1, .pixels = (uint8_t *)(uintptr_t)texel };
        scene->scene.image_count = 1;
    }
    for (uint32_t i = 0; i < TEST_SCENE_MESHES; i++) {
        float corner[3], u[3], v[3];
        const float wide = i % 4 == 3 ? 0.02f : 3.0f;
        for (int axis = 0; axis < 3; axis++) {
            corner[axis] = 2.0f * next_number(&seed) - (axis == 2 ? 2.5f : 0.0f);
            u[axis] = 3.0f * next_number(&seed);
            v[axis] = wide * next_number(&seed);
        }
        uint32_t shard = test_scene_add_quad(scene, corner, u, v);
        scene->materials[shard].normal_image = texel ? 0 : NOOK_NONE;
    }
    test_picture_create(picture, test_gpu_of(state), scene, SIZE, SIZE);
}

/* Over pictures of shards. @param leaning  the texel of their normal image, whose normals are compared then; NULL: none */
static void check_normals(void **state, uint32_t seeds, const uint8_t leaning[4])
{
    double normals[SIZE * SIZE][3];
    uint32_t seen = 0;
    for (uint32_t seed = 1; seed <= seeds; seed++) {
        test_scene scene;
        test_picture picture;
        make_shards(state, &scene, &picture, seed, leaning);
        nook_gbuffer g = nook_renderer_gbuffer(picture.renderer);
        for (int quick = 0; quick < 2; quick++) {
            picture.frame.quick = quick;
            test_picture_render(&picture, NOOK_VIEW_LIT);
            for (uint32_t i = 0; i < SIZE * SIZE; i++) {
                double normal[3];
                test_picture_normal(&picture, leaning ? g.normal : g.geometric_normal, i % SIZE, i / SIZE,
                                    quick ? normal : normals[i]);
                bool drawn = test_picture_depth(&picture, i % SIZE, i / SIZE) > 0.0f;
                seen += drawn;
                if (quick && drawn && !(angle_between(normal, normals[i]) < 0.01))
                    fail_msg("seed %u, pixel %u, %u: off by %.2g", seed, i % SIZE, i / SIZE,
                             angle_between(normal, normals[i]));
            }
        }
        test_picture_destroy(&picture);
    }
    assert_true(seen > seeds * SIZE * SIZE / 2);
}

/* Where faces of closed bodies meet, an exact frame may show the back of one at the same depth; a quick one that leaves out backs, as the
   game does, shows the other's front. Here neither leaves out any. */
static void test_quick_normals_of_edge_on_planes_and_slivers_are_those_of_the_exact_frame(void **state)
{
    check_normals(state, 40, NULL);
}

/* Seen from both sides and all angles; the lean of one texel is the same for every filter. */
static void test_quick_normals_lean_as_their_image_says_as_those_of_the_exact_frame(void **state)
{
    static const uint8_t leaning[4] = { 204, 178, 230, 255 };
    check_normals(state, 20, leaning);
}

/** A facing quad whose colours are products of all that a material can have. @param white  its vertices are */
static void make_product(void **state, test_scene *scene, test_picture *picture, const uint8_t *image, bool white)
{
    test_scene_init(scene);
    uint32_t quad = test_scene_add_facing(scene, 4.0f, -2.0f);
    nook_material *material = &scene->materials[quad];
    scene->images[0] = (nook_image){ .width = 2, .height = 2, .pixels = (uint8_t *)(uintptr_t)image };
    scene->scene.image_count = 1;
    material->base_colour_image = material->emissive_image = 0;
    memcpy(material->base_colour, (float[4]){ 0.8f, 0.5f, 1.0f, 1.0f }, 16);
    memcpy(material->emissive, (float[3]){ 0.9f, 0.4f, 0.7f }, 12);
    for (uint32_t i = 0; i < scene->scene.vertex_count && !white; i++)
        memcpy(scene->scene.vertices[i].colour, (float[4]){ 0.9f, 0.7f, 0.6f, 1.0f }, 16);
    test_picture_create(picture, test_gpu_of(state), scene, 8, 8);
}

static void test_quick_frame_has_colours_and_emission_within_five_of_255_of_the_exact_one(void **state)
{
    static const nook_view views[2] = { NOOK_VIEW_BASE_COLOUR, NOOK_VIEW_EMISSIVE };
    uint8_t image[2 * 2 * 4];
    for (int level = 40; level < 256; level += 15) {
        test_scene scene;
        test_picture picture;
        for (int i = 0; i < 16; i++)
            image[i] =
                (uint8_t)(i % 4 == 3 ? 255 : level + i % 4); /* one colour: what a filter does is not asked here */
        make_product(state, &scene, &picture, image, level % 2 == 0);
        for (int k = 0; k < 2; k++) {
            uint8_t exact[3];
            picture.frame.quick = false;
            test_picture_render(&picture, views[k]);
            memcpy(exact, test_picture_at(&picture, 4, 4), 3);
            picture.frame.quick = true;
            test_picture_render(&picture, views[k]);
            for (int c = 0; c < 3; c++) {
                int off = abs(test_picture_at(&picture, 4, 4)[c] - exact[c]);
                if (off > 5) /* sRGB is nearly a power, and the product of powers the power of the product */
                    fail_msg("%s of %d, channel %d: %d, exact %d", nook_view_name(views[k]), level, c,
                             test_picture_at(&picture, 4, 4)[c], exact[c]);
            }
        }
        test_picture_destroy(&picture);
    }
}

enum { STRIPES = 120 };

/** How far the picture's pixels are from their mean, of 255. */
static double contrast_of(test_picture *picture)
{
    double sum = 0.0, apart = 0.0;
    test_picture_render(picture, NOOK_VIEW_BASE_COLOUR);
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        sum += picture->pixels[i * 3];
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        apart += fabs(picture->pixels[i * 3] - sum / (SIZE * SIZE));
    return apart / (SIZE * SIZE);
}

/** Stripes one texel wide, of which the next level of the image is an even grey. */
static void test_quick_frame_blurs_no_image_that_is_seen_smaller_than_it_is_more_than_the_exact_one(void **state)
{
    static uint8_t image[STRIPES * STRIPES * 4];
    for (uint32_t width = SIZE + 8; width <= STRIPES;
         width += 8) { /* texels over the picture: less than two each pixel */
        test_scene scene;
        test_picture picture;
        for (uint32_t i = 0; i < width * width * 4; i++)
            image[i] = i % 4 == 3 || i / 4 % width % 2 == 1 ? 255 : 0;
        test_scene_init(&scene);
        uint32_t quad = test_scene_add_facing(&scene, 1.0f, -1.0f);
        scene.images[0] = (nook_image){ .width = width, .height = width, .pixels = image };
        scene.scene.image_count = 1;
        scene.materials[quad].base_colour_image = 0;
        test_picture_create(&picture, test_gpu_of(state), &scene, SIZE, SIZE);
        double exact = contrast_of(&picture);
        picture.frame.quick = true;
        double quick = contrast_of(&picture);
        assert_true(exact > 1.0);
        if (!(quick >= exact))
            fail_msg("%u texels over %d pixels: a contrast of %.3g, exact %.3g", width, SIZE, quick, exact);
        test_picture_destroy(&picture);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quick_frame_has_the_depth_and_nearly_the_normals_of_an_exact_one),
        cmocka_unit_test(test_quick_frame_shows_the_materials_and_leaves_the_exact_one_as_it_was),
        cmocka_unit_test(test_quick_normals_of_edge_on_planes_and_slivers_are_those_of_the_exact_frame),
        cmocka_unit_test(test_quick_normals_lean_as_their_image_says_as_those_of_the_exact_frame),
        cmocka_unit_test(test_quick_frame_has_colours_and_emission_within_five_of_255_of_the_exact_one),
        cmocka_unit_test(test_quick_frame_blurs_no_image_that_is_seen_smaller_than_it_is_more_than_the_exact_one),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
