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

static const nook_lights only_sun = {
    .sun = { .direction = { 0, -1, 0 }, .colour = { 3, 3, 3 } },
    .exposure = 1.0f,
};
static const nook_lights only_sky = {
    .ambient_top = { 0.5f, 0.5f, 0.5f },
    .ambient_bottom = { 0.5f, 0.5f, 0.5f },
    .exposure = 1.0f,
};

/** A floor 4 m across with a roof 1 m across above its middle, seen from the front. */
static void make_roof(void **state, test_scene *scene, test_picture *picture)
{
    test_scene_init(scene);
    test_scene_add_level(scene, 2.0f, 0, -1, -3, true);
    test_scene_add_level(scene, 0.5f, 0, 1, -3, false);
    test_picture_create(picture, test_gpu_of(state), scene, 128, 128);
}

/** Pixel that shows a point of the floor (camera at the origin, 90 degrees). */
static const uint8_t *floor_at(const test_picture *picture, double x, double z)
{
    double u = 0.5 + 0.5 * x / -z, v = 0.5 + 0.5 * 1.0 / -z;
    return test_picture_at(picture, (uint32_t)(u * picture->width), (uint32_t)(v * picture->height));
}

static void test_a_floor_is_dark_under_a_roof_and_lit_beside_it(void **state)
{
    test_scene scene;
    test_picture picture;
    make_roof(state, &scene, &picture);
    picture.lights = only_sun;
    test_picture_render(&picture, NOOK_VIEW_SHADOW);
    for (int i = -3; i <= 3; i++)
        assert_int_equal(floor_at(&picture, 0.15 * i, -3.0)[0], 0);
    for (int i = 6; i <= 18; i++) {
        assert_int_equal(floor_at(&picture, 0.1 * i, -3.0)[0], 255);
        assert_int_equal(floor_at(&picture, -0.1 * i, -3.0)[0], 255);
    }
    test_picture_render(&picture, NOOK_VIEW_LIT);
    assert_int_equal(floor_at(&picture, 0.0, -3.0)[0], 0);
    assert_true(floor_at(&picture, 1.0, -3.0)[0] > 100);
    test_picture_destroy(&picture);
}

static void test_flat_surfaces_never_shadow_themselves(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_level(&scene, 20.0f, 0, -1, -20, true);
    test_picture_create(&picture, test_gpu_of(state), &scene, 96, 96);
    picture.lights = only_sun;
    for (int i = 0; i < 8; i++) { /* from overhead to 2 degrees above the floor */
        double elevation = 1.5708 - 0.219 * i, azimuth = 0.77 * i;
        picture.lights.sun.direction[0] = cos(elevation) * cos(azimuth);
        picture.lights.sun.direction[1] = -sin(elevation);
        picture.lights.sun.direction[2] = cos(elevation) * sin(azimuth);
        test_picture_render(&picture, NOOK_VIEW_SHADOW);
        double z = -1.2;
        for (int row = 0; row < 12; row++, z *= 1.3) {
            for (int column = -8; column <= 8 && -0.8 * z < 19.0; column++) /* beside it is the sky */
                assert_int_equal(floor_at(&picture, -0.1 * column * z, z)[0], 255);
        }
    }
    test_picture_destroy(&picture);
}

static void test_shadow_reaches_the_foot_of_a_wall(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_level(&scene, 4.0f, 0, -1, -4, true);
    uint32_t wall = test_scene_add_quad(&scene, (float[3]){ 0, -1, -6 }, (float[3]){ 0, 0, 4 }, (float[3]){ 0, 1, 0 });
    scene.materials[wall].double_sided = true;
    test_picture_create(&picture, test_gpu_of(state), &scene, 256, 256);
    picture.lights = only_sun;
    picture.lights.sun.direction[0] = 1.0; /* from the left, 45 degrees: shadow on the right, 1 m wide */
    test_picture_render(&picture, NOOK_VIEW_SHADOW);
    assert_int_equal(floor_at(&picture, 0.05, -3.0)[0], 0); /* a texel is 6 mm */
    assert_int_equal(floor_at(&picture, 0.90, -3.0)[0], 0);
    assert_int_equal(floor_at(&picture, 1.10, -3.0)[0], 255);
    assert_int_equal(floor_at(&picture, -0.05, -3.0)[0], 255);
    test_picture_destroy(&picture);
}

