#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/support/log_capture.h"
#include "tests/support/test_glb.h"
#include <math.h>
#include <string.h>

static const uint32_t quad_indices[6] = { 0, 1, 2, 2, 1, 3 };

static void test_triangles_become_a_scene_of_one_node(void **state)
{
    (void)state;
    nook_scene *scene = NULL;
    assert_int_equal(nook_scene_from_triangles("quad", test_quad_positions, 4, quad_indices, 6, &scene), NOOK_OK);
    assert_int_equal(scene->triangle_count, 2);
    assert_int_equal(scene->node_count, 1);
    assert_int_equal(scene->nodes[0].mesh, 0);
    assert_false(scene->nodes[0].moving);
    assert_int_equal(scene->primitives[0].material, 0);
    assert_int_equal(scene->material_count, 1);
    assert_string_equal(scene->meshes[0].name, "quad");
    assert_int_equal(scene->warning_count, 0);
    assert_true(scene->bounds_min[0] == 0.0 && scene->bounds_max[1] == 1.0 && scene->bounds_max[2] == 0.0);
    for (uint32_t i = 0; i < 6; i++) {
        const nook_vertex *vertex = test_scene_corner(scene, i);
        assert_memory_equal(vertex->position, test_quad_positions + 3 * quad_indices[i], sizeof vertex->position);
        assert_true(vertex->normal[0] == 0.0f && vertex->normal[1] == 0.0f && vertex->normal[2] == 1.0f);
        assert_true(vertex->colour[3] == 1.0f);
    }
    nook_scene_destroy(scene);
}

static void test_tiny_and_degenerate_triangles_have_unit_normals(void **state)
{
    (void)state;
    static const float positions[12] = { 0, 0, 0, 1e-20f, 0, 0, 0, 0, 1e-20f, 5, 5, 5 };
    static const uint32_t indices[6] = { 0, 1, 2, 3, 3, 3 };
    nook_scene *scene = NULL;
    assert_int_equal(nook_scene_from_triangles("tiny", positions, 4, indices, 6, &scene), NOOK_OK);
    assert_true(test_scene_corner(scene, 0)->normal[1] == -1.0f);
    const float *n = test_scene_corner(scene, 3)->normal;
    assert_true(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] == 1.0f);
    nook_scene_destroy(scene);
}

static void refuse(const float *positions, uint32_t vertex_count, const uint32_t *indices, uint32_t index_count)
{
    nook_scene *scene = NULL;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_result result = nook_scene_from_triangles("wrong", positions, vertex_count, indices, index_count, &scene);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_ARG);
    assert_int_equal(log.errors, 1);
    assert_null(scene);
}

static void test_input_that_breaks_the_contract_is_refused(void **state)
{
    (void)state;
    float positions[12];
    memcpy(positions, test_quad_positions, sizeof positions);
    refuse(positions, 4, quad_indices, 5);
    refuse(positions, 3, quad_indices, 6);
    positions[4] = INFINITY;
    refuse(positions, 4, quad_indices, 6);
}

static void test_no_triangles_make_an_empty_scene_with_a_warning(void **state)
{
    (void)state;
    nook_scene *scene = NULL;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_scene_from_triangles("none", NULL, 0, NULL, 0, &scene), NOOK_OK);
    nook_log_capture_end();
    assert_int_equal(scene->triangle_count, 0);
    assert_int_equal(scene->warning_count, 1);
    assert_true(scene->bounds_min[0] > scene->bounds_max[0]);
    nook_scene_destroy(scene);
    nook_scene_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_triangles_become_a_scene_of_one_node),
        cmocka_unit_test(test_tiny_and_degenerate_triangles_have_unit_normals),
        cmocka_unit_test(test_input_that_breaks_the_contract_is_refused),
        cmocka_unit_test(test_no_triangles_make_an_empty_scene_with_a_warning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
