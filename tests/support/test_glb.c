#include "tests/support/test_glb.h"
#include "engine/core/file.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <assert.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { FILE_CAPACITY = 32768, PATH_CAPACITY = 1024 };

const float test_quad_positions[12] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 };

uint32_t test_glb_add_strided(test_glb *glb, const void *bytes, size_t size, uint32_t stride)
{
    char stride_member[40] = "";
    size_t used = strlen(glb->views);
    assert(glb->bin_size + size + 3 <= sizeof glb->bin);
    if (stride)
        snprintf(stride_member, sizeof stride_member, ", 'byteStride': %u", stride);
    snprintf(glb->views + used, sizeof glb->views - used, "%s{ 'buffer': 0, 'byteOffset': %zu, 'byteLength': %zu%s }",
             used ? ", " : "", glb->bin_size, size, stride_member);
    memcpy(glb->bin + glb->bin_size, bytes, size);
    glb->bin_size = (glb->bin_size + size + 3) / 4 * 4;
    return glb->view_count++;
}

uint32_t test_glb_add(test_glb *glb, const void *bytes, size_t size)
{
    return test_glb_add_strided(glb, bytes, size, 0);
}

static void turn_quotes(char *text)
{
    for (; *text; text++)
        if (*text == '\'')
            *text = '"';
}

static void put_u32(uint8_t *to, size_t value)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(value >> (8 * i));
}

const char *test_bytes_write(const char *name, const void *bytes, size_t size)
{
    static char path[PATH_CAPACITY];
    nook_result result = nook_file_write(nook_scratch_path(path, sizeof path, name), bytes, size);
    assert(result == NOOK_OK);
    (void)result;
    return path;
}

const char *test_gltf_write(const char *name, const char *text)
{
    char *copy = strdup(text);
    assert(copy);
    turn_quotes(copy);
    const char *path = test_bytes_write(name, copy, strlen(copy));
    free(copy);
    return path;
}

const char *test_glb_write(const test_glb *glb, const char *members)
{
    static uint8_t file[FILE_CAPACITY];
    char *json = (char *)file + 20;
    int length = snprintf(json, FILE_CAPACITY / 2,
                          "{ 'asset': { 'version': '2.0' }, 'buffers': [ { 'byteLength': %zu } ], "
                          "'bufferViews': [ %s ], %s }   ",
                          glb->bin_size, glb->views, members);
    assert(length > 0 && length < FILE_CAPACITY / 2);
    turn_quotes(json);
    size_t json_size = (size_t)length / 4 * 4, bin = 20 + json_size;
    memcpy(file, "glTF", 4);
    put_u32(file + 4, 2);
    put_u32(file + 8, bin + 8 + glb->bin_size);
    put_u32(file + 12, json_size);
    memcpy(file + 16, "JSON", 4);
    put_u32(file + bin, glb->bin_size);
    memcpy(file + bin + 4, "BIN", 4);
    memcpy(file + bin + 8, glb->bin, glb->bin_size);
    return test_bytes_write("made.glb", file, bin + 8 + glb->bin_size);
}

nook_scene *test_scene_must_load(const char *path)
{
    nook_scene *scene = NULL;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_result result = nook_scene_load(path, NULL, &scene);
    nook_log_capture_end();
    if (result != NOOK_OK || log.errors)
        fail_msg("refused: %s", log.text);
    return scene;
}

void test_scene_must_refuse(const char *path, nook_result code, const char *reason)
{
    nook_scene *scene = NULL;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_result result = nook_scene_load(path, NULL, &scene);
    nook_log_capture_end();
    if (result != code || log.errors != 1)
        fail_msg("gave %d and %d error lines, expected %d: %s", result, log.errors, code, log.text);
    assert_null(scene);
    if (!strstr(log.text, reason) || strchr(log.text, '\n'))
        fail_msg("'%s' is not one line that says '%s'", log.text, reason);
}

nook_scene *test_glb_must_load(const test_glb *glb, const char *members)
{
    return test_scene_must_load(test_glb_write(glb, members));
}

void test_glb_must_refuse(const test_glb *glb, const char *members, const char *reason)
{
    test_scene_must_refuse(test_glb_write(glb, members), NOOK_E_FORMAT, reason);
}

const nook_vertex *test_scene_corner(const nook_scene *scene, uint32_t index)
{
    const nook_primitive *primitive = &scene->primitives[0];
    assert(index < primitive->index_count);
    return &scene->vertices[primitive->first_vertex + scene->indices[primitive->first_index + index]];
}
