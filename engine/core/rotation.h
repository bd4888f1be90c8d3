/**
 * rotation.h - rotations as unit quaternions (x, y, z, w) in double precision, that turn a little every frame and do not drift.
 *
 * Why not a matrix that is multiplied by a small rotation every frame: each product rounds nine numbers that should stay
 * orthonormal, nothing pulls them back, and the body slowly shears and grows (in float: docs/measuring.md, Extremes). A quaternion
 * can only be too long or too short, which one division mends; the matrix made from it anew is orthonormal to its last digits.
 */
#pragma once
#include "engine/core/matrix.h"

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

/** The rotation alone; its columns are orthonormal to about 4 * 2.2e-16. @param rotation unit */
nook_matrix nook_rotation_matrix(const double rotation[4]);

#ifdef __cplusplus
}
#endif