static void test_no_sun_leaks_in_where_a_wall_meets_the_ceiling(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 2.0f, -3.0f);
    test_scene_add_level(&scene, 2.0f, 0.0f, 2.0f, -1.0f, false); /* from above the camera to the wall's upper edge */
    test_picture_create(&picture, test_gpu_of(state), &scene, 300, 300);
    picture.frame.camera.view_from_world = nook_matrix_translation(0, -1.95, 2.9); /* the edge is at row 75 */
    picture.frame.camera.z_near = 0.01;
    for (int i = 0; i < 5; i++) {
        int leaks = 0;
        picture.lights = only_sun;
        picture.lights.sun.direction[0] = 0.1 * i;
        picture.lights.sun.direction[2] = -0.5 - 0.1 * i;
        test_picture_render(&picture, NOOK_VIEW_SHADOW);
        for (uint32_t y = 76; y < 90; y++) {
            for (uint32_t x = 0; x < 300; x++)
                leaks += test_picture_at(&picture, x, y)[0] > 40;
        }
        assert_in_range(leaks, 0, 30); /* of 300 a row */
    }
    test_picture_destroy(&picture);
}

/** A Cornell box, open in front: 2 m wide and high, its back 1 m behind the origin. Neighbours share corners exactly. */
static void make_box(test_scene *scene)
{
    test_scene_init(scene);
    test_scene_add_quad(scene, (float[3]){ -1, 0, -1 }, (float[3]){ 2, 0, 0 }, (float[3]){ 0, 2, 0 }); /* back */
    test_scene_add_quad(scene, (float[3]){ -1, 2, -1 }, (float[3]){ 2, 0, 0 }, (float[3]){ 0, 0, 2 }); /* ceiling */
    test_scene_add_quad(scene, (float[3]){ -1, 0, 1 }, (float[3]){ 2, 0, 0 }, (float[3]){ 0, 0, -2 }); /* floor */
    test_scene_add_quad(scene, (float[3]){ -1, 0, 1 }, (float[3]){ 0, 0, -2 }, (float[3]){ 0, 2, 0 }); /* left */
    test_scene_add_quad(scene, (float[3]){ 1, 0, -1 }, (float[3]){ 0, 0, 2 }, (float[3]){ 0, 2, 0 });  /* right */
}

/** Pixels of the last picture that the sun reaches. */
static uint32_t count_sunlit(const test_picture *picture)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < picture->width * picture->height; i++)
        count += picture->pixels[3 * i] > 30;
    return count;
}

static void test_no_sun_leaks_into_the_corners_of_a_closed_box(void **state)
{
    /* Where the camera stands to see only what none of these suns reaches: the upper edge, the upper left corner. */
    static const double eyes[][3] = { { 0.3, 1.95, -0.9 }, { -0.9, 1.9, -0.8 }, { 0.0, 1.8, -0.6 } };
    test_scene scene;
    test_picture picture;
    make_box(&scene);
    test_picture_create(&picture, test_gpu_of(state), &scene, 256, 256);
    picture.frame.camera.z_near = 0.01;
    picture.lights = only_sun;
    for (size_t i = 0; i < NOOK_COUNT(eyes); i++) {
        picture.frame.camera.view_from_world = nook_matrix_translation(-eyes[i][0], -eyes[i][1], -eyes[i][2]);
        for (int j = 0; j < 12; j++) { /* from above, ever more from the front and the left */
            picture.lights.sun.direction[0] = 0.07 * j;
            picture.lights.sun.direction[2] = -0.1 - 0.06 * j;
            test_picture_render(&picture, NOOK_VIEW_SHADOW);
            assert_in_range(count_sunlit(&picture), 0, 256); /* one row: a tenth of a texel of the map */
        }
    }
    test_picture_destroy(&picture);
}

static void test_facets_of_a_smooth_surface_do_not_show_at_the_edge_of_light(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 1.0f, -2.0f);
    test_scene_add_level(&scene, 50.0f, 0, -50, 0, true); /* makes a facet a few texels, as in a scene */
    for (int i = 0; i < 4; i++) { /* the triangle turns 3 degrees from the sun, its smooth normal 3 towards it */
        scene.vertices[i].normal[0] = -0.1f;
        scene.vertices[i].normal[2] = 0.995f;
    }
    test_picture_create(&picture, test_gpu_of(state), &scene, 16, 16);
    picture.lights = only_sun;
    picture.lights.sun.direction[0] = 1.0;
    picture.lights.sun.direction[1] = 0.0;
    picture.lights.sun.direction[2] = 0.05;
    test_picture_render(&picture, NOOK_VIEW_SHADOW);
    assert_true(test_picture_at(&picture, 8, 8)[0] > 128);
    picture.lights.sun.direction[2] = 0.5; /* far behind */
    test_picture_render(&picture, NOOK_VIEW_SHADOW);
    assert_int_equal(test_picture_at(&picture, 8, 8)[0], 0);
    test_picture_destroy(&picture);
}

