#include "tests/support/bone_scene.h"
#include "tests/support/test_glb.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { VERTICES = 2 * BONE_SCENE_ROWS };

typedef struct arm {
    float positions[VERTICES][3], normals[VERTICES][3], lifts[VERTICES][3], weights[VERTICES][4];
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

nook_scene *bone_scene_load(const double root[3])
{
    static const char format[] =
        "'scenes': [ { 'nodes': [ 0 ] } ], 'nodes': [ { 'name': 'root', 'children': [ 1, 2 ], 'translation': [ %.17g, "
        "%.17g, %.17g ] }, { 'name': 'arm', 'mesh': 0, 'skin': 0 }, { 'name': 'upper', 'children': [ 3 ] }, { 'name': "
        "'lower', 'translation': [ 0, 1, 0 ] } ], 'skins': [ { 'joints': [ 2, 3 ], 'inverseBindMatrices': 8 } ], "
        "'animations': [ { 'name': 'bend', 'channels': [ { 'sampler': 0, 'target': { 'node': 3, 'path': 'rotation' } "
        "}, { 'sampler': 1, 'target': { 'node': 1, 'path': 'weights' } } ], 'samplers': [ { 'input': 5, 'output': 6 "
        "}, { 'input': 5, 'output': 7 } ] } ], 'meshes': [ { 'name': 'arm', 'primitives': [ { 'attributes': { "
        "'POSITION': 0, 'NORMAL': 1, 'JOINTS_0': 3, 'WEIGHTS_0': 4 }, 'mode': 5, 'targets': [ { 'POSITION': 2 } ] } ] "
        "} ], 'accessors': [ "
        "{ 'bufferView': 0, 'componentType': 5126, 'count': 18, 'type': 'VEC3' }, "
        "{ 'bufferView': 1, 'componentType': 5126, 'count': 18, 'type': 'VEC3' }, "
        "{ 'bufferView': 2, 'componentType': 5126, 'count': 18, 'type': 'VEC3' }, "
        "{ 'bufferView': 3, 'componentType': 5121, 'count': 18, 'type': 'VEC4' }, "
        "{ 'bufferView': 4, 'componentType': 5126, 'count': 18, 'type': 'VEC4' }, "
        "{ 'bufferView': 5, 'componentType': 5126, 'count': 2, 'type': 'SCALAR' }, "
        "{ 'bufferView': 6, 'componentType': 5126, 'count': 2, 'type': 'VEC4' }, "
        "{ 'bufferView': 7, 'componentType': 5126, 'count': 2, 'type': 'SCALAR' }, "
        "{ 'bufferView': 8, 'componentType': 5126, 'count': 2, 'type': 'MAT4' } ]";
    char text[sizeof format + 128];
    test_glb glb = { 0 };
    arm made;
    make_arm(&made);
    test_glb_add(&glb, made.positions, sizeof made.positions);
    test_glb_add(&glb, made.normals, sizeof made.normals);
    test_glb_add(&glb, made.lifts, sizeof made.lifts);
    test_glb_add(&glb, made.joints, sizeof made.joints);
    test_glb_add(&glb, made.weights, sizeof made.weights);
    add_motion(&glb);
    snprintf(text, sizeof text, format, root[0], root[1], root[2]);
    return test_glb_must_load(&glb, text);
}
