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

static void test_depth_of_a_facing_quad_is_near_over_distance(void **state)
{
    static const float distances[] = { 0.25f, 1.0f, 3.7f, 41.3f, 5000.0f };
    for (size_t i = 0; i < NOOK_COUNT(distances); i++) {
        test_scene scene;
        test_picture picture;
        test_scene_init(&scene);
        test_scene_add_facing(&scene, 2.0f * distances[i], -distances[i]);
        test_picture_create(&picture, test_gpu_of(state), &scene, 16, 16);
        test_picture_render(&picture, NOOK_VIEW_LIT);
        double depth = (double)test_picture_depth(&picture, 5, 9);
        double distance = picture.frame.camera.z_near / depth;
        assert_true(fabs(distance - (double)distances[i]) < 1e-6 * (double)distances[i]);
        test_picture_destroy(&picture);
    }
}

static void test_background_has_depth_zero(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 0.5f, -2.0f);
    test_picture_create(&picture, test_gpu_of(state), &scene, 16, 16);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    assert_true(test_picture_depth(&picture, 0, 0) == 0.0f);
    assert_true(test_picture_depth(&picture, 8, 8) > 0.0f);
    test_picture_destroy(&picture);
}

static void test_the_top_of_the_world_is_the_top_of_the_picture(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_quad(&scene, (float[3]){ 0.1f, 0.1f, -1.0f }, (float[3]){ 0.8f, 0, 0 }, (float[3]){ 0, 0.8f, 0 });
    test_picture_create(&picture, test_gpu_of(state), &scene, 16, 16);
    test_picture_render(&picture, NOOK_VIEW_DEPTH);
    assert_true(test_picture_at(&picture, 12, 3)[0] > 0); /* right, up */
    assert_int_equal(test_picture_at(&picture, 3, 3)[0], 0);
    assert_int_equal(test_picture_at(&picture, 12, 12)[0], 0);
    assert_true(test_picture_depth(&picture, 12, 3) > 0.0f);
    test_picture_destroy(&picture);
}

static void test_the_nearer_of_two_surfaces_is_seen(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    uint32_t near = test_scene_add_facing(&scene, 4.0f, -2.0f);
    uint32_t far = test_scene_add_facing(&scene, 4.0f, -3.0f);
    memcpy(scene.materials[near].base_colour, (float[4]){ 1, 0, 0, 1 }, 16);
    memcpy(scene.materials[far].base_colour, (float[4]){ 0, 1, 0, 1 }, 16);
    test_picture_create(&picture, test_gpu_of(state), &scene, 8, 8);
    test_picture_render(&picture, NOOK_VIEW_BASE_COLOUR);
    assert_int_equal(test_picture_at(&picture, 4, 4)[0], 255);
    assert_int_equal(test_picture_at(&picture, 4, 4)[1], 0);
    test_picture_destroy(&picture);
}

/** A lamp and a board of one size, one behind the other. @return the emission in the picture's middle */
static double emission_seen(void **state, bool lamp_in_front, bool masked)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    uint32_t lamp = test_scene_add_facing(&scene, 4.0f, lamp_in_front ? -2.0f : -3.0f);
    uint32_t board = test_scene_add_facing(&scene, 4.0f, lamp_in_front ? -3.0f : -2.0f);
    memcpy(scene.materials[lamp].emissive, (float[3]){ 0.5f, 0.5f, 0.5f }, 12);
    if (masked)
        scene.materials[board].alpha_mode = NOOK_ALPHA_MASK;
    test_picture_create(&picture, test_gpu_of(state), &scene, 8, 8);
    test_picture_render(&picture, NOOK_VIEW_EMISSIVE);
    double seen = test_picture_at(&picture, 4, 4)[0];
    test_picture_destroy(&picture);
    return seen;
}

static void test_emission_is_seen_where_what_emits_is_in_front_and_nowhere_else(void **state)
{
    for (int masked = 0; masked < 2; masked++) {
        assert_true(emission_seen(state, true, masked) > 180.0);
        assert_true(emission_seen(state, false, masked) == 0.0);
    }
}

static void test_back_faces_are_seen_unless_culled_and_single_sided(void **state)
{
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        for (int double_sided = 0; double_sided < 2; double_sided++) {
            test_scene scene;
            test_picture picture;
            test_scene_init(&scene);
            test_scene_add_facing(&scene, 4.0f, 2.0f); /* behind; turned to the front by the transform */
            scene.materials[0].double_sided = double_sided;
            test_picture_create(&picture, test_gpu_of(state), &scene, 8, 8);
            picture.frame.cull_back_faces = true;
            picture.draws[0].world_from_local = nook_matrix_scale(mirrored ? -1.0 : 1.0, 1.0, 1.0);
            picture.draws[0].world_from_local.m[14] = -4.0; /* in front, facing the camera */
            test_picture_render(&picture, NOOK_VIEW_LIT);
            assert_true(test_picture_depth(&picture, 4, 4) > 0.0f);
            picture.draws[0].world_from_local.m[10] = -1.0; /* mirrored in z: a mirror image keeps its outside */
            picture.draws[0].world_from_local.m[14] = 0.0;
            test_picture_render(&picture, NOOK_VIEW_LIT);
            assert_int_equal(test_picture_depth(&picture, 4, 4) > 0.0f, double_sided);
            picture.frame.cull_back_faces = false;
            test_picture_render(&picture, NOOK_VIEW_LIT);
            assert_true(test_picture_depth(&picture, 4, 4) > 0.0f);
            test_picture_destroy(&picture);
        }
    }
}

