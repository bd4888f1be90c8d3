#include "game/tune/surrogate.h"
#include <assert.h>
#include <math.h>
#include <string.h>

/* ---- The terms ---------------------------------------------------------------------------------------------------- */

/* Rungs are counted from the centre, in fours: a count that is four times as large is at 1. */
static uint32_t terms_of(const nook_tune_ladders *ladders, const nook_tune_point *centre, const nook_tune_point *point,
                         double out[NOOK_TUNE_TERMS_MAX])
{
    uint32_t count = 0;
    out[count++] = 1.0;
    for (uint32_t i = 0; i < ladders->axis_count; i++) {
        const nook_tune_axis *axis = &ladders->axes[i];
        double x = (point->rungs[i] - centre->rungs[i]) / 4.0;
        assert(count + axis->rung_count <= NOOK_TUNE_TERMS_MAX || axis->ordered);
        if (axis->ordered) {
            out[count++] = x;
            out[count++] = x * x;
            continue;
        }
        for (uint32_t rung = 0; rung < axis->rung_count; rung++)
            out[count++] = rung == point->rungs[i] ? 1.0 : 0.0;
    }
    return count;
}

/* ---- Weighted least squares --------------------------------------------------------------------------------------- */

typedef struct equations {
    double matrix[NOOK_TUNE_TERMS_MAX][NOOK_TUNE_TERMS_MAX];
    double error[NOOK_TUNE_TERMS_MAX], ms[NOOK_TUNE_TERMS_MAX];
    uint32_t count;
} equations;

static void add_trial(equations *e, const double *terms, const nook_tune_cost *cost, double weight)
{
    for (uint32_t i = 0; i < e->count; i++) {
        for (uint32_t k = 0; k < e->count; k++)
            e->matrix[i][k] += weight * terms[i] * terms[k];
        e->error[i] += weight * terms[i] * log(cost->error);
        e->ms[i] += weight * terms[i] * log(cost->ms);
    }
}

/* Cholesky, in place. The ridge makes the matrix positive definite. */
static void factorise(equations *e)
{
    for (uint32_t i = 0; i < e->count; i++) {
        for (uint32_t k = 0; k <= i; k++) {
            double sum = e->matrix[i][k];
            for (uint32_t j = 0; j < k; j++)
                sum -= e->matrix[i][j] * e->matrix[k][j];
            e->matrix[i][k] = i == k ? sqrt(fmax(sum, 1e-12)) : sum / e->matrix[k][k];
        }
    }
}

static void solve(const equations *e, const double *right, double *out)
{
    for (uint32_t i = 0; i < e->count; i++) {
        out[i] = right[i];
        for (uint32_t k = 0; k < i; k++)
            out[i] -= e->matrix[i][k] * out[k];
        out[i] /= e->matrix[i][i];
    }
    for (uint32_t i = e->count; i-- > 0;) {
        for (uint32_t k = i + 1; k < e->count; k++)
            out[i] -= e->matrix[k][i] * out[k];
        out[i] /= e->matrix[i][i];
    }
}

/* ---- Fit and prediction ------------------------------------------------------------------------------------------- */

/* Falls with what the trial does (halved at half as much again of error, at twice the time) and with how far its rungs are. */
static double weight_of(const nook_tune_surrogate *s, const nook_tune_point *point, const nook_tune_cost *cost,
                        const nook_tune_cost *best)
{
    double error = log(cost->error / best->error) / log(1.5), ms = log(cost->ms / best->ms) / log(2.0);
    double distance = error * error + ms * ms;
    for (uint32_t i = 0; i < s->ladders->axis_count; i++) {
        double rungs = point->rungs[i] - s->centre.rungs[i];
        distance += s->ladders->axes[i].ordered ? rungs * rungs / 16.0 : rungs != 0.0;
    }
    return 1.0 / (1.0 + distance);
}

