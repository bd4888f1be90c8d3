#include "game/compare/frame_times.h"
#include "game/compare/run.h"
#include "game/measure/site_internal.h"
#include "game/measure/site_time.h"
#include "game/stage.h"
#include "modules/ao/technique.h"
#include "modules/measure/noise.h"
#include <assert.h>
#include <math.h>

enum { SEEDS = 2 };

static nook_sample empty_sample(void)
{
    const nook_errors no_errors = { .rmse = NAN, .mae = NAN, .bias = NAN, .p99 = NAN, .max = NAN };
    return (nook_sample){ .ms_median = NAN,
                          .ms_min = NAN,
                          .ms_max = NAN,
                          .gpu_ms_median = NAN,
                          .fetches = NAN,
                          .bake_ms = NAN,
                          .truth = no_errors,
                          .screen = no_errors,
                          .ssim = NAN,
                          .ssim_ceiling = NAN,
                          .rmse_inside = NAN,
                          .rmse_outside = NAN,
                          .rmse_away = NAN,
                          .noise = NAN,
                          .instability = { .rms = NAN, .contrast = NAN, .relative = NAN },
                          .flicker = NAN,
                          .noise_inside = NAN,
                          .noise_outside = NAN,
                          .noise_away = NAN,
                          .screen_noise = NAN };
}

/* ---- Cost ------------------------------------------------------------------------------------------------------- */

/* Baking all volumes in the kind that is marched; NaN when any came from a cache: reading is not baking. */
static double sum_bake_ms(const nook_stage *stage)
{
    uint32_t count;
    const nook_world_volume *volumes = nook_game_world_volumes(stage->world, &count);
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        nook_world_bake bakes = nook_world_volume_sum(&volumes[i], nook_ao_volume_kinds(stage->ao));
        sum += bakes.there && bakes.cached ? NAN : bakes.ms;
    }
    return sum;
}

/* All rounds at once: where settings are compared, their caller takes turns (site_time.h). */
static nook_result time_rounds(nook_site *site, const nook_setting *setting, nook_sample *sample)
{
    nook_site_times times = { 0 };
    nook_result result = NOOK_OK;
    for (int round = 0; round < NOOK_SITE_ROUNDS && result == NOOK_OK; round++)
        result = nook_site_time_round(site, setting, &times);
    if (result == NOOK_OK)
        nook_site_times_put(&times, sample);
    return result;
}

/* A frame of an exact technique takes seconds: the only one is timed. */
static nook_result time_exact(nook_site *site, nook_sample *sample)
{
    nook_frame_times times;
    nook_result result = nook_frame_times_measure(site->stage, 1, INFINITY, &times);
    if (result != NOOK_OK)
        return result;
    sample->ms_median = times.median;
    sample->ms_min = times.min;
    sample->ms_max = times.max;
    sample->gpu_ms_median = times.gpu_median;
    sample->frames = times.frames;
    return NOOK_OK;
}

/* A frame that is not timed: its shaders count. */
static nook_result occlude(nook_site *site, nook_sample *sample, nook_ao_statistics *out_statistics)
{
    nook_result result = nook_stage_occlude(site->stage);
    if (result != NOOK_OK)
        return result;
    nook_ao_get_statistics(site->stage->ao, out_statistics);
    sample->outside += out_statistics->outside;
    return nook_stage_settle(site->stage);
}

/* The picture that is measured, and what it costs beside time. */
static nook_result take_picture(nook_site *site, const nook_setting *setting, uint32_t what, nook_sample *sample,
                                nook_grey *out_picture)
{
    const nook_ao_technique *technique = setting->technique;
    bool volumes = technique->inputs & NOOK_AO_IN_VOLUMES, timed = technique->exact && what & NOOK_MEASURE_TIME;
    nook_ao_statistics statistics;
    nook_result result = timed ? time_exact(site, sample) : NOOK_OK;
    if (!timed)
        result = occlude(site, sample, &statistics);
    if (result == NOOK_OK && !technique->exact) {
        sample->fetches = statistics.fetches_per_pixel;
        sample->volume_bytes = volumes ? (double)statistics.volume_bytes : 0.0;
        sample->texture_bytes = (double)statistics.texture_bytes;
        sample->bake_ms = volumes ? sum_bake_ms(site->stage) : 0.0;
    }
    return result == NOOK_OK ? nook_compare_read_visibility(site->stage, out_picture) : result;
}

/* ---- Steadiness ------------------------------------------------------------------------------------------------- */

static nook_result record(nook_site *site, uint32_t seed, nook_sample *sample, nook_grey *out_picture)
{
    nook_ao_statistics statistics;
    site->stage->frame_index = seed;
    nook_result result = occlude(site, sample, &statistics);
    site->stage->frame_index = 0;
    return result == NOOK_OK ? nook_compare_read_visibility(site->stage, out_picture) : result;
}

static nook_result record_from(nook_site *site, const nook_camera *camera, nook_sample *sample, nook_grey *out_picture)
{
    nook_result result = nook_stage_begin(site->stage, camera);
    return result == NOOK_OK ? record(site, 0, sample, out_picture) : result;
}

