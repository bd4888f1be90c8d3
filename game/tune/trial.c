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

/* Mean, its standard error and the mean spread of the times that there are. */
static void pool_times(const nook_tune_view *views, uint32_t count, nook_tune_estimate *estimate)
{
    double sum = 0.0, spread = 0.0, squares = 0.0, timed = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        if (isnan(views[i].ms))
            continue;
        sum += views[i].ms;
        spread += views[i].ms_spread;
        timed += 1.0;
    }
    estimate->cost.ms = sum / timed;
    estimate->ms_spread = spread / timed;
    for (uint32_t i = 0; i < count; i++) {
        if (!isnan(views[i].ms))
            squares += pow(views[i].ms - estimate->cost.ms, 2.0);
    }
    estimate->ms_standard = timed > 1.0 ? sqrt(squares / (timed - 1.0) / timed) : NAN;
}

nook_tune_estimate nook_tune_pool(const nook_tune_view *views, uint32_t count)
{
    double squares = 0.0, noises = 0.0, pixels = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        squares += views[i].squared * views[i].pixels;
        noises += views[i].noise * views[i].noise * views[i].pixels;
        pixels += views[i].pixels;
    }
    /* Cut off at 0 only here: of each view alone that would make small errors larger than they are. */
    double mean = fmax(squares / pixels, 0.0);
    nook_tune_estimate estimate = { .cost.error = sqrt(mean), .noise = sqrt(noises / pixels), .views = count };
    estimate.error_standard = count > 1 ? standard_error(views, count, mean, pixels) : NAN;
    pool_times(views, count, &estimate);
    return estimate;
}

nook_tune_cost nook_tune_with_margin(const nook_tune_goal *goal, const nook_tune_estimate *estimate)
{
    nook_tune_cost cost = estimate->cost;
    if (goal->max_error > 0.0 && !isnan(estimate->error_standard))
        cost.error += estimate->error_standard;
    if (goal->max_ms > 0.0 && !isnan(estimate->ms_standard))
        cost.ms += estimate->ms_standard;
    return cost;
}

uint32_t nook_tune_round_up(double views, uint32_t period)
{
    return (uint32_t)ceil(views / period) * period;
}

/* So many views of each of two sets make `sure` sqrt(2 / n) sigma equal to `part`. */
static double needed(const nook_tune_estimate *estimate, double part, double sure)
{
    if (!(estimate->cost.error > 0.0) || estimate->views < 2)
        return INFINITY;
    double relative = estimate->error_standard / estimate->cost.error / part;
    return 2.0 * sure * sure * relative * relative * estimate->views;
}

double nook_tune_views_needed(const nook_tune_estimate *estimate, double part)
{
    return needed(estimate, part, 3.0);
}

double nook_tune_views_needed_surely(const nook_tune_estimate *estimate, double part)
{
    /* Student's t for what lies beyond 3 of the normal distribution, by Cornish and Fisher (Abramowitz and Stegun 26.7.5). */
    double degrees = estimate->views - 1.0;
    return needed(estimate, part, 3.0 + (7.5 + (17.25 + 30.1875 / degrees) / degrees) / degrees);
}
