#include "game/tune/tune_run.h"
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "game/cameras/sample.h"
#include "game/techniques.h"
#include "game/tune/trials.h"
#include "game/tune/tune_progress.h"
#include "game/tune/tune_views.h"
#include "game/volumes.h"
#include <math.h>
#include <stdlib.h>

enum { VIEWS_FIRST = 2, VIEWS_FEW = 8, VIEWS_MAX = 32 };
/* Of the truth, RMS; a view whose error is under four times that has it traced further. What it adds in quadrature is subtracted. */
static const double noise = 0.02;

/* What the callbacks of the search need. */
typedef struct tuning {
    nook_tune_search_desc search;
    nook_tune_views views;
    nook_tune_progress progress;
    nook_tune_point held_point; /* what the held-back views below are of */
    nook_tune_view held[NOOK_TUNE_VIEWS_MAX];
    uint32_t held_count;
} tuning;

static nook_result measure(void *user, const nook_setting *setting, uint32_t view, bool timed, nook_tune_view *out)
{
    tuning *t = user;
    return nook_tune_views_measure(&t->views, setting, NOOK_TUNE_CHOOSE, view, timed, out);
}

static nook_result measure_held_back_up_to(tuning *t, const nook_setting *setting, uint32_t views)
{
    for (uint32_t i = t->held_count; i < views; i++) {
        nook_tune_progress_proof(&t->progress, true, i, views);
        nook_result measured = nook_tune_views_measure(&t->views, setting, NOOK_TUNE_PROVE, i, false, &t->held[i]);
        if (measured != NOOK_OK)
            return measured;
        t->held_count = i + 1;
    }
    return NOOK_OK;
}

/*
 * Measures the winner in as many views that nothing was chosen by, and in more until their own spread asks for no more. It must be
 * predicted from as many: a few views may be more alike than all are. Which setting wins does not follow from these errors.
 */
static nook_result ask_held_back(void *user, const nook_tune_trial *winner, uint32_t *out_views)
{
    tuning *t = user;
    if (!nook_tune_same(&t->held_point, &winner->point))
        t->held_count = 0;
    t->held_point = winner->point;
    for (uint32_t wanted = winner->view_count; t->held_count < wanted;) {
        nook_result measured = measure_held_back_up_to(t, &winner->setting, wanted);
        if (measured != NOOK_OK)
            return measured;
        nook_tune_estimate estimate = nook_tune_pool(t->held, t->held_count);
        wanted = nook_tune_wanted_surely(&t->search, &estimate);
    }
    *out_views = t->held_count;
    return NOOK_OK;
}

static void tell(void *user, const char *doing, uint32_t tried, const nook_tune_trial *best)
{
    tuning *t = user;
    nook_tune_progress_search(&t->progress, doing, tried, best);
}

/* Numbers of views as the scene's cameras have it: as many of each. */
static nook_tune_search_desc describe(const nook_scene *scene, const nook_tune_options *options, tuning *t)
{
    uint32_t period = nook_cameras_period(scene), given = (uint32_t)options->cameras;
    uint32_t most = period < VIEWS_MAX ? VIEWS_MAX / period * period : VIEWS_MAX;
    uint32_t few = nook_tune_round_up(VIEWS_FEW, period);
    nook_tune_search_desc desc = { .space = &options->space,
                                   .goal = options->goal,
                                   .views_max = given ? given : most,
                                   .period = period,
                                   .part = given ? 0.0 : NOOK_TUNE_TOLERANCE,
                                   .tries_max = (uint32_t)options->tries,
                                   .measure = measure,
                                   .ask = ask_held_back,
                                   .tell = tell,
                                   .user = t };
    desc.views_few = few < desc.views_max ? few : desc.views_max;
    desc.views_first = VIEWS_FIRST < desc.views_few ? VIEWS_FIRST : desc.views_few;
    return desc;
}

static nook_result set_params(nook_stage *stage, const nook_tune_options *options, nook_tune_result *result)
{
    result->r_max = options->r_max > 0.0 ? options->r_max : nook_volumes_default_r_max(stage->scene);
    if (result->r_max == 0.0)
        return nook_fail(NOOK_E_FORMAT, "%s: what it draws has no size, so there is nothing to tune for",
                         stage->scene->path);
    nook_result set = nook_ao_set_param(stage->ao, "ao.r_max", result->r_max);
    if (set == NOOK_OK && options->falloff)
        set = nook_ao_parse_param(stage->ao, "ao.falloff", options->falloff);
    double falloff;
    if (set == NOOK_OK)
        set = nook_ao_get_param(stage->ao, "ao.falloff", &falloff);
    if (set == NOOK_OK)
        nook_param_print_value(nook_shared_param("falloff"), falloff, result->falloff, sizeof result->falloff);
    return set;
}