static nook_result measure_noise(nook_site *site, const nook_grey *picture, nook_sample *sample)
{
    nook_grey others[SEEDS - 1] = { 0 };
    const float *pictures[SEEDS] = { picture->values };
    nook_result result = NOOK_OK;
    for (uint32_t i = 1; i < SEEDS && result == NOOK_OK; i++) {
        result = record(site, i, sample, &others[i - 1]);
        pictures[i] = others[i - 1].values;
    }
    if (result == NOOK_OK) {
        nook_noise noise = nook_noise_measure(pictures, SEEDS, site->geometry, (size_t)site->width * site->height);
        sample->noise = noise.rms;
        sample->noise_non_finite = noise.non_finite;
    }
    for (size_t i = 0; i < NOOK_COUNT(others); i++)
        nook_grey_free(&others[i]);
    return result;
}

static nook_result measure_instability(nook_site *site, const nook_grey *picture, nook_sample *sample)
{
    nook_grey second;
    nook_result result = record_from(site, &site->views.second.camera, sample, &second);
    if (result != NOOK_OK)
        return result;
    sample->instability = nook_instability_measure(&site->views.second_match, picture->values, second.values);
    nook_grey_free(&second);
    return NOOK_OK;
}

static nook_result measure_flicker(nook_site *site, const nook_grey *picture, nook_sample *sample)
{
    nook_grey others[NOOK_PATH_VIEWS - 1] = { 0 };
    const float *pictures[NOOK_PATH_VIEWS] = { picture->values };
    nook_result result = NOOK_OK;
    for (int i = 1; i < NOOK_PATH_VIEWS && result == NOOK_OK; i++) {
        result = record_from(site, &site->views.path[i], sample, &others[i - 1]);
        pictures[i] = others[i - 1].values;
    }
    if (result == NOOK_OK) {
        nook_noise flicker = nook_flicker_measure(site->views.path_matches, pictures, NOOK_PATH_VIEWS);
        sample->flicker = flicker.rms;
        sample->flicker_non_finite = flicker.non_finite;
    }
    for (size_t i = 0; i < NOOK_COUNT(others); i++)
        nook_grey_free(&others[i]);
    return result;
}

/* Seeds first, while the G-buffer is the site's own; it is again afterwards. */
static nook_result measure_steadiness(nook_site *site, const nook_grey *picture, nook_sample *sample)
{
    nook_result result = measure_noise(site, picture, sample);
    if (result == NOOK_OK)
        result = measure_instability(site, picture, sample);
    if (result == NOOK_OK)
        result = measure_flicker(site, picture, sample);
    return result == NOOK_OK ? nook_stage_begin(site->stage, &site->camera) : result;
}

/* Everything that needs the picture, which stays the caller's. */
static nook_result measure_picture(nook_site *site, const nook_setting *setting, uint32_t what,
                                   const nook_grey *picture, nook_sample *sample)
{
    nook_result result = NOOK_OK;
    if (what & NOOK_MEASURE_STEADINESS && !setting->technique->exact) /* whose frames take seconds */
        result = measure_steadiness(site, picture, sample);
    return result == NOOK_OK ? nook_site_measure_errors(site, setting, what, picture, sample) : result;
}

static bool is_as_it_was(const nook_site *site)
{
    double r_max = NAN;
    nook_ao_get_param(site->stage->ao, "ao.r_max", &r_max);
    return r_max == site->r_max && site->width == site->stage->width && site->height == site->stage->height;
}

/* With counting, which slows the shaders down: times are not taken here but of exact techniques, which count nothing. */
static nook_result measure_counted(nook_site *site, const nook_setting *setting, uint32_t what, nook_grey *picture,
                                   nook_sample *sample)
{
    nook_result result = nook_ao_set_param(site->stage->ao, "ao.count", 1.0);
    if (result == NOOK_OK)
        result = take_picture(site, setting, what, sample, picture);
    if (result == NOOK_OK)
        result = measure_picture(site, setting, what, picture, sample);
    nook_result reset = nook_ao_set_param(site->stage->ao, "ao.count", 0.0);
    return result == NOOK_OK ? reset : result;
}

nook_result nook_site_measure(nook_site *site, const nook_setting *setting, uint32_t what, nook_sample *out_sample)
{
    assert((what & ~site->what) == 0 && "a site is opened for all that is asked of it");
    assert(is_as_it_was(site) && "r_max and size are the site's");
    nook_sample sample = empty_sample();
    nook_grey picture = { 0 };
    nook_result result = nook_site_show(site);
    if (result == NOOK_OK)
        result = nook_setting_apply(site->stage->ao, setting);
    if (result == NOOK_OK && what & NOOK_MEASURE_TIME && !setting->technique->exact)
        result = time_rounds(site, setting, &sample);
    if (result == NOOK_OK)
        result = measure_counted(site, setting, what, &picture, &sample);
    if (result == NOOK_OK && what & NOOK_MEASURE_PICTURE)
        sample.visibility = picture;
    else
        nook_grey_free(&picture);
    if (result == NOOK_OK)
        *out_sample = sample;
    return result;
}
