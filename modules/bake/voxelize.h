/**
 * voxelize.h - three-way slice rasterisation (Papaioannou et al. 2010, section 4.1) of any triangle soup.
 *
 * A triangle is rasterised along each axis in turn (the voxel whose centre column it covers gets the voxel of its depth
 * there); the three results are ORed. Open, intersecting and double geometry needs no care.
 */
#pragma once
#include "modules/bake/volume_file.h"

typedef struct nook_triangles {
    const float *positions; /**< xyz, metres, mesh space. */
    uint32_t stride;        /**< Bytes between vertices; 0 means 12. */
    uint32_t vertex_count;
    const uint32_t *indices; /**< Each below vertex_count. */
    size_t index_count;      /**< A multiple of 3. */
} nook_triangles;

typedef struct nook_voxelize_desc {
    uint32_t resolution; /**< Voxels along the longest side of the mesh's box, the border not counted: [1, 510]. */
    uint32_t threads;    /**< 0: all cores. The result does not depend on it. */
} nook_voxelize_desc;

/**
 * Makes the volume of a soup: its bounding box at `resolution`, plus one empty voxel on every side.
 * Degenerate triangles are voxelised as the segments or points they are; triangles with a non-finite corner are left out.
 * @return NOOK_E_RANGE resolution; NOOK_E_ARG nothing finite to voxelise; NOOK_E_MEMORY; *out_volume untouched on failure
 */
nook_result nook_voxelize(const nook_triangles *triangles, const nook_voxelize_desc *desc, nook_volume *out_volume);
