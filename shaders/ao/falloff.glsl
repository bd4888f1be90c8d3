#pragma once
// rho(d) of modules/ao/falloff.h, in the same order.
#include "ao/frame.glsl"

const int FALLOFF_LINEAR = 1, FALLOFF_QUADRATIC = 2, FALLOFF_WENDLAND = 3, FALLOFF_EXPONENTIAL = 4;

float falloff(float distance)
{
    if (!(distance < frame.r_max))
        return 0.0;
    float k = distance / frame.r_max;
    switch (frame.falloff) {
    case FALLOFF_LINEAR: return 1.0 - k;
    case FALLOFF_QUADRATIC: return 1.0 - k * k;
    case FALLOFF_WENDLAND: { float q = (1.0 - k) * (1.0 - k); return q * q * (4.0 * k + 1.0); }
    case FALLOFF_EXPONENTIAL: return exp(-frame.falloff_tau * k);
    }
    return 1.0; // hard
}
