/** ray_points_internal.h - where the rays of every pixel go: one set of points, shifted by each pixel on its own. */
#pragma once
#include <stdint.h>

/** A point of the unit square, ready to become a direction. */
typedef struct ray_point {
    float square;       /**< Of the distance from the axis on the unit disc. */
    float cosine, sine; /**< Of the angle around the axis. */
    uint32_t place;     /**< Along a curve through the square on which neighbours are close to each other. */
} ray_point;

/** A shift of all points by as much, around the edges of the square. */
typedef struct ray_shift {
    float square;
    float cosine, sine; /**< Of the angle they turn by. */
} ray_shift;

/** The first points of the (0,2)-sequence, by their place: so that rays which are traced together lie close together. */
void ray_points_fill(ray_point *points, uint32_t count);

/** A hash of the pixel and the seed: the shifts of any two pixels or seeds have nothing to do with each other. */
ray_shift ray_shift_of_pixel(uint32_t x, uint32_t y, uint32_t seed);

/** nook_cosine_direction of the shifted point. All angles turn alike, so that no ray needs a cosine of its own. */
void ray_point_direction(const ray_point *point, const ray_shift *shift, float out[3]);
