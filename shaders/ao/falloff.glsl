#pragma once
// rho(d) of modules/ao/falloff.h, in the same order.
#include "ao/frame.glsl"

float falloff(float distance)
{
    if (!(distance < frame.r_max))
        return 0.0;
    float k = distance / frame.r_max;
    switch (frame.falloff) {
    case 1: return 1.0 - k;
    case 2: return 1.0 - k * k;
    case 3: { float q = (1.0 - k) * (1.0 - k); return q * q * (4.0 * k + 1.0); }
    case 4: return exp(-frame.falloff_tau * k);
    }
    return 1.0;
}
