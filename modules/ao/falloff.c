#include "modules/ao/falloff.h"
#include <math.h>

double nook_falloff_evaluate(nook_falloff falloff, double distance, double r_max, double tau)
{
    if (!(distance < r_max))
        return 0.0;
    double k = distance / r_max;
    switch (falloff) {
    case NOOK_FALLOFF_HARD:
        return 1.0;
    case NOOK_FALLOFF_LINEAR:
        return 1.0 - k;
    case NOOK_FALLOFF_QUADRATIC:
        return 1.0 - k * k;
    case NOOK_FALLOFF_WENDLAND:
        return (1.0 - k) * (1.0 - k) * (1.0 - k) * (1.0 - k) * (4.0 * k + 1.0);
    case NOOK_FALLOFF_EXPONENTIAL:
        return exp(-tau * k);
    }
    return 0.0;
}
