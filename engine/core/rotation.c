#include "engine/core/rotation.h"
#include "engine/core/angle.h"
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

static void normalize(const double q[4], double out[4])
{
    double length = sqrt(nook_vector_dot(q, q) + q[3] * q[3]);
    for (int i = 0; i < 4; i++)
        out[i] = q[i] / length;
}

void nook_rotation_multiply(const double a[4], const double b[4], double out[4])
{
    double v[3], w = a[3] * b[3] - nook_vector_dot(a, b);
    nook_vector_cross(a, b, v);
    for (int i = 0; i < 3; i++)
        v[i] += a[3] * b[i] + b[3] * a[i];
    out[0] = v[0], out[1] = v[1], out[2] = v[2], out[3] = w;
}

void nook_rotation_inverse(const double rotation[4], double out[4])
{
    for (int i = 0; i < 3; i++)
        out[i] = -rotation[i];
    out[3] = rotation[3];
}

void nook_rotation_apply(const double rotation[4], const double v[3], double out[3])
{
    double across[3], twice[3]; /* v + 2 w (q x v) + 2 q x (q x v) */
    nook_vector_cross(rotation, v, across);
    nook_vector_cross(rotation, across, twice);
    for (int i = 0; i < 3; i++)
        out[i] = v[i] + 2.0 * (rotation[3] * across[i] + twice[i]);
}

void nook_rotation_about(const double axis[3], double radians, double out[4])
{
    for (int i = 0; i < 3; i++)
        out[i] = axis[i] * sin(0.5 * radians);
    out[3] = cos(0.5 * radians);
}

void nook_rotation_from_degrees(const double degrees[3], double out[4])
{
    static const double axes[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    double turn[4], sum[4] = { 0, 0, 0, 1 };
    for (int i = 0; i < 3; i++) {
        nook_rotation_about(axes[i], degrees[i] * NOOK_DEGREE, turn);
        nook_rotation_multiply(turn, sum, sum);
    }
    normalize(sum, out);
}

/* Of orthonormal axes (Shepperd 1978): the largest of the four parts is found first, the others by dividing by it. */
static void from_axes(const double x[3], const double y[3], const double z[3], double out[4])
{
    const double parts[4] = { x[0] - y[1] - z[2], y[1] - x[0] - z[2], z[2] - x[0] - y[1], x[0] + y[1] + z[2] };
    int largest = 3;
    for (int i = 0; i < 3; i++)
        largest = parts[i] > parts[largest] ? i : largest;
    double part = 0.5 * sqrt(parts[largest] + 1.0), s = 0.25 / part;
    const double differences[3] = { y[2] - z[1], z[0] - x[2], x[1] - y[0] };
    const double sums[3] = { y[2] + z[1], z[0] + x[2], x[1] + y[0] }; /* of the two other axes */
    double q[4];
    for (int i = 0; i < 4; i++) {
        if (largest == 3 || i == 3)
            q[i] = differences[largest == 3 ? i % 3 : largest] * s;
        else
            q[i] = sums[(6 - largest - i) % 3] * s; /* the axis that is neither; unused where i is the largest */
    }
    q[largest] = part;
    normalize(q, out);
}

bool nook_rotation_from_matrix(const nook_matrix *matrix, double out_rotation[4], double out_scale[3])
{
    double axes[3][3], scale[3];
    for (int i = 0; i < 3; i++)
        scale[i] = nook_vector_length(matrix->m + 4 * i);
    if (nook_matrix_determinant3(matrix) < 0.0)
        scale[0] = -scale[0];
    double x[3];
    for (int i = 0; i < 3; i++)
        x[i] = matrix->m[i] * (scale[0] < 0.0 ? -1.0 : 1.0);
    if (!nook_vector_normalize(x, axes[0]))
        return false;
    nook_vector_add_scaled(matrix->m + 4, -nook_vector_dot(matrix->m + 4, axes[0]), axes[0], axes[1]);
    if (!nook_vector_normalize(axes[1], axes[1]))
        return false;
    nook_vector_cross(axes[0], axes[1], axes[2]);
    if (!(scale[2] > 0.0))
        return false;
    from_axes(axes[0], axes[1], axes[2], out_rotation);
    for (int i = 0; i < 3; i++)
        out_scale[i] = scale[i];
    return true;
}

void nook_rotation_advance(double rotation[4], const double angular_velocity[3], double seconds)
{
    double turn[3], step[4], turned[4];
    for (int i = 0; i < 3; i++)
        turn[i] = angular_velocity[i] * seconds;
    from_turn(turn, step);
    nook_rotation_multiply(step, rotation, turned);
    normalize(turned, rotation);
}

nook_matrix nook_rotation_matrix(const double rotation[4])
{
    const double nowhere[3] = { 0, 0, 0 }, unscaled[3] = { 1, 1, 1 };
    return nook_matrix_compose(nowhere, rotation, unscaled);
}
