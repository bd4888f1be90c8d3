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

#define DIRECTIONS 10000

/** Directions spread evenly (a Fibonacci spiral); the first six are the axes. */
static void make_directions(float (*out)[4])
{
    for (int i = 0; i < DIRECTIONS; i++) {
        double y = 1.0 - 2.0 * (i + 0.5) / DIRECTIONS, r = sqrt(1.0 - y * y), angle = 2.399963229728653 * i;
        out[i][0] = (float)(r * cos(angle));
        out[i][1] = (float)y;
        out[i][2] = (float)(r * sin(angle));
        out[i][3] = 0.0f;
    }
    memset(out, 0, 6 * sizeof *out);
    for (int i = 0; i < 6; i++)
        out[i][i / 2] = i % 2 == 0 ? 1.0f : -1.0f;
}

static void test_octahedral_round_trip_is_exact_on_axes_and_close_elsewhere(void **state)
{
    float(*in)[4] = malloc(DIRECTIONS * sizeof *in), (*out)[4] = malloc(DIRECTIONS * sizeof *out);
    make_directions(in);
    test_gpu_map(test_gpu_of(state), "tests/render/octahedral.comp.glsl", in, sizeof *in, out, sizeof *out, DIRECTIONS);
    for (int i = 0; i < DIRECTIONS; i++) {
        for (int k = 0; k < 3; k++)
            assert_true(i < 6 ? out[i][k] == in[i][k] : fabsf(out[i][k] - in[i][k]) < 1e-4f);
    }
    free(in);
    free(out);
}

static void assert_direction(const double got[3], double x, double y, double z, double within)
{
    double length = sqrt(x * x + y * y + z * z);
    assert_true(fabs(got[0] - x / length) < within);
    assert_true(fabs(got[1] - y / length) < within);
    assert_true(fabs(got[2] - z / length) < within);
}

/** The plane z = 0.3 x + 0.2 y - 2 before the transform, moved by it; n is what its normal must become. */
static void check_tilted(void **state, nook_matrix world_from_local, const double n[3])
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_quad(&scene, (float[3]){ -9, -9, -2 - 2.7f - 1.8f }, (float[3]){ 18, 0, 5.4f },
                        (float[3]){ 0, 18, 3.6f });
    test_picture_create(&picture, test_gpu_of(state), &scene, 16, 16);
    picture.draws[0].world_from_local = world_from_local;
    test_picture_render(&picture, NOOK_VIEW_GEOMETRIC_NORMAL);
    nook_gbuffer g = nook_renderer_gbuffer(picture.renderer);
    for (uint32_t i = 4; i < 12; i++) {
        double got[3];
        assert_true(test_picture_depth(&picture, i, i) > 0.0f);
        test_picture_normal(&picture, g.geometric_normal, i, i, got);
        assert_direction(got, n[0], n[1], n[2], 1e-4);
        test_picture_normal(&picture, g.normal, i, i, got);
        assert_direction(got, n[0], n[1], n[2], 1e-4);
    }
    test_picture_destroy(&picture);
}

static void test_geometric_normal_of_a_tilted_plane_is_right(void **state)
{
    check_tilted(state, nook_matrix_identity(), (double[3]){ -0.3, -0.2, 1 });
}

static void test_geometric_normal_is_right_under_non_uniform_scale(void **state)
{
    check_tilted(state, nook_matrix_scale(2, 1, 0.5), (double[3]){ -0.3 / 2, -0.2, 1 / 0.5 });
}

static void test_geometric_normal_is_right_under_mirroring_scale(void **state)
{
    check_tilted(state, nook_matrix_scale(-1, 1, 1), (double[3]){ 0.3, -0.2, 1 });
    check_tilted(state, nook_matrix_scale(-3, 0.5, 0.7), (double[3]){ 0.3 / 3, -0.2 / 0.5, 1 / 0.7 });
}

static void test_geometric_normal_is_right_at_extreme_scales(void **state)
{
    check_tilted(state, nook_matrix_scale(1e6, 1e6, 1e6), (double[3]){ -0.3, -0.2, 1 });
    nook_matrix small = nook_matrix_scale(1e-12, 1e-12, 1e-12);
    small.m[14] = -0.2;
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_quad(&scene, (float[3]){ -9e11f, -9e11f, 0 }, (float[3]){ 18e11f, 0, 5.4e11f },
                        (float[3]){ 0, 18e11f, 0 });
    test_picture_create(&picture, test_gpu_of(state), &scene, 8, 8);
    picture.draws[0].world_from_local = small;
    picture.draws[0].world_from_local.m[14] = -3.0;
    test_picture_render(&picture, NOOK_VIEW_LIT);
    double got[3];
    test_picture_normal(&picture, nook_renderer_gbuffer(picture.renderer).geometric_normal, 4, 4, got);
    assert_direction(got, -0.3, 0, 1, 1e-4);
    test_picture_destroy(&picture);
}

