#include "tests/support/bone_scene.h"
#include "tests/support/test_glb.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { VERTICES = 2 * BONE_SCENE_ROWS };

typedef struct arm {
    float positions[VERTICES][3], normals[VERTICES][3], lifts[VERTICES][3], weights[VERTICES][4], uvs[VERTICES][2];
    uint8_t joints[VERTICES][4];
} arm;

static void make_arm(arm *out)
{
    memset(out, 0, sizeof *out);
    for (int v = 0; v < VERTICES; v++) {
        float y = 0.25f * (float)(v / 2);
        out->positions[v][0] = v % 2 ? 0.1f : -0.1f;
        out->positions[v][1] = y;
        out->normals[v][2] = 1.0f;
        out->uvs[v][1] = 2.0f * y;
        out->lifts[v][0] = y == 2.0f ? 1.0f : 0.0f;
        out->joints[v][1] = 1;
        out->weights[v][1] = y > 1.0f ? 1.0f : y < 1.0f ? 0.0f : 0.5f;
        out->weights[v][0] = 1.0f - out->weights[v][1];
    }
}

static void add_motion(test_glb *glb)
{
    const float half = (float)sqrt(0.5);
    const float times[2] = { 0, 2 }, turns[8] = { 0, 0, 0, 1, 0, 0, half, half }, lifts[2] = { 0, 1 };
    const float binds[32] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                              1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1 };
    test_glb_add(glb, times, sizeof times);
    test_glb_add(glb, turns, sizeof turns);
    test_glb_add(glb, lifts, sizeof lifts);
    test_glb_add(glb, binds, sizeof binds);
}

/* A PNG of one column: white, and below it nothing. */
static const uint8_t half_image[] = { 137, 80,  78,  71,  13,  10,  26,  10, 0,   0,  0,  13,  73,  72,  68, 82, 0,   0,
                                      0,   1,   0,   0,   0,   2,   8,   6,  0,   0,  0,  153, 129, 182, 39, 0,  0,   0,
                                      14,  73,  68,  65,  84,  120, 156, 99, 248, 15, 4,  12,  32,  12,  0,  38, 227, 6,
                                      250, 210, 253, 104, 227, 0,   0,   0,  0,   73, 69, 78,  68,  174, 66, 96, 130 };
static const char half_material[] =
    ", 'materials': [ { 'alphaMode': 'MASK', 'doubleSided': true, 'pbrMetallicRoughness': { 'baseColorTexture': { "
    "'index': 0 } } } ], "
    "'textures': [ { 'source': 0 } ], 'images': [ { 'bufferView': 10, 'mimeType': 'image/png' } ]";

static nook_scene *load(const double root[3], bool masked)
{
    static const char format[] =
        "'scenes': [ { 'nodes': [ 0 ] } ], 'nodes': [ { 'name': 'root', 'children': [ 1, 2 ], 'translation': [ %.17g, "
        "%.17g, %.17g ] }, { 'name': 'arm', 'mesh': 0, 'skin': 0 }, { 'name': 'upper', 'children': [ 3 ] }, { 'name': "
        "'lower', 'translation': [ 0, 1, 0 ] } ], 'skins': [ { 'joints': [ 2, 3 ], 'inverseBindMatrices': 8 } ], "
        "'animations': [ { 'name': 'bend', 'channels': [ { 'sampler': 0, 'target': { 'node': 3, 'path': 'rotation' } "
        "}, { 'sampler': 1, 'target': { 'node': 1, 'path': 'weights' } } ], 'samplers': [ { 'input': 5, 'output': 6 "
        "}, { 'input': 5, 'output': 7 } ] } ], 'meshes': [ { 'name': 'arm', 'primitives': [ { 'attributes': { "
        "'POSITION': 0, 'NORMAL': 1, 'JOINTS_0': 3, 'WEIGHTS_0': 4, 'TEXCOORD_0': 9 }, 'mode': 5, %s'targets': [ { "
        "'POSITION': 2 } ] } ] "
        "} ]%s, 'accessors': [ "
        "{ 'bufferView': 0, 'componentType': 5126, 'count': 18, 'type': 'VEC3' }, "
        "{ 'bufferView': 1, 'componentType': 5126, 'count': 18, 'type': 'VEC3' }, "
        "{ 'bufferView': 2, 'componentType': 5126, 'count': 18, 'type': 'VEC3' }, "
        "{ 'bufferView': 3, 'componentType': 5121, 'count': 18, 'type': 'VEC4' }, "
        "{ 'bufferView': 4, 'componentType': 5126, 'count': 18, 'type': 'VEC4' }, "
        "{ 'bufferView': 5, 'componentType': 5126, 'count': 2, 'type': 'SCALAR' }, "
        "{ 'bufferView': 6, 'componentType': 5126, 'count': 2, 'type': 'VEC4' }, "
        "{ 'bufferView': 7, 'componentType': 5126, 'count': 2, 'type': 'SCALAR' }, "
        "{ 'bufferView': 8, 'componentType': 5126, 'count': 2, 'type': 'MAT4' }, "
        "{ 'bufferView': 9, 'componentType': 5126, 'count': 18, 'type': 'VEC2' } ]";
    char text[sizeof format + sizeof half_material + 128];
    test_glb glb = { 0 };
    arm made;
    make_arm(&made);
    test_glb_add(&glb, made.positions, sizeof made.positions);
    test_glb_add(&glb, made.normals, sizeof made.normals);
    test_glb_add(&glb, made.lifts, sizeof made.lifts);
    test_glb_add(&glb, made.joints, sizeof made.joints);
    test_glb_add(&glb, made.weights, sizeof made.weights);
    add_motion(&glb);
    test_glb_add(&glb, made.uvs, sizeof made.uvs);
    if (masked)
        test_glb_add(&glb, half_image, sizeof half_image);
    snprintf(text, sizeof text, format, root[0], root[1], root[2], masked ? "'material': 0, " : "",
             masked ? half_material : "");
    return test_glb_must_load(&glb, text);
}

nook_scene *bone_scene_load(const double root[3])
{
    return load(root, false);
}

nook_scene *bone_scene_load_masked(const double root[3])
{
    return load(root, true);
}
