/* The search against models of what settings do, whose best setting is found by trying all of them. */
#include "engine/core/log.h"
#include "game/techniques.h"
#include "game/tune/search.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* What a technique's model is made of; counts stand for the product of all of them, 1 at their initial values. */
typedef struct law {
    double ms;         /* of the initial setting, without what does not depend on it */
    double ms_fixed;   /* of every setting */
    double bias;       /* error that no setting takes away */
    double noise;      /* error that falls with the root of the counts */
    double voxels;     /* error of a volume of 256, falls with the resolution */
    double coarse[3];  /* error of the scale full, half, quarter */
    double blurred[3]; /* error of the filter none, disc, tile */
    double quiet[3];   /* what it leaves of the noise */
} law;

typedef struct world {
    nook_tune_space space;
    law laws[NOOK_TUNE_TECHNIQUES_MAX];
    double unevenness; /* of views, for all alike */
    double own;        /* of views, for each technique another: as large as this, either way */
    double chance;     /* of a setting in a view: as large as this, either way */
    double ms_noise;   /* of each timing */
    uint32_t measured, failing_at, asked;
    uint32_t tells;
    uint32_t seed; /* of timings */
} world;

static double value_of(const nook_setting *setting, const char *name)
{
    return nook_setting_get(setting, nook_shared_param(name));
}

/* The product of all counts over that of their initial values, each to its power: not all axes are worth the same. */
static double work_of(const nook_setting *setting, double power_of_later)
{
    const nook_ao_technique *technique = setting->technique;
    double work = 1.0, power = 1.0;
    for (uint32_t i = 0; i < technique->param_count; i++) {
        const nook_param *param = &technique->params[i];
        if (param->type != NOOK_PARAM_INT || param->unit != NOOK_UNIT_COUNT)
            continue;
        double part = fmax(nook_setting_get(setting, param), 0.5) / fmax(param->initial, 0.5);
        work *= pow(part, power);
        power *= power_of_later;
    }
    return work;
}

static nook_tune_cost cost_of(const world *w, uint32_t technique, const nook_setting *setting)
{
    const law *l = &w->laws[technique];
    int scale = (int)value_of(setting, "scale"), filter = (int)value_of(setting, "filter");
    double resolution = setting->resolution ? setting->resolution / 256.0 : 1.0;
    double noise = l->noise * l->quiet[filter] / sqrt(work_of(setting, 0.5));
    double squared = l->bias * l->bias + noise * noise + pow(l->voxels / resolution, 2.0) + pow(l->coarse[scale], 2.0) +
                     pow(l->blurred[filter], 2.0);
    double ms = l->ms_fixed + l->ms * work_of(setting, 0.8) * pow(0.25, scale) * pow(resolution, 0.2) + 1.5 * filter;
    return (nook_tune_cost){ sqrt(squared), ms };
}

static uint32_t technique_of(const world *w, const nook_setting *setting)
{
    uint32_t i = 0;
    while (w->space.techniques[i].technique != setting->technique)
        i++;
    return i;
}

static double chance_of_hash(uint32_t hash)
{
    hash ^= hash >> 15;
    hash *= 2246822519u;
    hash ^= hash >> 13;
    hash *= 3266489917u;
    hash ^= hash >> 16;
    return (hash >> 8) / 8388608.0 - 1.0;
}

/* In [-1, 1], another for every text and number. */
static double chance_of(const char *text, uint32_t number)
{
    uint32_t hash = 2166136261u ^ number * 2654435761u;
    for (; *text; text++)
        hash = (hash ^ (uint32_t)(unsigned char)*text) * 16777619u;
    return chance_of_hash(hash);
}

/* What a view does to all errors; of a technique also what it does to that one alone. */
static double lighter(const world *w, const nook_setting *setting, uint32_t view)
{
    char text[NOOK_SETTING_TEXT_MAX];
    return (1.0 + w->unevenness * sin(2.0 * view)) * (1.0 + w->own * chance_of(setting->technique->name, view)) +
           w->chance * chance_of(nook_setting_print(setting, text), view);
}

