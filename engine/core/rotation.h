/**
 * rotation.h - rotations as unit quaternions (x, y, z, w) in double precision, that turn a little every frame and do not drift.
 *
 * Why not a matrix that is multiplied by a small rotation every frame: each product rounds nine numbers that should stay
 * orthonormal, nothing pulls them back, and the body slowly shears and grows (in float: docs/measuring.md, Extremes). A quaternion
 * can only be too long or too short, which one division mends; the matrix made from it anew is orthonormal to its last digits.
 */
#pragma once
#include "engine/core/matrix.h"
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * One frame of turning: by |angular_velocity| * seconds radians about the axis angular_velocity, which stands in the space that the
 * rotation leads to (the world's for world_from_local), after what `rotation` already does. Exact for a constant velocity at
 * any step, large or small; N frames are off by less than N * 4 * 2.2e-16 radians in the angle.
 * @param rotation          unit to within 1e-3; is unit to the last digits afterwards
 * @param angular_velocity  radians per second, right-handed; finite
 */
void nook_rotation_advance(double rotation[4], const double angular_velocity[3], double seconds);

/** a * b: turns by b first. `out` may be an input. */
void nook_rotation_multiply(const double a[4], const double b[4], double out[4]);
/** The turn back, of a unit one. `out` may be the input. */
void nook_rotation_inverse(const double rotation[4], double out[4]);
/** Turns a vector. `out` may be the input. */
void nook_rotation_apply(const double rotation[4], const double v[3], double out[3]);
/** By `radians` about an axis, right-handed. @param axis unit */
void nook_rotation_about(const double axis[3], double radians, double out[4]);
/** About x, then y, then z, of the space that does not turn. @param degrees of each */
void nook_rotation_from_degrees(const double degrees[3], double out[4]);
/**
 * Takes a transform apart into a rotation and a scale along its own axes: matrix = rotation * scale where it has no shear; with
 * shear, the rotation is that of its x axis and the plane of x and y. A mirroring one has its first scale negative.
 * @return false: an axis has no length; the outputs are untouched then
 */
bool nook_rotation_from_matrix(const nook_matrix *matrix, double out_rotation[4], double out_scale[3]);

/** The rotation alone; its columns are orthonormal to about 4 * 2.2e-16. @param rotation unit */
nook_matrix nook_rotation_matrix(const double rotation[4]);

#ifdef __cplusplus
}
#endif
