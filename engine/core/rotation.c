#include "engine/core/rotation.h"
#include "engine/core/vector.h"
#include <math.h>

/* Of a turn by `turn` (axis times radians); sin(h) / h has no trouble at 0, only the division has. */
static void from_turn(const double turn[3], double out[4])
{
    double angle = nook_vector_length(turn), half = 0.5 * angle;
    double scale = half > 0.0 ? 0.5 * sin(half) / half : 0.5;
    for (int i = 0; i < 3; i++)
        out[i] = turn[i] * scale;
    out[3] = cos(half);
}

static void multiply(const double a[4], const double b[4], double out[4])
{
    nook_vector_cross(a, b, out);
    for (int i = 0; i < 3; i++)
        out[i] += a[3] * b[i] + b[3] * a[i];
    out[3] = a[3] * b[3] - nook_vector_dot(a, b);
}

void nook_rotation_advance(double rotation[4], const double angular_velocity[3], double seconds)
{
    double turn[3], step[4], turned[4];
    for (int i = 0; i < 3; i++)
        turn[i] = angular_velocity[i] * seconds;
    from_turn(turn, step);
    multiply(step, rotation, turned);
    double length = sqrt(nook_vector_dot(turned, turned) + turned[3] * turned[3]);
    for (int i = 0; i < 4; i++)
        rotation[i] = turned[i] / length;
}

nook_matrix nook_rotation_matrix(const double rotation[4])
{
    const double nowhere[3] = { 0, 0, 0 }, unscaled[3] = { 1, 1, 1 };
    return nook_matrix_compose(nowhere, rotation, unscaled);
}
