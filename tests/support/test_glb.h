/**
 * test_glb.h - small GLB files made by tests. JSON is written with ' for ", which reads better in C.
 *
 *   test_glb glb = { 0 };
 *   test_glb_add(&glb, positions, sizeof positions);                       // bufferViews[0]
 *   scene = test_glb_must_load(&glb, TEST_GLB_ONE_NODE ", 'meshes': [ ... ], 'accessors': [ ... ]");
 */
#pragma once
#include "engine/asset/scene.h"
#include <stddef.h>
#include <stdint.h>

/** A BIN chunk being filled, and its bufferViews. Starts zeroed. */
typedef struct test_glb {
    uint8_t bin[8192];
    size_t bin_size;
    char views[2048]; /**< JSON objects, separated by commas. */
    uint32_t view_count;
} test_glb;

/** Appends bytes, 4-byte aligned, as a bufferView. @return its index */
uint32_t test_glb_add(test_glb *glb, const void *bytes, size_t size);
/** The same with a byteStride. */
uint32_t test_glb_add_strided(test_glb *glb, const void *bytes, size_t size, uint32_t stride);

/**
 * Writes a file of these chunks into the scratch folder.
 * @param members  the members of the top-level object besides asset, buffers and bufferViews
 * @return its path, valid until the next call
 */
const char *test_glb_write(const test_glb *glb, const char *members);

/** Loads, with the log silent; fails the test when the file is refused. @return the caller destroys it */
nook_scene *test_scene_must_load(const char *path);
/** Loads and fails the test unless that gives `code`, no scene, and one error line that contains `reason`. */
void test_scene_must_refuse(const char *path, nook_result code, const char *reason);
/** The same for a file made of these chunks; `code` is NOOK_E_FORMAT. */
nook_scene *test_glb_must_load(const test_glb *glb, const char *members);
void test_glb_must_refuse(const test_glb *glb, const char *members, const char *reason);

/** Writes text with ' turned to " into the scratch folder. @return its path, valid until the next call */
const char *test_gltf_write(const char *name, const char *text);
/** Writes bytes into the scratch folder as they are. @return as above */
const char *test_bytes_write(const char *name, const void *bytes, size_t size);

/** accessors[0] VEC3 float positions, four of them, from bufferViews[0]; a mesh, a node and a scene that draw it. */
#define TEST_GLB_QUAD_POSITIONS "{ 'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3' }"
#define TEST_GLB_ONE_NODE "'scenes': [ { 'nodes': [ 0 ] } ], 'nodes': [ { 'mesh': 0 } ]"

/** A corner of a triangle of the scene's first primitive. @param index  3 * triangle + 0, 1, 2 */
const nook_vertex *test_scene_corner(const nook_scene *scene, uint32_t index);

/** A unit square in the plane z = 0, facing +z: (0 0) (1 0) (0 1) (1 1). Triangles 0 1 2 and 2 1 3. */
extern const float test_quad_positions[12];
