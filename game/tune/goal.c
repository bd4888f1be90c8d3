#include "game/tune/goal.h"
#include <math.h>

double nook_tune_log_ratio(double a, double b)
{
    const double least = 1e-6;
    return log(fmax(a, least) / fmax(b, least));
}

static double excess_of(double value, double limit)
{
    return limit > 0.0 ? fmax(0.0, nook_tune_log_ratio(value, limit)) : 0.0;
}

double nook_tune_excess(const nook_tune_goal *goal, const nook_tune_cost *cost)
{
    return excess_of(cost->error, goal->max_error) + excess_of(cost->ms, goal->max_ms);
}

bool nook_tune_fits(const nook_tune_goal *goal, const nook_tune_cost *cost)
{
    return (goal->max_error == 0.0 || cost->error <= goal->max_error) &&
           (goal->max_ms == 0.0 || cost->ms <= goal->max_ms);
}

double nook_tune_objective(const nook_tune_goal *goal, const nook_tune_cost *cost)
{
    return goal->max_ms > 0.0 ? cost->error : cost->ms;
}

bool nook_tune_better(const nook_tune_goal *goal, const nook_tune_cost *a, const nook_tune_cost *b)
{
    bool a_fits = nook_tune_fits(goal, a), b_fits = nook_tune_fits(goal, b);
    if (a_fits != b_fits)
        return a_fits;
    double a_excess = nook_tune_excess(goal, a), b_excess = nook_tune_excess(goal, b);
    if (!a_fits && a_excess != b_excess)
        return a_excess < b_excess;
    return nook_tune_objective(goal, a) < nook_tune_objective(goal, b);
}
