#pragma once
#include <math.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Vectors of three doubles, for what is far from the origin or a small difference of large numbers (why these are ours:
 * engine/core/matrix.h). Where single precision is meant, in .c files only: <cglm/cglm.h>, glm_vec3_*.
 *
 * `out` may be an input everywhere.
 */

static inline double nook_vector_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void nook_vector_cross(const double a[3], const double b[3], double out[3])
{
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    out[0] = x, out[1] = y, out[2] = z;
}

/** Infinite or 0 for lengths outside about 1e-154 .. 1e154, whose squares are not doubles. */
static inline double nook_vector_length(const double v[3])
{
    return sqrt(nook_vector_dot(v, v));
}

/** a + scale * b. */
static inline void nook_vector_add_scaled(const double a[3], double scale, const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] + scale * b[i];
}

/** to - from, of points in float: rounded once, in double, so that short edges far from the origin keep their direction. */
static inline void nook_vector_between(const float from[3], const float to[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (double)to[i] - (double)from[i];
}

/**
 * To length 1, at any finite length: areas of tiny triangles are too small for their squares.
 * @return false when v is 0 or not finite: it has no direction; out is untouched then
 */
static inline bool nook_vector_normalize(const double v[3], double out[3])
{
    double u[3] = { v[0], v[1], v[2] }, length = nook_vector_length(u);
    if (!(length > 1e-140 && length < 1e140)) { /* squares may have left the range */
        double largest = fmax(fabs(u[0]), fmax(fabs(u[1]), fabs(u[2])));
        for (int i = 0; i < 3; i++)
            u[i] /= largest; /* NaN for 0 and for infinity */
        length = nook_vector_length(u);
    }
    if (!isfinite(length))
        return false;
    for (int i = 0; i < 3; i++)
        out[i] = u[i] / length;
    return true;
}

#ifdef __cplusplus
}
#endif
