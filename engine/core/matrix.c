#include "engine/core/matrix.h"
#include "engine/core/vector.h"
#include <math.h>

nook_matrix nook_matrix_identity(void)
{
    return nook_matrix_scale(1.0, 1.0, 1.0);
}

nook_matrix nook_matrix_translation(double x, double y, double z)
{
    nook_matrix r = nook_matrix_identity();
    r.m[12] = x, r.m[13] = y, r.m[14] = z;
    return r;
}

nook_matrix nook_matrix_scale(double x, double y, double z)
{
    return (nook_matrix){ { x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1 } };
}

nook_matrix nook_matrix_compose(const double translation[3], const double rotation[4], const double scale[3])
{
    double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
    return (nook_matrix){ {
        scale[0] * (1 - 2 * (y * y + z * z)),
        scale[0] * 2 * (x * y + w * z),
        scale[0] * 2 * (x * z - w * y),
        0,
        scale[1] * 2 * (x * y - w * z),
        scale[1] * (1 - 2 * (x * x + z * z)),
        scale[1] * 2 * (y * z + w * x),
        0,
        scale[2] * 2 * (x * z + w * y),
        scale[2] * 2 * (y * z - w * x),
        scale[2] * (1 - 2 * (x * x + y * y)),
        0,
        translation[0],
        translation[1],
        translation[2],
        1,
    } };
}

nook_matrix nook_matrix_multiply(const nook_matrix *a, const nook_matrix *b)
{
    nook_matrix r;
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a->m[k * 4 + row] * b->m[column * 4 + k];
            r.m[column * 4 + row] = sum;
        }
    }
    return r;
}

double nook_matrix_determinant3(const nook_matrix *a)
{
    const double *m = a->m;
    return m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) +
           m[8] * (m[1] * m[6] - m[5] * m[2]);
}

int nook_matrix_inverse_affine(const nook_matrix *a, nook_matrix *out)
{
    const double *m = a->m;
    double det = nook_matrix_determinant3(a);
    *out = nook_matrix_identity();
    if (!isfinite(det) || det == 0.0 || !isfinite(1.0 / det))
        return 0;
    double s = 1.0 / det;
    double i[9] = {
        /* row by row */
        s * (m[5] * m[10] - m[9] * m[6]), s * (m[8] * m[6] - m[4] * m[10]), s * (m[4] * m[9] - m[8] * m[5]),
        s * (m[9] * m[2] - m[1] * m[10]), s * (m[0] * m[10] - m[8] * m[2]), s * (m[8] * m[1] - m[0] * m[9]),
        s * (m[1] * m[6] - m[5] * m[2]),  s * (m[4] * m[2] - m[0] * m[6]),  s * (m[0] * m[5] - m[4] * m[1]),
    };
    nook_matrix r = nook_matrix_identity();
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            r.m[column * 4 + row] = i[row * 3 + column];
        r.m[12 + row] = -(i[row * 3] * m[12] + i[row * 3 + 1] * m[13] + i[row * 3 + 2] * m[14]);
    }
    for (int k = 0; k < 16; k++) {
        if (!isfinite(r.m[k]))
            return 0;
    }
    *out = r;
    return 1;
}

double nook_matrix_longest_axis(const nook_matrix *a)
{
    double longest = 0.0;
    for (int column = 0; column < 3; column++)
        longest = fmax(longest, nook_vector_length(a->m + column * 4));
    return longest;
}

nook_matrix nook_matrix_from_float(const float m[16])
{
    nook_matrix r;
    for (int i = 0; i < 16; i++)
        r.m[i] = m[i];
    return r;
}

void nook_matrix_to_float(const nook_matrix *a, float out[16])
{
    for (int i = 0; i < 16; i++)
        out[i] = (float)a->m[i];
}

static void apply(const nook_matrix *a, const double v[3], double w, double out[3])
{
    const double *m = a->m;
    double r[3];
    for (int row = 0; row < 3; row++)
        r[row] = m[row] * v[0] + m[4 + row] * v[1] + m[8 + row] * v[2] + m[12 + row] * w;
    out[0] = r[0], out[1] = r[1], out[2] = r[2];
}

void nook_matrix_apply_point(const nook_matrix *a, const double p[3], double out[3])
{
    apply(a, p, 1.0, out);
}

void nook_matrix_apply_vector(const nook_matrix *a, const double v[3], double out[3])
{
    apply(a, v, 0.0, out);
}

nook_matrix nook_matrix_look_at(const double eye[3], const double target[3], const double up[3])
{
    double back[3], right[3], above[3];
    nook_vector_add_scaled(eye, -1.0, target, back);
    nook_vector_normalize(back, back);
    nook_vector_cross(up, back, right);
    nook_vector_normalize(right, right);
    nook_vector_cross(back, right, above);
    nook_matrix view = nook_matrix_identity();
    for (int i = 0; i < 3; i++) {
        view.m[i * 4 + 0] = right[i];
        view.m[i * 4 + 1] = above[i];
        view.m[i * 4 + 2] = back[i];
        view.m[12] -= right[i] * eye[i];
        view.m[13] -= above[i] * eye[i];
        view.m[14] -= back[i] * eye[i];
    }
    return view;
}

nook_matrix nook_matrix_perspective_reversed(double fov_y_radians, double aspect, double z_near)
{
    double f = 1.0 / tan(0.5 * fov_y_radians);
    return (nook_matrix){ { f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, 0, -1, 0, 0, z_near, 0 } };
}