static double slower(const world *w, const nook_setting *setting, uint32_t view)
{
    return (1.0 + 0.5 * w->unevenness * cos(5.0 * view)) *
           (1.0 + 0.5 * w->own * chance_of(setting->technique->name, 1000 + view));
}

/* No two timings are alike, not even of the same setting in the same view. */
static nook_result measure(void *user, const nook_setting *setting, uint32_t view, bool timed, nook_tune_view *out)
{
    world *w = user;
    nook_tune_cost cost = cost_of(w, technique_of(w, setting), setting);
    if (w->measured++ == w->failing_at)
        return nook_fail(NOOK_E_DEVICE, "the device is gone");
    double ms = cost.ms * slower(w, setting, view) * (1.0 + w->ms_noise * chance_of("timing", w->measured + w->seed));
    *out = (nook_tune_view){ .squared = pow(cost.error * lighter(w, setting, view), 2.0),
                             .pixels = 1000.0,
                             .ms = timed ? ms : NAN,
                             .ms_spread = timed ? w->ms_noise * ms : NAN };
    return NOOK_OK;
}

/* What a setting does over all views that there are: more of them than the search may look at. */
static nook_tune_cost truth_of(const world *w, const nook_setting *setting)
{
    enum { VIEWS = 2000 };
    nook_tune_cost cost = cost_of(w, technique_of(w, setting), setting);
    double squares = 0.0, ms = 0.0;
    for (uint32_t view = 0; view < VIEWS; view++) {
        squares += pow(lighter(w, setting, view), 2.0);
        ms += slower(w, setting, view);
    }
    return (nook_tune_cost){ cost.error * sqrt(squares / VIEWS), cost.ms * ms / VIEWS };
}

static void tell(void *user, const char *doing, uint32_t tried, const nook_tune_trial *best)
{
    world *w = user;
    assert_true(*doing != '\0');
    assert_int_equal(best == NULL, tried == 0);
    w->tells++;
}

static world make_world(double unevenness)
{
    world w = { .unevenness = unevenness, .failing_at = UINT32_MAX };
    size_t count;
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    for (size_t i = 0; i < count; i++) {
        if (techniques[i]->exact)
            continue;
        double k = (double)w.space.technique_count;
        w.laws[w.space.technique_count] = (law){ .ms = 100.0 / (1.0 + k),
                                                 .ms_fixed = 3.0,
                                                 .bias = 0.02 + 0.03 * k,
                                                 .noise = 0.05,
                                                 .voxels = 0.01,
                                                 .coarse = { 0.0, 0.02, 0.05 },
                                                 .blurred = { 0.0, 0.012, 0.02 },
                                                 .quiet = { 1.0, 0.35, 0.25 } };
        nook_tune_space_add(&w.space, techniques[i]);
    }
    return w;
}

static nook_tune_search_desc desc_of(world *w, double max_error, double max_ms)
{
    return (nook_tune_search_desc){ .space = &w->space,
                                    .goal = { max_error, max_ms },
                                    .views_first = 2,
                                    .views_few = 8,
                                    .views_max = 24,
                                    .period = 1,
                                    .part = 0.15,
                                    .tries_max = NOOK_TUNE_TRIES_DEFAULT,
                                    .measure = measure,
                                    .tell = tell,
                                    .user = w };
}

static nook_tune_outcome must_search(world *w, const nook_tune_search_desc *desc)
{
    nook_tune_outcome outcome;
    (void)w;
    assert_int_equal(nook_tune_search(desc, &outcome), NOOK_OK);
    return outcome;
}

/* What every setting of the first techniques does: going through all of them takes seconds, so it is done once. */
typedef struct all_settings {
    nook_tune_cost *costs[NOOK_TUNE_TECHNIQUES_MAX];
    size_t counts[NOOK_TUNE_TECHNIQUES_MAX];
    uint32_t technique_count;
} all_settings;

