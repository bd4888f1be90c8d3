#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/support/test_glb.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define QUAD_WITH(indices)                                                                                        \
    TEST_GLB_ONE_NODE ", 'meshes': [ { 'primitives': [ { 'attributes': { 'POSITION': 0 }, 'indices': 1 } ] } ], " \
                      "'accessors': [ " TEST_GLB_QUAD_POSITIONS ", " indices " ]"

/** One mesh of the attributes given; its accessors follow. */
#define MESH_OF(attributes, accessors)                                                \
    TEST_GLB_ONE_NODE ", 'meshes': [ { 'primitives': [ { 'attributes': { " attributes \
                      " } } ] } ], 'accessors': [ " accessors " ]"

static void assert_position(const nook_vertex *vertex, double x, double y, double z)
{
    const double expected[3] = { x, y, z };
    for (int k = 0; k < 3; k++)
        if (fabs((double)vertex->position[k] - expected[k]) > 1e-6)
            fail_msg("position %g %g %g, expected %g %g %g", (double)vertex->position[0], (double)vertex->position[1],
                     (double)vertex->position[2], x, y, z);
}

static void check_quad(const void *indices, size_t size, const char *accessor)
{
    test_glb glb = { 0 };
    char members[1024];
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    test_glb_add(&glb, indices, size);
    snprintf(members, sizeof members, QUAD_WITH("%s"), accessor);
    nook_scene *scene = test_glb_must_load(&glb, members);
    assert_int_equal(scene->triangle_count, 2);
    assert_position(test_scene_corner(scene, 2), 0, 1, 0);
    assert_position(test_scene_corner(scene, 3), 0, 1, 0);
    assert_position(test_scene_corner(scene, 4), 1, 0, 0);
    assert_position(test_scene_corner(scene, 5), 1, 1, 0);
    nook_scene_destroy(scene);
}

static void test_indices_of_all_three_types_are_read(void **state)
{
    (void)state;
    static const uint8_t bytes[] = { 0, 1, 2, 2, 1, 3 };
    static const uint16_t shorts[] = { 0, 1, 2, 2, 1, 3 };
    static const uint32_t ints[] = { 0, 1, 2, 2, 1, 3 };
    check_quad(bytes, sizeof bytes, "{ 'bufferView': 1, 'componentType': 5121, 'count': 6, 'type': 'SCALAR' }");
    check_quad(shorts, sizeof shorts, "{ 'bufferView': 1, 'componentType': 5123, 'count': 6, 'type': 'SCALAR' }");
    check_quad(ints, sizeof ints, "{ 'bufferView': 1, 'componentType': 5125, 'count': 6, 'type': 'SCALAR' }");
}

static void test_indices_that_are_not_unsigned_integers_are_refused(void **state)
{
    (void)state;
    static const float floats[] = { 0, 1, 2, 2, 1, 3 };
    static const char reason[] = "the indices are not single unsigned integers";
    test_glb glb = { 0 };
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    test_glb_add(&glb, floats, sizeof floats);
    test_glb_must_refuse(&glb, QUAD_WITH("{ 'bufferView': 1, 'componentType': 5126, 'count': 6, 'type': 'SCALAR' }"),
                         reason);
    test_glb_must_refuse(&glb, QUAD_WITH("{ 'bufferView': 1, 'componentType': 5122, 'count': 6, 'type': 'SCALAR' }"),
                         reason);
    test_glb_must_refuse(&glb, QUAD_WITH("{ 'bufferView': 1, 'componentType': 5123, 'count': 3, 'type': 'VEC2' }"),
                         reason);
}

static void test_index_beyond_the_vertices_is_refused(void **state)
{
    (void)state;
    static const uint16_t indices[] = { 0, 1, 4 };
    test_glb glb = { 0 };
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    test_glb_add(&glb, indices, sizeof indices);
    test_glb_must_refuse(&glb, QUAD_WITH("{ 'bufferView': 1, 'componentType': 5123, 'count': 3, 'type': 'SCALAR' }"),
                         "meshes[0].primitives[0]: index 2 is 4, there are 4 vertices");
}

