#include "game/tune/search.h"
#include "engine/core/log.h"
#include "game/tune/descent.h"
#include "modules/ao/technique.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SURVIVORS = 3, CONFIRMATIONS_MAX = 24, AGAIN_MAX = 3 };
/* A technique whose best anchor is by this factor further from the budget than another's, or worse within it, is left alone. */
static const double hopeless_factor = 1.8;

/* ---- Anchors ------------------------------------------------------------------------------------------------------ */

/* Rungs that the counts and the resolution of a technique's initial point are moved by, and its scale. */
typedef struct anchor {
    int rungs, scale;
} anchor;

static const anchor coarser[] = { { -2, 0 }, { 0, -1 }, { -4, -1 }, { -8, -2 } };
static const anchor finer[] = { { 2, 0 }, { 4, 0 } };

/* As far as the ladder goes. */
static void move(const nook_tune_space *space, nook_tune_point *point, uint32_t axis, int rungs)
{
    while (rungs != 0 && !nook_tune_step(space, point, axis, rungs))
        rungs += rungs < 0 ? 1 : -1;
}

static nook_tune_point place(const nook_tune_space *space, uint32_t technique, const anchor *a)
{
    nook_tune_point point = nook_tune_initial(space, technique);
    for (uint32_t i = 0; i < space->techniques[technique].axis_count; i++) {
        const char *name = space->techniques[technique].axes[i].name;
        if (strcmp(name, "ao.scale") == 0)
            move(space, &point, i, a->scale);
        else if (strncmp(name, "ao.", 3) != 0)
            move(space, &point, i, a->rungs);
    }
    return point;
}

/* On the far side of the budget from where the initial setting is, there is nothing more to learn from an anchor. */
static bool is_past(const nook_tune_goal *goal, const nook_tune_cost *cost, bool to_finer)
{
    if (goal->max_ms > 0.0)
        return (cost->ms > goal->max_ms) == to_finer;
    return (cost->error <= goal->max_error) == to_finer;
}

/* As it comes; then coarser where there is error to spare or too little time, else finer. */
static nook_result try_anchors(nook_tune_trials *trials, uint32_t technique)
{
    const nook_tune_search_desc *desc = trials->desc;
    const char *name = desc->space->techniques[technique].technique->name;
    nook_tune_point point = nook_tune_initial(desc->space, technique);
    nook_result result = nook_tune_trials_try(trials, name, &point);
    if (result != NOOK_OK)
        return result;
    nook_tune_cost cost = nook_tune_trials_cost(trials, nook_tune_trials_find(trials, &point));
    bool to_finer = desc->goal.max_ms > 0.0 ? cost.ms < 0.5 * desc->goal.max_ms : cost.error > desc->goal.max_error;
    const anchor *anchors = to_finer ? finer : coarser;
    const size_t count = to_finer ? NOOK_COUNT(finer) : NOOK_COUNT(coarser);
    for (size_t i = 0; i < count && nook_tune_trials_open(trials); i++) {
        point = place(desc->space, technique, &anchors[i]);
        result = nook_tune_trials_try(trials, name, &point);
        if (result != NOOK_OK)
            return result;
        cost = nook_tune_trials_cost(trials, nook_tune_trials_find(trials, &point));
        if (is_past(&desc->goal, &cost, to_finer))
            break;
    }
    return NOOK_OK;
}

/* ---- Which techniques are refined --------------------------------------------------------------------------------- */

/* A technique by the best of its anchors. */
typedef struct contender {
    uint32_t technique;
    nook_tune_cost cost;
} contender;

