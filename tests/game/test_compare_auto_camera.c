#include "game/compare/auto_camera.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { BOX_TRIANGLES = 12 };

/* A box around the origin whose faces look in or out, as one mesh under one node. */
typedef struct box_scene {
    nook_vertex vertices[8];
    uint32_t indices[BOX_TRIANGLES * 3];
    nook_primitive primitive;
    nook_mesh mesh;
    nook_node node;
    nook_scene scene;
} box_scene;

static void make_box(box_scene *box, double x, double y, double z, bool inwards)
{
    static const uint32_t faces[BOX_TRIANGLES][3] = { /* counter-clockwise from outside; corner = x + 2 y + 4 z */
                                                      { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 },
                                                      { 0, 1, 5 }, { 0, 5, 4 }, { 2, 6, 7 }, { 2, 7, 3 },
                                                      { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }
    };
    *box = (box_scene){ 0 };
    const double half[3] = { x, y, z };
    for (int c = 0; c < 8; c++) {
        for (int i = 0; i < 3; i++)
            box->vertices[c].position[i] = c >> i & 1 ? 1.0f : -1.0f;
    }
    for (int t = 0; t < BOX_TRIANGLES; t++) {
        box->indices[3 * t] = faces[t][0];
        box->indices[3 * t + 1] = faces[t][inwards ? 2 : 1];
        box->indices[3 * t + 2] = faces[t][inwards ? 1 : 2];
    }
    box->primitive = (nook_primitive){ .vertex_count = 8, .index_count = BOX_TRIANGLES * 3 };
    box->mesh = (nook_mesh){ .primitive_count = 1, .bounds_min = { -1, -1, -1 }, .bounds_max = { 1, 1, 1 } };
    box->node = (nook_node){ .parent = NOOK_NONE, .world_from_local = nook_matrix_scale(x, y, z) };
    box->scene = (nook_scene){ .vertices = box->vertices,
                               .vertex_count = 8,
                               .indices = box->indices,
                               .index_count = BOX_TRIANGLES * 3,
                               .primitives = &box->primitive,
                               .primitive_count = 1,
                               .meshes = &box->mesh,
                               .mesh_count = 1,
                               .nodes = &box->node,
                               .node_count = 1 };
    for (int i = 0; i < 3; i++) {
        box->scene.bounds_min[i] = -half[i];
        box->scene.bounds_max[i] = half[i];
    }
}

static void test_rays_meet_the_nearest_side_and_know_it(void **state)
{
    (void)state;
    box_scene box;
    make_box(&box, 2.0, 3.0, 4.0, false);
    const double outside[3] = { 10.0, 0.5, 0.25 }, inside[3] = { 0.5, 0.5, 0.25 };
    const double left[3] = { -2.0, 0.0, 0.0 }, right[3] = { 2.0, 0.0, 0.0 }, up[3] = { 0.0, 1.0, 0.0 };
    nook_view_hit hit = nook_scene_cast(&box.scene, outside, left);
    assert_true(fabs(hit.distance - 4.0) < 1e-12 && hit.front);
    hit = nook_scene_cast(&box.scene, inside, up);
    assert_true(fabs(hit.distance - 2.5) < 1e-12 && !hit.front);
    assert_true(isinf(nook_scene_cast(&box.scene, outside, right).distance));
    box.node.world_from_local = nook_matrix_scale(-2.0, 3.0, 4.0); /* mirrored: the same box, still facing out */
    assert_true(nook_scene_cast(&box.scene, outside, left).front);
}

static void test_a_room_is_seen_from_inside(void **state)
{
    (void)state;
    box_scene box;
    make_box(&box, 10.0, 3.0, 4.0, true);
    nook_camera outside = nook_camera_frame(box.scene.bounds_min, box.scene.bounds_max, 1.5), inside;
    assert_true(nook_camera_inside(&box.scene, &outside, &inside));
    nook_matrix world_from_view;
    const double origin[3] = { 0, 0, 0 }, ahead[3] = { 0, 0, -1 };
    double eye[3], forward[3];
    nook_matrix_inverse_affine(&inside.view_from_world, &world_from_view);
    nook_matrix_apply_point(&world_from_view, origin, eye);
    nook_matrix_apply_vector(&world_from_view, ahead, forward);
    for (int i = 0; i < 3; i++)
        assert_true(eye[i] > box.scene.bounds_min[i] && eye[i] < box.scene.bounds_max[i]);
    assert_true(fabs(forward[0]) > 0.8);    /* along the room */
    assert_true(eye[0] * forward[0] < 0.0); /* towards its middle */
}

