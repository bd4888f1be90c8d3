/**
 * live_scene.h - one volume of all that is rigid in a scene, voxelised anew on the GPU in every frame in which something has moved
 * (Papaioannou et al. 2010, section 4.2): nothing is baked, and every body may move.
 *
 * Box        the scene's bounds as it was loaded; what leaves it darkens nothing.
 * Left out   blended materials and the holes of masked ones, as from binary volumes; what skins and morph targets bend, which has live volumes of its own.
 */
#pragma once
#include "engine/render/renderer.h"
#include "modules/ao/nook_ao.h"

/** Zeroed is none. */
typedef struct nook_live_scene {
    nook_ao_volume volume;
    nook_matrix world_from_volume; /**< A translation: floats suffice around the scene's middle. */
    double voxel_size;             /**< Metres. */
    uint32_t size[3];              /**< Voxels. */
    float box_min[3], box_max[3];  /**< Its space. */
    nook_ao_triangle_range *ranges;
    const nook_scene *scene; /**< Borrowed. */
    uint32_t *first_range;   /**< Of each mesh, and one more. */
    nook_ao_live_part *parts;
    nook_ao_live_mask *masks; /**< Of each material. */
    nook_draw *drawn;         /**< What it was voxelised of. */
    uint32_t drawn_count;
    bool voxelized; /**< In the last call. */
} nook_live_scene;

/**
 * Makes room; empty until it is voxelised.
 * @param resolution  voxels along its longest side, [1, NOOK_AO_LIVE_SIDE_MAX - 4] after it was bounded by that
 * @return NOOK_E_FORMAT nothing is drawn; NOOK_E_MEMORY, NOOK_E_DEVICE; *out is zero then
 */
nook_result nook_live_scene_create(nook_ao *ao, const nook_scene *scene, uint32_t resolution, nook_live_scene *out);
/** Takes it out of the AO. Zeroed is allowed; becomes zero. */
void nook_live_scene_destroy(nook_ao *ao, nook_live_scene *live);
/**
 * Makes it anew unless all stands where it stood.
 * @param draws  at most one of each node; those with a pose are left out @return as nook_ao_voxelize
 */
nook_result nook_live_scene_voxelize(nook_live_scene *live, nook_ao *ao, const nook_render_scene *scene,
                                     const nook_draw *draws, size_t draw_count);
