#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/support/test_glb.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define QUAD_BOUNDS "'min': [ 0, 0, 0 ], 'max': [ 1, 1, 0 ]"
#define VEC(view, count, type) \
    "{ 'bufferView': " view ", 'componentType': 5126, 'count': " count ", 'type': '" type "' }"
/** Primitives and accessors; accessors[0] are the quad's positions. */
#define MESH(primitives, accessors)                                                                        \
    TEST_GLB_ONE_NODE ", 'meshes': [ { 'primitives': [ " primitives " ] } ], 'accessors': [ "              \
                      "{ 'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3', " QUAD_BOUNDS \
                      " }" accessors " ]"

static void start_quad(test_glb *glb)
{
    *glb = (test_glb){ 0 };
    test_glb_add(glb, test_quad_positions, sizeof test_quad_positions);
}

/* z of the cross product of a triangle's edges: positive when it faces +z. */
static double winding(const nook_scene *scene, uint32_t triangle)
{
    const float *a = test_scene_corner(scene, 3 * triangle)->position;
    const float *b = test_scene_corner(scene, 3 * triangle + 1)->position;
    const float *c = test_scene_corner(scene, 3 * triangle + 2)->position;
    return (double)((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

static void test_strip_becomes_triangles_of_one_winding(void **state)
{
    (void)state;
    test_glb glb;
    start_quad(&glb);
    nook_scene *scene = test_glb_must_load(&glb, MESH("{ 'attributes': { 'POSITION': 0 }, 'mode': 5 }", ""));
    assert_int_equal(scene->triangle_count, 2);
    assert_true(winding(scene, 0) == 1.0);
    assert_true(winding(scene, 1) == 1.0);
    nook_scene_destroy(scene);
}

static void test_fan_becomes_triangles_of_one_winding(void **state)
{
    (void)state;
    static const uint8_t around[] = { 0, 1, 3, 2 };
    test_glb glb;
    start_quad(&glb);
    test_glb_add(&glb, around, sizeof around);
    nook_scene *scene =
        test_glb_must_load(&glb, MESH("{ 'attributes': { 'POSITION': 0 }, 'indices': 1, 'mode': 6 }",
                                      ", { 'bufferView': 1, 'componentType': 5121, 'count': 4, 'type': 'SCALAR' }"));
    assert_int_equal(scene->triangle_count, 2);
    assert_true(winding(scene, 0) == 1.0);
    assert_true(winding(scene, 1) == 1.0);
    nook_scene_destroy(scene);
}

static void test_points_and_lines_are_left_out_with_a_warning(void **state)
{
    (void)state;
    test_glb glb;
    start_quad(&glb);
    nook_scene *scene = test_glb_must_load(
        &glb, MESH("{ 'attributes': { 'POSITION': 0 }, 'mode': 0 }, { 'attributes': { 'POSITION': 0 }, 'mode': 3 }, "
                   "{ 'attributes': { 'POSITION': 0 }, 'mode': 5 }",
                   ""));
    assert_int_equal(scene->triangle_count, 2);
    assert_int_equal(scene->meshes[0].primitive_count, 1);
    assert_int_equal(scene->warning_count, 1);
    assert_non_null(strstr(scene->warnings[0], "2 primitives of points or lines are left out"));
    nook_scene_destroy(scene);
}

static void test_two_indices_draw_nothing_and_say_so(void **state)
{
    (void)state;
    static const uint8_t indices[] = { 0, 1 };
    test_glb glb;
    start_quad(&glb);
    test_glb_add(&glb, indices, sizeof indices);
    nook_scene *scene =
        test_glb_must_load(&glb, MESH("{ 'attributes': { 'POSITION': 0 }, 'indices': 1 }",
                                      ", { 'bufferView': 1, 'componentType': 5121, 'count': 2, 'type': 'SCALAR' }"));
    assert_int_equal(scene->triangle_count, 0);
    assert_int_equal(scene->warning_count, 2);
    assert_non_null(strstr(scene->warnings[1], "nothing to draw"));
    nook_scene_destroy(scene);
}

static void test_missing_normals_become_flat_ones(void **state)
{
    (void)state;
    /* A roof: two triangles that share the edge 1 2. */
    static const float positions[12] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, -1 };
    static const uint8_t indices[] = { 0, 1, 2, 2, 1, 3 };
    test_glb glb = { 0 };
    test_glb_add(&glb, positions, sizeof positions);
    test_glb_add(&glb, indices, sizeof indices);
    nook_scene *scene =
        test_glb_must_load(&glb, TEST_GLB_ONE_NODE
                           ", 'meshes': [ { 'primitives': [ { 'attributes': { 'POSITION': 0 }, 'indices': 1 } ] } ], "
                           "'accessors': [ " TEST_GLB_QUAD_POSITIONS
                           ", { 'bufferView': 1, 'componentType': 5121, 'count': 6, 'type': 'SCALAR' } ]");
    assert_int_equal(scene->vertex_count, 6); /* the edge's vertices have two normals */
    const float third = 0.57735027f;
    for (uint32_t i = 0; i < 3; i++) {
        const float *first = test_scene_corner(scene, i)->normal, *second = test_scene_corner(scene, 3 + i)->normal;
        assert_true(first[0] == 0.0f && first[1] == 0.0f && first[2] == 1.0f);
        for (int k = 0; k < 3; k++)
            assert_true(fabsf(second[k] - third) < 1e-6f);
    }
    nook_scene_destroy(scene);
}

static void test_only_broken_normals_are_made_from_the_triangles(void **state)
{
    (void)state;
    float normals[12] = { 0, 0, -2, 0, 0, 0, NAN, 0, 0, 0, 3, 0 };
    test_glb glb;
    start_quad(&glb);
    test_glb_add(&glb, normals, sizeof normals);
    nook_scene *scene = test_glb_must_load(
        &glb, MESH("{ 'attributes': { 'POSITION': 0, 'NORMAL': 1 }, 'mode': 5 }", ", " VEC("1", "4", "VEC3")));
    assert_int_equal(scene->warning_count, 1);
    assert_non_null(strstr(scene->warnings[0], "2 broken normals"));
    assert_int_equal(scene->vertex_count, 4);
    assert_true(scene->vertices[0].normal[2] == -1.0f); /* wrong, but the file's own; made unit */
    assert_true(scene->vertices[1].normal[2] == 1.0f);
    assert_true(scene->vertices[2].normal[2] == 1.0f);
    assert_true(scene->vertices[3].normal[1] == 1.0f);
    nook_scene_destroy(scene);
}

static void test_primitives_with_the_same_attributes_share_vertices(void **state)
{
    (void)state;
    static const float normals[12] = { 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 };
    static const uint8_t indices[] = { 0, 1, 2, 0, 2, 1, 3, 0 };
    test_glb glb;
    start_quad(&glb);
    test_glb_add(&glb, normals, sizeof normals);
    test_glb_add(&glb, indices, sizeof indices);
    nook_scene *scene = test_glb_must_load(
        &glb,
        MESH("{ 'attributes': { 'POSITION': 0, 'NORMAL': 1 }, 'indices': 2 }, "
             "{ 'attributes': { 'POSITION': 0, 'NORMAL': 1 }, 'indices': 3 }",
             ", " VEC("1", "4", "VEC3") ", { 'bufferView': 2, 'componentType': 5121, 'count': 3, 'type': 'SCALAR' }, "
                                        "{ 'bufferView': 2, 'byteOffset': 4, 'componentType': 5121, 'count': 3, "
                                        "'type': 'SCALAR' }"));
    assert_int_equal(scene->vertex_count, 4);
    assert_int_equal(scene->primitive_count, 2);
    assert_int_equal(scene->primitives[1].first_vertex, scene->primitives[0].first_vertex);
    assert_int_equal(scene->indices[scene->primitives[1].first_index + 2], 3);
    nook_scene_destroy(scene);
}

static void test_primitive_without_position_is_left_out(void **state)
{
    (void)state;
    test_glb glb;
    start_quad(&glb);
    nook_scene *scene = test_glb_must_load(
        &glb, MESH("{ 'attributes': { 'NORMAL': 0 } }, { 'attributes': { 'POSITION': 0 }, 'mode': 5 }", ""));
    assert_int_equal(scene->primitive_count, 1);
    assert_int_equal(scene->triangle_count, 2);
    assert_int_equal(scene->warning_count, 1);
    nook_scene_destroy(scene);
}

/* The quad with coordinates, normals and a material that has a normal map (an image that is missing). */
static nook_scene *load_textured(const float uv[8], const char *normal_texture)
{
    static const float normals[12] = { 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 };
    char members[2048];
    test_glb glb;
    start_quad(&glb);
    test_glb_add(&glb, normals, sizeof normals);
    test_glb_add(&glb, uv, 8 * sizeof *uv);
    snprintf(members, sizeof members,
             MESH("{ 'attributes': { 'POSITION': 0, 'NORMAL': 1, 'TEXCOORD_0': 2 }, 'material': 0, 'mode': 5 }",
                  ", " VEC("1", "4", "VEC3") ", " VEC("2", "4", "VEC2")) ", 'materials': [ { %s } ], "
                                                                         "'textures': [ { 'source': 0 } ], "
                                                                         "'images': [ { 'uri': 'missing.png' } ]",
             normal_texture);
    return test_glb_must_load(&glb, members);
}

static void test_tangents_are_made_for_normal_maps_only(void **state)
{
    (void)state;
    static const float uv[8] = { 0, 0, 0, 1, 1, 0, 1, 1 }; /* u along +y, v along +x: mirrored */
    nook_scene *scene = load_textured(uv, "'normalTexture': { 'index': 0 }");
    for (uint32_t i = 0; i < 4; i++) {
        const float *t = scene->vertices[i].tangent;
        assert_true(fabsf(t[0]) < 1e-6f && fabsf(t[1] - 1.0f) < 1e-6f && fabsf(t[2]) < 1e-6f);
        /* normal z cross tangent y = -x; v runs along +x */
        assert_true(t[3] == -1.0f);
    }
    nook_scene_destroy(scene);
    scene = load_textured(uv, "'emissiveTexture': { 'index': 0 }");
    for (uint32_t i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            assert_true(scene->vertices[i].tangent[k] == 0.0f);
    nook_scene_destroy(scene);
}

static void test_tangents_lie_in_the_surface_where_coordinates_are_degenerate(void **state)
{
    (void)state;
    static const float uv[8] = { 0 };
    nook_scene *scene = load_textured(uv, "'normalTexture': { 'index': 0 }");
    for (uint32_t i = 0; i < 4; i++) {
        const float *t = scene->vertices[i].tangent;
        assert_true(fabsf(t[0] * t[0] + t[1] * t[1] - 1.0f) < 1e-6f && t[2] == 0.0f && fabsf(t[3]) == 1.0f);
    }
    nook_scene_destroy(scene);
}

static void test_texture_transform_moves_the_coordinates(void **state)
{
    (void)state;
    static const float uv[8] = { 0, 0, 1, 0, 0, 1, 1, 1 };
    /* A quarter turn counter-clockwise in an image whose v points down takes +u to -v. */
    nook_scene *scene =
        load_textured(uv, "'emissiveTexture': { 'index': 0, 'extensions': { 'KHR_texture_transform': { "
                          "'offset': [ 0.25, 0.5 ], 'rotation': 1.5707963267948966, 'scale': [ 2, 4 ] } } }");
    assert_true(fabsf(scene->vertices[0].uv[0] - 0.25f) < 1e-6f && fabsf(scene->vertices[0].uv[1] - 0.5f) < 1e-6f);
    assert_true(fabsf(scene->vertices[1].uv[0] - 0.25f) < 1e-6f && fabsf(scene->vertices[1].uv[1] + 1.5f) < 1e-6f);
    assert_true(fabsf(scene->vertices[2].uv[0] - 4.25f) < 1e-6f && fabsf(scene->vertices[2].uv[1] - 0.5f) < 1e-6f);
    nook_scene_destroy(scene);
}

static void test_second_coordinates_are_used_when_the_base_colour_says_so(void **state)
{
    (void)state;
    static const float first[8] = { 0 }, second[8] = { 5, 6, 7, 8, 9, 10, 11, 12 };
    test_glb glb;
    start_quad(&glb);
    test_glb_add(&glb, first, sizeof first);
    test_glb_add(&glb, second, sizeof second);
    nook_scene *scene = test_glb_must_load(
        &glb, MESH("{ 'attributes': { 'POSITION': 0, 'TEXCOORD_0': 1, 'TEXCOORD_1': 2 }, 'material': 0, 'mode': 5 }",
                   ", " VEC("1", "4", "VEC2") ", " VEC("2", "4", "VEC2")) ", 'materials': [ { 'pbrMetallicRoughness': "
                                                                          "{ 'baseColorTexture': { 'index': 0, "
                                                                          "'texCoord': 1 } } } ], 'textures': [ { } ]");
    assert_true(test_scene_corner(scene, 1)->uv[0] == 7.0f && test_scene_corner(scene, 1)->uv[1] == 8.0f);
    nook_scene_destroy(scene);
}

static void test_mesh_of_many_nodes_is_stored_once_and_counted_for_each(void **state)
{
    (void)state;
    test_glb glb;
    start_quad(&glb);
    nook_scene *scene = test_glb_must_load(
        &glb,
        "'scenes': [ { 'nodes': [ 0, 1, 2 ] } ], 'nodes': [ { 'mesh': 0 }, { 'mesh': 0, 'translation': [ 9, 0, 0 ] }, "
        "{ 'mesh': 0 } ], 'meshes': [ { 'name': 'plate', 'primitives': [ { 'attributes': { 'POSITION': 0 }, "
        "'mode': 5 } ] } ], 'accessors': [ " TEST_GLB_QUAD_POSITIONS " ]");
    assert_int_equal(scene->triangle_count, 6);
    assert_int_equal(scene->index_count, 6);
    assert_string_equal(scene->meshes[0].name, "plate");
    assert_true(scene->bounds_max[0] == 10.0 && scene->bounds_min[0] == 0.0);
    assert_true(scene->meshes[0].bounds_max[0] == 1.0f && scene->meshes[0].bounds_min[0] == 0.0f);
    nook_scene_destroy(scene);
}

static void test_a_mesh_with_morph_targets_is_a_deformable(void **state)
{
    (void)state;
    test_glb glb;
    start_quad(&glb);
    nook_scene *scene = test_glb_must_load(
        &glb, MESH("{ 'attributes': { 'POSITION': 0 }, 'mode': 5, 'targets': [ { 'POSITION': 0 } ] }", ""));
    assert_int_equal(scene->warning_count, 0);
    assert_int_equal(scene->deformable_count, 1);
    assert_int_equal(scene->deformables[0].target_count, 1);
    nook_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_strip_becomes_triangles_of_one_winding),
        cmocka_unit_test(test_fan_becomes_triangles_of_one_winding),
        cmocka_unit_test(test_points_and_lines_are_left_out_with_a_warning),
        cmocka_unit_test(test_two_indices_draw_nothing_and_say_so),
        cmocka_unit_test(test_missing_normals_become_flat_ones),
        cmocka_unit_test(test_only_broken_normals_are_made_from_the_triangles),
        cmocka_unit_test(test_primitives_with_the_same_attributes_share_vertices),
        cmocka_unit_test(test_primitive_without_position_is_left_out),
        cmocka_unit_test(test_tangents_are_made_for_normal_maps_only),
        cmocka_unit_test(test_tangents_lie_in_the_surface_where_coordinates_are_degenerate),
        cmocka_unit_test(test_texture_transform_moves_the_coordinates),
        cmocka_unit_test(test_second_coordinates_are_used_when_the_base_colour_says_so),
        cmocka_unit_test(test_mesh_of_many_nodes_is_stored_once_and_counted_for_each),
        cmocka_unit_test(test_a_mesh_with_morph_targets_is_a_deformable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
