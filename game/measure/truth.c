#include "game/measure/truth.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/compare/run.h"
#include "game/interrupt.h"
#include "game/measure/truth_file.h"
#include "game/stage.h"
#include "modules/ao_reference/reference.h"
#include "modules/measure/noise.h"
#include "modules/measure/ssim.h"
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

enum {
    BATCH_RAYS = 128,        /* one net of the Sobol points: the more of it, the fewer rays for the same noise */
    FIRST_SEED = 0x10000000, /* no frame of a measured technique has it: the reference is measured as well */
};

/* ---- What it is the truth of ------------------------------------------------------------------------------------ */

static double get(const nook_ao *ao, const char *name)
{
    double value = NAN;
    nook_ao_get_param(ao, name, &value);
    return value;
}

/* Also of the surfaces as they were drawn: where another machine's rasteriser rounds an edge to the other side, the truth of
   that pixel is another surface's. */
static uint64_t make_key(const nook_stage *stage, const nook_truth_desc *desc, uint32_t batch_rays)
{
    const nook_camera *camera = &stage->frame.camera;
    size_t pixels = (size_t)stage->width * stage->height;
    nook_gbuffer gbuffer = nook_renderer_gbuffer(stage->renderer); /* rays start as far off as its formats are coarse */
    const double numbers[] = { NOOK_TRUTH_VERSION,
                               NOOK_REFERENCE_VERSION,
                               stage->width,
                               stage->height,
                               get(stage->ao, "ao.r_max"),
                               get(stage->ao, "ao.falloff"),
                               get(stage->ao, "ao.falloff_tau"),
                               desc->screen,
                               batch_rays,
                               gbuffer.depth.format,
                               gbuffer.geometric_normal.format,
                               camera->fov_y_radians,
                               camera->z_near };
    uint64_t hash = XXH3_64bits_withSeed(numbers, sizeof numbers, desc->scene_hash);
    hash = XXH3_64bits_withSeed(camera->view_from_world.m, sizeof camera->view_from_world.m, hash);
    hash = XXH3_64bits_withSeed(desc->surfaces->distances, pixels * sizeof(float), hash);
    return XXH3_64bits_withSeed(desc->surfaces->normals, pixels * 3 * sizeof(float), hash);
}

/* ---- Means ------------------------------------------------------------------------------------------------------ */

double nook_truth_noise(const nook_truth *truth, const uint8_t *mask)
{
    size_t pixels = (size_t)truth->width * truth->height;
    return nook_noise_of_mean(truth->sums[0], truth->sums[1], mask, pixels).rms / (0.5 * truth->batches);
}

nook_result nook_truth_compare_halves(const nook_truth *truth, double *out_ssim)
{
    size_t pixels = (size_t)truth->width * truth->height;
    float *halves = malloc(2 * pixels * sizeof *halves);
    nook_ssim ssim;
    if (!halves)
        return nook_fail(NOOK_E_MEMORY, "no memory for the halves of a truth of %zu pixels", pixels);
    for (size_t i = 0; i < 2 * pixels; i++)
        halves[i] = truth->sums[i / pixels][i % pixels] / (0.5f * (float)truth->batches);
    nook_result result =
        nook_ssim_measure(halves, halves + pixels, truth->geometry, truth->width, truth->height, &ssim);
    free(halves);
    if (result == NOOK_OK)
        *out_ssim = ssim.mean;
    return result;
}

static void update(nook_truth *truth)
{
    size_t pixels = (size_t)truth->width * truth->height;
    for (size_t i = 0; i < pixels; i++)
        truth->values[i] = (float)(((double)truth->sums[0][i] + (double)truth->sums[1][i]) / truth->batches);
    truth->noise = nook_truth_noise(truth, truth->geometry);
    truth->rays = truth->batches * truth->batch_rays;
}

