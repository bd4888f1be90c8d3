/** depth_mesh_internal.h - the surfaces that a depth buffer shows, as triangles. */
#pragma once
#include "modules/ao/technique.h"

/** In view space, owned. */
typedef struct depth_mesh {
    float *positions;  /**< xyz * vertex_count: one vertex a pixel, row by row; 0 where nothing is seen. */
    uint32_t *indices; /**< index_count, a multiple of 3. */
    uint32_t vertex_count, index_count;
} depth_mesh;

/**
 * Two triangles between the centres of each 2 x 2 pixels. A triangle stands only when one surface may reach along all three of
 * its sides (nook_surface_joins), so that the mesh ends at silhouettes. Of the two ways to split a square the one that keeps
 * more triangles is taken, then the one whose ends face more alike: along an edge, not across it.
 * @param depth, normal  of the pass: width * height, and RG pairs
 * @return NOOK_E_MEMORY; *out_mesh is zero then
 */
nook_result depth_mesh_create(const nook_ao_pass *pass, const float *depth, const uint16_t *normal,
                              depth_mesh *out_mesh);
void depth_mesh_free(depth_mesh *mesh); /**< Zeroed ones are allowed. */
