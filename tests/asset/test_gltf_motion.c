/* Skins, morph targets and animations as they are read: what becomes of them, and what is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/support/test_glb.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define ACCESSOR(view, type, count, kind) \
    "{ 'bufferView': " view ", 'componentType': " type ", 'count': " count ", 'type': '" kind "' }"
#define NODES "'scenes': [ { 'nodes': [ 0, 1 ] } ], 'nodes': [ { 'mesh': 0, 'skin': 0 }, { 'children': [ 2 ] }, { } ]"

static const uint8_t joints[4][4] = { { 0, 0, 0, 0 }, { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 1, 9, 0, 0 } };
static const float weights[4][4] = { { 1, 0, 0, 0 }, { 2, 0, 0, 0 }, { 1, 3, 0, 0 }, { 0.5f, 0, 0, 0 } };

/* A quad of two triangles that two joints move; accessors 0 positions, 1 joints, 2 weights. `more` goes to the primitive. */
static const char *skinned(test_glb *glb, const void *vertex_weights, const char *skin, const char *more)
{
    static char text[4096];
    *glb = (test_glb){ 0 };
    test_glb_add(glb, test_quad_positions, sizeof test_quad_positions);
    test_glb_add(glb, joints, sizeof joints);
    test_glb_add(glb, vertex_weights, sizeof weights);
    snprintf(text, sizeof text,
             NODES ", 'skins': [ %s ], 'meshes': [ { 'primitives': [ { 'attributes': { 'POSITION': 0, 'JOINTS_0': 1, "
                   "'WEIGHTS_0': 2 }, 'mode': 5 } ] } ], 'accessors': [ " TEST_GLB_QUAD_POSITIONS
                   ", " ACCESSOR("1", "5121", "4", "VEC4") ", " ACCESSOR("2", "5126", "4", "VEC4") " %s ]",
             skin, more);
    return text;
}

static void test_weights_become_fractions_and_stay_with_their_vertices(void **state)
{
    (void)state;
    test_glb glb;
    const char *text = skinned(&glb, weights, "{ 'joints': [ 1, 2 ] }", "");
    nook_scene *scene = test_glb_must_load(&glb, text);
    assert_int_equal(scene->deformable_count, 1);
    const nook_deformable *d = &scene->deformables[0];
    assert_int_equal(d->vertex_count, 6); /* the file has no normals: each triangle has its own */
    for (uint32_t v = 0; v < d->vertex_count; v++) {
        const nook_influence *influence = &scene->influences[d->first_influence + v];
        const float *p = scene->vertices[d->first_vertex + v].position;
        int source = (p[0] > 0.5f) + 2 * (p[1] > 0.5f);
        float sum = influence->weights[0] + influence->weights[1];
        assert_true(fabsf(sum - 1.0f) < 1e-6f && influence->weights[2] == 0.0f);
        assert_int_equal(influence->joints[0], joints[source][0]);
        assert_true(influence->weights[1] == (source == 2 ? 0.75f : 0.0f));
    }
    assert_true(scene->nodes[0].animated);
    nook_scene_destroy(scene);
}

static void test_vertices_without_weights_follow_their_first_joint(void **state)
{
    (void)state;
    static const float none[4][4] = { { 0 }, { NAN, 0, 0, 0 }, { -1, 0, 0, 0 }, { 1, 0, 0, 0 } };
    test_glb glb;
    const char *text = skinned(&glb, none, "{ 'joints': [ 1, 2 ] }", "");
    nook_scene *scene = test_glb_must_load(&glb, text);
    for (size_t i = 0; i < scene->influence_count; i++)
        assert_true(scene->influences[i].weights[0] == 1.0f && scene->influences[i].weights[1] == 0.0f);
    assert_int_equal(scene->warning_count, 2); /* POSITION without bounds, and this */
    assert_non_null(strstr(scene->warnings[1], "have no weights"));
    nook_scene_destroy(scene);
}

