/** random_transform.h - transforms as they come: turned, mirrored, stretched, sheared. The same for the same seed. */
#pragma once
#include "engine/core/matrix.h"
#include <stdint.h>

/** A stream of numbers. Start it from any seed. */
typedef struct nook_random {
    uint32_t state;
} nook_random;

/** Uniform in [low, high). */
double nook_random_between(nook_random *random, double low, double high);
/** A unit quaternion, uniform over all turns. */
void nook_random_turn(nook_random *random, double out_quaternion[4]);

/**
 * Translation * turn * scale * shear.
 * @param stretch  the axes' scales differ by at most this factor; >= 1. Each is negative half of the time
 * @param shear    off-diagonal entries are in [-shear, shear]
 */
nook_matrix nook_random_affine(nook_random *random, const double translation[3], double stretch, double shear);