static void test_shadows_follow_what_moves(void **state)
{
    test_scene scene;
    test_picture picture;
    make_roof(state, &scene, &picture);
    picture.lights = only_sun;
    test_picture_render(&picture, NOOK_VIEW_SHADOW);
    assert_int_equal(floor_at(&picture, 0.0, -3.0)[0], 0);
    picture.draws[1].world_from_local = nook_matrix_translation(1.2, 0, 0);
    test_picture_render(&picture, NOOK_VIEW_SHADOW);
    assert_int_equal(floor_at(&picture, 0.0, -3.0)[0], 255);
    assert_int_equal(floor_at(&picture, 1.2, -3.0)[0], 0);
    picture.lights.sun.direction[0] = -0.6; /* 2 m below the roof: 1.2 m to the left */
    test_picture_render(&picture, NOOK_VIEW_SHADOW);
    assert_int_equal(floor_at(&picture, 0.0, -3.0)[0], 0);
    assert_int_equal(floor_at(&picture, 1.2, -3.0)[0], 255);
    picture.lights.sun = (nook_sun){ .direction = { 0, -1, 0 } }; /* black: there is none */
    test_picture_render(&picture, NOOK_VIEW_SHADOW);
    assert_int_equal(floor_at(&picture, 1.2, -3.0)[0], 0);
    test_picture_destroy(&picture);
}

static void test_masked_surfaces_cast_the_shadow_of_what_is_left(void **state)
{
    test_scene scene;
    test_picture picture;
    make_roof(state, &scene, &picture);
    test_picture_destroy(&picture);
    scene.materials[1].alpha_mode = NOOK_ALPHA_MASK;
    scene.materials[1].base_colour[3] = 0.4f; /* below the cutoff: nothing is left */
    test_picture_create(&picture, test_gpu_of(state), &scene, 128, 128);
    picture.lights = only_sun;
    test_picture_render(&picture, NOOK_VIEW_SHADOW);
    assert_int_equal(floor_at(&picture, 0.0, -3.0)[0], 255);
    assert_true(test_picture_depth(&picture, 64, 40) == 0.0f);
    test_picture_destroy(&picture);
}

static void set_visibility(test_picture *picture, float value)
{
    nook_texture *texture = &picture->visibility;
    size_t count = (size_t)picture->width * picture->height;
    float *values = malloc(count * sizeof *values);
    for (size_t i = 0; i < count; i++)
        values[i] = value;
    if (texture->id == 0)
        assert_int_equal(
            nook_texture_create_2d(picture->gpu, GL_R32F, picture->width, picture->height, GL_NEAREST, texture),
            NOOK_OK);
    nook_texture_write(picture->gpu, *texture, GL_RED, GL_FLOAT, values, count * sizeof *values);
    free(values);
}

static void test_visibility_takes_ambient_light_and_leaves_the_sun(void **state)
{
    test_scene scene;
    test_picture picture;
    make_roof(state, &scene, &picture);
    picture.lights = only_sun;
    set_visibility(&picture, 0.0f);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    uint8_t dark = floor_at(&picture, 1.0, -3.0)[0];
    set_visibility(&picture, 1.0f);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    assert_int_equal(floor_at(&picture, 1.0, -3.0)[0], dark);
    assert_true(dark > 100);

    picture.lights = only_sky;
    test_picture_render(&picture, NOOK_VIEW_LIT);
    uint8_t open = floor_at(&picture, 1.0, -3.0)[0];
    set_visibility(&picture, 0.5f);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    uint8_t half = floor_at(&picture, 1.0, -3.0)[0];
    set_visibility(&picture, 0.0f);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    assert_int_equal(floor_at(&picture, 1.0, -3.0)[0], 0);
    assert_true(half > 0 && half < open);
    nook_texture_destroy(picture.gpu, &picture.visibility);
    test_picture_render(&picture, NOOK_VIEW_LIT); /* none given: open */
    assert_int_equal(floor_at(&picture, 1.0, -3.0)[0], open);
    test_picture_destroy(&picture);
}

static void test_visibility_view_shows_its_numbers_as_they_are(void **state)
{
    test_scene scene;
    test_picture picture;
    make_roof(state, &scene, &picture);
    set_visibility(&picture, 0.2f);
    test_picture_render(&picture, NOOK_VIEW_VISIBILITY);
    assert_int_equal(floor_at(&picture, 0.0, -3.0)[1], 51);
    assert_int_equal(test_picture_at(&picture, 0, 0)[1], 255); /* background */
    nook_texture_destroy(picture.gpu, &picture.visibility);
    test_picture_destroy(&picture);
}