static all_settings all;

static void go_through(const world *w, uint32_t technique)
{
    const nook_tune_ladders *ladders = &w->space.techniques[technique];
    nook_tune_space alone = { .techniques[0] = *ladders, .technique_count = 1 };
    nook_tune_point point = { .technique = technique };
    size_t count = 0;
    all.costs[technique] = calloc((size_t)nook_tune_space_size(&alone), sizeof *all.costs[technique]);
    for (bool more = true; more;) {
        nook_setting setting = nook_tune_setting(&w->space, &point);
        all.costs[technique][count++] = cost_of(w, technique, &setting);
        more = false;
        for (uint32_t i = 0; i < ladders->axis_count && !more; i++) {
            more = nook_tune_step(&w->space, &point, i, 1);
            if (!more)
                point.rungs[i] = 0;
        }
    }
    assert_true((double)count == nook_tune_space_size(&alone));
    all.counts[technique] = count;
}

static int set_up(void **state)
{
    (void)state;
    world w = make_world(0.0);
    all.technique_count = w.space.technique_count;
    for (uint32_t t = 0; t < all.technique_count; t++)
        go_through(&w, t);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    for (uint32_t t = 0; t < all.technique_count; t++)
        free(all.costs[t]);
    return 0;
}

/* @param technique  in make_world's order, or UINT32_MAX: of all */
static nook_tune_cost best_of_all(uint32_t technique, const nook_tune_goal *goal)
{
    nook_tune_cost best = { INFINITY, INFINITY };
    for (uint32_t t = 0; t < all.technique_count; t++) {
        for (size_t i = 0; i < all.counts[t] && (technique == UINT32_MAX || technique == t); i++) {
            if (nook_tune_better(goal, &all.costs[t][i], &best))
                best = all.costs[t][i];
        }
    }
    return best;
}

/* As best_of_all, over all views: of a technique they all turn errors and times by the same factors. */
static nook_tune_cost best_over_views(const world *w, const nook_tune_goal *goal)
{
    nook_tune_cost best = { INFINITY, INFINITY };
    for (uint32_t t = 0; t < all.technique_count; t++) {
        nook_tune_point point = nook_tune_initial(&w->space, t);
        nook_setting setting = nook_tune_setting(&w->space, &point);
        nook_tune_cost here = truth_of(w, &setting), flat = cost_of(w, t, &setting);
        for (size_t i = 0; i < all.counts[t]; i++) {
            nook_tune_cost cost = { all.costs[t][i].error * here.error / flat.error,
                                    all.costs[t][i].ms * here.ms / flat.ms };
            if (nook_tune_better(goal, &cost, &best))
                best = cost;
        }
    }
    return best;
}

static void check_against(uint32_t technique, world *w, double max_error, double max_ms, double factor)
{
    nook_tune_search_desc desc = desc_of(w, max_error, max_ms);
    nook_tune_outcome found = must_search(w, &desc);
    nook_tune_cost best = best_of_all(technique, &desc.goal);
    nook_tune_cost true_cost = cost_of(w, found.best.point.technique, &found.best.setting);
    char text[NOOK_SETTING_TEXT_MAX];
    print_message("error %g, ms %g: found %.4f at %.2f ms, best %.4f at %.2f ms, %u tried, %u measured: %s\n",
                  max_error, max_ms, true_cost.error, true_cost.ms, best.error, best.ms, found.tried,
                  found.measurements, nook_setting_print(&found.best.setting, text));
    assert_true(found.fits);
    nook_tune_cost with_margin = nook_tune_with_margin(&desc.goal, &found.estimate);
    assert_true(nook_tune_fits(&desc.goal, &with_margin));
    assert_true(nook_tune_objective(&desc.goal, &true_cost) <= factor * nook_tune_objective(&desc.goal, &best));
    assert_true(found.tried <= desc.tries_max && found.tried < 0.2 * nook_tune_space_size(&w->space));
    assert_int_equal(found.measurements, w->measured);
    assert_true(w->tells >= found.tried);
}