/* Three positions, one of each kind of integer: the lowest, a middle and the highest value. */
static void check_quantized(const void *values, size_t size, uint32_t stride, const char *type, bool normalized,
                            double low, double high)
{
    test_glb glb = { 0 };
    char members[1024];
    test_glb_add_strided(&glb, values, size, stride);
    snprintf(members, sizeof members,
             MESH_OF("'POSITION': 0",
                     "{ 'bufferView': 0, 'componentType': %s, 'count': 3, 'type': 'VEC3', 'normalized': %s }"),
             type, normalized ? "true" : "false");
    nook_scene *scene = test_glb_must_load(&glb, members);
    assert_position(test_scene_corner(scene, 0), low, 0, 0);
    assert_position(test_scene_corner(scene, 1), 0, high, 0);
    assert_position(test_scene_corner(scene, 2), 0, 0, high);
    nook_scene_destroy(scene);
}

static void test_quantized_positions_are_read_normalised_and_plain(void **state)
{
    (void)state;
    static const int8_t bytes[] = { -128, 0, 0, 0, 0, 127, 0, 0, 0, 0, 127, 0 };
    static const uint8_t ubytes[] = { 51, 0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0 };
    static const int16_t shorts[] = { -32768, 0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0 };
    static const uint16_t ushorts[] = { 13107, 0, 0, 0, 0, 65535, 0, 0, 0, 0, 65535, 0 };
    check_quantized(bytes, sizeof bytes, 4, "5120", true, -1, 1); /* -128 is clamped */
    check_quantized(bytes, sizeof bytes, 4, "5120", false, -128, 127);
    check_quantized(ubytes, sizeof ubytes, 4, "5121", true, 0.2, 1);
    check_quantized(ubytes, sizeof ubytes, 4, "5121", false, 51, 255);
    check_quantized(shorts, sizeof shorts, 8, "5122", true, -1, 1);
    check_quantized(shorts, sizeof shorts, 8, "5122", false, -32768, 32767);
    check_quantized(ushorts, sizeof ushorts, 8, "5123", true, 0.2, 1);
    check_quantized(ushorts, sizeof ushorts, 8, "5123", false, 13107, 65535);
}

static void test_quantized_normals_are_read_and_made_unit(void **state)
{
    (void)state;
    static const float positions[] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    static const int8_t normals[] = { 0, 127, 0, 0, 0, 0, -128, 0, 90, 0, 90, 0 };
    test_glb glb = { 0 };
    test_glb_add(&glb, positions, sizeof positions);
    test_glb_add_strided(&glb, normals, sizeof normals, 4);
    nook_scene *scene = test_glb_must_load(
        &glb, MESH_OF("'POSITION': 0, 'NORMAL': 1",
                      "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }, "
                      "{ 'bufferView': 1, 'componentType': 5120, 'count': 3, 'type': 'VEC3', 'normalized': true }"));
    assert_true(test_scene_corner(scene, 0)->normal[1] == 1.0f);
    assert_true(test_scene_corner(scene, 1)->normal[2] == -1.0f);
    assert_true(fabsf(test_scene_corner(scene, 2)->normal[0] - 0.70710678f) < 1e-6f);
    nook_scene_destroy(scene);
}

