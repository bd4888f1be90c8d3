#include "game/tune/trial.h"
#include <math.h>

/*
 * The mean squared error is a ratio of sums, that of the squares over that of the pixels; its variance is the usual one of a ratio
 * (Cochran, Sampling Techniques, 6.4), and the root halves the relative error. Evenly spread views differ less from the whole than
 * random ones: it errs on the safe side.
 */
static double standard_error(const nook_tune_view *views, uint32_t count, double mean, double pixels)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        double difference = views[i].pixels * (views[i].squared - mean);
        sum += difference * difference;
    }
    double variance = sum / (pixels * pixels) * count / (count - 1.0);
    return mean > 0.0 ? 0.5 * sqrt(variance) / sqrt(mean) : 0.0;
}

nook_tune_estimate nook_tune_pool(const nook_tune_view *views, uint32_t count)
{
    double squares = 0.0, pixels = 0.0, ms = 0.0;
    uint32_t timed = 0;
    for (uint32_t i = 0; i < count; i++) {
        squares += views[i].squared * views[i].pixels;
        pixels += views[i].pixels;
        if (isnan(views[i].ms))
            continue;
        ms += views[i].ms;
        timed++;
    }
    double mean = squares / pixels;
    nook_tune_estimate estimate = { .cost = { sqrt(fmax(mean, 0.0)), ms / timed }, .views = count };
    estimate.error_standard = count > 1 ? standard_error(views, count, mean, pixels) : NAN;
    return estimate;
}

double nook_tune_views_needed(const nook_tune_estimate *estimate, double part)
{
    double relative = estimate->error_standard / estimate->cost.error;
    return 18.0 * relative * relative * estimate->views / (part * part); /* 3 sqrt(2 / n) sigma <= part */
}