static void check_against_all(world *w, double max_error, double max_ms, double factor)
{
    check_against(UINT32_MAX, w, max_error, max_ms, factor);
}

static void test_the_cheapest_setting_is_found_where_views_are_alike(void **state)
{
    (void)state;
    static const double errors[] = { 0.03, 0.045, 0.06, 0.09, 0.15 };
    for (size_t i = 0; i < NOOK_COUNT(errors); i++) {
        world w = make_world(0.0);
        check_against_all(&w, errors[i], 0.0, 1.5);
    }
}

static void test_the_most_accurate_setting_is_found_where_views_are_alike(void **state)
{
    (void)state;
    static const double times[] = { 5.0, 10.0, 25.0, 60.0, 200.0 };
    for (size_t i = 0; i < NOOK_COUNT(times); i++) {
        world w = make_world(0.0);
        /* 5 ms, of which 3 are every setting's, are far from where any technique starts: 70 tries end on the way */
        check_against_all(&w, 0.0, times[i], times[i] < 10.0 ? 1.35 : 1.15);
    }
}

static void test_views_that_differ_cost_little(void **state)
{
    (void)state;
    static const double unevenness[] = { 0.1, 0.3, 0.5 };
    for (size_t i = 0; i < NOOK_COUNT(unevenness); i++) {
        world w = make_world(unevenness[i]);
        check_against_all(&w, 0.06, 0.0, 1.5);
        w = make_world(unevenness[i]);
        check_against_all(&w, 0.0, 20.0, 1.15);
    }
}

static void test_chance_does_not_keep_it_from_what_fits(void **state)
{
    (void)state;
    static const double chances[] = { 0.1, 0.25, 0.4 };
    for (size_t i = 0; i < NOOK_COUNT(chances); i++) {
        world w = make_world(0.3);
        w.chance = chances[i];
        nook_tune_search_desc desc = desc_of(&w, 0.06, 0.0);
        nook_tune_outcome found = must_search(&w, &desc);
        nook_tune_cost best = best_of_all(UINT32_MAX, &desc.goal);
        nook_tune_cost true_cost = cost_of(&w, found.best.point.technique, &found.best.setting);
        print_message("chance %g: %.4f at %.2f ms, best %.2f ms, %u views\n", chances[i], true_cost.error, true_cost.ms,
                      best.ms, found.estimate.views);
        assert_true(found.fits);
        assert_true(true_cost.ms < 2.0 * best.ms);
        assert_true(fabs(found.estimate.cost.error / true_cost.error - 1.0) < 0.15);
    }
}

/*
 * What a scene is like: views that are hard for one technique and easy for another, and times that chance is in. A budget may then be
 * missed by the error of what was measured; the best is what is best over all views.
 */
static void test_views_that_each_technique_takes_in_its_own_way_and_noisy_times(void **state)
{
    (void)state;
    static const double noises[] = { 0.05, 0.1 };
    for (size_t i = 0; i < 2 * NOOK_COUNT(noises) * 4; i++) {
        world w = make_world(0.3);
        bool by_ms = i % 2;
        w.own = 0.25;
        w.ms_noise = noises[i / 2 % NOOK_COUNT(noises)];
        w.seed = (uint32_t)i * 7919u;
        nook_tune_search_desc desc = desc_of(&w, by_ms ? 0.0 : 0.06, by_ms ? 20.0 : 0.0);
        nook_tune_outcome found = must_search(&w, &desc);
        nook_tune_cost true_cost = truth_of(&w, &found.best.setting), best = best_over_views(&w, &desc.goal);
        print_message(
            "%s, noise %g: %.4f at %.2f ms, predicted %.4f at %.2f, best %.4f at %.2f ms, %u tried, %u measured\n",
            by_ms ? "20 ms" : "error 0.06", w.ms_noise, true_cost.error, true_cost.ms, found.estimate.cost.error,
            found.estimate.cost.ms, best.error, best.ms, found.tried, found.measurements);
        assert_true(found.fits);
        assert_true(nook_tune_excess(&desc.goal, &true_cost) < log(1.05));
        assert_true(nook_tune_objective(&desc.goal, &true_cost) <=
                    (by_ms ? 1.15 : 1.5) * nook_tune_objective(&desc.goal, &best));
    }
}

