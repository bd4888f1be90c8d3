/* Scalar fields that nodes of a glTF file name. */
#include "engine/asset/scalar_medium.h"
#include "engine/asset/scene_join.h"
#include "tests/support/test_glb.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#define SCENE(density)                                                                                       \
    "{ 'asset': { 'version': '2.0' }, 'scenes': [ { 'nodes': [ 0 ] } ], 'nodes': [ { 'name': 'room', "       \
    "'translation': [ 1, 2, 3 ], 'children': [ 1 ] }, { 'name': 'cloud', 'scale': [ 2, 2, 2 ], 'extras': { " \
    "'nook_density': " density " } }, { 'extras': { 'nook_density': 5 } } ] }"
#define GOOD "{ 'file': 'cloud.nrrd', 'window': [ 0, 100 ], 'length': 0.25 }"

static void write_field(const char *header)
{
    char bytes[512];
    const unsigned char samples[6] = { 0, 50, 100, 200, 25, 75 };
    int size = snprintf(bytes, sizeof bytes, "%s", header);
    memcpy(bytes + size, samples, sizeof samples);
    test_bytes_write("cloud.nrrd", bytes, (size_t)size + sizeof samples);
}

static void write_good_field(void)
{
    write_field("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 2 1\nspacings: 0.5 1 2\nencoding: raw\n\n");
}

static void assert_has_cloud(const nook_scene *scene)
{
    assert_int_equal(scene->density_count, 1); /* the third node is not of the scene */
    const nook_scene_density *cloud = &scene->densities[0];
    const nook_scalar_transfer transfer = { 0.0, 100.0, 0.25 };
    assert_string_equal(cloud->name, "cloud");
    assert_int_equal(cloud->medium.size[0], 3);
    assert_int_equal(cloud->medium.size[1], 2);
    assert_true(cloud->medium.spacing[0] == 0.5 && cloud->medium.spacing[2] == 2.0);
    assert_true(cloud->medium.extinction[1] == (float)nook_scalar_extinction(&transfer, 50.0));
    assert_true(cloud->medium.extinction[3] == (float)nook_scalar_extinction(&transfer, 200.0));
    assert_true(cloud->world_from_local.m[0] == 2.0 && cloud->world_from_local.m[14] == 3.0);
    assert_non_null(strstr(scene->files[1], "cloud.nrrd")); /* a change of it is seen */
}

static void test_a_node_names_a_field_its_window_and_its_length(void **state)
{
    (void)state;
    write_good_field();
    nook_scene *scene = test_scene_must_load(test_gltf_write("density.gltf", SCENE(GOOD)));
    assert_has_cloud(scene);
    nook_scene_destroy(scene);
}

/* Files of a scene are watched: when one of them is saved it is read again. */
static void test_the_samples_beside_a_detached_header_are_files_of_the_scene(void **state)
{
    static const char header[] = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 2 2\nencoding: raw\n"
                                 "data file: slice%d.raw 1 2 1 2\n";
    (void)state;
    test_bytes_write("cloud.nrrd", header, sizeof header - 1);
    test_bytes_write("slice1.raw", "abcdef", 6);
    test_bytes_write("slice2.raw", "ghijkl", 6);
    nook_scene *scene = test_scene_must_load(test_gltf_write("density.gltf", SCENE(GOOD)));
    assert_int_equal(scene->file_count, 4);
    assert_non_null(strstr(scene->files[1], "cloud.nrrd"));
    assert_non_null(strstr(scene->files[2], "slice1.raw"));
    assert_non_null(strstr(scene->files[3], "slice2.raw"));
    nook_scene_destroy(scene);
}

static void test_a_field_that_its_node_flattens_is_left_out_with_a_warning(void **state)
{
    (void)state;
    write_good_field();
    nook_scene *scene = test_scene_must_load(test_gltf_write(
        "flat.gltf",
        "{ 'asset': { 'version': '2.0' }, 'scenes': [ { 'nodes': [ 0 ] } ], 'nodes': [ { 'scale': [ 2, 0, 2 ], "
        "'extras': { 'nook_density': " GOOD " } } ] }"));
    assert_non_null(strstr(scene->warnings[0], "nodes[0].extras.nook_density is flattened to nothing"));
    assert_int_equal(scene->density_count, 0);
    nook_scene_destroy(scene);
}

