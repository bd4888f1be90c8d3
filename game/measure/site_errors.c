#include "game/measure/measure_verdict.h"
#include "game/measure/site_internal.h"
#include "game/stage.h"
#include "modules/ao/technique.h"
#include "modules/measure/ssim.h"
#include <math.h>

static size_t pixel_count(const nook_site *site)
{
    return (size_t)site->width * site->height;
}

/* @param side  of a silhouette; those without a pixel have neither error nor noise */
static nook_result measure_side(const nook_site *site, const nook_grey *picture, size_t side, double *out_rmse,
                                double *out_noise)
{
    nook_errors errors;
    nook_result result =
        nook_errors_measure(picture->values, site->truth.values, site->sides[side], pixel_count(site), &errors);
    if (result != NOOK_OK)
        return result;
    *out_rmse = errors.rmse;
    *out_noise = nook_truth_noise(&site->truth, site->sides[side]);
    return NOOK_OK;
}

static nook_result measure_against_truth(const nook_site *site, const nook_grey *picture, nook_sample *sample)
{
    double *const errors[] = { &sample->rmse_inside, &sample->rmse_outside, &sample->rmse_away };
    double *const noises[] = { &sample->noise_inside, &sample->noise_outside, &sample->noise_away };
    nook_result result =
        nook_errors_measure(picture->values, site->truth.values, site->geometry, pixel_count(site), &sample->truth);
    for (size_t i = 0; i < NOOK_COUNT(errors) && result == NOOK_OK; i++)
        result = measure_side(site, picture, i, errors[i], noises[i]);
    sample->reference_noise = site->truth.noise;
    sample->reference_rays = site->truth.rays;
    return result;
}

static nook_result measure_against_screen(const nook_site *site, const nook_grey *picture, nook_sample *sample)
{
    sample->screen_noise = site->screen.noise;
    return nook_errors_measure(picture->values, site->screen.values, site->geometry, pixel_count(site),
                               &sample->screen);
}

typedef nook_result measure_function(const nook_site *site, const nook_grey *picture, nook_sample *sample);

/* Measures; where the truth is too noisy for what was found, it is traced further and measured again. */
static nook_result measure_until_quiet(nook_site *site, nook_truth *truth, measure_function *measure, bool is_screen,
                                       const nook_grey *picture, nook_sample *sample)
{
    nook_result result = measure(site, picture, sample);
    uint32_t rays = 0;
    while (result == NOOK_OK && truth->rays != rays) {
        double part = nook_measure_noise_part(sample, is_screen, NULL);
        if (part <= NOOK_MEASURE_NOISE_PART)
            break;
        rays = truth->rays;
        result = nook_truth_refine(truth, site->stage, truth->noise * NOOK_MEASURE_NOISE_PART / part);
        if (result == NOOK_OK)
            result = measure(site, picture, sample);
    }
    return result;
}

/* Found once for every state of the truth. */
static nook_result find_ceiling(nook_site *site)
{
    double similarity;
    if (site->ceiling_rays == site->truth.rays)
        return NOOK_OK;
    nook_result result = nook_truth_compare_halves(&site->truth, &similarity);
    if (result != NOOK_OK)
        return result;
    site->ceiling = nook_ssim_ceiling(similarity);
    site->ceiling_rays = site->truth.rays;
    return NOOK_OK;
}

static nook_result measure_similarity(nook_site *site, const nook_grey *picture, nook_sample *sample)
{
    nook_ssim ssim;
    nook_result result = find_ceiling(site);
    if (result == NOOK_OK)
        result =
            nook_ssim_measure(picture->values, site->truth.values, site->geometry, site->width, site->height, &ssim);
    if (result != NOOK_OK)
        return result;
    sample->ssim = ssim.mean;
    sample->ssim_ceiling = site->ceiling;
    return NOOK_OK;
}

/* What is left out of `screen`: the rays of the screen's own truth, whose difference from it is chance. */
nook_result nook_site_measure_errors(nook_site *site, const nook_setting *setting, uint32_t what,
                                     const nook_grey *picture, nook_sample *sample)
{
    nook_result result = measure_until_quiet(site, &site->truth, measure_against_truth, false, picture, sample);
    if (result == NOOK_OK)
        result = measure_similarity(site, picture, sample);
    if (result == NOOK_OK && what & NOOK_MEASURE_SCREEN && !setting->technique->exact)
        result = measure_until_quiet(site, &site->screen, measure_against_screen, true, picture, sample);
    else if (what & NOOK_MEASURE_SCREEN)
        sample->screen_noise = site->screen.noise;
    return result;
}
