/**
 * edit.h - in which bricks a soup differs from what it was before it was edited; inside modules/bake only.
 */
#pragma once
#include "modules/bake/triangle_grid.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_edit_soup {
    const nook_triangles *triangles; /**< Checked. */
    const nook_alphas *alphas;       /**< NULL: all is opaque. */
} nook_edit_soup;

/**
 * Sets the bytes of the bricks that triangles may lie in which are not in both soups.
 * @param frame  the grid of both @param bricks  of each level all of its grid, 0; NULL: it is not wanted
 * @return NOOK_E_MEMORY, not logged
 */
nook_result nook_edit_find(const nook_edit_soup *before, const nook_edit_soup *after, const nook_grid_frame *frame,
                           uint8_t *const bricks[NOOK_VOXELIZE_LEVELS]);

#ifdef __cplusplus
}
#endif
