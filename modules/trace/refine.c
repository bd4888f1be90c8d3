#include "modules/trace/refine.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "modules/trace/pixel_rays.h"
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum {
    RAYS_FIRST = 4,  /* of the first two pictures: they are there at once */
    RAYS_LAST = 128, /* of all later ones: one net of the Sobol points, as of measured truths */
    PROBE_RAYS = 512,
    PIXELS_AT_ONCE = 32,     /* between two looks whether to stop */
    FIRST_SEED = 0x20000000, /* no frame and no measured truth has it */
    LOWEST_PRIORITY = 19,
};

struct nook_refine {
    nook_tracer *tracer;
    nook_ao_snapshot frame;
    uint32_t rays_max;
    unsigned workers;       /**< At a picture, the thread itself among them. */
    nook_ray_point *points; /**< Of the picture in work. */
    nook_ray_point *probe_points;
    float *picture; /**< In work; width * height, as are the sums. */
    float *sums[2]; /**< Of visibility times rays, over even and odd pictures. */
    double *shares; /**< Of a probe, of each instance. */
    nook_trace_work work;
    pthread_t thread;
    bool started; /**< And not joined yet. */
    atomic_bool stopping, ready, running;
    atomic_int result;
    pthread_mutex_t mutex;   /**< Of what stands below. */
    float *readable_sums[2]; /**< The sums as they were when both had as many rays. */
    uint32_t readable;       /**< Rays in both of these together. */
};

/* ---- The thread --------------------------------------------------------------------------------------------------- */

static bool stops(const nook_refine *r)
{
    return atomic_load_explicit(&r->stopping, memory_order_relaxed);
}

static void trace_rows(void *user, size_t first, size_t last, unsigned worker)
{
    (void)worker;
    nook_refine *r = user;
    uint32_t width = r->frame.pass.width;
    for (size_t y = first; y < last; y++) {
        for (uint32_t x = 0; x < width && !stops(r); x += PIXELS_AT_ONCE) {
            uint32_t end = width - x < PIXELS_AT_ONCE ? width : x + PIXELS_AT_ONCE;
            nook_trace_pixels(&r->work, x, end, (uint32_t)y, r->picture + y * width);
        }
    }
}

/** Two pictures each of 4, 8, 16, ... rays. */
static uint32_t rays_of_picture(uint32_t picture)
{
    uint32_t doublings = picture / 2;
    return doublings > 5 ? (uint32_t)RAYS_LAST : (uint32_t)RAYS_FIRST << doublings;
}

/** A picture belongs to its half; when both have as many rays, they can be read. */
static void keep_picture(nook_refine *r, uint32_t picture, uint32_t rays, uint32_t total)
{
    size_t pixels = (size_t)r->frame.pass.width * r->frame.pass.height;
    float *sum = r->sums[picture % 2];
    for (size_t i = 0; i < pixels; i++)
        sum[i] += r->picture[i] * (float)rays;
    if (picture % 2 == 0)
        return;
    pthread_mutex_lock(&r->mutex);
    for (int half = 0; half < 2; half++)
        memcpy(r->readable_sums[half], r->sums[half], pixels * sizeof *sum);
    r->readable = total;
    pthread_mutex_unlock(&r->mutex);
}

static void refine(nook_refine *r)
{
    uint32_t total = 0;
    for (uint32_t picture = 0; !stops(r) && total + rays_of_picture(picture) <= r->rays_max; picture++) {
        uint32_t rays = rays_of_picture(picture);
        nook_ray_points_fill(r->points, rays);
        r->work.count = rays;
        r->work.seed = FIRST_SEED + picture;
        nook_parallel_for(r->frame.pass.height, r->workers, trace_rows, r);
        total += rays;
        if (!stops(r))
            keep_picture(r, picture, rays, total);
    }
}