static void test_a_joined_scene_has_the_fields_of_its_parts(void **state)
{
    (void)state;
    write_good_field();
    nook_scene *part = test_scene_must_load(test_gltf_write("density.gltf", SCENE(GOOD))), *joined;
    const nook_scene_part parts[] = { { part, true } };
    assert_int_equal(nook_scene_join("all", parts, 1, NULL, 0, &joined), NOOK_OK);
    nook_scene_destroy(part);
    assert_int_equal(joined->density_count, 1);
    assert_string_equal(joined->densities[0].name, "cloud");
    assert_true(joined->densities[0].medium.extinction[1] > 0.0f);
    nook_scene_destroy(joined);
}

static void refuse(const char *text, nook_result code, const char *reason)
{
    test_scene_must_refuse(test_gltf_write("density.gltf", text), code, reason);
}

static void test_what_a_density_does_not_say_right_is_refused_with_its_name(void **state)
{
    (void)state;
    write_good_field();
    refuse(SCENE("7"), NOOK_E_FORMAT, "nodes[1].extras.nook_density: give an object");
    refuse(SCENE("{ 'window': [ 0, 1 ], 'length': 1 }"), NOOK_E_FORMAT, "nook_density.file");
    refuse(SCENE("{ 'file': 'cloud.nrrd', 'length': 1 }"), NOOK_E_FORMAT, "nook_density.window");
    refuse(SCENE("{ 'file': 'cloud.nrrd', 'window': [ 0 ], 'length': 1 }"), NOOK_E_FORMAT, "nook_density.window");
    refuse(SCENE("{ 'file': 'cloud.nrrd', 'window': [ 0, 'x' ], 'length': 1 }"), NOOK_E_FORMAT, "nook_density.window");
    refuse(SCENE("{ 'file': 'cloud.nrrd', 'window': [ 0, 1 ] }"), NOOK_E_FORMAT, "nook_density.length");
    refuse(SCENE("{ 'file': 'cloud.nrrd', 'window': [ 0, 1 ], 'length': 0 }"), NOOK_E_RANGE, "its length is 0");
}

static void test_a_window_upside_down_is_refused(void **state)
{
    (void)state;
    write_good_field();
    refuse(SCENE("{ 'file': 'cloud.nrrd', 'window': [ 100, 0 ], 'length': 1 }"), NOOK_E_RANGE, "the lower one first");
}

static void test_files_outside_of_the_scenes_folder_are_not_read(void **state)
{
    (void)state;
    refuse(SCENE("{ 'file': '../cloud.nrrd', 'window': [ 0, 1 ], 'length': 1 }"), NOOK_E_FORMAT, "climbs out");
    refuse(SCENE("{ 'file': '/dev/zero', 'window': [ 0, 1 ], 'length': 1 }"), NOOK_E_FORMAT, "absolute");
    refuse(SCENE("{ 'file': 'data:,x', 'window': [ 0, 1 ], 'length': 1 }"), NOOK_E_FORMAT, "data uri");
    refuse(SCENE("{ 'file': 'missing.nrrd', 'window': [ 0, 1 ], 'length': 1 }"), NOOK_E_NOT_FOUND, "missing.nrrd");
}

static void test_a_broken_field_breaks_its_scene(void **state)
{
    (void)state;
    write_field("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 3 3\nencoding: raw\n\n"); /* 27 samples, 6 are there */
    refuse(SCENE(GOOD), NOOK_E_FORMAT, "cloud.nrrd");
    write_field("NRRD0004\ntype: uchar\ndimension: 4\nsizes: 3 2 1 1\nencoding: raw\n\n"); /* vectors */
    refuse(SCENE(GOOD), NOOK_E_FORMAT, "3 numbers a sample");
    test_bytes_write("cloud.nrrd", "", 0);
    refuse(SCENE(GOOD), NOOK_E_FORMAT, "cloud.nrrd");
}

