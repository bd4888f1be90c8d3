/**
 * alpha_area.h - how much of a piece of surface its texture leaves; inside modules/bake only.
 *
 * A piece is cut into texels, or where it has more than NOOK_ALPHA_BLOCKS of them along a side into blocks of texels, whose mean is
 * exact (sums over rectangles of a texture are four look-ups: Crow, "Summed-Area Tables for Texture Mapping", 1984). So area is exact
 * for pieces of few texels, and for others but for the blocks at their edges.
 */
#pragma once
#include "engine/core/alpha.h"
#include "modules/bake/polygon.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { NOOK_ALPHA_BLOCKS = 16 };

/** The sums of all parts' textures: 8 bytes for each texel, once for parts that share one in the same way. */
typedef struct nook_alpha_areas nook_alpha_areas;

/** @param alphas  sound; NULL: none @return NULL when there is no memory */
nook_alpha_areas *nook_alpha_areas_create(const nook_alphas *alphas);
void nook_alpha_areas_destroy(nook_alpha_areas *areas); /**< NULL is allowed. */

/** Where on its texture a triangle's points lie: along u and v at dot(normal, x) + offset, in texels. */
typedef struct nook_alpha_map {
    double normal[2][3], offset[2];
} nook_alpha_map;

/** @param corners  of the triangle, not on one line @param uvs  theirs, 0 to 1 */
nook_alpha_map nook_alpha_map_make(const double corners[3][3], const double uvs[3][2], const nook_alpha_part *part);

/** Takes a part of the piece, and what of light it holds back: above 0, up to 1. */
typedef void (*nook_alpha_visit)(void *user, const nook_polygon *polygon, double alpha);

/**
 * Cuts a piece where its alpha changes; what is not there is not visited.
 * @param part  of the alphas that `areas` were made of @param map  may be NULL for a part without texture
 * @param polygon  of at most NOOK_POLYGON_CORNERS - 4 corners
 */
void nook_alpha_cut(const nook_alpha_areas *areas, const nook_alpha_part *part, const nook_alpha_map *map,
                    const nook_polygon *polygon, nook_alpha_visit visit, void *user);

#ifdef __cplusplus
}
#endif