static void test_base_colour_survives_srgb_both_ways(void **state)
{
    uint8_t texel[4] = { 7, 100, 201, 255 };
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 4.0f, -2.0f);
    scene.images[0] = (nook_image){ .name = "colour", .pixels = texel, .width = 1, .height = 1 };
    scene.scene.image_count = 1;
    scene.materials[0].base_colour_image = 0;
    memcpy(scene.materials[0].base_colour, (float[4]){ 1, 1, 1, 1 }, 16);
    test_picture_create(&picture, test_gpu_of(state), &scene, 8, 8);
    test_picture_render(&picture, NOOK_VIEW_BASE_COLOUR);
    for (int i = 0; i < 3; i++)
        assert_true(abs(test_picture_at(&picture, 4, 4)[i] - texel[i]) <= 1);
    test_picture_destroy(&picture);
}

static void test_images_stand_upright(void **state)
{
    uint8_t texels[2][4] = { { 255, 0, 0, 255 }, { 0, 255, 0, 255 } }; /* red on top */
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 2.0f, -2.0f);
    scene.images[0] = (nook_image){ .name = "colour", .pixels = texels[0], .width = 1, .height = 2 };
    scene.scene.image_count = 1;
    scene.materials[0].base_colour_image = 0;
    memcpy(scene.materials[0].base_colour, (float[4]){ 1, 1, 1, 1 }, 16);
    test_picture_create(&picture, test_gpu_of(state), &scene, 16, 16);
    test_picture_render(&picture, NOOK_VIEW_BASE_COLOUR);
    assert_true(test_picture_at(&picture, 8, 4)[0] > test_picture_at(&picture, 8, 4)[1] + 100);
    assert_true(test_picture_at(&picture, 8, 11)[1] > test_picture_at(&picture, 8, 11)[0] + 100);
    test_picture_destroy(&picture);
}

static void test_tone_mapping_rises_and_keeps_black(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 4.0f, -2.0f);
    int last = -1;
    float light = 0.0f;
    for (int i = 0; i < 24; i++, light = light * 1.4f + 0.01f) {
        memcpy(scene.materials[0].emissive, (float[3]){ light, light, light }, 12);
        test_picture_create(&picture, test_gpu_of(state), &scene, 4, 4);
        picture.lights = (nook_lights){ .exposure = 1.0f };
        test_picture_render(&picture, NOOK_VIEW_LIT);
        int now = test_picture_at(&picture, 2, 2)[0];
        assert_true(light == 0.0f ? now == 0 : now > last || now == 255);
        last = now;
        test_picture_destroy(&picture);
    }
    assert_int_equal(last, 255);
}

static void test_point_light_falls_with_the_square_and_ends_at_its_range(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 8.0f, -2.0f);
    test_picture_create(&picture, test_gpu_of(state), &scene, 65, 65);
    picture.lights = (nook_lights){ .point_count = 1, .exposure = 1.0f };
    nook_point_light *light = &picture.lights.points[0];
    *light = (nook_point_light){ .position = { 0, 0, -1 }, .colour = { 0.5f, 0.5f, 0.5f } };
    test_picture_render(&picture, NOOK_VIEW_LIT);
    int near = test_picture_at(&picture, 32, 32)[0];
    light->position[2] = 0.0; /* twice as far, four times as strong: the same in the middle */
    for (int i = 0; i < 3; i++)
        light->colour[i] = 2.0f;
    test_picture_render(&picture, NOOK_VIEW_LIT);
    assert_true(near > 50 && abs(test_picture_at(&picture, 32, 32)[0] - near) <= 1);
    light->range = 1.9f;
    test_picture_render(&picture, NOOK_VIEW_LIT);
    assert_int_equal(test_picture_at(&picture, 32, 32)[0], 0);
    light->range = 0.0f;
    light->direction[2] = -1.0;
    light->cos_inner = cosf(0.2f), light->cos_outer = cosf(0.3f);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    assert_true(abs(test_picture_at(&picture, 32, 32)[0] - near) <= 1);
    assert_int_equal(test_picture_at(&picture, 60, 32)[0], 0); /* 41 degrees off the spot's axis */
    test_picture_destroy(&picture);
}

static void test_white_surface_under_white_sky_is_as_bright_as_the_sky(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 0.8f, -2.0f);
    memcpy(scene.materials[0].base_colour, (float[4]){ 1, 1, 1, 1 }, 16);
    test_picture_create(&picture, test_gpu_of(state), &scene, 32, 32);
    picture.lights = only_sky;
    test_picture_render(&picture, NOOK_VIEW_LIT); /* a furnace: the surface vanishes in it */
    assert_true(abs(test_picture_at(&picture, 16, 16)[0] - test_picture_at(&picture, 1, 1)[0]) <= 3);
    test_picture_destroy(&picture);
}

