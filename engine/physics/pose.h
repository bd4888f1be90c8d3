/**
 * pose.h - places and turns of rigid bodies: a position and a unit quaternion (x, y, z, w), in double precision.
 *
 * A pose reads as a transform without scale: world_from_body. Named and multiplied like matrices.
 */
#pragma once
#include "engine/core/matrix.h"
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Where a body is. */
typedef struct nook_pose {
    double position[3]; /**< Of the body's origin, metres. */
    double rotation[4]; /**< world from body: unit, (x, y, z, w). */
} nook_pose;

nook_pose nook_pose_identity(void);
/** Whether its numbers are finite and its rotation is unit to within 1e-3. */
bool nook_pose_valid(const nook_pose *pose);
/** a * b: applies b first; its rotation is unit to the last digits. */
nook_pose nook_pose_multiply(const nook_pose *a, const nook_pose *b);
nook_pose nook_pose_inverse(const nook_pose *pose);
/** Of a point and of a direction. `out` may be the input. */
void nook_pose_apply_point(const nook_pose *pose, const double point[3], double out[3]);
void nook_pose_apply_vector(const nook_pose *pose, const double vector[3], double out[3]);
/** On the straight line and the shortest turn. @param t [0, 1]: exactly `from` at 0 and `to` at 1 */
nook_pose nook_pose_between(const nook_pose *from, const nook_pose *to, double t);
/** The angular velocity, radians per second, that turns one rotation into the other in that time on the shortest way. */
void nook_pose_turn_rate(const double from[4], const double to[4], double seconds, double out_angular[3]);
nook_matrix nook_pose_matrix(const nook_pose *pose);

#ifdef __cplusplus
}
#endif
