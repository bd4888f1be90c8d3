/**
 * polygon.h - convex polygons cut by planes, and their moments; inside modules/bake only.
 */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

/** A triangle cut by the six faces of a voxel and the four sides of a texel has 13 corners; one to spare. */
enum { NOOK_POLYGON_CORNERS = 14 };

typedef struct nook_polygon {
    double corner[NOOK_POLYGON_CORNERS][3];
    int count; /**< 0 or 3 to NOOK_POLYGON_CORNERS. */
} nook_polygon;

/** Area, and the integrals of x and of x x^T over it. */
typedef struct nook_polygon_moments {
    double area, first[3];
    double second[6]; /**< xx, yy, zz, xy, yz, zx. */
} nook_polygon_moments;

/** What of `polygon` has dot(normal, x) >= offset. `out` may not be `polygon`; of a part without area some corners may be left. */
void nook_polygon_clip(const nook_polygon *polygon, const double normal[3], double offset, nook_polygon *out);
/** The parts of `polygon` below and above x[axis] = at, which share the corners on it. */
void nook_polygon_split(const nook_polygon *polygon, int axis, double at, nook_polygon *out_below,
                        nook_polygon *out_above);

/** @param normal  of unit length, across the polygon, either way @param origin  the moments are about it */
nook_polygon_moments nook_polygon_measure(const nook_polygon *polygon, const double normal[3], const double origin[3]);

/** Where the plane dot(normal, x) = offset cuts the cube from `low` to low + 1 on each axis. @param normal  of unit length */
void nook_polygon_of_cube(const double normal[3], double offset, double low, nook_polygon *out);

#ifdef __cplusplus
}
#endif