static uint32_t rank(const nook_tune_trials *trials, contender out[NOOK_TUNE_TECHNIQUES_MAX])
{
    const nook_tune_search_desc *desc = trials->desc;
    uint32_t count = 0;
    for (uint32_t i = 0; i < desc->space->technique_count; i++) {
        const nook_tune_trial *best = nook_tune_trials_best(trials, i);
        if (!best)
            continue;
        contender c = { i, nook_tune_trials_cost(trials, best) };
        uint32_t at = count++;
        for (; at > 0 && nook_tune_better(&desc->goal, &c.cost, &out[at - 1].cost); at--)
            out[at] = out[at - 1];
        out[at] = c;
    }
    return count;
}

static bool has_hope(const nook_tune_goal *goal, const nook_tune_cost *cost, const nook_tune_cost *best)
{
    double excess = nook_tune_excess(goal, cost) - nook_tune_excess(goal, best);
    double behind = nook_tune_log_ratio(nook_tune_objective(goal, cost), nook_tune_objective(goal, best));
    const double hopeless = log(hopeless_factor);
    return excess < hopeless && (!nook_tune_fits(goal, cost) || behind < hopeless);
}

/* How views differ is learnt from one setting of each contender before its neighbours are compared. */
static nook_result refine(nook_tune_trials *trials)
{
    const nook_tune_search_desc *desc = trials->desc;
    contender contenders[NOOK_TUNE_TECHNIQUES_MAX];
    uint32_t count = rank(trials, contenders);
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < count && i < SURVIVORS && result == NOOK_OK; i++) {
        if (!has_hope(&desc->goal, &contenders[i].cost, &contenders[0].cost))
            continue;
        result =
            nook_tune_trials_extend(trials, nook_tune_trials_best(trials, contenders[i].technique), desc->views_few);
        if (result == NOOK_OK)
            result = nook_tune_descend(trials, contenders[i].technique);
    }
    return result;
}

/* ---- The winner --------------------------------------------------------------------------------------------------- */

/* The number of views that any trial was measured in, at most. */
static uint32_t most_views(const nook_tune_trials *trials)
{
    uint32_t most = 0;
    for (uint32_t i = 0; i < trials->count; i++)
        most = trials->items[i].view_count > most ? trials->items[i].view_count : most;
    return most;
}

/* The best, when what was not measured in as many views as others is taken to do worse than it seems by that factor. */
static nook_tune_trial *best_with_doubt(const nook_tune_trials *trials, double doubt)
{
    nook_tune_trial *best = NULL;
    nook_tune_cost best_cost = { 0 };
    uint32_t most = most_views(trials);
    for (uint32_t i = 0; i < trials->count; i++) {
        nook_tune_trial *trial = &trials->items[i];
        nook_tune_cost cost = nook_tune_trials_cost(trials, trial);
        double factor = trial->view_count < most ? doubt : 1.0;
        cost = (nook_tune_cost){ cost.error * factor, cost.ms * factor };
        if (best && !nook_tune_better(&trials->desc->goal, &cost, &best_cost))
            continue;
        best = trial;
        best_cost = cost;
    }
    return best;
}

/* So far twice as many views at a time: what does not hold in these needs no more. */
static nook_result extend(nook_tune_trials *trials, nook_tune_trial *trial, uint32_t wanted)
{
    uint32_t twice = 2 * trial->view_count, few = trials->desc->views_few;
    uint32_t views = twice > few ? twice : few;
    return nook_tune_trials_extend(trials, trial, views < wanted ? views : wanted);
}

/*
 * Measures what looks best in more views, until what looks best was measured in as many as its spread asks for. Each time that it was
 * not, the others are doubted more.
 */