/** Renders a quad with a box shadow on it, everything `offset` metres from the origin. */
static void render_offset(void **state, double offset, test_picture *picture, test_scene *scene)
{
    test_scene_init(scene);
    test_scene_add_level(scene, 3.0f, 0.0f, -1.0f, -4.0f, true);
    test_scene_add_quad(scene, (float[3]){ -0.5f, -1.0f, -4.0f }, (float[3]){ 1, 0, 0.4f },
                        (float[3]){ 0, 1.3f, 0.2f });
    scene->materials[1].double_sided = true;
    test_picture_create(picture, test_gpu_of(state), scene, 64, 48);
    nook_matrix move = nook_matrix_translation(offset, -offset, offset);
    nook_matrix back = nook_matrix_translation(-offset, offset, -offset);
    for (int i = 0; i < 2; i++)
        picture->draws[i].world_from_local = nook_matrix_multiply(&move, &picture->draws[i].world_from_local);
    picture->lights.point_count = 1;
    picture->lights.points[0] =
        (nook_point_light){ .position = { offset - 1, -offset, offset - 3 }, .colour = { 1, 2, 3 } };
    picture->frame.camera.view_from_world = nook_matrix_multiply(&picture->frame.camera.view_from_world, &back);
    test_picture_render(picture, NOOK_VIEW_LIT);
}

static void test_a_million_metres_from_the_origin_is_the_same_picture(void **state)
{
    test_scene scenes[2];
    test_picture here, there;
    render_offset(state, 0.0, &here, &scenes[0]);
    render_offset(state, 1048576.7, &there, &scenes[1]);
    for (size_t i = 0; i < (size_t)here.width * here.height * 3; i++)
        assert_true(abs(here.pixels[i] - there.pixels[i]) <= 1);
    test_picture_destroy(&here);
    test_picture_destroy(&there);
}

static void test_draws_of_one_mesh_become_instances_in_their_places(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 0.5f, -2.0f);
    test_picture_create(&picture, test_gpu_of(state), &scene, 32, 32);
    for (int i = 0; i < 4; i++)
        picture.draws[i] =
            (nook_draw){ .world_from_local = nook_matrix_translation(i % 2 == 0 ? -1 : 1, i < 2 ? -1 : 1, 0) };
    picture.draws[3].world_from_local.m[0] = -1.0; /* a mirrored one is culled by its winding only if that is wrong */
    picture.frame.draw_count = 4;
    test_picture_render(&picture, NOOK_VIEW_LIT);
    for (uint32_t i = 0; i < 4; i++)
        assert_true(test_picture_depth(&picture, i % 2 == 0 ? 8 : 24, i < 2 ? 24 : 8) > 0.0f);
    assert_true(test_picture_depth(&picture, 16, 16) == 0.0f);
    test_picture_destroy(&picture);
}

static void test_draws_outside_the_view_or_singular_are_left_out(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 0.5f, -2.0f);
    test_picture_create(&picture, test_gpu_of(state), &scene, 8, 8);
    picture.draws[0].world_from_local = nook_matrix_translation(0, 0, 5);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    assert_true(test_picture_depth(&picture, 4, 4) == 0.0f);
    picture.draws[0].world_from_local = nook_matrix_scale(1, 0, 1);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    assert_true(test_picture_depth(&picture, 4, 4) == 0.0f);
    picture.frame.draw_count = 0;
    test_picture_render(&picture, NOOK_VIEW_LIT);
    test_picture_destroy(&picture);
}

static void test_a_new_size_renders_at_that_size(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 4.0f, -2.0f);
    test_picture_create(&picture, test_gpu_of(state), &scene, 16, 8);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    assert_int_equal(nook_renderer_set_size(picture.renderer, 37, 21), NOOK_OK);
    picture.width = 37, picture.height = 21;
    test_picture_render(&picture, NOOK_VIEW_LIT);
    assert_true(test_picture_depth(&picture, 36, 20) > 0.0f);
    assert_int_equal(nook_renderer_image(picture.renderer).width, 37);
    assert_int_equal(nook_renderer_set_size(picture.renderer, 0, 21), NOOK_E_RANGE);
    assert_int_equal(nook_renderer_set_size(picture.renderer, 37, 1u << 30), NOOK_E_RANGE);
    test_picture_render(&picture, NOOK_VIEW_LIT); /* the old targets stand */
    assert_int_equal(nook_renderer_image(picture.renderer).height, 21);
    test_picture_destroy(&picture);
}