/** Its helpers, which nook_parallel_for starts, inherit the priority: all of it takes what nobody else wants. */
static void *run(void *user)
{
    nook_refine *r = user;
    setpriority(PRIO_PROCESS, 0, LOWEST_PRIORITY); /* on Linux: of this thread alone */
    nook_result result = nook_tracer_update(r->tracer, &r->frame.pass);
    atomic_store(&r->result, (int)result);
    if (result == NOOK_OK) {
        atomic_store(&r->ready, true);
        refine(r);
    }
    atomic_store(&r->running, false);
    return NULL;
}

/* ---- Start and stop ----------------------------------------------------------------------------------------------- */

nook_result nook_refine_create(nook_refine **out_refine)
{
    *out_refine = NULL;
    nook_refine *r = calloc(1, sizeof *r);
    if (!r)
        return nook_fail(NOOK_E_MEMORY, "refinement: no memory");
    r->points = malloc(RAYS_LAST * sizeof *r->points);
    r->probe_points = malloc(PROBE_RAYS * sizeof *r->probe_points);
    nook_result result = r->points && r->probe_points ? nook_tracer_create(1, &r->tracer) /* at its own low priority */
                                                      : nook_fail(NOOK_E_MEMORY, "refinement: no memory");
    if (result != NOOK_OK) {
        free(r->points);
        free(r->probe_points);
        free(r);
        return result;
    }
    pthread_mutex_init(&r->mutex, NULL);
    nook_ray_points_fill(r->probe_points, PROBE_RAYS);
    *out_refine = r;
    return NOOK_OK;
}

void nook_refine_stop(nook_refine *r)
{
    atomic_store(&r->stopping, true);
    if (r->started)
        pthread_join(r->thread, NULL);
    r->started = false;
}

static void forget(nook_refine *r)
{
    nook_ao_snapshot_free(&r->frame);
    free(r->picture);
    free(r->shares);
    r->picture = NULL;
    r->shares = NULL;
    for (int half = 0; half < 2; half++) {
        free(r->sums[half]);
        free(r->readable_sums[half]);
        r->sums[half] = r->readable_sums[half] = NULL;
    }
    r->readable = 0;
    atomic_store(&r->ready, false);
    atomic_store(&r->result, (int)NOOK_OK);
}

void nook_refine_destroy(nook_refine *r)
{
    if (!r)
        return;
    nook_refine_stop(r);
    forget(r);
    nook_tracer_destroy(r->tracer);
    pthread_mutex_destroy(&r->mutex);
    free(r->points);
    free(r->probe_points);
    free(r);
}

static bool allocate(nook_refine *r)
{
    size_t pixels = (size_t)r->frame.pass.width * r->frame.pass.height;
    r->picture = malloc(pixels * sizeof *r->picture);
    r->shares = calloc(r->frame.pass.instance_count + 1, sizeof *r->shares);
    bool whole = r->picture && r->shares;
    for (int half = 0; half < 2; half++) {
        r->sums[half] = calloc(pixels, sizeof *r->sums[half]);
        r->readable_sums[half] = calloc(pixels, sizeof *r->readable_sums[half]);
        whole = whole && r->sums[half] && r->readable_sums[half];
    }
    return whole;
}

nook_result nook_refine_start(nook_refine *r, const nook_refine_desc *desc, nook_ao_snapshot *snapshot)
{
    nook_refine_stop(r);
    forget(r);
    r->frame = *snapshot;
    *snapshot = (nook_ao_snapshot){ 0 };
    r->rays_max = desc->rays_max;
    unsigned cores = nook_core_count();
    r->workers = desc->threads ? desc->threads : cores > 1 ? cores - 1 : 1;
    if (!allocate(r)) {
        forget(r);
        return nook_fail(NOOK_E_MEMORY, "refinement: no memory for a picture");
    }
    r->work = (nook_trace_work){ .pass = &r->frame.pass,
                                 .triangles = r->tracer,
                                 .depth = r->frame.depth,
                                 .normal = r->frame.normal,
                                 .points = r->points };
    atomic_store(&r->stopping, false);
    atomic_store(&r->running, true);
    r->started = pthread_create(&r->thread, NULL, run, r) == 0;
    if (r->started)
        return NOOK_OK;
    atomic_store(&r->running, false);
    forget(r);
    return nook_fail(NOOK_E_DEVICE, "refinement: no thread can be started");
}