static nook_result confirm(nook_tune_trials *trials, bool *out_settled)
{
    *out_settled = false;
    for (int i = 0; i < CONFIRMATIONS_MAX; i++) {
        nook_tune_trial *best = best_with_doubt(trials, 1.0 + 0.01 * i);
        uint32_t wanted = nook_tune_trials_wanted(trials, best);
        *out_settled = best->view_count >= trials->desc->views_few && best->view_count >= wanted;
        if (*out_settled)
            return NOOK_OK;
        nook_result result = extend(trials, best, wanted);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

/* The best of those that were measured in a few views at least, by these alone and their own margins. There is one. */
static nook_tune_trial *best_of_measured(const nook_tune_trials *trials)
{
    nook_tune_trial *best = NULL;
    nook_tune_cost best_cost = { 0 };
    for (uint32_t i = 0; i < trials->count; i++) {
        nook_tune_trial *trial = &trials->items[i];
        nook_tune_estimate estimate = nook_tune_pool(trial->views, trial->view_count);
        nook_tune_cost cost = nook_tune_with_margin(&trials->desc->goal, &estimate);
        if (trial->view_count < trials->desc->views_few ||
            (best && !nook_tune_better(&trials->desc->goal, &cost, &best_cost)))
            continue;
        best = trial;
        best_cost = cost;
    }
    return best;
}

/* The winner, measured in as many views as it and its user ask for. Each turn measures more or ends, and views are limited. */
static nook_result choose(nook_tune_trials *trials, const nook_tune_trial **out_best)
{
    const nook_tune_search_desc *desc = trials->desc;
    for (;;) {
        nook_tune_trial *best = best_of_measured(trials);
        uint32_t wanted = nook_tune_trials_wanted(trials, best);
        nook_result result = NOOK_OK;
        if (best->view_count >= wanted && desc->ask)
            result = desc->ask(desc->user, best, &wanted);
        if (result == NOOK_OK && best->view_count >= wanted) {
            *out_best = best;
            return NOOK_OK;
        }
        assert(result != NOOK_OK || wanted <= desc->views_max);
        if (result == NOOK_OK)
            result = extend(trials, best, wanted);
        if (result != NOOK_OK)
            return result;
    }
}

static nook_result search(nook_tune_trials *trials, bool *out_settled)
{
    const nook_tune_search_desc *desc = trials->desc;
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < desc->space->technique_count && result == NOOK_OK && nook_tune_trials_open(trials); i++)
        result = try_anchors(trials, i);
    if (result == NOOK_OK)
        result = refine(trials);
    /* What many views say of the best may shift the budget's edge: then there is something to gain beside it. */
    for (int again = 0; again < AGAIN_MAX && result == NOOK_OK; again++) {
        uint32_t before = trials->count;
        result = confirm(trials, out_settled);
        if (result == NOOK_OK && nook_tune_trials_open(trials))
            result = nook_tune_descend(trials, nook_tune_trials_best(trials, UINT32_MAX)->point.technique);
        if (trials->count == before)
            break;
    }
    return result == NOOK_OK ? confirm(trials, out_settled) : result;
}

nook_result nook_tune_search(const nook_tune_search_desc *desc, nook_tune_outcome *out)
{
    assert(desc->views_first >= 1 && desc->views_first <= desc->views_few && desc->views_few <= desc->views_max);
    assert(desc->views_max <= NOOK_TUNE_VIEWS_MAX && desc->tries_max <= NOOK_TUNE_TRIALS_MAX);
    nook_tune_trials trials = { .desc = desc, .items = calloc(NOOK_TUNE_TRIALS_MAX, sizeof *trials.items) };
    if (!trials.items)
        return nook_fail(NOOK_E_MEMORY, "no memory for %d settings", NOOK_TUNE_TRIALS_MAX);
    const nook_tune_trial *best = NULL;
    bool settled = false;
    nook_result result = search(&trials, &settled);
    if (result == NOOK_OK)
        result = choose(&trials, &best);
    if (result == NOOK_OK) {
        out->best = *best;
        out->estimate = nook_tune_pool(best->views, best->view_count);
        nook_tune_cost cost = nook_tune_with_margin(&desc->goal, &out->estimate);
        out->fits = nook_tune_fits(&desc->goal, &cost);
        out->settled = settled;
        out->tried = trials.count;
        out->measurements = trials.measurements;
    }
    free(trials.items);
    return result;
}
