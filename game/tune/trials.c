#include "game/tune/trials.h"
#include <assert.h>
#include <math.h>

bool nook_tune_trials_open(const nook_tune_trials *trials)
{
    return trials->count < trials->desc->tries_max;
}

nook_tune_trial *nook_tune_trials_find(const nook_tune_trials *trials, const nook_tune_point *point)
{
    for (uint32_t i = 0; i < trials->count; i++) {
        if (nook_tune_same(&trials->items[i].point, point))
            return &trials->items[i];
    }
    return NULL;
}

static nook_result measure(nook_tune_trials *trials, nook_tune_trial *trial, uint32_t view, bool timed)
{
    const nook_tune_search_desc *desc = trials->desc;
    trials->measurements++;
    return desc->measure(desc->user, &trial->setting, view, timed, &trial->views[view]);
}

/* Timing takes several frames; of the first views one is timed. */
nook_result nook_tune_trials_try(nook_tune_trials *trials, const char *doing, const nook_tune_point *point)
{
    const nook_tune_search_desc *desc = trials->desc;
    assert(trials->items);
    if (nook_tune_trials_find(trials, point))
        return NOOK_OK;
    assert(nook_tune_trials_open(trials));
    if (desc->tell)
        desc->tell(desc->user, doing, trials->count, nook_tune_trials_best(trials, UINT32_MAX));
    nook_tune_trial *trial = &trials->items[trials->count];
    *trial = (nook_tune_trial){ .point = *point, .setting = nook_tune_setting(desc->space, point) };
    for (uint32_t view = 0; view < desc->views_first; view++) {
        nook_result result = measure(trials, trial, view, view == 0);
        if (result != NOOK_OK)
            return result;
    }
    trial->view_count = desc->views_first;
    trials->count++;
    return NOOK_OK;
}

nook_result nook_tune_trials_extend(nook_tune_trials *trials, nook_tune_trial *trial, uint32_t views)
{
    const nook_tune_search_desc *desc = trials->desc;
    if (views <= trial->view_count)
        return NOOK_OK;
    if (desc->tell)
        desc->tell(desc->user, "confirming", trials->count, trial);
    for (uint32_t view = 0; view < views; view++) {
        bool timed = 2 * view < desc->views_few || desc->goal.max_ms > 0.0;
        if (view < trial->view_count && !(timed && isnan(trial->views[view].ms)))
            continue;
        nook_result result = measure(trials, trial, view, timed);
        if (result != NOOK_OK)
            return result;
    }
    trial->view_count = views;
    return NOOK_OK;
}

/* Of the technique's trials the one in the most views: how those differ from the first is much the same for its neighbours. */
static const nook_tune_trial *reference_of(const nook_tune_trials *trials, const nook_tune_trial *trial)
{
    const nook_tune_trial *best = trial;
    for (uint32_t i = 0; i < trials->count; i++) {
        const nook_tune_trial *other = &trials->items[i];
        if (other->point.technique == trial->point.technique && other->view_count > best->view_count)
            best = other;
    }
    return best;
}

/* The mean of those times of the reference that the trial has too. */
static double common_ms(const nook_tune_trial *reference, const nook_tune_trial *trial)
{
    double sum = 0.0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < trial->view_count; i++) {
        if (isnan(trial->views[i].ms))
            continue;
        sum += reference->views[i].ms;
        count++;
    }
    return sum / count;
}

static uint32_t within(const nook_tune_search_desc *desc, double needed)
{
    if (desc->part == 0.0)
        return desc->views_max;
    uint32_t views = needed < desc->views_max ? nook_tune_round_up(needed, desc->period) : desc->views_max;
    views = views < desc->views_few ? desc->views_few : views;
    return views < desc->views_max ? views : desc->views_max;
}

uint32_t nook_tune_wanted_surely(const nook_tune_search_desc *desc, const nook_tune_estimate *estimate)
{
    return within(desc, nook_tune_views_needed_surely(estimate, desc->part));
}

uint32_t nook_tune_trials_wanted(const nook_tune_trials *trials, const nook_tune_trial *trial)
{
    nook_tune_estimate estimate = nook_tune_pool(trial->views, trial->view_count);
    return within(trials->desc, nook_tune_views_needed(&estimate, trials->desc->part));
}

/* The margins as parts of error and ms, as small as they will be in as many views as are wanted; 1: nothing is known of them. */
static nook_tune_cost margins(const nook_tune_trials *trials, const nook_tune_trial *reference)
{
    nook_tune_cost factors = { 1.0, 1.0 };
    if (reference->view_count < trials->desc->views_few)
        return factors;
    nook_tune_estimate estimate = nook_tune_pool(reference->views, reference->view_count);
    nook_tune_cost with = nook_tune_with_margin(&trials->desc->goal, &estimate);
    uint32_t wanted = nook_tune_trials_wanted(trials, reference), count = reference->view_count;
    double shrinks = wanted > count ? sqrt((double)count / wanted) : 1.0;
    if (estimate.cost.error > 0.0)
        factors.error += shrinks * (with.error / estimate.cost.error - 1.0);
    factors.ms += shrinks * (with.ms / estimate.cost.ms - 1.0);
    return factors;
}

nook_tune_cost nook_tune_trials_cost(const nook_tune_trials *trials, const nook_tune_trial *trial)
{
    const nook_tune_trial *reference = reference_of(trials, trial);
    nook_tune_cost own = nook_tune_pool(trial->views, trial->view_count).cost, factors = margins(trials, reference);
    if (reference != trial) {
        nook_tune_cost all = nook_tune_pool(reference->views, reference->view_count).cost;
        nook_tune_cost part = nook_tune_pool(reference->views, trial->view_count).cost;
        if (part.error > 0.0)
            own.error *= all.error / part.error;
        own.ms *= all.ms / common_ms(reference, trial);
    }
    return (nook_tune_cost){ own.error * factors.error, own.ms * factors.ms };
}

nook_tune_trial *nook_tune_trials_best(const nook_tune_trials *trials, uint32_t technique)
{
    nook_tune_trial *best = NULL;
    nook_tune_cost best_cost = { 0 };
    for (uint32_t i = 0; i < trials->count; i++) {
        nook_tune_trial *trial = &trials->items[i];
        if (technique != UINT32_MAX && trial->point.technique != technique)
            continue;
        nook_tune_cost cost = nook_tune_trials_cost(trials, trial);
        if (best && !nook_tune_better(&trials->desc->goal, &cost, &best_cost))
            continue;
        best = trial;
        best_cost = cost;
    }
    return best;
}
