/** voxels_internal.h - the grid of bits around the view, made anew when something has moved or the view has changed. */
#pragma once
#include "modules/ao/slicemap.h"
#include "modules/ao/technique.h"
#include "modules/ao_hao/grid_internal.h"
#include "modules/ao_hao/meshes_internal.h"

/** What the bits are made of: where any of it differs they are made anew. */
typedef struct hao_source {
    hao_view view;
    uint32_t resolution, map_count;
    uint32_t shader_version;
    uint32_t instance_count;
} hao_source;

/** A mesh as it was drawn. */
typedef struct hao_drawn {
    uint32_t id;
    nook_matrix view_from_mesh;
} hao_drawn;

/** All zero before the first update. */
typedef struct hao_voxels {
    nook_slicemap maps[3]; /**< Along x, y, z; one slicemap: along z alone. */
    nook_slicer slicer;
    hao_grid grid;
    bool holds; /**< The maps hold `source` and `drawn`. */
    hao_source source;
    hao_drawn *drawn; /**< Owned: room for drawn_capacity, of which source.instance_count are used. */
    uint32_t drawn_capacity;
} hao_voxels;

/**
 * @param resolution  most voxels along a side @param map_count  1 or 3
 * @param far  metres from the eye that it reaches at the most
 * @return NOOK_E_MEMORY, NOOK_E_DEVICE, NOOK_E_NOT_FOUND
 */
nook_result hao_voxels_update(hao_voxels *voxels, const nook_ao_pass *pass, const hao_meshes *meshes,
                              uint32_t resolution, uint32_t map_count, double far);
void hao_voxels_release(hao_voxels *voxels, nook_gpu *gpu);
