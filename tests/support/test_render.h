/**
 * test_render.h - small scenes made by code and pictures of them, for tests of the renderer.
 */
#pragma once
#include "engine/render/renderer.h"

#define TEST_SCENE_MESHES 8
#define TEST_SCENE_VERTICES 64

/** A scene with fixed room: each mesh has one primitive and one material of the same number. */
typedef struct test_scene {
    nook_scene scene;
    nook_vertex vertices[TEST_SCENE_VERTICES];
    uint32_t indices[TEST_SCENE_VERTICES * 2];
    nook_primitive primitives[TEST_SCENE_MESHES];
    nook_mesh meshes[TEST_SCENE_MESHES];
    nook_material materials[TEST_SCENE_MESHES];
    nook_image images[1];
} test_scene;

void test_scene_init(test_scene *scene);
/** A mesh that is one parallelogram; its front shows from where u, v turn counter-clockwise. @return its number */
uint32_t test_scene_add_quad(test_scene *scene, const float corner[3], const float u[3], const float v[3]);
/** A quad in the plane z = `z`, 2 * half on a side around the z axis, facing +z. */
uint32_t test_scene_add_facing(test_scene *scene, float half, float z);
/** Level, 2 * half on a side around (x, y, z), facing up or down. */
uint32_t test_scene_add_level(test_scene *scene, float half, float x, float y, float z, bool up);

/** One renderer, one scene, and what the next picture is made from. */
typedef struct test_picture {
    nook_gpu *gpu;
    nook_renderer *renderer;
    nook_render_scene *scene;
    nook_draw draws[TEST_SCENE_MESHES];
    nook_lights lights;
    nook_frame frame; /* draws all meshes where they are; camera at the origin looking along -z, 90 degrees */
    nook_texture visibility;
    uint32_t width, height;
    uint8_t *pixels; /* of the last render, RGB, top row first */
} test_picture;

/** Fails the test when something cannot be made. */
void test_picture_create(test_picture *picture, nook_gpu *gpu, const test_scene *scene, uint32_t width,
                         uint32_t height);
void test_picture_destroy(test_picture *picture);
void test_picture_render(test_picture *picture, nook_view view);
/** Pixel from the top left. */
const uint8_t *test_picture_at(const test_picture *picture, uint32_t x, uint32_t y);
/** One float of the depth buffer, from the top left. */
float test_picture_depth(const test_picture *picture, uint32_t x, uint32_t y);
/** Unit vector of one of the two normal textures, from the top left. */
void test_picture_normal(const test_picture *picture, nook_texture texture, uint32_t x, uint32_t y, double out[3]);
