/**
 * surfel_shapes.h - meshes to make surfels of, and looks at what came of it.
 */
#pragma once
#include "modules/bake/surfel_word.h"
#include "modules/bake/voxelize.h"

/** Fails the test when it cannot. @return release with nook_volume_free */
nook_volume test_make_surfels(const nook_triangles *triangles, uint32_t resolution, uint32_t threads);
/** @return NULL: the voxel has none */
const nook_surfel *test_surfel_at(const nook_volume *v, uint32_t x, uint32_t y, uint32_t z);
void test_assert_same_surfels(const nook_volume *a, const nook_volume *b);
/** What the only plane of a voxel, which lies across z, covers of it: alpha times its box. Fails when there are two. @param surfel  NULL: 0 */
double test_covered_across_z(const nook_surfel *surfel);
/** In voxels from the volume's outer corner. */
void test_to_voxels(const nook_volume *v, const double metres[3], double out[3]);
/** From a point, in voxels from the outer corner, to a plane of the surfel in voxel x, y, z. */
double test_height_over(const nook_surfel_plane *plane, const uint32_t voxel[3], const double point[3]);

/** Two triangles and two specks without area at (0, 0, 0) and (side, side, side) that fix the grid. */
typedef struct test_sheet {
    float points[6][3];
    uint32_t indices[12];
} test_sheet;

/** A parallelogram: a corner and two edges. The grid then has `side` voxels of 1 m, the border not counted. */
test_sheet test_make_sheet(float side, const float corner[3], const float u[3], const float v[3]);
nook_triangles test_sheet_triangles(const test_sheet *sheet); /**< Borrows it. */
