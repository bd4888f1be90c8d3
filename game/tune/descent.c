#include "game/tune/descent.h"
#include "game/tune/surrogate.h"
#include "modules/ao/technique.h"
#include <math.h>
#include <stdio.h>

enum { STEP_FIRST = 2, PROMISES_MAX = 16, VAIN_MAX = 4, ROUNDS_MAX = 5 };

static const nook_tune_ladders *ladders_of(const nook_tune_trials *trials, uint32_t technique)
{
    return &trials->desc->space->techniques[technique];
}

/* ---- Single steps ------------------------------------------------------------------------------------------------ */

static nook_result try_step(nook_tune_trials *trials, const nook_tune_point *from, uint32_t axis, int rungs)
{
    char doing[96];
    nook_tune_point point = *from;
    const nook_tune_ladders *ladders = ladders_of(trials, from->technique);
    /* An axis whose ladder ends before a whole step is tried with a smaller one. */
    while (rungs != 0 && !nook_tune_step(trials->desc->space, &point, axis, rungs))
        rungs += rungs < 0 ? 1 : -1;
    if (rungs == 0 || !nook_tune_trials_open(trials))
        return NOOK_OK;
    snprintf(doing, sizeof doing, "%.24s: %.48s", ladders->technique->name, ladders->axes[axis].name);
    return nook_tune_trials_try(trials, doing, &point);
}

static nook_result try_axis(nook_tune_trials *trials, const nook_tune_point *from, uint32_t axis, int step)
{
    const nook_tune_axis *a = &ladders_of(trials, from->technique)->axes[axis];
    nook_result result = NOOK_OK;
    if (a->ordered) {
        result = try_step(trials, from, axis, -step);
        return result == NOOK_OK ? try_step(trials, from, axis, step) : result;
    }
    for (int rung = 0; rung < (int)a->rung_count && result == NOOK_OK; rung++) {
        if (rung != from->rungs[axis])
            result = try_step(trials, from, axis, rung - from->rungs[axis]);
    }
    return result;
}

/* ---- What the fit promises ---------------------------------------------------------------------------------------- */

/*
 * The fit is a few percent off, and the best settings lie at the budget's edge: what it takes for a little outside may be within. So
 * the edge is moved out by and by as long as nothing comes of it.
 */
static bool choose(const nook_tune_trials *trials, const nook_tune_surrogate *surrogate, const nook_tune_cost *best,
                   int *vain, nook_tune_point *out_point)
{
    for (; *vain < VAIN_MAX; ++*vain) {
        const nook_tune_goal *goal = &trials->desc->goal;
        const double slack = 1.0 + 0.015 * *vain;
        const nook_tune_goal wider = { goal->max_error * slack, goal->max_ms * slack };
        if (nook_tune_surrogate_choose(surrogate, trials, &wider, best, out_point))
            return true;
    }
    return false;
}

/* Until it promises nothing better, or has been wrong a few times in a row. */
static nook_result follow_promises(nook_tune_trials *trials, uint32_t technique)
{
    char doing[64];
    snprintf(doing, sizeof doing, "%.24s: combinations", ladders_of(trials, technique)->technique->name);
    int vain = 0;
    for (int i = 0; i < PROMISES_MAX && vain < VAIN_MAX && nook_tune_trials_open(trials); i++) {
        nook_tune_surrogate surrogate;
        nook_tune_point point;
        const nook_tune_trial *before = nook_tune_trials_best(trials, technique);
        nook_tune_cost best = nook_tune_trials_cost(trials, before);
        if (!nook_tune_surrogate_fit(trials, technique, &surrogate) ||
            !choose(trials, &surrogate, &best, &vain, &point))
            return NOOK_OK;
        nook_result result = nook_tune_trials_try(trials, doing, &point);
        if (result != NOOK_OK)
            return result;
        vain = before == nook_tune_trials_best(trials, technique) ? vain + 1 : 0;
    }
    return NOOK_OK;
}

/* ---- Rounds ------------------------------------------------------------------------------------------------------ */

static nook_result go_round(nook_tune_trials *trials, const nook_tune_point *from, int step)
{
    nook_result result = NOOK_OK;
    for (uint32_t axis = 0; axis < ladders_of(trials, from->technique)->axis_count && result == NOOK_OK; axis++)
        result = try_axis(trials, from, axis, step);
    return result == NOOK_OK ? follow_promises(trials, from->technique) : result;
}

/* Whether a technique is so far behind another one that small steps cannot make up for it. */
static bool is_beaten(const nook_tune_trials *trials, uint32_t technique)
{
    const double hopeless = log(1.5);
    const nook_tune_goal *goal = &trials->desc->goal;
    const nook_tune_trial *best = nook_tune_trials_best(trials, UINT32_MAX);
    if (best->point.technique == technique)
        return false;
    nook_tune_cost ahead = nook_tune_trials_cost(trials, best);
    nook_tune_cost own = nook_tune_trials_cost(trials, nook_tune_trials_best(trials, technique));
    double behind = nook_tune_excess(goal, &own) - nook_tune_excess(goal, &ahead);
    if (nook_tune_fits(goal, &own))
        behind = nook_tune_log_ratio(nook_tune_objective(goal, &own), nook_tune_objective(goal, &ahead));
    return behind > hopeless;
}

nook_result nook_tune_descend(nook_tune_trials *trials, uint32_t technique)
{
    int step = STEP_FIRST;
    for (int round = 0; round < ROUNDS_MAX && nook_tune_trials_open(trials); round++) {
        nook_tune_point from = nook_tune_trials_best(trials, technique)->point;
        nook_result result = go_round(trials, &from, step);
        if (result != NOOK_OK)
            return result;
        bool moved = !nook_tune_same(&from, &nook_tune_trials_best(trials, technique)->point);
        if ((!moved && step == 1) || is_beaten(trials, technique))
            break;
        step = 1;
    }
    return NOOK_OK;
}