/* ---- Reading ------------------------------------------------------------------------------------------------------ */

nook_refine_status nook_refine_look(nook_refine *r)
{
    nook_refine_status status = { .running = atomic_load(&r->running),
                                  .ready = atomic_load(&r->ready),
                                  .result = (nook_result)atomic_load(&r->result),
                                  .rays_max = r->rays_max };
    pthread_mutex_lock(&r->mutex);
    status.rays = r->readable;
    pthread_mutex_unlock(&r->mutex);
    return status;
}

/** Half the RMS difference of the halves, over the geometry. */
static double noise_of(const nook_refine *r, float scale)
{
    size_t pixels = (size_t)r->frame.pass.width * r->frame.pass.height, count = 0;
    double sum = 0.0;
    for (size_t i = 0; i < pixels; i++) {
        if (!(r->frame.depth[i] > 0.0f))
            continue;
        double apart = (double)((r->readable_sums[0][i] - r->readable_sums[1][i]) * scale);
        sum += apart * apart;
        count++;
    }
    return count ? 0.5 * sqrt(sum / (double)count) : NAN;
}

uint32_t nook_refine_read(nook_refine *r, float *out_mean, double *out_noise)
{
    size_t pixels = (size_t)r->frame.pass.width * r->frame.pass.height;
    pthread_mutex_lock(&r->mutex);
    uint32_t rays = r->readable;
    float scale = rays ? 1.0f / (float)rays : 0.0f;
    for (size_t i = 0; rays && i < pixels; i++)
        out_mean[i] = (r->readable_sums[0][i] + r->readable_sums[1][i]) * scale;
    if (rays)
        *out_noise = noise_of(r, 2.0f * scale);
    pthread_mutex_unlock(&r->mutex);
    return rays;
}

const float *nook_refine_depth(const nook_refine *r, uint32_t *out_width, uint32_t *out_height)
{
    *out_width = r->frame.pass.width;
    *out_height = r->frame.pass.height;
    return r->frame.depth;
}

/* ---- Probes ------------------------------------------------------------------------------------------------------- */

/** The largest shares, by insertion. */
static void rank(const nook_refine *r, nook_refine_probe_result *out)
{
    for (uint32_t i = 0; i < r->frame.pass.instance_count; i++) {
        double share = r->shares[i];
        uint32_t at = out->count;
        if (!(share > 0.0) || (at == NOOK_REFINE_SHARES_MAX && share <= out->shares[at - 1]))
            continue;
        at = at == NOOK_REFINE_SHARES_MAX ? at - 1 : at;
        for (; at > 0 && out->shares[at - 1] < share; at--) {
            out->shares[at] = out->shares[at - 1];
            out->occluders[at] = out->occluders[at - 1];
        }
        out->shares[at] = share;
        out->occluders[at] = r->frame.occluders[i];
        out->count += out->count < NOOK_REFINE_SHARES_MAX;
    }
}

bool nook_refine_probe(nook_refine *r, uint32_t x, uint32_t y, nook_refine_probe_result *out_result)
{
    const nook_ao_pass *pass = &r->frame.pass;
    if (!atomic_load(&r->ready) || x >= pass->width || y >= pass->height ||
        !(r->frame.depth[(size_t)y * pass->width + x] > 0.0f))
        return false;
    nook_trace_work work = r->work;
    work.points = r->probe_points;
    work.count = PROBE_RAYS;
    work.seed = FIRST_SEED;
    memset(r->shares, 0, pass->instance_count * sizeof *r->shares);
    *out_result = (nook_refine_probe_result){ .rays = PROBE_RAYS };
    out_result->visibility = nook_trace_shares(&work, x, y, r->shares);
    rank(r, out_result);
    return true;
}
