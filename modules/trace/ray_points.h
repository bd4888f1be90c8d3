/** ray_points.h - where the rays of every pixel go: one set of points, shifted by each pixel on its own. */
#pragma once
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A point of the unit square, ready to become a direction. */
typedef struct nook_ray_point {
    uint32_t square;    /**< Of the distance from the axis on the unit disc, in 2^-23. */
    float cosine, sine; /**< Of the angle around the axis. */
    uint32_t place;     /**< Along a curve through the square on which neighbours are close to each other. */
} nook_ray_point;

/**
 * A digital shift of the squares and a turn of all angles. Either keeps the points as well spread as they are, while a sum modulo 1
 * tears the spread apart where it wraps: at 256 rays that costs 7 to 10 % more noise.
 */
typedef struct nook_ray_shift {
    uint32_t square;    /**< 23 bits, to be combined by exclusive or. */
    float cosine, sine; /**< Of the angle all turn by. */
} nook_ray_shift;

/** The first points of the (0,2)-sequence, by their place: so that rays which are traced together lie close together. */
void nook_ray_points_fill(nook_ray_point *points, uint32_t count);

/** A hash of the pixel and the seed: the shifts of any two pixels or seeds have nothing to do with each other. */
nook_ray_shift nook_ray_shift_of_pixel(uint32_t x, uint32_t y, uint32_t seed);

/** nook_cosine_direction of the shifted point. All angles turn alike, so that no ray needs a cosine of its own. */
void nook_ray_point_direction(const nook_ray_point *point, const nook_ray_shift *shift, float out[3]);

#ifdef __cplusplus
}
#endif
