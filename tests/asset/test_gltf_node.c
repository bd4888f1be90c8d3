#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/support/test_glb.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** meshes[0]: the quad as a strip; its accessor. */
#define QUAD_MESH                                                                                           \
    "'meshes': [ { 'primitives': [ { 'attributes': { 'POSITION': 0 }, 'mode': 5 } ] } ], 'accessors': [ { " \
    "'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3', 'min': [ 0, 0, 0 ], 'max': [ 1, 1, 0 ] } ]"

static test_glb quad(void)
{
    test_glb glb = { 0 };
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    return glb;
}

/* @param nodes  "[ {...}, ... ]"; the scene has the node 0 */
static nook_scene *load_nodes(const char *nodes)
{
    char members[4096];
    test_glb glb = quad();
    snprintf(members, sizeof members, "'scenes': [ { 'nodes': [ 0 ] } ], 'nodes': %s, " QUAD_MESH, nodes);
    return test_glb_must_load(&glb, members);
}

static void refuse_nodes(const char *nodes, const char *reason)
{
    char members[4096];
    test_glb glb = quad();
    snprintf(members, sizeof members, "'scenes': [ { 'nodes': [ 0 ] } ], 'nodes': %s, " QUAD_MESH, nodes);
    test_glb_must_refuse(&glb, members, reason);
}

static void assert_point(const nook_matrix *world, double x, double y, double z, double wx, double wy, double wz)
{
    const double expected[3] = { wx, wy, wz };
    double point[3] = { x, y, z };
    nook_matrix_apply_point(world, point, point);
    for (int k = 0; k < 3; k++)
        if (!(fabs(point[k] - expected[k]) < 1e-9))
            fail_msg("%g %g %g becomes %g %g %g, expected %g %g %g", x, y, z, point[0], point[1], point[2], wx, wy, wz);
}

static void test_scale_rotation_and_translation_apply_in_this_order(void **state)
{
    (void)state;
    /* A quarter turn about z; the quaternion is not quite unit. */
    nook_scene *scene = load_nodes("[ { 'mesh': 0, 'scale': [ 2, 3, 4 ], 'rotation': [ 0, 0, 0.7071, 0.7071 ], "
                                   "'translation': [ 10, 20, 30 ] } ]");
    assert_point(&scene->nodes[0].world_from_local, 1, 0, 0, 10, 22, 30);
    assert_point(&scene->nodes[0].world_from_local, 0, 1, 0, 7, 20, 30);
    assert_point(&scene->nodes[0].world_from_local, 0, 0, 1, 10, 20, 34);
    assert_true(fabs(scene->bounds_min[0] - 7.0) < 1e-9 && fabs(scene->bounds_max[1] - 22.0) < 1e-9);
    nook_scene_destroy(scene);
}

static void test_matrix_is_read_column_by_column(void **state)
{
    (void)state;
    nook_scene *scene =
        load_nodes("[ { 'mesh': 0, 'matrix': [ 0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 20, 30, 1 ] } ]");
    assert_point(&scene->nodes[0].world_from_local, 1, 0, 0, 10, 22, 30);
    assert_point(&scene->nodes[0].world_from_local, 0, 1, 0, 7, 20, 30);
    assert_int_equal(scene->warning_count, 0);
    nook_scene_destroy(scene);
}

static void test_parents_stand_before_their_children_and_compose(void **state)
{
    (void)state;
    nook_scene *scene = load_nodes("[ { 'name': 'root', 'children': [ 3, 1 ], 'scale': [ 2, 2, 2 ] }, "
                                   "{ 'name': 'leaf', 'mesh': 0, 'translation': [ 0, 5, 0 ] }, { 'name': 'unused' }, "
                                   "{ 'name': 'arm', 'children': [ 4 ], 'translation': [ 1, 0, 0 ] }, "
                                   "{ 'name': 'hand', 'mesh': 0 } ]");
    static const char *const names[] = { "root", "arm", "hand", "leaf" };
    static const uint32_t parents[] = { NOOK_NONE, 0, 1, 0 };
    assert_int_equal(scene->node_count, 4);
    assert_int_equal(scene->file_node_count, 5);
    for (int i = 0; i < 4; i++) {
        assert_string_equal(scene->nodes[i].name, names[i]);
        assert_int_equal(scene->nodes[i].parent, parents[i]);
    }
    assert_point(&scene->nodes[2].world_from_local, 0, 0, 0, 2, 0, 0);
    assert_point(&scene->nodes[3].world_from_local, 1, 0, 0, 2, 10, 0);
    nook_scene_destroy(scene);
}

