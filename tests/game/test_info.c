#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "engine/asset/json_tree.h"
#include "engine/core/file.h"
#include "game/commands/commands.h"
#include "modules/bake/voxelize.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include "tests/support/test_glb.h"
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/** What the command printed on standard output, and what it logged. */
typedef struct run {
    int exit_code;
    char output[8192];
    nook_log_capture log;
} run;

static run run_info(const char *first, const char *second)
{
    static run r;
    char path[1024], *argv[] = { "info", (char *)first, (char *)second, NULL };
    nook_file printed;
    nook_scratch_path(path, sizeof path, "printed.txt");
    fflush(stdout);
    int terminal = dup(STDOUT_FILENO), file = open(path, O_CREAT | O_TRUNC | O_WRONLY, 0600);
    assert_true(terminal >= 0 && file >= 0);
    dup2(file, STDOUT_FILENO);
    nook_log_capture_begin(&r.log);
    r.exit_code = nook_command_info(&(nook_app){ .root = "." }, second ? 3 : first ? 2 : 1, argv);
    nook_log_capture_end();
    fflush(stdout);
    dup2(terminal, STDOUT_FILENO);
    close(terminal);
    close(file);
    assert_int_equal(nook_file_read(path, &printed), NOOK_OK);
    snprintf(r.output, sizeof r.output, "%s", (const char *)printed.bytes);
    nook_file_free(&printed);
    return r;
}

/* Two nodes with one mesh of two triangles, and one empty node of another scene. */
static const char *write_scene(void)
{
    test_glb glb = { 0 };
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    return test_glb_write(
        &glb,
        "'scenes': [ { 'nodes': [ 0, 1 ] } ], 'nodes': [ { 'mesh': 0 }, { 'mesh': 0, 'translation': [ 2, 0, 0 ] }, "
        "{ } ], 'materials': [ { } ], 'meshes': [ { 'primitives': [ { 'attributes': { 'POSITION': 0 }, 'mode': 5 "
        "} ] } ], 'accessors': [ " TEST_GLB_QUAD_POSITIONS " ]");
}

static uint64_t integer_of(const nook_json_tree *tree, const char *name)
{
    uint64_t number = UINT64_MAX;
    uint32_t value = nook_json_tree_find(tree, 0, name);
    if (value == NOOK_JSON_NONE || !nook_json_tree_integer(tree, value, &number))
        fail_msg("%s is missing or no integer", name);
    return number;
}

static void test_a_scene_is_described_as_json(void **state)
{
    (void)state;
    nook_json_tree tree = { 0 };
    run r = run_info("--json", write_scene());
    assert_int_equal(r.exit_code, NOOK_EXIT_OK);
    assert_int_equal(nook_json_tree_read("output", r.output, strlen(r.output), 16, &tree), NOOK_OK);
    static const struct {
        const char *name;
        uint64_t value;
    } expected[] = { { "triangles", 4 }, { "vertices", 6 },   { "nodes", 3 },     { "nodes_drawn", 2 },
                     { "meshes", 1 },    { "primitives", 1 }, { "materials", 1 }, { "images", 0 },
                     { "skins", 0 },     { "animations", 0 }, { "bodies", 2 } };
    for (size_t i = 0; i < NOOK_COUNT(expected); i++)
        assert_int_equal(integer_of(&tree, expected[i].name), expected[i].value);
    uint32_t corner = nook_json_tree_find(&tree, 0, "bounds_max");
    assert_true(nook_json_tree_number(&tree, corner + 1) == 3.0);
    assert_int_equal(tree.values[nook_json_tree_find(&tree, 0, "warnings")].count,
                     1); /* POSITION without min and max */
    nook_json_tree_free(&tree);
}

static void test_a_scene_is_described_as_text(void **state)
{
    (void)state;
    run r = run_info(write_scene(), NULL);
    assert_int_equal(r.exit_code, NOOK_EXIT_OK);
    assert_non_null(strstr(r.output, "triangles    4\n"));
    assert_non_null(strstr(r.output, "bounds_max   3 1 0\n"));
    assert_non_null(strstr(r.output, "warnings     1\n"));
}

