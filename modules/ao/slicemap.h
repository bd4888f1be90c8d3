/**
 * slicemap.h - triangles voxelised by the rasteriser: a picture whose bits are layers of voxels (Eisemann, Decoret: Fast Scene
 * Voxelization and Applications, 2006).
 *
 * A grid is looked along by one of its axes. A pixel is a column of voxels, and each bit of it one voxel: the blend's logic op ORs the
 * bits of all triangles that cross the line through the pixel's centre. What is seen edge-on covers no centre, so that one slicemap
 * has holes where surfaces hold its axis; three of them, one along each axis, have none but for crumbs.
 *
 *   begin -> for each map: clear, then draws -> end
 *
 * shaders/ao/slicemap.glsl reads what shaders/ao/voxel_slice.* write.
 */
#pragma once
#include "modules/ao/draw_state.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    NOOK_SLICEMAP_BITS = 128, /**< Layers of a texel: RGBA32UI. */
    NOOK_SLICEMAP_TEXELS = 4, /**< Texels of a column at the most: 512 layers. */
    NOOK_SLICEMAP_SIDE_MAX = NOOK_SLICEMAP_BITS * NOOK_SLICEMAP_TEXELS,
    NOOK_SLICING_UNIT = 5, /**< Of textures: where masks are read. */
};

typedef struct nook_slicemap {
    nook_texture bits; /**< RGBA32UI, 3D: texel (x, y, t) holds layers 128 t to 128 t + 127 of column (x, y). */
    nook_framebuffer target;
} nook_slicemap;

/**
 * Makes room for a grid of `side` voxels along each axis; keeps what is larger. Zero-initialise before the first call.
 * @param side  1 to NOOK_SLICEMAP_SIDE_MAX
 * @return NOOK_E_MEMORY, NOOK_E_DEVICE; the map is released then
 */
nook_result nook_slicemap_fit(nook_slicemap *map, nook_gpu *gpu, uint32_t side);
void nook_slicemap_release(nook_slicemap *map, nook_gpu *gpu);
/**
 * Changes when the shaders that fill the map were reloaded: what keeps a map makes it anew then.
 * @return NOOK_E_NOT_FOUND, NOOK_E_DEVICE: the shaders
 */
nook_result nook_slicemap_shader_version(const nook_slicemap *map, nook_gpu *gpu, uint32_t *out_version);

/** Indexed triangles on the GPU. */
typedef struct nook_slice_mesh {
    uint32_t vertex_buffer; /**< GL name; a vertex begins with its position, three floats. */
    uint32_t vertex_stride; /**< Bytes. */
    /** Of what is masked: where on its texture each vertex lies, two floats. GL name; 0: nothing is. Bytes to the first one, and from each to the next. */
    uint32_t uv_buffer, uv_offset, uv_stride;
    uint32_t index_buffer; /**< GL name; 32-bit. */
    /** Rows: voxels of the grid, whose first one is (0, 0, 0) to (1, 1, 1). What leaves the map marks nothing. */
    float voxel_from_mesh[3][4];
} nook_slice_mesh;

/**
 * Triangles with holes: a point is there where the factor times the texture's alpha is at least the cutoff. Of the texture the texel at that
 * point is looked at, repeated, as engine/core/alpha.h says; so a column has what its middle has, as in modules/bake/voxelize.h.
 */
typedef struct nook_slice_mask {
    uint32_t texture; /**< GL name, 2D, level 0; first row at v = 0. */
    float factor, cutoff;
} nook_slice_mask;

/** What slicing needs of GL, kept from one time to the next. All zero before nook_slicer_fit. */
typedef struct nook_slicer {
    uint32_t vertex_array;
    uint32_t
        mask_sampler; /**< Level 0 of a mask is there to be read whatever filter it has itself and levels it lacks. */
} nook_slicer;

/** GL's state while triangles are sliced; what a host had is put back at the end, but for NOOK_SLICING_UNIT. */
typedef struct nook_slicing {
    nook_gpu *gpu;
    nook_slicer slicer;
    nook_draw_state host;
    nook_program programs[2]; /**< Of what is opaque, of what is masked. */
    int32_t used;             /**< Which of them has all that mesh and map say. */
    int32_t axis;
    float side;
    nook_slice_mesh mesh;
} nook_slicing;

void nook_slicer_fit(nook_slicer *slicer, nook_gpu *gpu); /**< Makes what is not there. */
void nook_slicer_release(nook_slicer *slicer, nook_gpu *gpu);
/** Takes GL over until nook_slicing_end: framebuffer, viewport, tests, logic op, texture and sampler of NOOK_SLICING_UNIT. */
void nook_slicing_begin(nook_gpu *gpu, const nook_slicer *slicer, nook_slicing *out_slicing);
/**
 * Empties a map; draws go to it from now on.
 * @param axis  0, 1, 2: what it looks along. Its columns are (y, z), (x, z), (x, y) of the grid
 * @return NOOK_E_NOT_FOUND, NOOK_E_DEVICE: the shaders
 */
nook_result nook_slicing_map(nook_slicing *slicing, const nook_slicemap *map, int32_t axis);
/** What is drawn from now on. */
void nook_slicing_mesh(nook_slicing *slicing, const nook_slice_mesh *mesh);
/** What of the mesh is drawn from now on has holes. @param mask  NULL: none, as after nook_slicing_mesh */
void nook_slicing_mask(nook_slicing *slicing, const nook_slice_mask *mask);
/** @param first_index, index_count  a multiple of 3 @param first_vertex  added to each index */
void nook_slicing_draw(const nook_slicing *slicing, uint32_t first_index, uint32_t index_count, uint32_t first_vertex);
/** Leaves no sampler in NOOK_SLICING_UNIT, and the last mask's texture. */
void nook_slicing_end(const nook_slicing *slicing);

#ifdef __cplusplus
}
#endif