/* The front of a triangle is where it turns counter-clockwise; a mirroring node turns it over. */
static void test_mirrored_nodes_keep_normals_and_winding_consistent(void **state)
{
    (void)state;
    nook_scene *scene = load_nodes("[ { 'mesh': 0, 'scale': [ -1, 2, 3 ] } ]");
    const nook_matrix *world = &scene->nodes[0].world_from_local;
    double p[3][3], edge[2][3], normal[3] = { 0, 0, 0 };
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            p[i][k] = (double)test_scene_corner(scene, (uint32_t)i)->position[k];
        nook_matrix_apply_point(world, p[i], p[i]);
    }
    for (int k = 0; k < 3; k++) {
        edge[0][k] = p[1][k] - p[0][k];
        edge[1][k] = p[2][k] - p[0][k];
    }
    for (int k = 0; k < 3; k++)
        normal[k] = edge[0][(k + 1) % 3] * edge[1][(k + 2) % 3] - edge[0][(k + 2) % 3] * edge[1][(k + 1) % 3];
    assert_true(nook_matrix_determinant3(world) < 0.0);
    assert_true(normal[2] < 0.0); /* clockwise as seen from +z: the renderer swaps the front for such a node */
    assert_true(test_scene_corner(scene, 0)->normal[2] == 1.0f);
    assert_true(normal[2] * nook_matrix_determinant3(world) > 0.0);
    nook_scene_destroy(scene);
}

static void test_scale_of_zero_is_a_warning(void **state)
{
    (void)state;
    nook_scene *scene = load_nodes("[ { 'mesh': 0, 'scale': [ 1, 0, 1 ] } ]");
    assert_int_equal(scene->warning_count, 1);
    assert_non_null(strstr(scene->warnings[0], "scale of zero"));
    nook_scene_destroy(scene);
}

static void test_default_scene_is_the_named_one_else_the_first_else_all_roots(void **state)
{
    (void)state;
    static const char nodes[] =
        "'nodes': [ { 'mesh': 0 }, { 'mesh': 0, 'translation': [ 5, 0, 0 ], 'children': [ 2 ] }, "
        "{ 'mesh': 0 } ], " QUAD_MESH;
    static const struct {
        const char *scenes;
        uint32_t drawn;
    } cases[] = { { "'scene': 1, 'scenes': [ { 'nodes': [ 0 ] }, { 'nodes': [ 1 ] } ], ", 2 },
                  { "'scenes': [ { 'nodes': [ 0 ] }, { 'nodes': [ 1 ] } ], ", 1 },
                  { "", 3 } };
    for (size_t i = 0; i < NOOK_COUNT(cases); i++) {
        char members[4096];
        test_glb glb = quad();
        snprintf(members, sizeof members, "%s%s", cases[i].scenes, nodes);
        nook_scene *scene = test_glb_must_load(&glb, members);
        assert_int_equal(scene->node_count, cases[i].drawn);
        assert_int_equal(scene->triangle_count, 2 * cases[i].drawn);
        nook_scene_destroy(scene);
    }
}

static void test_bodies_are_named_by_extras_or_shared_meshes(void **state)
{
    (void)state;
    static const char shared[] = "[ { 'children': [ 1, 2 ] }, { 'mesh': 0 }, "
                                 "{ 'mesh': 0, 'extras': { 'nook_body': false } } ]";
    static const char inherited[] =
        "[ { 'children': [ 1, 3 ], 'extras': { 'nook_body': true } }, { 'children': [ 2 ] }, "
        "{ 'mesh': 0 }, { 'extras': { 'nook_body': false }, 'children': [ 4 ] }, { } ]";
    nook_scene *scene = load_nodes("[ { 'mesh': 0 } ]");
    assert_false(scene->nodes[0].moving);
    nook_scene_destroy(scene);
    scene = load_nodes(shared);
    assert_true(scene->nodes[1].moving);
    assert_false(scene->nodes[2].moving);
    nook_scene_destroy(scene);
    scene = load_nodes(inherited);
    assert_true(scene->nodes[2].moving);
    assert_false(scene->nodes[4].moving);
    nook_scene_destroy(scene);
    scene = load_nodes("[ { 'mesh': 0, 'extras': { 'nook_body': 'yes' } } ]"); /* not a boolean: says nothing */
    assert_false(scene->nodes[0].moving);
    nook_scene_destroy(scene);
}