static void test_axis_aligned_walls_have_exact_normals(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_level(&scene, 10.0f, 0, -1, -5, true);
    test_picture_create(&picture, test_gpu_of(state), &scene, 16, 16);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    double got[3];
    test_picture_normal(&picture, nook_renderer_gbuffer(picture.renderer).geometric_normal, 8, 14, got);
    assert_true(got[0] == 0.0 && got[1] == 1.0 && got[2] == 0.0);
    test_picture_destroy(&picture);
}

static void test_normals_face_the_viewer_on_the_back_of_a_surface(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_quad(&scene, (float[3]){ 5, -5, -2 }, (float[3]){ -10, 0, 0 }, (float[3]){ 0, 10, 0 });
    scene.materials[0].double_sided = true;
    test_picture_create(&picture, test_gpu_of(state), &scene, 8, 8);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    double got[3];
    test_picture_normal(&picture, nook_renderer_gbuffer(picture.renderer).geometric_normal, 4, 4, got);
    assert_direction(got, 0, 0, 1, 1e-9);
    test_picture_normal(&picture, nook_renderer_gbuffer(picture.renderer).normal, 4, 4, got);
    assert_direction(got, 0, 0, 1, 1e-9);
    test_picture_destroy(&picture);
}

static void test_shading_normals_against_the_winding_are_turned_to_it(void **state)
{
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 5.0f, -2.0f);
    for (int i = 0; i < 4; i++)
        scene.vertices[i].normal[2] = -1.0f;
    test_picture_create(&picture, test_gpu_of(state), &scene, 8, 8);
    test_picture_render(&picture, NOOK_VIEW_LIT);
    double got[3];
    test_picture_normal(&picture, nook_renderer_gbuffer(picture.renderer).normal, 4, 4, got);
    assert_direction(got, 0, 0, 1, 1e-9);
    test_picture_destroy(&picture);
}

/** A normal map of one texel that leans to +u by `x` and to the image's top by `y`, on a facing quad. */
static void mapped_normal(void **state, const float tangent[4], bool mirrored, bool quick, double out[3])
{
    uint8_t texel[4] = { 204, 178, 230, 255 }; /* 0.6, 0.4, 0.8 */
    test_scene scene;
    test_picture picture;
    test_scene_init(&scene);
    test_scene_add_facing(&scene, 5.0f, -2.0f);
    scene.images[0] = (nook_image){ .name = "normal", .pixels = texel, .width = 1, .height = 1 };
    scene.scene.image_count = 1;
    scene.materials[0].normal_image = 0;
    for (int i = 0; i < 4; i++)
        memcpy(scene.vertices[i].tangent, tangent, sizeof scene.vertices[i].tangent);
    test_picture_create(&picture, test_gpu_of(state), &scene, 8, 8);
    picture.draws[0].world_from_local.m[0] = mirrored ? -1.0 : 1.0;
    picture.frame.quick = quick;
    test_picture_render(&picture, NOOK_VIEW_LIT);
    test_picture_normal(&picture, nook_renderer_gbuffer(picture.renderer).normal, 4, 4, out);
    test_picture_destroy(&picture);
}

static void test_normal_maps_lean_to_u_and_to_the_top_of_the_image(void **state)
{
    static const float given[4] = { 1, 0, 0, 1 }, none[4] = { 0 };
    for (int i = 0; i < 4; i++) {
        const bool mirrored = i & 1, quick = i & 2;
        double with[3], without[3], side = mirrored ? -0.6 : 0.6;
        mapped_normal(state, given, mirrored, quick, with);
        mapped_normal(state, none, mirrored, quick, without);
        assert_direction(with, side, 0.396, 0.804, 0.01);
        assert_direction(without, side, 0.396, 0.804, 0.01);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_octahedral_round_trip_is_exact_on_axes_and_close_elsewhere),
        cmocka_unit_test(test_geometric_normal_of_a_tilted_plane_is_right),
        cmocka_unit_test(test_geometric_normal_is_right_under_non_uniform_scale),
        cmocka_unit_test(test_geometric_normal_is_right_under_mirroring_scale),
        cmocka_unit_test(test_geometric_normal_is_right_at_extreme_scales),
        cmocka_unit_test(test_axis_aligned_walls_have_exact_normals),
        cmocka_unit_test(test_normals_face_the_viewer_on_the_back_of_a_surface),
        cmocka_unit_test(test_shading_normals_against_the_winding_are_turned_to_it),
        cmocka_unit_test(test_normal_maps_lean_to_u_and_to_the_top_of_the_image),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
