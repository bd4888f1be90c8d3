/** gltf_vertex_internal.h - inside engine/asset only: the attributes of one primitive become nook_vertex. */
#pragma once
#include "engine/asset/gltf_internal.h"

/** The primitive whose vertices were read last, so that one with the same attributes can share them. */
typedef struct nook_gltf_vertex_source {
    const nook_gltf_primitive *primitive; /**< NULL: none, or its vertices were changed to fit its triangles. */
    uint32_t first_vertex;
} nook_gltf_vertex_source;

/** Types, counts and bounds of the attributes of a primitive that has positions. @return NOOK_E_FORMAT */
nook_result nook_gltf_check_attributes(nook_gltf *gltf, const nook_gltf_primitive *from, const char *place);

/**
 * Reads the vertices of `to`, whose triangles are there. Without normals in the file, each triangle gets its own three
 * vertices (flat shading, glTF 2.0 section 3.7.2.1) and the indices are rewritten.
 * @return NOOK_E_FORMAT a position is not finite; NOOK_E_MEMORY
 */
nook_result nook_gltf_read_vertices(nook_gltf *gltf, const nook_gltf_primitive *from, const char *place,
                                    nook_primitive *to, nook_gltf_vertex_source *previous);