static void test_hierarchies_that_are_not_trees_are_refused(void **state)
{
    (void)state;
    refuse_nodes("[ { 'children': [ 0 ] } ]", "nodes[0] is reached twice");
    refuse_nodes("[ { 'children': [ 1 ] }, { 'children': [ 2 ] }, { 'children': [ 0 ] } ]",
                 "nodes[0] is reached twice");
    refuse_nodes("[ { 'children': [ 1, 2 ] }, { 'children': [ 2 ] }, { } ]", "nodes[2] has two parents");
    refuse_nodes("[ { 'children': [ 1, 1 ] }, { } ]", "nodes[1] has two parents");
    refuse_nodes("[ { 'children': [ 7 ] } ]", "nodes[0].children[0] is 7; expected the index of one of 1 nodes");
    test_glb glb = quad();
    test_glb_must_refuse(&glb, "'scenes': [ { 'nodes': [ 0, 0 ] } ], 'nodes': [ { 'mesh': 0 } ], " QUAD_MESH,
                         "nodes[0] is reached twice");
}

static void test_transforms_that_are_not_finite_are_refused(void **state)
{
    (void)state;
    refuse_nodes("[ { 'scale': [ 1e200, 1, 1 ], 'children': [ 1 ] }, { 'scale': [ 1e200, 1, 1 ], 'mesh': 0 } ]",
                 "the transform of nodes[1] is not finite");
    refuse_nodes("[ { 'mesh': 0, 'translation': [ 1e30, 0, 0 ] } ]", "beyond 1e+18; scale it down");
    refuse_nodes("[ { 'mesh': 0, 'translation': [ 1e999, 0, 0 ] } ]", "nodes[0].translation[0] is 1e999");
    refuse_nodes("[ { 'mesh': 0, 'translation': [ 1, 0 ] } ]", "nodes[0].translation has 2 numbers; expected 3");
}

static void test_chain_of_100000_nodes_loads(void **state)
{
    (void)state;
    enum { DEPTH = 100000, ENTRY = 32 };
    char *text = malloc((size_t)DEPTH * ENTRY + 200);
    assert_non_null(text);
    size_t at = (size_t)sprintf(text, "{ 'asset': { 'version': '2.0' }, 'scenes': [ { 'nodes': [ 0 ] } ], 'nodes': [ ");
    for (int i = 1; i < DEPTH; i++)
        at += (size_t)sprintf(text + at, "{ 'children': [ %d ] },\n", i);
    sprintf(text + at, "{ 'name': 'last' } ] }");
    nook_scene *scene = test_scene_must_load(test_gltf_write("chain.gltf", text));
    free(text);
    assert_int_equal(scene->node_count, DEPTH);
    assert_string_equal(scene->nodes[DEPTH - 1].name, "last");
    assert_int_equal(scene->nodes[DEPTH - 1].parent, DEPTH - 2);
    nook_scene_destroy(scene);
}