static void test_skins_that_contradict_themselves_are_refused(void **state)
{
    (void)state;
    static const float strong[4][4] = { { 1, 0, 0, 0 }, { 1, 0, 0, 0 }, { 1, 0, 0, 0 }, { 0.5f, 0.5f, 0, 0 } };
    float matrices[32] = { 0 };
    test_glb glb;
    test_glb_must_refuse(&glb, skinned(&glb, strong, "{ 'joints': [ 1, 2 ] }", ""), "names joint 9");
    test_glb_must_refuse(&glb, skinned(&glb, weights, "{ 'joints': [ ] }", ""), "no joints");
    const char *text = skinned(&glb, weights, "{ 'joints': [ 1, 2 ], 'inverseBindMatrices': 3 }",
                               ", " ACCESSOR("3", "5126", "1", "MAT4"));
    test_glb_add(&glb, matrices, sizeof matrices);
    test_glb_must_refuse(&glb, text, "1 inverseBindMatrices for 2 joints");
    text = skinned(&glb, weights, "{ 'joints': [ 1, 2 ], 'inverseBindMatrices': 3 }",
                   ", " ACCESSOR("3", "5126", "2", "MAT4"));
    matrices[17] = INFINITY;
    test_glb_add(&glb, matrices, sizeof matrices);
    test_glb_must_refuse(&glb, text, "that of joint 1 is not finite");
    text = skinned(&glb, weights, "{ 'joints': [ 1, 2 ], 'inverseBindMatrices': 3 }",
                   ", " ACCESSOR("3", "5126", "3", "MAT4"));
    test_glb_add(&glb, matrices, sizeof matrices);
    test_glb_must_refuse(&glb, text, "end at byte 192");
}

static void test_joints_outside_of_the_scene_leave_the_mesh_unposed(void **state)
{
    (void)state;
    test_glb glb;
    char text[4096];
    snprintf(text, sizeof text, "%s", skinned(&glb, weights, "{ 'joints': [ 1, 2 ] }", ""));
    char *nodes = strstr(text, "[ 0, 1 ]");
    memcpy(nodes, "[ 0    ]", 8);
    nook_scene *scene = test_glb_must_load(&glb, text);
    assert_int_equal(scene->deformable_count, 0);
    assert_int_equal(scene->nodes[0].skin, NOOK_NONE);
    assert_non_null(strstr(scene->warnings[scene->warning_count - 1], "not in the drawn scene"));
    nook_scene_destroy(scene);
}

/* ---- Morph targets ----------------------------------------------------------------------------------------------- */

#define MORPH(nodes, count, attributes)                                                                         \
    "'scenes': [ { 'nodes': [ 0, 1 ] } ], 'nodes': [ " nodes                                                    \
    " ], 'meshes': [ { 'weights': [ 0.25 ], 'primitives': [ {"                                                  \
    " 'attributes': { 'POSITION': 0" attributes                                                                 \
    " }, 'mode': 5, 'targets': [ { 'POSITION': 1 } ] } ] } ], 'accessors':"                                     \
    " [ " TEST_GLB_QUAD_POSITIONS ", { 'componentType': 5126, 'count': " count ", 'type': 'VEC3', 'sparse': { " \
    "'count': 1, 'indices': { 'bufferView': 1, 'componentType': 5121 }, 'values': { 'bufferView': 2 } } "       \
    "}, " TEST_GLB_QUAD_POSITIONS " ]"

static test_glb morphing(const float moved[3])
{
    static const uint8_t index[4] = { 3 };
    test_glb glb = { 0 };
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    test_glb_add(&glb, index, sizeof index);
    test_glb_add(&glb, moved, 3 * sizeof *moved);
    return glb;
}

static void test_sparse_targets_move_only_what_they_name(void **state)
{
    (void)state;
    const float moved[3] = { 5, 6, 7 };
    test_glb glb = morphing(moved);
    nook_scene *scene = test_glb_must_load(&glb, MORPH("{ 'mesh': 0 }, { }", "4", ""));
    const nook_deformable *d = &scene->deformables[0];
    assert_int_equal(d->target_count, 1);
    assert_true(scene->morph_weights[d->first_weight] == 0.25);
    int count = 0;
    for (uint32_t v = 0; v < d->vertex_count; v++) {
        const float *p = scene->vertices[d->first_vertex + v].position;
        bool named = p[0] == 1.0f && p[1] == 1.0f;
        assert_true(scene->morph_deltas[d->first_delta + v].position[1] == (named ? 6.0f : 0.0f));
        count += named;
    }
    assert_int_equal(count, 1);
    assert_true(scene->target_boxes[d->first_target_box].max[2] == 7.0f);
    nook_scene_destroy(scene);
}

