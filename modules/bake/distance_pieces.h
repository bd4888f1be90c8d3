/**
 * distance_pieces.h - what of a soup is there, as triangles: what distances are measured to; inside modules/bake only.
 *
 * A distance has no alpha, and no detail below a voxel. So what lies in a voxel of the triangles of a part that is not opaque is there where
 * their alpha, in the mean of the area in there, is at least a half, and else it is not: no rule that says yes or no is less wrong, and a
 * grating that a voxel cannot show is a wall or nothing, whichever it is nearer to. Triangles without area are there by the alpha at their middle.
 */
#pragma once
#include "modules/bake/triangle_grid.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_distance_pieces {
    nook_snapped_triangle *triangles; /**< Owned. */
    size_t count, capacity;
    bool cut; /**< Some are parts of triangles, with corners that were rounded once more. */
} nook_distance_pieces;

/**
 * @param alphas  NULL: all is opaque @param frame  of the checked soup
 * @return NOOK_E_MEMORY, not logged; *out is untouched then
 */
nook_result nook_distance_pieces_make(const nook_triangles *triangles, const nook_alphas *alphas,
                                      const nook_grid_frame *frame, nook_distance_pieces *out);
void nook_distance_pieces_free(nook_distance_pieces *pieces); /**< Zeroed ones are allowed. */

#ifdef __cplusplus
}
#endif
