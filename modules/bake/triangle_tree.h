/**
 * triangle_tree.h - how far the nearest of some triangles is: a tree of boxes; inside modules/bake only.
 */
#pragma once
#include "modules/bake/triangle_grid.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_triangle_tree nook_triangle_tree;

/** Copies the triangles. Degenerate ones are segments and points. @return NULL when there is no memory */
nook_triangle_tree *nook_triangle_tree_create(const nook_snapped_triangle *triangles, size_t count);
void nook_triangle_tree_destroy(nook_triangle_tree *tree); /**< NULL is allowed. */

/**
 * The squared distance from a point to the nearest triangle, all in steps of 1 / NOOK_SUBVOXEL voxel; exact but for rounding of doubles.
 * @param limit  squared: what is not nearer is not looked for
 * @param hint   in: a triangle that may be near, as a former call gave it, 0 at first; out: the nearest one. It changes how long the
 *               search takes, and nothing else.
 * @return limit when no triangle is nearer
 */
double nook_triangle_tree_distance(const nook_triangle_tree *tree, const double point[3], double limit, uint32_t *hint);

#ifdef __cplusplus
}
#endif