/* The best is out of reach of the doubts: after its last view it is what fits that is told, not what was measured most. */
static void test_what_fits_in_few_views_is_told_before_what_does_not_in_many(void **state)
{
    (void)state;
    for (uint32_t seed = 0; seed < 8; seed++) {
        world w = make_world(0.2);
        w.chance = 0.5; /* so much that what looks best seldom is */
        w.ms_noise = 0.1;
        w.seed = seed * 104729u;
        nook_tune_search_desc desc = desc_of(&w, 0.05 + 0.005 * seed, 0.0);
        nook_tune_outcome found = must_search(&w, &desc);
        assert_true(found.fits);
        assert_true(found.estimate.views >= desc.views_few);
    }
}

static void test_with_two_limits_the_error_decides_among_what_is_within_both(void **state)
{
    (void)state;
    world w = make_world(0.0);
    check_against_all(&w, 0.08, 20.0, 1.15);
}

static void test_when_nothing_fits_the_nearest_is_told(void **state)
{
    (void)state;
    static const nook_tune_goal goals[] = { { 0.001, 0.0 }, { 0.0, 0.5 }, { 0.03, 4.0 } };
    for (size_t i = 0; i < NOOK_COUNT(goals); i++) {
        world w = make_world(0.2);
        nook_tune_search_desc desc = desc_of(&w, goals[i].max_error, goals[i].max_ms);
        nook_tune_outcome found = must_search(&w, &desc);
        nook_tune_cost best = best_of_all(UINT32_MAX, &desc.goal);
        nook_tune_cost true_cost = cost_of(&w, found.best.point.technique, &found.best.setting);
        assert_false(found.fits);
        assert_true(nook_tune_excess(&desc.goal, &best) > 0.0);
        /* in logarithms: within a fifth of what can be reached */
        assert_true(nook_tune_excess(&desc.goal, &true_cost) < nook_tune_excess(&desc.goal, &best) + 0.3);
    }
}

static void test_the_winner_is_measured_in_as_many_views_as_its_spread_asks_for(void **state)
{
    (void)state;
    world w = make_world(0.3);
    nook_tune_search_desc desc = desc_of(&w, 0.06, 0.0);
    nook_tune_outcome found = must_search(&w, &desc);
    assert_true(found.estimate.views >= desc.views_few && found.estimate.views <= desc.views_max);
    for (uint32_t i = 0; i < found.estimate.views; i++)
        assert_true(isfinite(found.best.views[i].ms) || 2 * i >= desc.views_few);
    double relative = 3.0 * sqrt(2.0) * found.estimate.error_standard / found.estimate.cost.error;
    assert_true(relative < 1.3 * desc.part || found.estimate.views == desc.views_max);
}

static nook_result ask_for_more(void *user, const nook_tune_trial *winner, uint32_t *out_views)
{
    world *w = user;
    w->asked++;
    assert_true(winner->view_count >= 8);
    *out_views = 23;
    return NOOK_OK;
}

static nook_result ask_in_vain(void *user, const nook_tune_trial *winner, uint32_t *out_views)
{
    (void)user, (void)winner;
    *out_views = UINT32_MAX; /* what failed is not looked at */
    return nook_fail(NOOK_E_DEVICE, "the device is gone");
}

