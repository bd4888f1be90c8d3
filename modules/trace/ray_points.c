#include "modules/trace/ray_points.h"
#include "modules/ao/sampling.h"
#include <math.h>
#include <stdlib.h>

static const float full_turn = 6.283185307179586f, steps = 8388608.0f; /* 2^23 to the unit interval */

/** The bits of both coordinates by turns, highest first (Morton 1966). */
static uint32_t place_of(const float point[2])
{
    uint32_t x = (uint32_t)(point[0] * 65536.0f), y = (uint32_t)(point[1] * 65536.0f), place = 0;
    for (int bit = 15; bit >= 0; bit--)
        place = place << 2 | (x >> bit & 1u) << 1 | (y >> bit & 1u);
    return place;
}

static int compare_places(const void *a, const void *b)
{
    uint32_t x = ((const nook_ray_point *)a)->place, y = ((const nook_ray_point *)b)->place;
    return (x > y) - (x < y);
}

void nook_ray_points_fill(nook_ray_point *points, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        float point[2];
        nook_sobol_point(i, 0, point);
        float angle = full_turn * point[1];
        points[i] = (nook_ray_point){ (uint32_t)(point[0] * steps), cosf(angle), sinf(angle), place_of(point) };
    }
    qsort(points, count, sizeof *points, compare_places);
}

nook_ray_shift nook_ray_shift_of_pixel(uint32_t x, uint32_t y, uint32_t seed)
{
    uint32_t hash = nook_mix_bits(x + nook_mix_bits(y + nook_mix_bits(seed)));
    float angle = full_turn * (float)(nook_mix_bits(hash) >> 9) / steps;
    return (nook_ray_shift){ hash >> 9, cosf(angle), sinf(angle) };
}

void nook_ray_point_direction(const nook_ray_point *point, const nook_ray_shift *shift, float out[3])
{
    float square = ((float)(point->square ^ shift->square) + 0.5f) / steps; /* never 0, never 1 */
    float radius = sqrtf(square);
    out[0] = radius * (point->cosine * shift->cosine - point->sine * shift->sine);
    out[1] = radius * (point->sine * shift->cosine + point->cosine * shift->sine);
    out[2] = sqrtf(1.0f - square);
}
