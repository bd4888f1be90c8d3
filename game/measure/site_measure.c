#include "engine/core/clock.h"
#include "game/compare/frame_times.h"
#include "game/compare/run.h"
#include "game/measure/site_internal.h"
#include "game/stage.h"
#include "modules/ao/technique.h"
#include "modules/measure/noise.h"
#include <assert.h>
#include <math.h>

enum { FRAMES_MIN = 3, FRAMES_MAX = 9, TIMING_MS = 400, WARM_UPS = 2, SEEDS = 2 };

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

/* Baking all volumes; NaN when any came from a cache: reading is not baking. */
static double sum_bake_ms(const nook_game_world *world)
{
    uint32_t count;
    const nook_world_volume *volumes = nook_game_world_volumes(world, &count);
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++)
        sum += volumes[i].cached ? NAN : volumes[i].bake_ms;
    return sum;
}

/* Counting slows the shaders down, so it has a frame of its own; that one warms up what the others share with it. */
static nook_result count(nook_site *site, const nook_ao_technique *technique, nook_sample *sample)
{
    nook_ao *ao = site->stage->ao;
    nook_ao_statistics statistics;
    nook_result result = nook_ao_set_param(ao, "ao.count", 1.0);
    if (result == NOOK_OK)
        result = nook_stage_occlude(site->stage);
    if (result != NOOK_OK)
        return result;
    nook_ao_get_statistics(ao, &statistics);
    bool volumes = technique->inputs & NOOK_AO_IN_VOLUMES;
    sample->fetches = statistics.fetches_per_pixel;
    sample->outside = statistics.outside;
    sample->volume_bytes = volumes ? (double)statistics.volume_bytes : 0.0;
    sample->texture_bytes = (double)statistics.texture_bytes;
    sample->bake_ms = volumes ? sum_bake_ms(site->stage->world) : 0.0;
    return nook_ao_set_param(ao, "ao.count", 0.0);
}

/* As many frames as fit, told from the second of two that warm up: the first links and compiles, as without counting it is another
   program. */
static nook_result warm_up(nook_site *site, uint32_t *out_frames)
{
    double start = 0.0;
    nook_result result = NOOK_OK;
    for (int i = 0; i < WARM_UPS && result == NOOK_OK; i++) {
        nook_gpu_finish(site->stage->gpu);
        start = nook_clock_ms();
        result = nook_stage_occlude(site->stage);
    }
    nook_gpu_finish(site->stage->gpu);
    double frames = TIMING_MS / fmax(nook_clock_ms() - start, 1e-3);
    *out_frames = (uint32_t)fmin(fmax(frames, FRAMES_MIN), FRAMES_MAX);
    return result;
}

/* The last frame is the picture that is measured. */
static nook_result time_frames(nook_site *site, const nook_ao_technique *technique, nook_sample *sample)
{
    nook_frame_times times;
    uint32_t frames = 1;
    nook_result result = technique->exact ? NOOK_OK : warm_up(site, &frames);
    if (result == NOOK_OK)
        result = nook_frame_times_measure(site->stage, frames, INFINITY, &times);
    if (result != NOOK_OK)
        return result;
    sample->ms_median = times.median;
    sample->ms_min = times.min;
    sample->ms_max = times.max;
    sample->gpu_ms_median = times.gpu_median;
    sample->frames = times.frames;
    return NOOK_OK;
}

/* ---- Steadiness ------------------------------------------------------------------------------------------------- */

static nook_result record(nook_site *site, uint32_t seed, nook_grey *out_picture)
{
    site->stage->frame_index = seed;
    nook_result result = nook_stage_occlude(site->stage);
    site->stage->frame_index = 0;
    return result == NOOK_OK ? nook_compare_read_visibility(site->stage, out_picture) : result;
}

static nook_result record_from(nook_site *site, const nook_camera *camera, nook_grey *out_picture)
{
    nook_result result = nook_stage_begin(site->stage, camera);
    return result == NOOK_OK ? record(site, 0, out_picture) : result;
}

static nook_result measure_noise(nook_site *site, const nook_grey *picture, nook_sample *sample)
{
    nook_grey others[SEEDS - 1] = { 0 };
    const float *pictures[SEEDS] = { picture->values };
    nook_result result = NOOK_OK;
    for (uint32_t i = 1; i < SEEDS && result == NOOK_OK; i++) {
        result = record(site, i, &others[i - 1]);
        pictures[i] = others[i - 1].values;
    }
    if (result == NOOK_OK)
        sample->noise = nook_noise_measure(pictures, SEEDS, site->geometry, (size_t)site->width * site->height).rms;
    for (size_t i = 0; i < NOOK_COUNT(others); i++)
        nook_grey_free(&others[i]);
    return result;
}

static nook_result measure_instability(nook_site *site, const nook_grey *picture, nook_sample *sample)
{
    nook_grey second;
    nook_result result = record_from(site, &site->views.second.camera, &second);
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
        result = record_from(site, &site->views.path[i], &others[i - 1]);
        pictures[i] = others[i - 1].values;
    }
    if (result == NOOK_OK)
        sample->flicker = nook_flicker_measure(site->views.path_matches, pictures, NOOK_PATH_VIEWS).rms;
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

nook_result nook_site_measure(nook_site *site, const nook_setting *setting, uint32_t what, nook_sample *out_sample)
{
    assert((what & ~site->what) == 0 && "a site is opened for all that is asked of it");
    assert(is_as_it_was(site) && "r_max and size are the site's");
    nook_sample sample = empty_sample();
    nook_grey picture = { 0 };
    site->stage->frame_index = 0;
    nook_result result = nook_stage_begin(site->stage, &site->camera);
    if (result == NOOK_OK)
        result = nook_setting_apply(site->stage->ao, setting);
    if (result == NOOK_OK && !setting->technique->exact)
        result = count(site, setting->technique, &sample);
    if (result == NOOK_OK && what & NOOK_MEASURE_TIME)
        result = time_frames(site, setting->technique, &sample);
    else if (result == NOOK_OK)
        result = nook_stage_occlude(site->stage);
    if (result == NOOK_OK)
        result = nook_compare_read_visibility(site->stage, &picture);
    if (result == NOOK_OK)
        result = measure_picture(site, setting, what, &picture, &sample);
    if (result == NOOK_OK && what & NOOK_MEASURE_PICTURE)
        sample.visibility = picture;
    else
        nook_grey_free(&picture);
    if (result == NOOK_OK)
        *out_sample = sample;
    return result;
}