static void test_a_thing_is_seen_from_outside(void **state)
{
    (void)state;
    box_scene box;
    make_box(&box, 10.0, 3.0, 4.0, false);
    nook_camera outside = nook_camera_frame(box.scene.bounds_min, box.scene.bounds_max, 1.5), inside = outside;
    assert_false(nook_camera_inside(&box.scene, &outside, &inside));
    assert_memory_equal(&inside, &outside, sizeof inside);
}

static void test_a_room_with_one_side_open_is_seen_through_it(void **state)
{
    (void)state;
    box_scene box;
    make_box(&box, 2.0, 2.0, 2.0, true);
    box.primitive.index_count -= 6; /* the two triangles at +z are the last */
    nook_camera outside = nook_camera_outside(&box.scene, 1.5);
    nook_matrix world_from_view;
    const double origin[3] = { 0, 0, 0 };
    double eye[3];
    nook_matrix_inverse_affine(&outside.view_from_world, &world_from_view);
    nook_matrix_apply_point(&world_from_view, origin, eye);
    assert_true(fabs(eye[0]) < 1e-9 && fabs(eye[1]) < 1e-9 && eye[2] > 2.0);
    assert_true(nook_view_back_fraction(&box.scene, &outside, 1.5) == 0.0);
    nook_camera three_quarters = nook_camera_frame(box.scene.bounds_min, box.scene.bounds_max, 1.5);
    assert_true(nook_view_back_fraction(&box.scene, &three_quarters, 1.5) > 0.1);
}

static void test_a_solid_thing_keeps_its_three_quarter_view(void **state)
{
    (void)state;
    box_scene box;
    make_box(&box, 2.0, 1.0, 2.0, false);
    nook_camera outside = nook_camera_outside(&box.scene, 1.5);
    nook_camera three_quarters = nook_camera_frame(box.scene.bounds_min, box.scene.bounds_max, 1.5);
    assert_memory_equal(&outside.view_from_world, &three_quarters.view_from_world, sizeof outside.view_from_world);
}

/* How many pixels of a picture show the scene. */
static int count_seen(const nook_scene *scene, const nook_camera *view, int width, int height)
{
    nook_matrix world_from_view;
    const double origin[3] = { 0, 0, 0 };
    double eye[3], tangent = tan(0.5 * view->fov_y_radians);
    int seen = 0;
    nook_matrix_inverse_affine(&view->view_from_world, &world_from_view);
    nook_matrix_apply_point(&world_from_view, origin, eye);
    for (int i = 0; i < width * height; i++) {
        double u = 2.0 * (i % width + 0.5) / width - 1.0, v = 2.0 * (i / width + 0.5) / height - 1.0;
        double direction[3] = { u * tangent * width / height, v * tangent, -1.0 };
        nook_matrix_apply_vector(&world_from_view, direction, direction);
        seen += isfinite(nook_scene_cast(scene, eye, direction).distance);
    }
    return seen;
}

static void test_extreme_pictures_show_the_scene(void **state)
{
    (void)state;
    static const int sizes[][2] = { { 400, 1 }, { 1, 400 }, { 16384, 2 }, { 2, 1000 }, { 6, 1 } };
    box_scene box;
    make_box(&box, 1.0, 1.0, 1.0, false);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        int width = sizes[i][0], height = sizes[i][1];
        nook_camera outside = nook_camera_outside(&box.scene, width / (double)height);
        assert_in_range(count_seen(&box.scene, &outside, width, height), width * height / 10 + 1, width * height);
    }
}

static void test_a_scene_without_triangles_is_no_room(void **state)
{
    (void)state;
    nook_scene scene = { .bounds_min = { 1, 1, 1 }, .bounds_max = { -1, -1, -1 } };
    nook_camera outside = nook_camera_frame(scene.bounds_min, scene.bounds_max, 1.5), inside;
    assert_false(nook_camera_inside(&scene, &outside, &inside));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rays_meet_the_nearest_side_and_know_it),
        cmocka_unit_test(test_a_room_is_seen_from_inside),
        cmocka_unit_test(test_a_thing_is_seen_from_outside),
        cmocka_unit_test(test_a_room_with_one_side_open_is_seen_through_it),
        cmocka_unit_test(test_a_solid_thing_keeps_its_three_quarter_view),
        cmocka_unit_test(test_extreme_pictures_show_the_scene),
        cmocka_unit_test(test_a_scene_without_triangles_is_no_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