/* Once, and kept with the scene: ./nook info counts them. */
static void assert_warns(const char *density, const char *text)
{
    nook_scene *scene = test_scene_must_load(test_gltf_write("density.gltf", density));
    assert_int_equal(scene->warning_count, 2); /* and that there is nothing to draw */
    assert_non_null(strstr(scene->warnings[0], text));
    assert_non_null(strstr(scene->warnings[0], "density.gltf: nodes[1].extras.nook_density"));
    nook_scene_destroy(scene);
}

static void test_keys_that_are_not_known_are_warned_of_with_the_nearest_that_is(void **state)
{
    (void)state;
    write_good_field();
    assert_warns(SCENE("{ 'file': 'cloud.nrrd', 'window': [ 0, 100 ], 'length': 1, 'windwo': { 'length': 2 } }"),
                 "nook_density.windwo is not known and does nothing; did you mean 'window'?");
    assert_warns(SCENE("{ 'unit': 3, 'file': 'cloud.nrrd', 'window': [ 0, 100 ], 'length': 1 }"),
                 "nook_density.unit is not known and does nothing; file, window and length are");
}

static void test_warnings_of_a_field_are_the_scenes_and_name_its_node(void **state)
{
    (void)state;
    write_good_field();
    assert_warns(SCENE("{ 'file': 'cloud.nrrd', 'window': [ 201, 300 ], 'length': 1 }"), "no sample reaches");
    write_field("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 2 1\nspacings: 1 -1 1\nencoding: raw\n\n");
    assert_warns(SCENE(GOOD), "cloud.nrrd: the spacing of axis 1 is -1");
    write_field("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 1 1\nencoding: raw\n\n");
    assert_warns(SCENE(GOOD), "cloud.nrrd: the data behind the last sample");
}

static void test_a_broken_field_names_its_scene_and_its_node(void **state)
{
    static const char detached[] = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 2 2\nencoding: hex\n"
                                   "data file: slice%d.raw 1 2 1 2\n";
    (void)state;
    write_field("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 3 3\nencoding: raw\n\n"); /* cut short */
    refuse(SCENE(GOOD), NOOK_E_FORMAT, "density.gltf: nodes[1].extras.nook_density: ");
    write_field("NRRD0004\ntype: uchar\nsizes: 3 3 3\nencoding: raw\n\n"); /* no dimension */
    refuse(SCENE(GOOD), NOOK_E_FORMAT, "density.gltf: nodes[1].extras.nook_density: ");
    test_bytes_write("cloud.nrrd", detached, sizeof detached - 1);
    test_bytes_write("slice1.raw", "0123456789ab", 12);
    test_bytes_write("slice2.raw", "0123456789ax", 12);
    refuse(SCENE(GOOD), NOOK_E_FORMAT, "density.gltf: nodes[1].extras.nook_density: ");
    refuse(SCENE(GOOD), NOOK_E_FORMAT, "slice2.raw: byte 0x78");
    test_bytes_write("cloud.nrrd", "NRRD", 4);
    refuse(SCENE(GOOD), NOOK_E_FORMAT, "density.gltf: nodes[1].extras.nook_density: ");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_node_names_a_field_its_window_and_its_length),
        cmocka_unit_test(test_the_samples_beside_a_detached_header_are_files_of_the_scene),
        cmocka_unit_test(test_a_field_that_its_node_flattens_is_left_out_with_a_warning),
        cmocka_unit_test(test_a_joined_scene_has_the_fields_of_its_parts),
        cmocka_unit_test(test_what_a_density_does_not_say_right_is_refused_with_its_name),
        cmocka_unit_test(test_a_window_upside_down_is_refused),
        cmocka_unit_test(test_files_outside_of_the_scenes_folder_are_not_read),
        cmocka_unit_test(test_a_broken_field_breaks_its_scene),
        cmocka_unit_test(test_a_broken_field_names_its_scene_and_its_node),
        cmocka_unit_test(test_keys_that_are_not_known_are_warned_of_with_the_nearest_that_is),
        cmocka_unit_test(test_warnings_of_a_field_are_the_scenes_and_name_its_node),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
