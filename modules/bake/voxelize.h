/**
 * voxelize.h - three-way slice rasterisation (Papaioannou et al. 2010, section 4.1) of any triangle soup.
 *
 * A triangle is rasterised along each axis in turn (the voxel whose centre column it covers gets the voxel of its depth
 * there); the three results are ORed. Open, intersecting and double geometry needs no care.
 *
 * Where the grid lies   Its longest side is exactly `resolution` voxels of the box, the other sides are rounded up; the
 *                       box stands in the middle, and one empty voxel surrounds it. So a flat mesh lies in the middle of
 *                       its one layer, and the faces at the ends of the longest side are the outer faces of its voxels.
 *                       A surface on the boundary of two layers, or up to 1/1000 voxel below it, takes the upper one: walls at
 *                       round numbers do not flicker between two layers.
 * What is exact         Corners are snapped to 1/65536 voxel; coverage is then decided in integers, edges included, so
 *                       triangles that share an edge leave no gap. A line through voxel centres never crosses the surface
 *                       unmarked: a closed mesh has no 6-connected path from inside to outside.
 * What the paper misses A triangle narrower than four voxels may cover no centre at all. Such ones are walked along their
 *                       longest edge, and a voxel found that neither has a mark nor touches one by a face is marked too.
 *                       Wires and crumbs stay, while finely tessellated surfaces stay as thin as coarse ones.
 */
#pragma once
#include "engine/core/alpha.h"
#include "modules/bake/volume_file.h"
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Distances know nothing of what has less alpha than this, a half but for the rounding of areas. */
#define NOOK_DISTANCE_LEAST_ALPHA (0.5 - 1e-6)

/* What the other kinds hold, and how they are made: docs/surfel_bricks.md, docs/volume_kinds.md. Their grid lies where that of the
   voxels does. */

/** Raise it when the voxels of the same triangles change: cached volumes of older versions are then baked again. */
#define NOOK_VOXELIZE_VERSION 2u
#define NOOK_VOXELIZE_MEMORY (64u << 20)
#define NOOK_VOXELIZE_LEVELS 4 /**< The volume itself, and three coarser ones. */
#define NOOK_VOXELIZE_RESOLUTION_MAX (NOOK_VOLUME_SIDE_MAX - 2u)

typedef struct nook_triangles {
    const float *positions; /**< xyz, metres, mesh space. */
    uint32_t stride;        /**< Bytes between vertices, at least 12; 0 means 12. */
    uint32_t vertex_count;
    const uint32_t *indices; /**< Each below vertex_count. */
    size_t index_count;      /**< A multiple of 3. */
} nook_triangles;

typedef struct nook_voxelize_desc {
    uint32_t resolution; /**< Voxels along the longest side of the mesh's box, the border not counted: [1, 512]. */
    uint32_t threads;    /**< 0: all cores. The result does not depend on it. */
    size_t
        memory; /**< Bytes that each thread may use to sum up surfels, at least 4 MiB; 0: NOOK_VOXELIZE_MEMORY. Nor on this. */
    nook_volume_kind kind; /**< What is made of the triangles; 0: voxels. */
    uint32_t
        level; /**< Of surfels: how often 2 x 2 x 2 voxels are merged into one, below NOOK_VOXELIZE_LEVELS. 0: the volume itself. */
    const nook_alphas
        *alphas; /**< Of the triangles; NULL: all are opaque. What each kind makes of them: docs/volume_kinds.md. */
} nook_voxelize_desc;

/**
 * Makes the volume of a soup, or a level of it: its bounding box at `resolution`, plus one empty voxel on every side.
 * Degenerate triangles are voxelised as the segments or points they are, and have no surfels, which cover area; triangles with a non-finite corner are left out
 * (one warning counts them). A soup without extent is voxelised as if it were as large as floats can tell apart where it lies, a micrometre in the origin.
 * @return NOOK_E_RANGE resolution, kind or level; NOOK_E_ARG nothing finite to voxelise, or indices, stride or parts out of bounds;
 *         NOOK_E_MEMORY; *out_volume is untouched on failure. Its content_hash is nook_voxelize_hash's.
 */
nook_result nook_voxelize(const nook_triangles *triangles, const nook_voxelize_desc *desc, nook_volume *out_volume);

/** Voxels along the longest side of a level: resolution / 2^level, rounded up. */
uint32_t nook_voxelize_level_resolution(uint32_t resolution, uint32_t level);

/**
 * Makes several levels of a volume of surfels in one pass: triangles are cut once. Level 0 is nook_voxelize's volume bit for bit; level k is
 * made of the sums of level k - 1, those of 2 x 2 x 2 voxels in each of its own, and is the same whichever levels are asked for, also
 * as the only one by nook_voxelize: docs/surfel_bricks.md, "Levels". Other kinds cannot be merged; bake each at its own resolution.
 * @param desc  its level is not looked at
 * @param levels  which: bits 1 << level, at least one, all below NOOK_VOXELIZE_LEVELS
 * @param out_volumes  NOOK_VOXELIZE_LEVELS of them; those of the levels are filled, and all are untouched on failure
 * @return as nook_voxelize; NOOK_E_RANGE also for other levels and kinds
 */
nook_result nook_voxelize_levels(const nook_triangles *triangles, const nook_voxelize_desc *desc, uint32_t levels,
                                 nook_volume *out_volumes);

/** What a soup was before it was edited, and the volume that was made of it. Borrowed. */
typedef struct nook_voxelize_before {
    const nook_triangles *triangles;
    const nook_alphas *alphas; /**< NULL: all was opaque. */
    /** As nook_voxelize made it of them, with the same resolution, kind and level. For nook_voxelize_levels_again NOOK_VOXELIZE_LEVELS of them, of
        which those of the levels are looked at. */
    const nook_volume *volume;
} nook_voxelize_before;

/**
 * The same as nook_voxelize bit for bit, sooner: of surfels only those bricks are made in whose boxes triangles differ, before or after. Where
 * the grid differs, as the soup's box does, and for other kinds, everything is made. Triangles are told apart by their places in
 * the lists: what is put in or taken out in one place of a list changes only the triangles between.
 * @param out_bricks  how many were made; NULL is allowed
 * @return as nook_voxelize; NOOK_E_ARG also when the volume is not that of those triangles
 */
nook_result nook_voxelize_again(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                                const nook_voxelize_before *before, nook_volume *out_volume, size_t *out_bricks);

/**
 * The same as nook_voxelize_levels bit for bit, sooner, by the same rule: triangles are cut once, where they reach changed bricks of the coarsest of the levels.
 * @param out_bricks  of each of the levels how many were made, NOOK_VOXELIZE_LEVELS of them; NULL is allowed
 * @return as nook_voxelize_levels; NOOK_E_ARG also when one of the volumes is not that level of those triangles
 */
nook_result nook_voxelize_levels_again(const nook_triangles *triangles, const nook_voxelize_desc *desc, uint32_t levels,
                                       const nook_voxelize_before *before, nook_volume *out_volumes,
                                       size_t *out_bricks);

/**
 * Identifies a bake: a hash of positions, indices, kind, resolution, level, the versions of voxeliser and file, and of those parts that the kind
 * looks at. Threads and stride do not enter. Takes what nook_voxelize takes.
 */
uint64_t nook_voxelize_hash(const nook_triangles *triangles, const nook_voxelize_desc *desc);

#ifdef __cplusplus
}
#endif