nook_result nook_truth_open(nook_stage *stage, const nook_truth_desc *desc, nook_truth *out_truth)
{
    uint32_t batch_rays = desc->rays_max / 2 < BATCH_RAYS ? desc->rays_max / 2 : BATCH_RAYS;
    size_t pixels = (size_t)stage->width * stage->height;
    nook_truth truth = { .noise = INFINITY,
                         .rays_max = desc->rays_max,
                         .batch_rays = batch_rays > 0 ? batch_rays : 1,
                         .width = stage->width,
                         .height = stage->height,
                         .geometry = desc->geometry,
                         .screen = desc->screen };
    *out_truth = (nook_truth){ 0 };
    truth.values = calloc(pixels, sizeof *truth.values);
    truth.sums[0] = calloc(pixels, sizeof *truth.sums[0]);
    truth.sums[1] = calloc(pixels, sizeof *truth.sums[1]);
    if (!truth.values || !truth.sums[0] || !truth.sums[1]) {
        nook_truth_close(&truth);
        return nook_fail(NOOK_E_MEMORY, "no memory for the truth of %u x %u pixels", stage->width, stage->height);
    }
    truth.key = make_key(stage, desc, truth.batch_rays);
    if (desc->cache && nook_directory_try_make(desc->cache) == 0) {
        char name[32];
        snprintf(name, sizeof name, "%016" PRIx64 ".truth", truth.key);
        nook_path_join(truth.path, sizeof truth.path, desc->cache, name);
    }
    if (nook_truth_file_read(&truth))
        update(&truth);
    *out_truth = truth;
    return NOOK_OK;
}

void nook_truth_close(nook_truth *truth)
{
    free(truth->values);
    free(truth->sums[0]);
    free(truth->sums[1]);
    *truth = (nook_truth){ 0 };
}

/* ---- Tracing ---------------------------------------------------------------------------------------------------- */

static nook_result choose_reference(const nook_truth *truth, nook_stage *stage)
{
    nook_result result = nook_ao_set_technique(stage->ao, "reference");
    if (result == NOOK_OK)
        result = nook_ao_set_param(stage->ao, "reference.rays", truth->batch_rays);
    if (result == NOOK_OK)
        result = nook_ao_parse_param(stage->ao, "reference.sampling", "pixel");
    return result == NOOK_OK ? nook_ao_parse_param(stage->ao, "reference.sees", truth->screen ? "screen" : "scene")
                             : result;
}

static nook_result trace_batch(nook_truth *truth, nook_stage *stage)
{
    nook_grey picture;
    stage->frame_index = FIRST_SEED + truth->batches;
    nook_result result = nook_stage_occlude(stage);
    if (result == NOOK_OK)
        result = nook_compare_read_visibility(stage, &picture);
    if (result != NOOK_OK)
        return result;
    size_t pixels = (size_t)truth->width * truth->height;
    float *sums = truth->sums[truth->batches % 2];
    for (size_t i = 0; i < pixels; i++)
        sums[i] += picture.values[i];
    nook_grey_free(&picture);
    truth->batches++;
    return NOOK_OK;
}

/* An even number, more than there are, and as many as the noise of those that there are asks for. */
static uint32_t plan_batches(const nook_truth *truth, double noise)
{
    uint32_t most = truth->rays_max / truth->batch_rays / 2 * 2;
    double wanted = 2.0;
    if (truth->batches > 0) {
        double ratio = truth->noise / noise;
        wanted = fmax(truth->batches + 2.0, 2.0 * ceil(0.5 * truth->batches * ratio * ratio));
    }
    return wanted < most ? (uint32_t)wanted : most;
}

static nook_result trace_to(nook_truth *truth, nook_stage *stage, uint32_t batches, nook_progress *progress)
{
    uint32_t before = truth->batches;
    nook_result result = NOOK_OK;
    /* Told to end it stops as soon as the halves are equal again; what there is by then is kept. */
    while (truth->batches < batches && result == NOOK_OK && (truth->batches % 2 != 0 || !nook_interrupt_asked())) {
        result = trace_batch(truth, stage);
        nook_progress_update(progress, (double)(truth->batches - before) / (batches - before));
    }
    if (result != NOOK_OK)
        return result;
    update(truth);
    nook_truth_file_write(truth);
    return NOOK_OK;
}

nook_result nook_truth_refine(nook_truth *truth, nook_stage *stage, double noise)
{
    uint32_t frame_index = stage->frame_index;
    nook_progress *outer = stage->progress;
    nook_progress progress =
        nook_progress_begin_within(outer, truth->screen ? "tracing what the screen holds" : "tracing the truth");
    nook_result result = NOOK_OK;
    stage->progress = NULL;
    while (truth->noise > noise && plan_batches(truth, noise) > truth->batches && result == NOOK_OK &&
           !nook_interrupt_asked()) {
        result = choose_reference(truth, stage);
        if (result == NOOK_OK)
            result = trace_to(truth, stage, plan_batches(truth, noise), &progress);
    }
    nook_progress_end(&progress);
    stage->progress = outer;
    stage->frame_index = frame_index;
    return result;
}
