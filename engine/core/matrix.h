#pragma once

#ifdef __cplusplus
extern "C" {
#endif

/**
 * 4x4 matrices in double precision. Column-major, column vectors, like every matrix in Nook; the name says to_from.
 * Transforms are composed here and only the (small, relative) product goes to the GPU as float: see docs/architecture.md.
 *
 * Why not cglm, which does all our mathematics in single precision: it has floats only. A float at 1 km from the origin is
 * 0.06 mm wide, at 100 km 8 mm; view_from_world * world_from_mesh subtracts two such numbers, and what is left would shake
 * from frame to frame. So composing, inverting and looking at are ours, and so are vectors in double (engine/core/vector.h).
 */
typedef struct nook_matrix {
    double m[16]; /**< m[column * 4 + row]. */
} nook_matrix;

nook_matrix nook_matrix_identity(void);
nook_matrix nook_matrix_translation(double x, double y, double z);
nook_matrix nook_matrix_scale(double x, double y, double z);
/** From glTF-style parts: translation, unit quaternion (x, y, z, w), scale. Applied scale first. */
nook_matrix nook_matrix_compose(const double translation[3], const double rotation[4], const double scale[3]);
/** a * b: applies b first. */
nook_matrix nook_matrix_multiply(const nook_matrix *a, const nook_matrix *b);
/**
 * Inverse of an affine matrix (bottom row 0 0 0 1).
 * @return 0 when the matrix is singular or not finite (*out is the identity then), else 1
 */
int nook_matrix_inverse_affine(const nook_matrix *a, nook_matrix *out);
double nook_matrix_determinant3(const nook_matrix *a); /**< Of the upper left 3x3. */
/** Length of the longest of the first three columns: by so much it lengthens an axis at most. */
double nook_matrix_longest_axis(const nook_matrix *a);
nook_matrix nook_matrix_from_float(const float m[16]);
void nook_matrix_to_float(const nook_matrix *a, float out[16]);
/** a * (p, 1) and a * (v, 0). `out` may be the input. */
void nook_matrix_apply_point(const nook_matrix *a, const double p[3], double out[3]);
void nook_matrix_apply_vector(const nook_matrix *a, const double v[3], double out[3]);

/** View from world: right-handed, looking from `eye` to `target` along -Z. up must not be parallel to the view direction. */
nook_matrix nook_matrix_look_at(const double eye[3], const double target[3], const double up[3]);
/**
 * Clip from view, reversed-Z with an infinite far plane: depth 1 at z_near, 0 at infinity (clip control 0..1).
 * @param fov_y_radians  vertical field of view, (0, pi)
 */
nook_matrix nook_matrix_perspective_reversed(double fov_y_radians, double aspect, double z_near);

#ifdef __cplusplus
}
#endif
