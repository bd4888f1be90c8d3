/**
 * surface.h - whether two pixels of a depth buffer show one surface or two with a gap between them.
 */
#pragma once
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What the centre of a pixel shows, in view space: the camera at the origin, looking along -Z. */
typedef struct nook_surface_point {
    double position[3]; /**< Metres; z < 0. */
    double normal[3];   /**< Unit, of the geometry. */
} nook_surface_point;

/** Rounding of a depth buffer of 24 bits and of positions in float, as a part of the distance: no gap is smaller. */
#define NOOK_SURFACE_ROUNDING 4e-6

/**
 * Whether one surface may reach from one pixel to its neighbour: one of the two lies in the other's plane to within the
 * distance of the two pixels, measured as large as pixels are there (nook_match asks the same of its points).
 *
 * This is not a tuned number. In tangent coordinates u = xy / -z a plane is 1 / -z = a + b u; the distance of a point (u, z)
 * from the plane through another at u' is -z |u - u'| |b - s| / sqrt(a^2 + b^2), s being the slope from one point to the
 * other. Where a surface bends only one way between the two (a plane, an edge, a corner, a ball: at any slant), s lies between
 * the slopes b of the two planes, so between 0 and one of them, and there the distance is at most -z |u - u'|. So none of these
 * is cut. What is joined wrongly is a smaller step: less than a pixel between walls that face the camera, and behind a slanted
 * surface one that ends not far from where the slope would have led.
 */
bool nook_surface_joins(const nook_surface_point *a, const nook_surface_point *b);

#ifdef __cplusplus
}
#endif