static void test_blended_surfaces_mix_back_to_front(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    uint32_t near = test_scene_add_facing(&scene, 4.0f, -2.0f);
    uint32_t far = test_scene_add_facing(&scene, 8.0f, -3.0f);
    uint32_t wall = test_scene_add_facing(&scene, 8.0f, -4.0f);
    for (uint32_t i = 0; i < 3; i++) {
        memset(scene.materials[i].base_colour, 0, 12);
        scene.materials[i].unlit = true;
    }
    scene.materials[near].alpha_mode = scene.materials[far].alpha_mode = NOOK_ALPHA_BLEND;
    scene.materials[near].base_colour[3] = scene.materials[far].base_colour[3] = 0.5f;
    scene.materials[near].base_colour[0] = 1.0f;
    scene.materials[far].base_colour[1] = 1.0f;
    scene.materials[wall].base_colour[2] = 1.0f;
    test_picture_create(&picture, test_gpu_of(state), &scene, 8, 8);
    picture.lights = (nook_lights){ .exposure = 1.0f };
    test_picture_render(&picture, NOOK_VIEW_LIT); /* red 1/2, green 1/4, blue 1/4 */
    const uint8_t *pixel = test_picture_at(&picture, 4, 4);
    assert_true(pixel[0] > pixel[1] + 20 && abs(pixel[1] - pixel[2]) <= 1 && pixel[1] > 50);
    assert_true(fabs(0.1 / (double)test_picture_depth(&picture, 4, 4) - 4.0) < 1e-4); /* not in the G-buffer */
    test_picture_destroy(&picture);
}

static void test_scene_lights_are_exposed_to_their_own_strength(void **state)
{
    nook_light lights[2] = {
        { .kind = NOOK_LIGHT_DIRECTIONAL, .colour = { 1, 1, 1 }, .intensity = 90000.0f },
        { .kind = NOOK_LIGHT_POINT, .colour = { 1, 0.5f, 0 }, .intensity = 10.0f, .range = 7.0f },
    };
    nook_scene scene = { .path = "lights", .lights = lights, .light_count = 2, .bounds_max = { 4, 4, 4 } };
    (void)state;
    lights[0].world_from_light = nook_matrix_identity();
    lights[1].world_from_light = nook_matrix_translation(1, 2, 3);
    nook_lights out = nook_lights_from_scene(&scene);
    assert_true(fabsf(out.exposure * 90000.0f / 3.14159265f - 1.0f) < 1e-5f);
    assert_true(out.sun.direction[2] == -1.0 && out.sun.colour[1] == 90000.0f);
    assert_int_equal(out.point_count, 1);
    assert_true(out.points[0].position[2] == 3.0 && out.points[0].colour[1] == 5.0f && out.points[0].range == 7.0f);
    scene.light_count = 0;
    out = nook_lights_from_scene(&scene);
    assert_true(out.sun.colour[0] > 0.0f && out.exposure == 1.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_floor_is_dark_under_a_roof_and_lit_beside_it),
        cmocka_unit_test(test_flat_surfaces_never_shadow_themselves),
        cmocka_unit_test(test_shadow_reaches_the_foot_of_a_wall),
        cmocka_unit_test(test_no_sun_leaks_in_where_a_wall_meets_the_ceiling),
        cmocka_unit_test(test_no_sun_leaks_into_the_corners_of_a_closed_box),
        cmocka_unit_test(test_facets_of_a_smooth_surface_do_not_show_at_the_edge_of_light),
        cmocka_unit_test(test_shadows_follow_what_moves),
        cmocka_unit_test(test_masked_surfaces_cast_the_shadow_of_what_is_left),
        cmocka_unit_test(test_visibility_takes_ambient_light_and_leaves_the_sun),
        cmocka_unit_test(test_visibility_view_shows_its_numbers_as_they_are),
        cmocka_unit_test(test_base_colour_survives_srgb_both_ways),
        cmocka_unit_test(test_images_stand_upright),
        cmocka_unit_test(test_tone_mapping_rises_and_keeps_black),
        cmocka_unit_test(test_point_light_falls_with_the_square_and_ends_at_its_range),
        cmocka_unit_test(test_white_surface_under_white_sky_is_as_bright_as_the_sky),
        cmocka_unit_test(test_blended_surfaces_mix_back_to_front),
        cmocka_unit_test(test_scene_lights_are_exposed_to_their_own_strength),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