static void test_cameras_and_lights_take_the_place_of_their_nodes(void **state)
{
    (void)state;
    nook_scene *scene = test_scene_must_load(test_gltf_write(
        "lights.gltf",
        "{ 'asset': { 'version': '2.0' }, 'scenes': [ { 'nodes': [ 0, 1, 2 ] } ], 'nodes': [ "
        "{ 'name': 'eye', 'camera': 0, 'translation': [ 1, 2, 3 ], 'scale': [ 5, -5, 5 ] }, "
        "{ 'extensions': { 'KHR_lights_punctual': { 'light': 1 } }, 'rotation': [ 0, 1, 0, 0 ] }, "
        "{ 'extensions': { 'KHR_lights_punctual': { 'light': 0 } }, 'translation': [ 0, 4, 0 ] } ], "
        "'cameras': [ { 'type': 'perspective', 'perspective': { 'yfov': 1, 'znear': 0.5, 'aspectRatio': 2 } } ], "
        "'extensions': { 'KHR_lights_punctual': { 'lights': [ { 'type': 'spot', 'color': [ 1, 0.5, 0 ], 'intensity': "
        "7, "
        "'range': 9, 'spot': { 'innerConeAngle': 0.2, 'outerConeAngle': 0.4 } }, { 'type': 'directional' } ] } } }"));
    assert_int_equal(scene->camera_count, 1);
    assert_string_equal(scene->cameras[0].name, "eye");
    assert_true(scene->cameras[0].perspective && scene->cameras[0].fov_y_radians == 1.0);
    assert_true(scene->cameras[0].z_near == 0.5);
    assert_point(&scene->cameras[0].world_from_view, 0, 0, -1, 1, 2, 2);
    assert_true(fabs(nook_matrix_determinant3(&scene->cameras[0].world_from_view) - 1.0) < 1e-12);
    assert_int_equal(scene->nodes[0].camera, 0);

    assert_int_equal(scene->light_count, 2);
    assert_int_equal(scene->lights[0].kind, NOOK_LIGHT_DIRECTIONAL);
    assert_true(scene->lights[0].colour[2] == 1.0f && scene->lights[0].intensity == 1.0f);
    assert_point(&scene->lights[0].world_from_light, 0, 0, -1, 0, 0, 1); /* turned about y */
    assert_int_equal(scene->nodes[2].light, 1);
    const nook_light *spot = &scene->lights[1];
    assert_int_equal(spot->kind, NOOK_LIGHT_SPOT);
    assert_true(spot->colour[1] == 0.5f && spot->intensity == 7.0f && spot->range == 9.0f);
    assert_true(spot->inner_cone == 0.2f && spot->outer_cone == 0.4f);
    assert_point(&spot->world_from_light, 0, 0, 0, 0, 4, 0);
    nook_scene_destroy(scene);
}

static void test_a_skin_without_joints_of_vertices_moves_nothing_and_says_so(void **state)
{
    (void)state;
    test_glb glb = quad();
    nook_scene *scene = test_glb_must_load(
        &glb,
        "'scenes': [ { 'nodes': [ 0, 1 ] } ], 'nodes': [ { 'mesh': 0, 'skin': 0, 'translation': [ 9, 9, 9 ] }, "
        "{ } ], 'skins': [ { 'joints': [ 1 ] } ], 'animations': [ { 'channels': [ ], 'samplers': [ ] } ], " QUAD_MESH);
    assert_int_equal(scene->skin_count, 1);
    assert_int_equal(scene->clip_count, 1);
    assert_int_equal(scene->deformable_count, 0);
    assert_int_equal(scene->nodes[0].skin, 0);
    assert_point(&scene->nodes[0].world_from_local, 0, 0, 0, 0, 0, 0);
    assert_int_equal(scene->warning_count, 1);
    assert_non_null(strstr(scene->warnings[0], "its mesh has no JOINTS_0"));
    nook_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scale_rotation_and_translation_apply_in_this_order),
        cmocka_unit_test(test_matrix_is_read_column_by_column),
        cmocka_unit_test(test_parents_stand_before_their_children_and_compose),
        cmocka_unit_test(test_mirrored_nodes_keep_normals_and_winding_consistent),
        cmocka_unit_test(test_scale_of_zero_is_a_warning),
        cmocka_unit_test(test_default_scene_is_the_named_one_else_the_first_else_all_roots),
        cmocka_unit_test(test_bodies_are_named_by_extras_or_shared_meshes),
        cmocka_unit_test(test_hierarchies_that_are_not_trees_are_refused),
        cmocka_unit_test(test_transforms_that_are_not_finite_are_refused),
        cmocka_unit_test(test_chain_of_100000_nodes_loads),
        cmocka_unit_test(test_cameras_and_lights_take_the_place_of_their_nodes),
        cmocka_unit_test(test_a_skin_without_joints_of_vertices_moves_nothing_and_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