static void test_every_node_that_deforms_a_mesh_has_its_own(void **state)
{
    (void)state;
    const float moved[3] = { 5, 6, 7 };
    test_glb glb = morphing(moved);
    nook_scene *scene =
        test_glb_must_load(&glb, MORPH("{ 'mesh': 0, 'weights': [ 1 ] }, { 'mesh': 0 }", "4", ", 'NORMAL': 2"));
    assert_int_equal(scene->deformable_count, 2);
    const nook_deformable *a = &scene->deformables[0], *b = &scene->deformables[1];
    assert_int_not_equal(a->mesh, b->mesh);
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_true(a->first_vertex + a->vertex_count <= b->first_vertex ||
                b->first_vertex + b->vertex_count <= a->first_vertex);
    assert_true(scene->morph_weights[a->first_weight] == 1.0 && scene->morph_weights[b->first_weight] == 0.25);
    assert_memory_equal(&scene->morph_deltas[a->first_delta], &scene->morph_deltas[b->first_delta],
                        a->vertex_count * sizeof(nook_morph_delta));
    nook_scene_destroy(scene);
}

static void test_targets_that_do_not_fit_are_refused(void **state)
{
    (void)state;
    const float moved[3] = { 5, 6, 7 }, broken[3] = { 0, NAN, 0 };
    test_glb glb = morphing(moved);
    test_glb_must_refuse(&glb, MORPH("{ 'mesh': 0 }, { }", "5", ""), "5 of POSITION of a morph target, 4 of POSITION");
    glb = morphing(broken);
    test_glb_must_refuse(&glb, MORPH("{ 'mesh': 0 }, { }", "4", ""), "adds to vertex 3 is not finite");
}

/* ---- Animations -------------------------------------------------------------------------------------------------- */

/* One channel over the second node. accessors: 0 positions, 1 times, 2 values. */
static const char *animated(test_glb *glb, const float times[2], const float *values, size_t value_size,
                            const char *channel, const char *output)
{
    static char text[4096];
    *glb = (test_glb){ 0 };
    test_glb_add(glb, test_quad_positions, sizeof test_quad_positions);
    test_glb_add(glb, times, 2 * sizeof *times);
    test_glb_add(glb, values, value_size);
    snprintf(text, sizeof text,
             "'scenes': [ { 'nodes': [ 0, 1 ] } ], 'nodes': [ { 'mesh': 0 }, { 'children': [ 2 ] }, { } ], "
             "'animations': [ { 'name': 'walk', %s } ], 'meshes': [ { 'primitives': [ { 'attributes': { 'POSITION': 0 "
             "}, 'mode': 5 } ] } ], 'accessors': [ " TEST_GLB_QUAD_POSITIONS
             ", " ACCESSOR("1", "5126", "2", "SCALAR") ", %s ]",
             channel, output);
    return text;
}

#define CHANNEL(sampler, node, path, interpolation)                                                                    \
    "'channels': [ { 'sampler': " sampler ", 'target': { 'node': " node ", 'path': '" path "' } } ], 'samplers': [ { " \
    "'input': 1, 'output': 2, 'interpolation': '" interpolation "' } ]"
#define VEC3_2 ACCESSOR("2", "5126", "2", "VEC3")
#define VEC4_2 ACCESSOR("2", "5126", "2", "VEC4")

static void test_a_channel_becomes_a_track_of_its_clip(void **state)
{
    (void)state;
    const float times[2] = { 0.5f, 2.0f }, values[8] = { 0, 0, 0, 2, 0, 3, 0, 4 };
    test_glb glb;
    nook_scene *scene = test_glb_must_load(
        &glb, animated(&glb, times, values, sizeof values, CHANNEL("0", "1", "rotation", "LINEAR"), VEC4_2));
    assert_int_equal(scene->clip_count, 1);
    assert_string_equal(scene->clips[0].name, "walk");
    assert_true(scene->clips[0].duration == 2.0);
    const nook_track *track = &scene->tracks[scene->clips[0].first_track];
    assert_int_equal(track->node, 1);
    assert_int_equal(track->key_count, 2);
    const float *value = scene->track_values + track->first_value;
    assert_true(value[3] == 1.0f && fabsf(value[5] - 0.6f) < 1e-6f && fabsf(value[7] - 0.8f) < 1e-6f);
    assert_true(!scene->nodes[0].animated && scene->nodes[1].animated && scene->nodes[2].animated);
    nook_scene_destroy(scene);
}