bool nook_tune_surrogate_fit(const nook_tune_trials *trials, uint32_t technique, nook_tune_surrogate *out)
{
    const double ridge = 3e-3; /* against the weights, of which the best trial's is 1 */
    const nook_tune_trial *best = nook_tune_trials_best(trials, technique);
    nook_tune_cost best_cost = nook_tune_trials_cost(trials, best);
    double terms[NOOK_TUNE_TERMS_MAX];
    equations e = { .count = 0 };
    *out = (nook_tune_surrogate){ .ladders = &trials->desc->space->techniques[technique], .centre = best->point };
    if (!(best_cost.error > 0.0))
        return false;
    e.count = out->terms = terms_of(out->ladders, &out->centre, &best->point, terms);
    for (uint32_t i = 1; i < e.count; i++) /* the constant is free */
        e.matrix[i][i] = ridge;
    for (uint32_t i = 0; i < trials->count; i++) {
        const nook_tune_trial *trial = &trials->items[i];
        nook_tune_cost cost = nook_tune_trials_cost(trials, trial);
        if (trial->point.technique != technique || !(cost.error > 0.0))
            continue;
        terms_of(out->ladders, &out->centre, &trial->point, terms);
        add_trial(&e, terms, &cost, weight_of(out, &trial->point, &cost, &best_cost));
    }
    factorise(&e);
    solve(&e, e.error, out->error);
    solve(&e, e.ms, out->ms);
    return true;
}

nook_tune_cost nook_tune_surrogate_predict(const nook_tune_surrogate *surrogate, const nook_tune_point *point)
{
    double terms[NOOK_TUNE_TERMS_MAX] = { 0.0 }, error = 0.0, ms = 0.0;
    terms_of(surrogate->ladders, &surrogate->centre, point, terms);
    for (uint32_t i = 0; i < surrogate->terms; i++) {
        error += surrogate->error[i] * terms[i];
        ms += surrogate->ms[i] * terms[i];
    }
    return (nook_tune_cost){ exp(error), exp(ms) };
}

/* ---- The next one ------------------------------------------------------------------------------------------------- */

/* Rungs of each axis between the lowest and the highest that were tried, and two beyond: further off nothing is known. */
typedef struct ranges {
    uint8_t low[NOOK_TUNE_AXES_MAX], high[NOOK_TUNE_AXES_MAX];
} ranges;

static ranges tried_ranges(const nook_tune_surrogate *s, const nook_tune_trials *trials)
{
    enum { BEYOND = 2 };
    ranges r;
    memcpy(r.low, s->centre.rungs, sizeof r.low);
    memcpy(r.high, s->centre.rungs, sizeof r.high);
    for (uint32_t i = 0; i < trials->count; i++) {
        const nook_tune_point *point = &trials->items[i].point;
        for (uint32_t k = 0; k < s->ladders->axis_count && point->technique == s->centre.technique; k++) {
            r.low[k] = point->rungs[k] < r.low[k] ? point->rungs[k] : r.low[k];
            r.high[k] = point->rungs[k] > r.high[k] ? point->rungs[k] : r.high[k];
        }
    }
    for (uint32_t k = 0; k < s->ladders->axis_count; k++) {
        int beyond = s->ladders->axes[k].ordered ? BEYOND : 0, last = (int)s->ladders->axes[k].rung_count - 1;
        r.low[k] = (uint8_t)(r.low[k] > beyond ? r.low[k] - beyond : 0);
        r.high[k] = (uint8_t)(r.high[k] + beyond < last ? r.high[k] + beyond : last);
    }
    return r;
}

bool nook_tune_surrogate_choose(const nook_tune_surrogate *surrogate, const nook_tune_trials *trials,
                                const nook_tune_goal *goal, const nook_tune_cost *best, nook_tune_point *out_point)
{
    const ranges r = tried_ranges(surrogate, trials);
    nook_tune_point point = surrogate->centre;
    nook_tune_cost least = *best;
    bool found = false;
    memcpy(point.rungs, r.low, sizeof point.rungs);
    for (bool more = true; more;) {
        nook_tune_cost cost = nook_tune_surrogate_predict(surrogate, &point);
        if (nook_tune_better(goal, &cost, &least) && !nook_tune_trials_find(trials, &point)) {
            found = true;
            least = cost;
            *out_point = point;
        }
        more = false;
        for (uint32_t i = 0; i < surrogate->ladders->axis_count && !more; i++) {
            more = point.rungs[i] < r.high[i];
            point.rungs[i] = more ? (uint8_t)(point.rungs[i] + 1) : r.low[i];
        }
    }
    return found;
}
