/**
 * voxel_shapes.h - meshes to voxelise, and looks at what came of it.
 */
#pragma once
#include "modules/bake/voxelize.h"

/** Fails the test when it cannot. @return release with nook_volume_free */
nook_volume test_voxelize(const nook_triangles *triangles, uint32_t resolution, uint32_t threads);

int test_voxel_at(const nook_volume *v, uint32_t x, uint32_t y, uint32_t z);
size_t test_voxel_count(const nook_volume *v);
/** Fails the test at a voxel that is neither 0 nor 255. */
uint64_t test_count_occupied(const nook_volume *v);
void test_assert_border_empty(const nook_volume *v);
void test_assert_same_voxels(const nook_volume *a, const nook_volume *b);

/** From the origin to (x, y, z), metres; corner = 1 x + 2 y + 4 z. */
void test_make_box(float x, float y, float z, float out[8][3]);
extern const uint32_t test_box_indices[36];
nook_triangles test_box_triangles(float (*points)[3]); /**< Of test_make_box; borrows them. */
/** About the origin, radians. */
void test_rotate(float (*points)[3], uint32_t count, double about_x, double about_y);

enum { RINGS = 24, SECTORS = 48, SPHERE_VERTICES = (RINGS + 1) * SECTORS, SPHERE_INDICES = RINGS * SECTORS * 6 };

/** Around the origin, closed. */
typedef struct test_sphere {
    float points[SPHERE_VERTICES][3];
    uint32_t indices[SPHERE_INDICES];
} test_sphere;

test_sphere *test_make_sphere(double radius);               /**< Release with free. */
nook_triangles test_sphere_triangles(const test_sphere *s); /**< Borrows it. */