static void refuse(const float times[2], const float *values, size_t size, const char *channel, const char *output,
                   const char *reason)
{
    test_glb glb;
    const char *text = animated(&glb, times, values, size, channel, output);
    test_glb_must_refuse(&glb, text, reason);
}

static void test_broken_animations_are_refused(void **state)
{
    (void)state;
    const float times[2] = { 0, 1 }, falling[2] = { 1, 0 }, early[2] = { -1, 0 }, never[2] = { 0, NAN };
    const float values[8] = { 0, 0, 0, 1, 0, 0, 0, 1 }, zero[8] = { 0 }, broken[8] = { 0, INFINITY };
    size_t three = 6 * sizeof(float), four = 8 * sizeof(float);
    refuse(falling, values, three, CHANNEL("0", "1", "translation", "STEP"), VEC3_2, "its times fall");
    refuse(early, values, three, CHANNEL("0", "1", "translation", "STEP"), VEC3_2, "negative or not finite");
    refuse(never, values, three, CHANNEL("0", "1", "translation", "STEP"), VEC3_2, "negative or not finite");
    refuse(times, broken, three, CHANNEL("0", "1", "scale", "STEP"), VEC3_2, "a value is not finite");
    refuse(times, zero, four, CHANNEL("0", "1", "rotation", "LINEAR"), VEC4_2, "a rotation has no length");
    refuse(times, values, three, CHANNEL("0", "1", "rotation", "LINEAR"), VEC3_2, "of the type that its path");
    refuse(times, values, three, CHANNEL("0", "1", "scale", "CUBICSPLINE"), VEC3_2, "2 values for 2 times; expected 6");
    refuse(times, values, three, CHANNEL("0", "1", "scale", "SMOOTH"), VEC3_2, "expected LINEAR");
    refuse(times, values, three, CHANNEL("1", "1", "scale", "STEP"), VEC3_2, "sampler is 1; there are 1");
    refuse(times, values, three, CHANNEL("0", "7", "scale", "STEP"), VEC3_2, "one of 3 nodes");
}

static void test_what_nothing_can_follow_is_left_out_with_a_warning(void **state)
{
    (void)state;
    const float times[2] = { 0, 1 }, values[2] = { 0, 1 };
    test_glb glb;
    const char *one = ACCESSOR("2", "5126", "2", "SCALAR");
    nook_scene *scene = test_glb_must_load(
        &glb, animated(&glb, times, values, sizeof values, CHANNEL("0", "1", "weights", "LINEAR"), one));
    assert_int_equal(scene->track_count, 0);
    assert_non_null(strstr(scene->warnings[scene->warning_count - 1], "no morph targets"));
    nook_scene_destroy(scene);
    scene = test_glb_must_load(
        &glb, animated(&glb, times, values, sizeof values, CHANNEL("0", "1", "pointer", "LINEAR"), one));
    assert_int_equal(scene->track_count, 0);
    assert_non_null(strstr(scene->warnings[scene->warning_count - 1], "'pointer', which is not known"));
    nook_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_weights_become_fractions_and_stay_with_their_vertices),
        cmocka_unit_test(test_vertices_without_weights_follow_their_first_joint),
        cmocka_unit_test(test_skins_that_contradict_themselves_are_refused),
        cmocka_unit_test(test_joints_outside_of_the_scene_leave_the_mesh_unposed),
        cmocka_unit_test(test_sparse_targets_move_only_what_they_name),
        cmocka_unit_test(test_every_node_that_deforms_a_mesh_has_its_own),
        cmocka_unit_test(test_targets_that_do_not_fit_are_refused),
        cmocka_unit_test(test_a_channel_becomes_a_track_of_its_clip),
        cmocka_unit_test(test_broken_animations_are_refused),
        cmocka_unit_test(test_what_nothing_can_follow_is_left_out_with_a_warning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
