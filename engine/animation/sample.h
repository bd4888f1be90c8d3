/** sample.h - the value of a track at a time: glTF 2.0, appendix C. Pure functions on checked data. */
#pragma once
#include "engine/asset/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Before the first key and behind the last one it is theirs. Rotations are unit.
 * @param values   scene->track_values
 * @param seconds  finite
 * @param out      track->width numbers
 */
void nook_track_sample(const nook_track *track, const float *values, double seconds, double *out);

/**
 * Between two rotations along the shorter arc, at constant speed. @param a, b  unit quaternions @param t  [0, 1]
 * @param out  unit; may be an input
 */
void nook_rotation_slerp(const double a[4], const double b[4], double t, double out[4]);

#ifdef __cplusplus
}
#endif
