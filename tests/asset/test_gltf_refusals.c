/* Files that are refused before anything is made of them: containers, documents, uris. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "engine/core/file.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include "tests/support/test_glb.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define ASSET "'asset': { 'version': '2.0' }"

static nook_file valid_glb(void)
{
    test_glb glb = { 0 };
    nook_file file;
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    const char *path = test_glb_write(&glb, TEST_GLB_ONE_NODE ", 'meshes': [ { 'primitives': [ { 'attributes': { "
                                                              "'POSITION': 0 }, 'mode': 5 } ] } ], 'accessors': "
                                                              "[ " TEST_GLB_QUAD_POSITIONS " ]");
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    return file;
}

static void refuse_text(const char *text, nook_result code, const char *reason)
{
    test_scene_must_refuse(test_gltf_write("refused.gltf", text), code, reason);
}

static void test_every_cut_of_a_glb_is_refused(void **state)
{
    (void)state;
    nook_file file = valid_glb();
    for (size_t size = 0; size < file.size; size++) {
        nook_scene *scene = NULL;
        nook_log_capture log;
        const char *path = test_bytes_write("cut.glb", file.bytes, size);
        nook_log_capture_begin(&log);
        nook_result result = nook_scene_load(path, NULL, &scene);
        nook_log_capture_end();
        assert_int_equal(result, NOOK_E_FORMAT);
        assert_int_equal(log.errors, 1);
        assert_null(scene);
    }
    nook_file_free(&file);
}

static void refuse_changed(size_t offset, uint32_t value, nook_result code, const char *reason)
{
    nook_file file = valid_glb();
    for (size_t i = 0; i < 4; i++)
        file.bytes[offset + i] = (uint8_t)(value >> (8 * i));
    test_scene_must_refuse(test_bytes_write("changed.glb", file.bytes, file.size), code, reason);
    nook_file_free(&file);
}

static void test_wrong_numbers_in_a_glb_header_are_refused(void **state)
{
    (void)state;
    refuse_changed(0, 0x47546C67, NOOK_E_FORMAT, "not a GLB file");
    refuse_changed(4, 1, NOOK_E_VERSION, "GLB version 1");
    refuse_changed(8, UINT32_MAX, NOOK_E_FORMAT, "cut off");
    refuse_changed(8, 19, NOOK_E_FORMAT, "cut off inside a chunk header");
    refuse_changed(8, 12, NOOK_E_FORMAT, "without a JSON chunk");
    refuse_changed(12, 0xFFFFFFF0, NOOK_E_FORMAT, "a chunk of 4294967280 bytes"); /* wraps when added to 20 */
    refuse_changed(16, 0x004E4942, NOOK_E_FORMAT, "the first chunk is not JSON");
}

static void test_bytes_after_a_glb_are_a_warning(void **state)
{
    (void)state;
    nook_file file = valid_glb();
    uint8_t *longer = calloc(file.size + 5, 1);
    assert_non_null(longer);
    memcpy(longer, file.bytes, file.size);
    nook_scene *scene = test_scene_must_load(test_bytes_write("longer.glb", longer, file.size + 5));
    assert_non_null(strstr(scene->warnings[0], "5 bytes after the end of the GLB are ignored"));
    nook_scene_destroy(scene);
    free(longer);
    nook_file_free(&file);
}

static void test_files_that_are_not_there_or_not_files_are_refused(void **state)
{
    (void)state;
    char path[1024];
    test_scene_must_refuse(nook_scratch_path(path, sizeof path, "nothing_here.glb"), NOOK_E_NOT_FOUND, "no such file");
    nook_scratch_path(path, sizeof path, "folder.glb");
    assert_int_equal(nook_directory_make(path), NOOK_OK);
    test_scene_must_refuse(path, NOOK_E_IO, "is a directory");
    test_scene_must_refuse(test_bytes_write("empty.gltf", "", 0), NOOK_E_FORMAT, "is empty");
}

static void test_versions_and_extensions_that_are_not_ours_are_refused_by_name(void **state)
{
    (void)state;
    refuse_text("NRRD0004", NOOK_E_FORMAT, "not a glTF scene; give a .gltf or .glb file");
    refuse_text(" \n ", NOOK_E_FORMAT, "not a glTF scene");
    refuse_text("{ }", NOOK_E_FORMAT, "asset is missing");
    refuse_text("[ ]", NOOK_E_FORMAT, "the JSON is not an object");
    refuse_text("{ 'asset': { } }", NOOK_E_FORMAT, "asset.version is missing");
    refuse_text("{ 'asset': { 'version': 2.0 } }", NOOK_E_FORMAT, "asset.version is 2.0; expected a string");
    refuse_text("{ 'asset': { 'version': '1.0' } }", NOOK_E_VERSION, "asset.version is '1.0'");
    refuse_text("{ 'asset': { 'version': '2' } }", NOOK_E_VERSION, "asset.version is '2'");
    refuse_text("{ 'asset': { 'version': '2.0', 'minVersion': '2.1' } }", NOOK_E_VERSION, "asset.minVersion is '2.1'");
    refuse_text("{ " ASSET ", 'extensionsRequired': [ 'KHR_mesh_quantization', 'KHR_draco_mesh_compression' ] }",
                NOOK_E_VERSION, "requires the extension KHR_draco_mesh_compression");
    refuse_text("{ " ASSET ", 'extensionsRequired': 'KHR_mesh_quantization' }", NOOK_E_FORMAT, "expected an array");
}