static void test_normals_of_plain_integers_are_refused(void **state)
{
    (void)state;
    static const int8_t normals[12] = { 0, 0, 127 };
    static const float positions[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    test_glb glb = { 0 };
    test_glb_add(&glb, positions, sizeof positions);
    test_glb_add_strided(&glb, normals, sizeof normals, 4);
    test_glb_must_refuse(&glb,
                         MESH_OF("'POSITION': 0, 'NORMAL': 1",
                                 "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }, "
                                 "{ 'bufferView': 1, 'componentType': 5120, 'count': 3, 'type': 'VEC3' }"),
                         "NORMAL has componentType 5120, not normalized");
}

static void test_interleaved_attributes_are_read_with_their_stride(void **state)
{
    (void)state;
    /* position, normal, one number of something else: a stride of 28 */
    static const float rows[3][7] = { { 0, 0, 5, 0, 0, 1, -9 }, { 1, 0, 5, 0, 0, 1, -9 }, { 0, 1, 5, 0, 0, 1, -9 } };
    test_glb glb = { 0 };
    test_glb_add_strided(&glb, rows, sizeof rows, 28);
    nook_scene *scene = test_glb_must_load(
        &glb, MESH_OF("'POSITION': 0, 'NORMAL': 1",
                      "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }, "
                      "{ 'bufferView': 0, 'byteOffset': 12, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }"));
    assert_position(test_scene_corner(scene, 0), 0, 0, 5);
    assert_position(test_scene_corner(scene, 2), 0, 1, 5);
    assert_true(test_scene_corner(scene, 1)->normal[2] == 1.0f);
    nook_scene_destroy(scene);
}

static void test_stride_smaller_than_an_element_is_refused(void **state)
{
    (void)state;
    test_glb glb = { 0 };
    test_glb_add_strided(&glb, test_quad_positions, sizeof test_quad_positions, 8);
    test_glb_must_refuse(&glb, MESH_OF("'POSITION': 0", TEST_GLB_QUAD_POSITIONS), "elements of 12 bytes");
}

#define SPARSE_QUAD(base, type)                                                                                      \
    MESH_OF("'POSITION': 0", "{ " base "'componentType': 5126, 'count': 3, 'type': 'VEC3', 'sparse': { 'count': 2, " \
                             "'indices': { 'bufferView': 1, 'componentType': " type " }, "                           \
                             "'values': { 'bufferView': 2 } } }")

static void fill_sparse(test_glb *glb, const void *indices, size_t size)
{
    static const float base[9] = { 7, 7, 7, 7, 7, 7, 0, 1, 4 }, values[6] = { 1, 2, 3, 4, 5, 6 };
    test_glb_add(glb, base, sizeof base);
    test_glb_add(glb, indices, size);
    test_glb_add(glb, values, sizeof values);
}

static void test_sparse_elements_replace_those_of_the_base(void **state)
{
    (void)state;
    static const uint8_t bytes[2] = { 0, 1 };
    static const uint16_t shorts[2] = { 0, 1 };
    static const uint32_t ints[2] = { 0, 1 };
    static const struct {
        const void *indices;
        size_t size;
        const char *members;
    } cases[] = { { bytes, sizeof bytes, SPARSE_QUAD("'bufferView': 0, ", "5121") },
                  { shorts, sizeof shorts, SPARSE_QUAD("'bufferView': 0, ", "5123") },
                  { ints, sizeof ints, SPARSE_QUAD("'bufferView': 0, ", "5125") } };
    for (size_t i = 0; i < NOOK_COUNT(cases); i++) {
        test_glb glb = { 0 };
        fill_sparse(&glb, cases[i].indices, cases[i].size);
        nook_scene *scene = test_glb_must_load(&glb, cases[i].members);
        assert_position(test_scene_corner(scene, 0), 1, 2, 3);
        assert_position(test_scene_corner(scene, 1), 4, 5, 6);
        assert_position(test_scene_corner(scene, 2), 0, 1, 4);
        nook_scene_destroy(scene);
    }
}

static void test_sparse_elements_without_a_base_stand_among_zeros(void **state)
{
    (void)state;
    static const uint8_t indices[2] = { 0, 2 };
    test_glb glb = { 0 };
    fill_sparse(&glb, indices, sizeof indices);
    nook_scene *scene = test_glb_must_load(&glb, SPARSE_QUAD("", "5121"));
    assert_position(test_scene_corner(scene, 0), 1, 2, 3);
    assert_position(test_scene_corner(scene, 1), 0, 0, 0);
    assert_position(test_scene_corner(scene, 2), 4, 5, 6);
    nook_scene_destroy(scene);
}

static void test_sparse_index_beyond_the_elements_is_refused(void **state)
{
    (void)state;
    static const uint8_t indices[2] = { 0, 3 };
    test_glb glb = { 0 };
    fill_sparse(&glb, indices, sizeof indices);
    test_glb_must_refuse(&glb, SPARSE_QUAD("", "5121"), "sparse replaces element 3 of 3");
    test_glb_must_refuse(&glb, SPARSE_QUAD("", "5126"), "expected an integer from 5121 to 5125");
    test_glb_must_refuse(&glb, SPARSE_QUAD("", "5122"), "sparse has indices of type 5122");
}

static void test_elements_past_their_view_are_refused(void **state)
{
    (void)state;
    test_glb glb = { 0 };
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    test_glb_must_refuse(
        &glb, MESH_OF("'POSITION': 0", "{ 'bufferView': 0, 'componentType': 5126, 'count': 5, 'type': 'VEC3' }"),
        "the elements of accessors[0] end at byte 60 of bufferViews[0], which has 48");
    test_glb_must_refuse(
        &glb,
        MESH_OF("'POSITION': 0",
                "{ 'bufferView': 0, 'byteOffset': 4, 'componentType': 5126, 'count': 4, 'type': 'VEC3' }"),
        "end at byte 52");
    test_glb_must_refuse(
        &glb,
        MESH_OF("'POSITION': 0",
                "{ 'bufferView': 0, 'byteOffset': 4294967295, 'componentType': 5126, 'count': 4294967295, "
                "'type': 'VEC3' }"),
        "end at byte 55834574835"); /* nothing wrapped */
}

static void test_numbers_that_are_no_counts_are_refused(void **state)
{
    (void)state;
    static const char *const counts[] = { "-1", "0", "4.0", "4e0", "'4'", "4611686018427387904", "null", "[ 4 ]" };
    for (size_t i = 0; i < NOOK_COUNT(counts); i++) {
        char members[1024];
        test_glb glb = { 0 };
        test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
        snprintf(members, sizeof members,
                 MESH_OF("'POSITION': 0", "{ 'bufferView': 0, 'componentType': 5126, 'count': %s, 'type': 'VEC3' }"),
                 counts[i]);
        test_glb_must_refuse(&glb, members, "accessors[0].count is ");
    }
}

static void test_attributes_of_other_lengths_and_shapes_are_refused(void **state)
{
    (void)state;
    test_glb glb = { 0 };
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    test_glb_must_refuse(&glb,
                         MESH_OF("'POSITION': 0, 'NORMAL': 1", TEST_GLB_QUAD_POSITIONS
                                 ", { 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }"),
                         "3 of NORMAL, 4 of POSITION");
    test_glb_must_refuse(
        &glb, MESH_OF("'POSITION': 0", "{ 'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC2' }"),
        "POSITION has 2 components; expected 3");
    test_glb_must_refuse(
        &glb, MESH_OF("'POSITION': 0", "{ 'bufferView': 0, 'componentType': 5125, 'count': 4, 'type': 'VEC3' }"),
        "POSITION has componentType 5125");
    test_glb_must_refuse(
        &glb, MESH_OF("'POSITION': 0", "{ 'bufferView': 0, 'componentType': 5126, 'count': 1, 'type': 'MAT3' }"),
        "POSITION has 0 components");
}

static void test_misaligned_positions_are_read_with_a_warning(void **state)
{
    (void)state;
    uint8_t bytes[40] = { 0 };
    static const float positions[9] = { 3, 0, 0, 1, 0, 0, 0, 1, 0 };
    test_glb glb = { 0 };
    memcpy(bytes + 2, positions, sizeof positions);
    test_glb_add(&glb, bytes, sizeof bytes);
    nook_scene *scene = test_glb_must_load(
        &glb, MESH_OF("'POSITION': 0",
                      "{ 'bufferView': 0, 'byteOffset': 2, 'componentType': 5126, 'count': 3, 'type': 'VEC3', "
                      "'min': [ 0, 0, 0 ], 'max': [ 3, 1, 0 ] }"));
    assert_position(test_scene_corner(scene, 0), 3, 0, 0);
    assert_int_equal(scene->warning_count, 1);
    assert_non_null(strstr(scene->warnings[0], "not aligned"));
    nook_scene_destroy(scene);
}

static void test_wrong_and_missing_bounds_are_warnings(void **state)
{
    (void)state;
    test_glb glb = { 0 };
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    nook_scene *scene = test_glb_must_load(&glb, MESH_OF("'POSITION': 0", TEST_GLB_QUAD_POSITIONS));
    assert_int_equal(scene->warning_count, 2); /* 4 vertices without indices are not whole triangles either */
    assert_non_null(strstr(scene->warnings[1], "POSITION has no min and max"));
    nook_scene_destroy(scene);
    scene = test_glb_must_load(&glb, MESH_OF("'POSITION': 0",
                                             "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3', "
                                             "'min': [ 0, 0, 0 ], 'max': [ 1, 2, 0 ] }"));
    assert_int_equal(scene->warning_count, 1);
    assert_non_null(strstr(scene->warnings[0], "min and max of POSITION are wrong"));
    assert_true(scene->bounds_max[1] == 1.0);
    nook_scene_destroy(scene);
}

static void test_positions_that_are_not_finite_are_refused(void **state)
{
    (void)state;
    float positions[9] = { 0, 0, 0, 1, 0, 0, 0, NAN, 0 };
    test_glb glb = { 0 };
    test_glb_add(&glb, positions, sizeof positions);
    test_glb_must_refuse(
        &glb, MESH_OF("'POSITION': 0", "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }"),
        "the position of vertex 2 is not finite");
}

static void test_colours_with_and_without_alpha_are_read(void **state)
{
    (void)state;
    static const float positions[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    static const uint8_t rgb[12] = { 255, 51, 0, 0 };
    static const uint16_t rgba[12] = { 0, 65535, 0, 13107 };
    test_glb glb = { 0 };
    test_glb_add(&glb, positions, sizeof positions);
    test_glb_add_strided(&glb, rgb, sizeof rgb, 4);
    test_glb_add(&glb, rgba, sizeof rgba);
    nook_scene *scene = test_glb_must_load(
        &glb, MESH_OF("'POSITION': 0, 'COLOR_0': 1",
                      "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }, "
                      "{ 'bufferView': 1, 'componentType': 5121, 'count': 3, 'type': 'VEC3', 'normalized': true }"));
    const float *colour = test_scene_corner(scene, 0)->colour;
    assert_true(colour[0] == 1.0f && fabsf(colour[1] - 0.2f) < 1e-6f && colour[2] == 0.0f && colour[3] == 1.0f);
    nook_scene_destroy(scene);
    scene = test_glb_must_load(&glb, MESH_OF("'POSITION': 0, 'COLOR_0': 1",
                                             "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }, "
                                             "{ 'bufferView': 2, 'componentType': 5123, 'count': 3, 'type': 'VEC4', "
                                             "'normalized': true }"));
    colour = test_scene_corner(scene, 0)->colour;
    assert_true(colour[1] == 1.0f && fabsf(colour[3] - 0.2f) < 1e-6f);
    nook_scene_destroy(scene);
}

static void test_accessor_without_data_costs_no_memory(void **state)
{
    (void)state;
    test_glb glb = { 0 };
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    test_glb_must_refuse(&glb,
                         MESH_OF("'POSITION': 0", "{ 'componentType': 5126, 'count': 4000000000, 'type': 'VEC3' }"),
                         "4000000000 elements and no data");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_indices_of_all_three_types_are_read),
        cmocka_unit_test(test_indices_that_are_not_unsigned_integers_are_refused),
        cmocka_unit_test(test_index_beyond_the_vertices_is_refused),
        cmocka_unit_test(test_quantized_positions_are_read_normalised_and_plain),
        cmocka_unit_test(test_quantized_normals_are_read_and_made_unit),
        cmocka_unit_test(test_normals_of_plain_integers_are_refused),
        cmocka_unit_test(test_interleaved_attributes_are_read_with_their_stride),
        cmocka_unit_test(test_stride_smaller_than_an_element_is_refused),
        cmocka_unit_test(test_sparse_elements_replace_those_of_the_base),
        cmocka_unit_test(test_sparse_elements_without_a_base_stand_among_zeros),
        cmocka_unit_test(test_sparse_index_beyond_the_elements_is_refused),
        cmocka_unit_test(test_elements_past_their_view_are_refused),
        cmocka_unit_test(test_numbers_that_are_no_counts_are_refused),
        cmocka_unit_test(test_attributes_of_other_lengths_and_shapes_are_refused),
        cmocka_unit_test(test_misaligned_positions_are_read_with_a_warning),
        cmocka_unit_test(test_wrong_and_missing_bounds_are_warnings),
        cmocka_unit_test(test_positions_that_are_not_finite_are_refused),
        cmocka_unit_test(test_colours_with_and_without_alpha_are_read),
        cmocka_unit_test(test_accessor_without_data_costs_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