static const char *write_cameras_and_lights(void)
{
    return test_gltf_write(
        "seen.gltf",
        "{ 'asset': { 'version': '2.0' }, 'extensionsUsed': [ 'KHR_lights_punctual' ], 'extensions': { "
        "'KHR_lights_punctual': { 'lights': [ { 'type': 'point' }, { 'type': 'directional' } ] } }, 'cameras': [ { "
        "'type': "
        "'perspective', 'perspective': { 'yfov': 1, 'znear': 0.1 } }, { 'type': 'orthographic', 'orthographic': { "
        "'xmag': "
        "1, 'ymag': 1, 'znear': 0.1, 'zfar': 9 } } ], 'scenes': [ { 'nodes': [ 0, 1, 2, 3, 4 ] } ], 'nodes': [ { "
        "'name': "
        "'door', 'camera': 0 }, { 'name': 'plan', 'camera': 1 }, { 'extensions': { 'KHR_lights_punctual': { 'light': 0 "
        "} } "
        "}, { 'extensions': { 'KHR_lights_punctual': { 'light': 0 } } }, { 'extensions': { 'KHR_lights_punctual': { "
        "'light': 1 } } } ] }");
}

static void test_cameras_are_named_and_lights_counted_by_kind(void **state)
{
    (void)state;
    nook_json_tree tree = { 0 };
    run r = run_info(write_cameras_and_lights(), NULL);
    assert_int_equal(r.exit_code, NOOK_EXIT_OK);
    assert_non_null(strstr(r.output, "light_kinds  1 directional, 2 point, 0 spot\n"));
    assert_non_null(strstr(r.output, "camera       door\ncamera       plan (orthographic"));
    r = run_info("--json", write_cameras_and_lights());
    assert_int_equal(nook_json_tree_read("output", r.output, strlen(r.output), 16, &tree), NOOK_OK);
    uint32_t names = nook_json_tree_find(&tree, 0, "camera_names");
    assert_int_equal(tree.values[names].count, 2);
    assert_true(nook_json_tree_string_is(&tree, names + 1, "door"));
    uint64_t points = 0;
    uint32_t kinds = nook_json_tree_find(&tree, 0, "light_kinds");
    assert_true(nook_json_tree_integer(&tree, nook_json_tree_find(&tree, kinds, "point"), &points));
    assert_int_equal(points, 2);
    nook_json_tree_free(&tree);
}

static void test_an_empty_scene_has_no_box(void **state)
{
    (void)state;
    nook_json_tree tree = { 0 };
    const char *path = test_gltf_write("nothing.gltf", "{ 'asset': { 'version': '2.0' } }");
    run r = run_info("--json", path);
    assert_int_equal(r.exit_code, NOOK_EXIT_OK);
    assert_int_equal(nook_json_tree_read("output", r.output, strlen(r.output), 16, &tree), NOOK_OK);
    assert_int_equal(tree.values[nook_json_tree_find(&tree, 0, "bounds_min")].kind, NOOK_JSON_NULL);
    nook_json_tree_free(&tree);
}

static void test_a_baked_volume_is_described(void **state)
{
    (void)state;
    uint8_t voxels[3 * 3 * 4] = { [13] = 255 }; /* the middle of its second slice */
    nook_volume volume = {
        .info = { .width = 3, .height = 3, .depth = 4, .voxel_size = 0.5, .origin = { 1, 2, 3 }, .occupied = 1 },
        .voxels = voxels
    };
    void *bytes = NULL;
    size_t size = 0;
    nook_json_tree tree = { 0 };
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_OK);
    run r = run_info("--json", test_bytes_write("made.nkv", bytes, size));
    assert_int_equal(r.exit_code, NOOK_EXIT_OK);
    assert_int_equal(nook_json_tree_read("output", r.output, strlen(r.output), 16, &tree), NOOK_OK);
    assert_true(nook_json_tree_string_is(&tree, nook_json_tree_find(&tree, 0, "kind"), "binary volume"));
    assert_int_equal(integer_of(&tree, "bytes"), 36);
    assert_int_equal(integer_of(&tree, "file_bytes"), size);
    assert_int_equal(integer_of(&tree, "occupied"), 1);
    nook_json_tree_free(&tree);
    r = run_info(test_bytes_write("cut.nkv", bytes, size - 1), NULL);
    assert_int_equal(r.exit_code, NOOK_EXIT_FAILED);
    assert_int_equal(r.log.errors, 1);
    assert_string_equal(r.output, "");
    free(bytes);
}