static void test_extensions_that_are_ours_may_be_required(void **state)
{
    (void)state;
    nook_scene *scene = test_scene_must_load(
        test_gltf_write("ours.gltf", "{ 'asset': { 'version': '2.1', 'minVersion': '2.0' }, 'extensionsUsed': "
                                     "[ 'VENDOR_other' ], 'extensionsRequired': [ 'KHR_mesh_quantization', "
                                     "'KHR_texture_transform', 'KHR_materials_unlit', 'KHR_lights_punctual', "
                                     "'KHR_materials_emissive_strength' ] }"));
    assert_int_equal(scene->triangle_count, 0);
    assert_int_equal(scene->warning_count, 1);
    assert_non_null(strstr(scene->warnings[0], "nothing to draw"));
    nook_scene_destroy(scene);
}

static void test_members_of_wrong_types_are_refused_with_their_place(void **state)
{
    (void)state;
    refuse_text("{ " ASSET ", 'nodes': { } }", NOOK_E_FORMAT, "nodes is an object; expected an array");
    refuse_text("{ " ASSET ", 'nodes': [ 5 ] }", NOOK_E_FORMAT, "nodes[0] is 5; expected an object");
    refuse_text("{ " ASSET ", 'nodes': [ { 'mesh': '0' } ] }", NOOK_E_FORMAT, "nodes[0].mesh is 0; expected the index");
    refuse_text("{ " ASSET ", 'scene': 0 }", NOOK_E_FORMAT, "scene is 0; expected the index of one of 0 scenes");
    refuse_text("{ " ASSET ", 'skins': [ { } ] }", NOOK_E_FORMAT, "skins[0].joints is missing");
    refuse_text("{ " ASSET ", 'materials': [ { 'doubleSided': 1 } ] }", NOOK_E_FORMAT, "expected true or false");
    refuse_text("{ " ASSET ", 'materials': [ { 'alphaCutoff': '1' } ] }", NOOK_E_FORMAT, "expected a finite number");
    refuse_text("{ " ASSET ", 'nodes': [ { 'extensions': { 'KHR_lights_punctual': { 'light': 0 } } } ] }",
                NOOK_E_FORMAT, "KHR_lights_punctual.light is 0; expected the index of one of 0 lights");
    refuse_text("{ " ASSET ", 'nodes': [ ], 'n\\u006fdes': [ { } ] }", NOOK_E_FORMAT,
                "expected every member name once");
}

static void test_nesting_beyond_a_limit_is_refused(void **state)
{
    (void)state;
    enum { DEEP = 50000 };
    static char text[2 * DEEP + 200];
    size_t at = (size_t)sprintf(text, "{ " ASSET ", 'extras': ");
    memset(text + at, '[', DEEP);
    memset(text + at + DEEP, ']', DEEP);
    snprintf(text + at + (size_t)2 * DEEP, 3, " }");
    refuse_text(text, NOOK_E_FORMAT, "nested too deeply");
}

