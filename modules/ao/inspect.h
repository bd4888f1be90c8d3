/**
 * inspect.h - what the AO core holds and works on, for those who show it: debug views, probes, truth in the background.
 *
 * Counting and snapshots work on a frame as a record does: for nook_ao_frame.same_view and nook_ao_get_statistics they are the last one.
 */
#pragma once
#include "modules/ao/technique.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A volume in its atlas: its binary voxels, else its densities if it has those (a scalar field: of 255 steps to its highest extinction). */
typedef struct nook_ao_volume_place {
    nook_texture atlas; /**< R8 3D, linear filtering; 255 is full. Valid until volumes are added or removed. */
    uint32_t origin[3]; /**< Its first voxel there. */
    uint32_t size[3];   /**< Voxels; the outermost are empty. 0: it has neither. */
    double voxel_size;  /**< Metres, mesh space. */
    double corner[3];   /**< Metres, mesh space: outer corner of its first voxel. */
} nook_ao_volume_place;

/** @return NOOK_E_NOT_FOUND a volume that has been removed; NOOK_E_MEMORY, NOOK_E_DEVICE; *out_place is untouched then */
nook_result nook_ao_inspect_volume(nook_ao *ao, nook_ao_volume volume, nook_ao_volume_place *out_place);

/**
 * Counts for each pixel of the frame's part the submitted volumes that may darken it: in whose box, extended by r_max, it lies.
 * @param out_counts  R32UI of the full size; 0 where there is no geometry
 * @return as nook_ao_record
 */
nook_result nook_ao_count_occluders(nook_ao *ao, const nook_ao_frame *frame, nook_ao_texture out_counts);

/** All that a technique which works on the CPU with triangles takes of a frame, in memory of its own. */
typedef struct nook_ao_snapshot {
    nook_ao_pass pass; /**< Without gpu, textures, buffers and progress; its meshes and instances are those below. */
    float *depth;      /**< width * height, as pass.depth. Owned. */
    uint16_t *normal;  /**< RG pairs, as pass.normal. Owned. */
    nook_ao_mesh_view *meshes;        /**< Owned; the triangles are the context's, until the mesh is removed. */
    nook_ao_mesh_instance *instances; /**< Owned. */
    uint32_t *occluders;              /**< Of each instance: its place in the submitted list. Owned. */
} nook_ao_snapshot;

/** Waits for the GPU. @return as nook_ao_record; *out_snapshot is zero then */
nook_result nook_ao_snapshot_take(nook_ao *ao, const nook_ao_frame *frame, nook_ao_snapshot *out_snapshot);
void nook_ao_snapshot_free(nook_ao_snapshot *snapshot); /**< Zeroed ones are allowed; becomes zero. */

#ifdef __cplusplus
}
#endif
