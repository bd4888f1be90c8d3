#include "game/extremes/random_transform.h"
#include "modules/ao/sampling.h"
#include <math.h>

double nook_random_between(nook_random *random, double low, double high)
{
    uint32_t bits = nook_mix_bits(++random->state);
    return low + (high - low) * (bits / 4294967296.0);
}

void nook_random_turn(nook_random *random, double out_quaternion[4])
{
    double length = 0.0; /* a point of the unit ball in four dimensions, pushed to its surface */
    while (!(length > 0.01 && length <= 1.0)) {
        length = 0.0;
        for (int k = 0; k < 4; k++) {
            out_quaternion[k] = nook_random_between(random, -1.0, 1.0);
            length += out_quaternion[k] * out_quaternion[k];
        }
    }
    for (int k = 0; k < 4; k++)
        out_quaternion[k] /= sqrt(length);
}

nook_matrix nook_random_affine(nook_random *random, const double translation[3], double stretch, double shear)
{
    double turn[4], scale[3], half = 0.5 * log(stretch);
    nook_random_turn(random, turn);
    for (int axis = 0; axis < 3; axis++) {
        scale[axis] = exp(nook_random_between(random, -half, half));
        scale[axis] *= nook_random_between(random, -1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    }
    nook_matrix placed = nook_matrix_compose(translation, turn, scale), sheared = nook_matrix_identity();
    sheared.m[4] = nook_random_between(random, -shear, shear);
    sheared.m[8] = nook_random_between(random, -shear, shear);
    sheared.m[9] = nook_random_between(random, -shear, shear);
    return nook_matrix_multiply(&placed, &sheared);
}
