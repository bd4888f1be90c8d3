/**
 * live_volumes.h - volumes of meshes that change their shape while they play, made anew on the GPU when the pose has changed and someone
 * could see it; and their triangles for the reference, made anew on the CPU when that is asked for.
 *
 * Resolution    as bodies have it (game/volumes.h), of the mesh as it stands; coarser where a clip reaches out of what one live volume
 *               is to hold (NOOK_LIVE_VOLUME_SIDE_MAX).
 */
#pragma once
#include "engine/animation/scene_pose.h"
#include "engine/render/renderer.h"
#include "modules/ao/ecs/occluder.h"
#include "modules/ao/nook_ao.h"

enum { NOOK_LIVE_VOLUME_SIDE_MAX = 128 /**< Voxels, as many as a texel of a slicemap has bits. */ };

typedef struct nook_live_volume {
    uint32_t deformable;           /**< Into scene->deformables. */
    nook_volume_occluder occluder; /**< Its ids in the AO; the mesh's changes with each pose that is traced. */
    double voxel_size;             /**< Metres, mesh space. */
    uint32_t size[3];              /**< Voxels that it has room for. */
    uint32_t first_range, range_count;
    uint32_t first_index, index_count;    /**< Of its triangles for the reference. */
    uint32_t first_part, part_count;      /**< Of those the masked ones. */
    uint32_t voxel_version, mesh_version; /**< Of the poses that they were made of; 0: none yet. */
} nook_live_volume;

typedef struct nook_live_volumes {
    nook_live_volume *items;
    uint32_t count;
    nook_ao_triangle_range *ranges; /**< Of everything that is not blended. */
    nook_ao_live_mask *masks;       /**< Of each material. */
    nook_alpha_part *parts;         /**< Their triangles are counted from the volume's first index. */
    float *uvs;                     /**< Room for the largest, as vertices and positions. */
    uint32_t *indices;              /**< Relative to the deformable's first vertex. */
    nook_vertex *vertices;          /**< Room for the largest of them. */
    float *positions;
    uint32_t voxelized; /**< Volumes that the last nook_live_volumes_voxelize made anew. */
} nook_live_volumes;

/**
 * @param pose   of the scene, in any pose; left at rest
 * @param r_max  metres: resolutions follow from it
 * @return NOOK_E_MEMORY, NOOK_E_DEVICE; *out is zero then
 */
nook_result nook_live_volumes_create(nook_ao *ao, nook_scene_pose *pose, double r_max, nook_live_volumes *out);
/** Takes them out of the AO. Zeroed ones are allowed; becomes zero. */
void nook_live_volumes_destroy(nook_ao *ao, nook_live_volumes *volumes);

/** Gives the reference the triangles of a pose. @return NOOK_E_MEMORY */
nook_result nook_live_volumes_trace(nook_live_volumes *volumes, nook_ao *ao, const nook_scene_pose *pose,
                                    uint32_t version);
/**
 * Makes anew what is of another pose and within r_max of what a camera sees; what lies elsewhere darkens nothing that is seen.
 * @param scene  in that pose: nook_render_scene_pose @return as nook_ao_voxelize
 */
nook_result nook_live_volumes_voxelize(nook_live_volumes *volumes, nook_ao *ao, const nook_scene_pose *pose,
                                       uint32_t version, const nook_render_scene *scene, const nook_camera *camera,
                                       double aspect);