static void test_frame_refuses_what_cannot_be_drawn(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 4.0f, -2.0f);
    test_picture_create(&picture, test_gpu_of(state), &scene, 8, 8);
    nook_frame frame = picture.frame;
    frame.camera.z_near = 0.0;
    assert_int_equal(nook_frame_begin(picture.renderer, &frame), NOOK_E_ARG);
    frame = picture.frame;
    frame.camera.fov_y_radians = (double)NAN;
    assert_int_equal(nook_frame_begin(picture.renderer, &frame), NOOK_E_ARG);
    frame = picture.frame;
    frame.camera.view_from_world.m[12] = (double)INFINITY;
    assert_int_equal(nook_frame_begin(picture.renderer, &frame), NOOK_E_ARG);
    picture.lights.point_count = NOOK_MAX_POINT_LIGHTS + 1;
    assert_int_equal(nook_frame_begin(picture.renderer, &picture.frame), NOOK_E_ARG);
    picture.lights.point_count = 0;
    picture.draws[0].mesh = 1;
    assert_int_equal(nook_frame_begin(picture.renderer, &picture.frame), NOOK_E_ARG);
    test_picture_destroy(&picture);
}

static void test_every_view_shows_something_and_has_a_name(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_level(&scene, 8.0f, 0.0f, -1.0f, -4.0f, true);
    scene.materials[0].metallic = 0.4f;
    scene.materials[0].emissive[1] = 0.3f;
    test_picture_create(&picture, test_gpu_of(state), &scene, 16, 16);
    for (int view = 0; view < NOOK_VIEW_COUNT; view++) {
        nook_view parsed = NOOK_VIEW_COUNT;
        assert_true(nook_view_parse(nook_view_name((nook_view)view), &parsed));
        assert_int_equal(parsed, view);
        test_picture_render(&picture, (nook_view)view);
        /* The map stands upright whatever the camera looks at. */
        const uint8_t *floor = test_picture_at(&picture, 8, view == NOOK_VIEW_SHADOW_MAP ? 8 : 15);
        assert_true(floor[0] + floor[1] + floor[2] > 20);
    }
    nook_view untouched = NOOK_VIEW_DEPTH;
    assert_false(nook_view_parse("nosuch", &untouched));
    assert_int_equal(untouched, NOOK_VIEW_DEPTH);
    test_picture_destroy(&picture);
}

static void test_default_camera_holds_the_whole_box(void **state)
{
    static const double boxes[][2][3] = {
        { { -1, -1, -1 }, { 1, 1, 1 } },
        { { 100, 0, -3 }, { 101, 90, 2 } },
        { { 5, 5, 5 }, { 5, 5, 5 } },
        { { -1e-4, 0, -1e-4 }, { 1e-4, 1e-5, 1e-4 } },
    };
    (void)state;
    for (size_t i = 0; i < NOOK_COUNT(boxes); i++) {
        double aspect = i % 2 == 0 ? 1.7 : 0.5;
        nook_camera camera = nook_camera_frame(boxes[i][0], boxes[i][1], aspect);
        nook_matrix clip = nook_matrix_perspective_reversed(camera.fov_y_radians, aspect, camera.z_near);
        for (int corner = 0; corner < 8; corner++) {
            double p[3], distance;
            for (int k = 0; k < 3; k++)
                p[k] = boxes[i][corner >> k & 1][k];
            nook_matrix_apply_point(&camera.view_from_world, p, p);
            distance = -p[2];
            assert_true(distance > camera.z_near);
            assert_true(fabs(p[0] * clip.m[0]) < distance && fabs(p[1] * clip.m[5]) < distance);
        }
    }
    const double nothing[2][3] = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    nook_camera camera = nook_camera_frame(nothing[0], nothing[1], 1.0);
    assert_true(isfinite(camera.view_from_world.m[14]) && camera.z_near > 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_depth_of_a_facing_quad_is_near_over_distance),
        cmocka_unit_test(test_background_has_depth_zero),
        cmocka_unit_test(test_the_top_of_the_world_is_the_top_of_the_picture),
        cmocka_unit_test(test_the_nearer_of_two_surfaces_is_seen),
        cmocka_unit_test(test_emission_is_seen_where_what_emits_is_in_front_and_nowhere_else),
        cmocka_unit_test(test_back_faces_are_seen_unless_culled_and_single_sided),
        cmocka_unit_test(test_a_million_metres_from_the_origin_is_the_same_picture),
        cmocka_unit_test(test_draws_of_one_mesh_become_instances_in_their_places),
        cmocka_unit_test(test_draws_outside_the_view_or_singular_are_left_out),
        cmocka_unit_test(test_a_new_size_renders_at_that_size),
        cmocka_unit_test(test_frame_refuses_what_cannot_be_drawn),
        cmocka_unit_test(test_every_view_shows_something_and_has_a_name),
        cmocka_unit_test(test_default_camera_holds_the_whole_box),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