static void test_a_baked_volume_is_named_by_its_kind(void **state)
{
    (void)state;
    const uint32_t kinds[] = { NOOK_VOLUME_DENSITY, NOOK_VOLUME_SURFEL };
    const char *const expected[] = { "kind         density volume\n", "kind         surfel volume\n" };
    /* A byte a voxel; 16 for the brick and 8 for each of three surfels. */
    const char *const memory[] = { "bytes        48\n", "bytes        40\n" };
    for (int i = 0; i < 2; i++) {
        const float corners[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
        const uint32_t indices[3] = { 0, 1, 2 };
        const nook_triangles triangles = { corners, 0, 3, indices, 3 };
        const nook_voxelize_desc desc = { .resolution = 2, .threads = 1, .kind = kinds[i] };
        nook_volume volume;
        void *bytes = NULL;
        size_t size = 0;
        assert_int_equal(nook_voxelize(&triangles, &desc, &volume), NOOK_OK);
        assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_OK);
        run r = run_info(test_bytes_write("made.nkv", bytes, size), NULL);
        assert_int_equal(r.exit_code, NOOK_EXIT_OK);
        if (!strstr(r.output, expected[i]) || !strstr(r.output, memory[i]))
            fail_msg("not in: %s", r.output);
        nook_volume_free(&volume);
        free(bytes);
    }
}

static void test_a_scalar_volume_is_described(void **state)
{
    (void)state;
    static const char nrrd[] = "NRRD0001\ntype: uint8\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n\n\x07\x09";
    nook_json_tree tree = { 0 };
    run r = run_info("--json", test_bytes_write("made.nrrd", nrrd, sizeof nrrd - 1));
    assert_int_equal(r.exit_code, NOOK_EXIT_OK);
    assert_int_equal(nook_json_tree_read("output", r.output, strlen(r.output), 16, &tree), NOOK_OK);
    assert_int_equal(integer_of(&tree, "bytes"), 2);
    assert_int_equal(integer_of(&tree, "minimum"), 7);
    assert_int_equal(integer_of(&tree, "maximum"), 9);
    assert_true(nook_json_tree_string_is(&tree, nook_json_tree_find(&tree, 0, "type"), "uint8"));
    nook_json_tree_free(&tree);
}

static void test_a_refused_file_is_one_line_and_exit_code_1(void **state)
{
    (void)state;
    run r = run_info(test_gltf_write("broken.gltf", "{ 'asset': 5 }"), NULL);
    assert_int_equal(r.exit_code, NOOK_EXIT_FAILED);
    assert_int_equal(r.log.errors, 1);
    assert_non_null(strstr(r.log.text, "asset is 5; expected an object"));
    assert_string_equal(r.output, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_scene_is_described_as_json),
        cmocka_unit_test(test_a_scene_is_described_as_text),
        cmocka_unit_test(test_cameras_are_named_and_lights_counted_by_kind),
        cmocka_unit_test(test_an_empty_scene_has_no_box),
        cmocka_unit_test(test_a_baked_volume_is_described),
        cmocka_unit_test(test_a_baked_volume_is_named_by_its_kind),
        cmocka_unit_test(test_a_scalar_volume_is_described),
        cmocka_unit_test(test_a_refused_file_is_one_line_and_exit_code_1),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
