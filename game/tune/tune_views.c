#include "game/tune/tune_views.h"
#include "engine/core/log.h"
#include "game/cameras/sample.h"
#include "game/compare/camera.h"
#include "game/measure/site_time.h"
#include "game/tune/tune_pairs.h"
#include "modules/ao/technique.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

nook_result nook_tune_views_open(nook_stage *stage, const nook_tune_views_desc *desc, nook_tune_views *out)
{
    assert(desc->views_max <= NOOK_TUNE_VIEWS_MAX);
    *out = (nook_tune_views){ .stage = stage, .desc = *desc };
    nook_camera cameras[NOOK_TUNE_SETS * NOOK_TUNE_VIEWS_MAX];
    double aspect = (double)stage->width / stage->height;
    nook_result result = nook_cameras_sample(stage->scene, aspect, 0, NOOK_TUNE_SETS * desc->views_max, cameras);
    if (result != NOOK_OK) {
        *out = (nook_tune_views){ 0 };
        return result;
    }
    nook_tune_pair_views(cameras, NOOK_TUNE_SETS * desc->views_max, nook_scene_diagonal(stage->scene),
                         out->cameras[NOOK_TUNE_CHOOSE], out->cameras[NOOK_TUNE_PROVE]);
    return NOOK_OK;
}

void nook_tune_views_close(nook_tune_views *views)
{
    for (uint32_t set = 0; set < NOOK_TUNE_SETS; set++) {
        for (uint32_t i = 0; i < NOOK_TUNE_VIEWS_MAX; i++)
            nook_site_close(views->sites[set][i]);
    }
    *views = (nook_tune_views){ 0 };
}

/* Volumes of the resolution that the setting asks for; techniques without volumes take what there is. */
static nook_result fill(nook_tune_views *views, const nook_setting *setting)
{
    if (!(setting->technique->inputs & NOOK_AO_IN_VOLUMES) || views->resolution == setting->resolution)
        return NOOK_OK;
    const nook_game_world_desc world = { setting->resolution, views->desc.r_max, views->desc.cache };
    nook_result result = nook_stage_fill(views->stage, &world);
    views->resolution = result == NOOK_OK ? setting->resolution : UINT32_MAX;
    return result;
}

static nook_result open_site(nook_tune_views *views, nook_tune_set set, uint32_t view)
{
    if (views->sites[set][view])
        return NOOK_OK;
    char name[32];
    snprintf(name, sizeof name, "%s %u", set == NOOK_TUNE_CHOOSE ? "view" : "other view", view + 1);
    const nook_site_desc desc = { .camera = views->cameras[set][view],
                                  .camera_name = name,
                                  .noise = views->desc.noise,
                                  .rays_max = views->desc.rays_max,
                                  .cache = views->desc.cache,
                                  .what = NOOK_MEASURE_TIME };
    return nook_site_open(views->stage, &desc, &views->sites[set][view]);
}

nook_result nook_tune_views_measure(nook_tune_views *views, const nook_setting *setting, nook_tune_set set,
                                    uint32_t view, bool timed, nook_tune_view *out)
{
    assert(view < views->desc.views_max);
    nook_sample sample;
    nook_result result = fill(views, setting);
    if (result == NOOK_OK)
        result = open_site(views, set, view);
    if (result == NOOK_OK)
        result = nook_site_measure(views->sites[set][view], setting, timed ? NOOK_MEASURE_TIME : 0, &sample);
    if (result != NOOK_OK)
        return result;
    if (!sample.truth.valid || sample.outside > 0)
        return nook_fail(
            NOOK_E_DEVICE,
            "%s: %llu pixels are not finite and %llu visibilities outside of [0, 1]; its error means nothing",
            setting->technique->name, (unsigned long long)sample.truth.non_finite, (unsigned long long)sample.outside);
    /* The truth's noise is chance of its own: its square is a part of the squared difference, and known. */
    double noise = sample.reference_noise;
    *out = (nook_tune_view){ .squared = sample.truth.rmse * sample.truth.rmse - noise * noise,
                             .pixels = (double)sample.truth.count,
                             .ms = timed ? sample.ms_median : NAN,
                             .ms_spread = timed ? 0.5 * (sample.ms_max - sample.ms_min) : NAN,
                             .noise = noise };
    return NOOK_OK;
}

static nook_result time_round(nook_tune_views *views, const nook_setting *setting, nook_tune_set set, uint32_t count,
                              nook_site_times *times)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < count && result == NOOK_OK; i++) {
        result = nook_site_show(views->sites[set][i]);
        if (result == NOOK_OK)
            result = nook_site_time_round(views->sites[set][i], setting, &times[i]);
    }
    return result;
}

nook_result nook_tune_views_time(nook_tune_views *views, const nook_setting *setting, nook_tune_set set, uint32_t count,
                                 nook_tune_view *out_views)
{
    assert(count <= views->desc.views_max);
    nook_site_times times[NOOK_TUNE_VIEWS_MAX] = { 0 };
    nook_result result = fill(views, setting);
    for (int round = 0; round < NOOK_SITE_ROUNDS && result == NOOK_OK; round++)
        result = time_round(views, setting, set, count, times);
    for (uint32_t i = 0; i < count && result == NOOK_OK; i++) {
        nook_sample sample;
        nook_site_times_put(&times[i], &sample);
        out_views[i].ms = sample.ms_median;
        out_views[i].ms_spread = 0.5 * (sample.ms_max - sample.ms_min);
    }
    return result;
}