static void test_uris_outside_the_folder_are_refused_before_opening(void **state)
{
    (void)state;
    static const struct {
        const char *uri, *reason;
    } cases[] = {
        { "../outside.bin", "climbs out" },
        { "a/../../outside.bin", "climbs out" },
        { "a\\\\..\\\\outside.bin", "climbs out" },
        { "%2e%2E/outside.bin", "climbs out" },
        { "..%2foutside.bin", "climbs out" },
        { "/etc/hostname", "absolute path" },
        { "%2Fetc/hostname", "absolute path" },
        { "\\\\\\\\server/x", "absolute path" },
        { "file:///etc/hostname", "has a scheme" },
        { "http://127.0.0.1/x", "has a scheme" },
        { "C:/x.bin", "has a scheme" },
        { "a\\u0000.bin", "NUL" },
        { "a%00.bin", "NUL" },
        { "", "is empty" },
        { "line\\nbreak.bin", "cannot be read" },
        { "nothing_here.bin", "cannot be read" },
        { "folder.bin", "is not a regular file" },
        { "pipe.bin", "is not a regular file" },
        { "data:application/octet-stream;base64", "without data" },
        { "data:application/octet-stream,AAAA", "not marked as base64" },
        { "data:;base64,AA!A", "broken base64" },
        { "data:;base64,AAAAA", "broken base64" },
        { "data:;base64,AAAA", "has 3 bytes, it promises 36" },
    };
    char path[1024];
    assert_int_equal(nook_directory_make(nook_scratch_path(path, sizeof path, "folder.bin")), NOOK_OK);
    nook_scratch_path(path, sizeof path, "pipe.bin");
    remove(path);
    assert_int_equal(mkfifo(path, 0600), 0);
    for (size_t i = 0; i < NOOK_COUNT(cases); i++) {
        char text[512];
        nook_scene *scene = NULL;
        nook_log_capture log;
        snprintf(text, sizeof text, "{ " ASSET ", 'buffers': [ { 'byteLength': 36, 'uri': '%s' } ] }", cases[i].uri);
        const char *file = test_gltf_write("uri.gltf", text);
        nook_log_capture_begin(&log);
        nook_result result = nook_scene_load(file, NULL, &scene);
        nook_log_capture_end();
        if (result == NOOK_OK || log.errors != 1 || strchr(log.text, '\n') || !strstr(log.text, cases[i].reason))
            fail_msg("'%s': %d, %d lines, '%s', expected '%s'", cases[i].uri, result, log.errors, log.text,
                     cases[i].reason);
    }
    remove(path);
}

/* A triangle, 36 bytes, whose largest x is 1. */
static void load_with_buffer(const char *uri)
{
    char text[1024];
    snprintf(
        text, sizeof text,
        "{ " ASSET ", 'buffers': [ { 'byteLength': 36, 'uri': '%s' } ], 'bufferViews': [ { 'buffer': 0, "
        "'byteLength': 36 } ], 'accessors': [ { 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' "
        "} ], 'meshes': [ { 'primitives': [ { 'attributes': { 'POSITION': 0 } } ] } ], " TEST_GLB_ONE_NODE " }",
        uri);
    nook_scene *scene = test_scene_must_load(test_gltf_write("uri.gltf", text));
    assert_int_equal(scene->triangle_count, 1);
    assert_true(scene->bounds_max[0] == 1.0);
    assert_string_equal(scene->files[0], scene->path);
    assert_int_equal(scene->file_count, strncmp(uri, "data:", 5) == 0 ? 1 : 2);
    for (uint32_t i = 0; i < scene->file_count; i++)
        assert_true(nook_file_exists(scene->files[i]));
    nook_scene_destroy(scene);
}

static void test_buffers_beside_the_scene_are_read_by_any_spelling(void **state)
{
    (void)state;
    static const float triangle[10] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 99 }; /* longer than the buffer, as is allowed */
    char folder[1024];
    assert_int_equal(nook_directory_make(nook_scratch_path(folder, sizeof folder, "sub")), NOOK_OK);
    test_bytes_write("sub/a b+c%.bin", triangle, sizeof triangle);
    load_with_buffer("sub/a b+c%.bin");
    load_with_buffer("sub/a%20b+c%25.bin");
    load_with_buffer("./sub/a%20b%2bc%.bin");
    load_with_buffer("sub\\/a b+c\\u0025.bin");
    load_with_buffer("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA");
    load_with_buffer("data:whatever/type;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAA==");
}

static void test_warnings_are_kept_up_to_a_hundred(void **state)
{
    (void)state;
    static char text[32768];
    size_t at = (size_t)sprintf(text, "{ " ASSET ", 'textures': [ { }");
    for (int i = 0; i < 300; i++)
        at += (size_t)sprintf(text + at, ", { }");
    snprintf(text + at, sizeof text - at, " ] }");
    nook_scene *scene = test_scene_must_load(test_gltf_write("noisy.gltf", text));
    assert_int_equal(scene->warning_count, 100);
    assert_non_null(strstr(scene->warnings[99], "further warnings are not shown"));
    nook_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_cut_of_a_glb_is_refused),
        cmocka_unit_test(test_wrong_numbers_in_a_glb_header_are_refused),
        cmocka_unit_test(test_bytes_after_a_glb_are_a_warning),
        cmocka_unit_test(test_files_that_are_not_there_or_not_files_are_refused),
        cmocka_unit_test(test_versions_and_extensions_that_are_not_ours_are_refused_by_name),
        cmocka_unit_test(test_extensions_that_are_ours_may_be_required),
        cmocka_unit_test(test_members_of_wrong_types_are_refused_with_their_place),
        cmocka_unit_test(test_nesting_beyond_a_limit_is_refused),
        cmocka_unit_test(test_uris_outside_the_folder_are_refused_before_opening),
        cmocka_unit_test(test_buffers_beside_the_scene_are_read_by_any_spelling),
        cmocka_unit_test(test_warnings_are_kept_up_to_a_hundred),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
