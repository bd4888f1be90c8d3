/** gltf_motion_internal.h - inside engine/asset only: the stages that read what can move. docs/animation.md has the rules. */
#pragma once
#include "engine/asset/gltf_internal.h"

/** Largest tables of what moves that are taken: 2^26 differences are 1.5 GiB, 2^26 numbers of tracks 256 MiB. */
enum { NOOK_GLTF_DELTAS_MAX = 1 << 26, NOOK_GLTF_TRACK_VALUES_MAX = 1 << 26 };

/** What the stages below must know of meshes and nodes, kept while those are converted. */
typedef struct nook_gltf_origin {
    const nook_gltf_primitive *primitive; /**< In the file. */
    uint32_t *source_vertices;            /**< Per vertex, the file's; NULL: they are the same. Owned. */
} nook_gltf_origin;

/** Types and counts of JOINTS_0, WEIGHTS_0 and morph targets of a primitive that has positions. @return NOOK_E_FORMAT */
nook_result nook_gltf_check_deformation(const nook_gltf *gltf, const nook_gltf_primitive *from, const char *place);

/** Joints and inverse bind matrices. After the nodes. @return NOOK_E_FORMAT, NOOK_E_MEMORY */
nook_result nook_gltf_convert_skins(nook_gltf *gltf);
/** Finds the meshes that are deformed, one for each node, and reads influences and targets. After the skins. @return as skins */
nook_result nook_gltf_convert_deformables(nook_gltf *gltf);
/** Fills one deformable's tables, whose room is there. @return NOOK_E_FORMAT, NOOK_E_MEMORY */
nook_result nook_gltf_read_influences(nook_gltf *gltf, const nook_deformable *deformable);
nook_result nook_gltf_read_targets(nook_gltf *gltf, const nook_deformable *deformable);
/** Clips, and which nodes they move. After the deformables. @return NOOK_E_FORMAT, NOOK_E_MEMORY */
nook_result nook_gltf_convert_animations(nook_gltf *gltf);
