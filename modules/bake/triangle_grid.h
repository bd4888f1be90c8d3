/**
 * triangle_grid.h - where the grid of a soup lies, and its triangles in it: what bakers of every kind begin with; inside
 * modules/bake only. The rules are those of voxelize.h.
 */
#pragma once
#include "modules/bake/voxelize.h"
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_SUBVOXEL_BITS 16
#define NOOK_SUBVOXEL (1 << NOOK_SUBVOXEL_BITS) /**< Steps per voxel of a snapped corner. */

/**
 * Layers are told apart this many steps below the voxel boundary. Walls and floors often lie at round numbers, exactly on a
 * boundary or within rounding of it; without this they would flicker between two layers. The half step keeps the limit off
 * every snapped corner.
 */
#define NOOK_LAYER_BIAS 64.5

/** Corners in steps of 1 / NOOK_SUBVOXEL voxel from the grid's outer corner, within voxels [1, inner]. */
typedef struct nook_snapped_triangle {
    int32_t corner[3][3];
} nook_snapped_triangle;

typedef struct nook_grid_frame {
    double voxel_size, origin[3]; /**< Metres, mesh space: of a voxel; outer corner of voxel (0, 0, 0). */
    int32_t inner[3];             /**< Voxels without the border. */
    uint32_t size[3];             /**< With it. */
} nook_grid_frame;

/** Checks the soup and finds its grid. @return as nook_voxelize; *out_frame is untouched on failure */
nook_result nook_grid_place(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                            nook_grid_frame *out_frame);

/**
 * The same of a soup that has been checked, without a word.
 * @return how many triangles have a corner that is not finite; where all have, *out_frame is untouched
 */
size_t nook_grid_find(const nook_triangles *triangles, uint32_t resolution, nook_grid_frame *out_frame);

/** @return false when a corner is not finite */
bool nook_grid_snap(const nook_grid_frame *frame, const nook_triangles *triangles, size_t triangle,
                    nook_snapped_triangle *out);

/** The grid whose voxels are 2^level of this one's a side; its first ones begin with this one's. */
nook_grid_frame nook_grid_level(const nook_grid_frame *frame, uint32_t level);
/** The layer of that grid in which a layer in [0, inner] of this one lies; that of the border, 0, is its border. */
int32_t nook_grid_level_layer(int32_t layer, uint32_t level);

/** The layer in [1, inner] in which a depth in steps lies. */
int32_t nook_grid_layer(double depth, int32_t inner);

/** One vertex, as it stands in the soup. */
void nook_grid_read_position(const nook_triangles *triangles, uint32_t vertex, float out[3]);

#ifdef __cplusplus
}
#endif
