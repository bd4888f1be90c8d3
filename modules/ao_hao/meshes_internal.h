/** meshes_internal.h - the host's triangles on the GPU, copied once. */
#pragma once
#include "modules/ao/technique.h"
#include "modules/ao_hao/grid_internal.h"

/** Triangles of a mesh that are drawn together. */
typedef struct hao_range {
    uint32_t first_index, index_count;
    nook_texture *texture; /**< Of a mask: one of the mesh's. NULL: all of it is there. */
    float factor, cutoff;  /**< nook_slice_mask. */
} hao_range;

typedef struct hao_mesh {
    uint32_t id;                   /**< nook_ao_mesh_view. */
    nook_buffer vertices, indices; /**< id 0: it has no triangles. */
    nook_buffer uvs;               /**< Of what is masked; id 0: nothing is. */
    nook_texture *textures;        /**< Owned: alpha is what they hold. Each of them once. */
    uint32_t texture_count;
    hao_range *ranges; /**< Owned. What is neither blended nor masked away by a factor alone. */
    uint32_t range_count;
    hao_box box; /**< Mesh space. */
} hao_mesh;

/** In the order of a pass's meshes: nook_ao_mesh_instance.mesh is an index here as well. All zero before there are any. */
typedef struct hao_meshes {
    hao_mesh *items; /**< Owned. */
    uint32_t count;
} hao_meshes;

/**
 * Copies what has come, drops what has gone; does nothing when it is all there.
 * @return NOOK_E_MEMORY: then there are none
 */
nook_result hao_meshes_update(hao_meshes *meshes, const nook_ao_pass *pass);
void hao_meshes_release(hao_meshes *meshes, nook_gpu *gpu);
