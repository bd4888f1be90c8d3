/**
 * rasterize.h - the voxels of one triangle; inside modules/bake only. What is marked: see voxelize.h.
 */
#pragma once
#include "modules/bake/triangle_grid.h"
#include "modules/bake/voxel_grid.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Takes a voxel, and the weights of the triangle's corners at the point in it; a voxel may come several times. */
typedef void (*nook_rasterize_mark)(void *user, const int32_t voxel[3], const double weight[3]);

/** Marks, for each axis, the voxels in which the triangle crosses the lines through voxel centres along that axis. */
void nook_rasterize_three_way(const nook_snapped_triangle *triangle, const int32_t inner[3], nook_rasterize_mark mark,
                              void *user);

/**
 * Walks a triangle narrower than four voxels along its longest edge and marks each voxel met that is
 * neither set in `rasterized` nor shares a face with a voxel that is. Wider triangles always cover a centre.
 */
void nook_rasterize_narrow(const nook_snapped_triangle *triangle, const int32_t inner[3],
                           const nook_voxel_grid *rasterized, nook_rasterize_mark mark, void *user);

#ifdef __cplusplus
}
#endif