static void test_the_winner_is_measured_in_as_many_views_as_its_user_asks_for(void **state)
{
    (void)state;
    world w = make_world(0.0);
    nook_tune_search_desc desc = desc_of(&w, 0.06, 0.0);
    assert_int_equal(must_search(&w, &desc).estimate.views, desc.views_few);
    desc.ask = ask_for_more;
    assert_int_equal(must_search(&w, &desc).estimate.views, 23);
    assert_true(w.asked >= 2); /* again when it was measured in them: another may be the best by then */
    desc.ask = ask_in_vain;
    nook_tune_outcome outcome;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_tune_search(&desc, &outcome), NOOK_E_DEVICE);
    nook_log_capture_end();
}

static void test_numbers_of_views_follow_the_period_of_the_cameras(void **state)
{
    (void)state;
    world w = make_world(0.3);
    nook_tune_search_desc desc = desc_of(&w, 0.06, 0.0);
    desc.period = 5;
    desc.views_few = 10;
    desc.views_max = 40;
    assert_int_equal(must_search(&w, &desc).estimate.views % 5, 0);
    desc.part = 0.0;
    assert_int_equal(must_search(&w, &desc).estimate.views, 40);
}

static void test_a_few_tries_are_kept_to(void **state)
{
    (void)state;
    for (uint32_t tries = 1; tries < 20; tries += 3) {
        world w = make_world(0.1);
        nook_tune_search_desc desc = desc_of(&w, 0.06, 0.0);
        desc.tries_max = tries;
        nook_tune_outcome found = must_search(&w, &desc);
        assert_true(found.tried <= tries);
        assert_true(found.estimate.views >= desc.views_few);
    }
}

static void test_a_measurement_that_fails_ends_the_search(void **state)
{
    (void)state;
    for (uint32_t at = 0; at < 200; at += 17) {
        world w = make_world(0.1);
        nook_tune_search_desc desc = desc_of(&w, 0.06, 0.0);
        nook_tune_outcome outcome, before;
        nook_log_capture log;
        memset(&outcome, 7, sizeof outcome);
        before = outcome;
        w.failing_at = at;
        nook_log_capture_begin(&log);
        nook_result result = nook_tune_search(&desc, &outcome);
        nook_log_capture_end();
        if (w.measured <= at) /* it needed fewer */
            continue;
        assert_int_equal(result, NOOK_E_DEVICE);
        assert_int_equal(log.count, 1);
        assert_memory_equal(&outcome, &before, sizeof outcome);
    }
}

static void test_a_space_of_one_technique_is_enough(void **state)
{
    (void)state;
    world every = make_world(0.1);
    for (uint32_t t = 0; t < every.space.technique_count; t++) {
        world w = { .unevenness = 0.1, .failing_at = UINT32_MAX, .laws[0] = every.laws[t] };
        nook_tune_space_add(&w.space, every.space.techniques[t].technique);
        check_against(t, &w, every.laws[t].bias + 0.04, 0.0, 1.5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_cheapest_setting_is_found_where_views_are_alike),
        cmocka_unit_test(test_the_most_accurate_setting_is_found_where_views_are_alike),
        cmocka_unit_test(test_views_that_differ_cost_little),
        cmocka_unit_test(test_chance_does_not_keep_it_from_what_fits),
        cmocka_unit_test(test_views_that_each_technique_takes_in_its_own_way_and_noisy_times),
        cmocka_unit_test(test_what_fits_in_few_views_is_told_before_what_does_not_in_many),
        cmocka_unit_test(test_with_two_limits_the_error_decides_among_what_is_within_both),
        cmocka_unit_test(test_when_nothing_fits_the_nearest_is_told),
        cmocka_unit_test(test_the_winner_is_measured_in_as_many_views_as_its_spread_asks_for),
        cmocka_unit_test(test_the_winner_is_measured_in_as_many_views_as_its_user_asks_for),
        cmocka_unit_test(test_numbers_of_views_follow_the_period_of_the_cameras),
        cmocka_unit_test(test_a_few_tries_are_kept_to),
        cmocka_unit_test(test_a_measurement_that_fails_ends_the_search),
        cmocka_unit_test(test_a_space_of_one_technique_is_enough),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