/* In how many of its views the winner is timed: in all where time is limited, else in a few. */
static uint32_t timed_views(const nook_tune_goal *goal, uint32_t views)
{
    return goal->max_ms > 0.0 || views < VIEWS_FEW ? views : VIEWS_FEW;
}

/* Times afresh what was chosen: the times that it was chosen by are among the lucky ones. Its errors would be the same again. */
static nook_result time_winner(tuning *t, const nook_tune_goal *goal, nook_tune_result *result)
{
    nook_tune_trial winner = result->outcome.best;
    uint32_t timed = timed_views(goal, winner.view_count);
    for (uint32_t i = 0; i < winner.view_count; i++)
        winner.views[i].ms = NAN;
    nook_tune_progress_proof(&t->progress, false, 0, timed);
    nook_result measured = nook_tune_views_time(&t->views, &winner.setting, NOOK_TUNE_CHOOSE, timed, winner.views);
    if (measured == NOOK_OK)
        result->predicted = nook_tune_pool(winner.views, winner.view_count);
    return measured;
}

static nook_result time_held_back(tuning *t, nook_tune_result *result)
{
    nook_result timed = nook_tune_views_time(&t->views, &result->outcome.best.setting, NOOK_TUNE_PROVE,
                                             timed_views(&t->search.goal, t->held_count), t->held);
    if (timed == NOOK_OK)
        result->actual = nook_tune_pool(t->held, t->held_count);
    return timed;
}

static bool is_ms_within(const nook_tune_goal *goal, const nook_tune_estimate *estimate)
{
    return goal->max_ms == 0.0 || estimate->cost.ms - estimate->ms_spread <= goal->max_ms;
}

static void judge(const nook_tune_goal *goal, nook_tune_result *result)
{
    const nook_tune_estimate *predicted = &result->predicted, *actual = &result->actual;
    result->difference = actual->cost.error / predicted->cost.error - 1.0;
    result->difference_standard = hypot(actual->error_standard, predicted->error_standard) / predicted->cost.error;
    result->near = fabs(result->difference) <= NOOK_TUNE_TOLERANCE;
    result->error_holds = goal->max_error == 0.0 || actual->cost.error - actual->error_standard <= goal->max_error;
    result->ms_holds = is_ms_within(goal, predicted) && is_ms_within(goal, actual);
    result->holds = result->near && result->error_holds && result->ms_holds;
}

static nook_result prove(tuning *t, nook_tune_result *result)
{
    nook_result measured = time_winner(t, &t->search.goal, result);
    if (measured == NOOK_OK)
        measured = time_held_back(t, result);
    if (measured == NOOK_OK)
        judge(&t->search.goal, result);
    return measured;
}

static nook_result search_and_prove(tuning *t, nook_stage *stage, const nook_tune_options *options,
                                    nook_tune_result *result)
{
    t->search = describe(stage->scene, options, t);
    const nook_tune_views_desc views = { .cache = options->cache,
                                         .r_max = result->r_max,
                                         .noise = noise,
                                         .rays_max = (uint32_t)options->reference_rays,
                                         .views_max = t->search.views_max };
    nook_progress *outer = stage->progress;
    t->progress = nook_tune_progress_begin(&options->goal, t->search.tries_max);
    stage->progress = t->progress.terminal ? outer : &t->progress.whole;
    nook_result done = nook_tune_views_open(stage, &views, &t->views);
    if (done == NOOK_OK)
        done = nook_tune_search(&t->search, &result->outcome);
    result->predicted = result->outcome.estimate;
    if (done == NOOK_OK && result->outcome.fits)
        done = prove(t, result);
    stage->progress = outer;
    nook_tune_progress_end(&t->progress);
    nook_tune_views_close(&t->views);
    return done;
}

nook_result nook_tune_run(nook_stage *stage, const nook_tune_options *options, nook_tune_result *out)
{
    double start = nook_clock_ms();
    nook_tune_result result = { .settings = nook_tune_space_size(&options->space) };
    tuning *t = calloc(1, sizeof *t);
    if (!t)
        return nook_fail(NOOK_E_MEMORY, "tune: no memory");
    nook_result done = set_params(stage, options, &result);
    const nook_game_world_desc world = { 0, result.r_max, options->cache };
    if (done == NOOK_OK)
        done = nook_stage_fill(stage, &world);
    if (done == NOOK_OK)
        done = search_and_prove(t, stage, options, &result);
    free(t);
    if (done != NOOK_OK)
        return done;
    result.seconds = (nook_clock_ms() - start) / 1000.0;
    *out = result;
    return NOOK_OK;
}
