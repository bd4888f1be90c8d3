/* The truth of a frozen frame: refined in the background, compared with what each view shows. */
#include "engine/core/log.h"
#include "game/live/live_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const uint32_t rays_max = 16384; /* minutes on few cores: noise is then far below any error that is looked for */

/* ---- Start and end ------------------------------------------------------------------------------------------------ */

static void release_pictures(nook_live *live)
{
    live_truth *t = &live->truth;
    nook_texture_destroy(live->stage->gpu, &t->texture);
    free(t->mean);
    free(t->visibility);
    t->mean = t->visibility = NULL;
}

/* Of the frame's size; kept from one freeze to the next. */
static nook_result fit_pictures(nook_live *live)
{
    live_truth *t = &live->truth;
    const nook_stage *stage = live->stage;
    size_t pixels = (size_t)stage->width * stage->height;
    if (t->mean && t->texture.width == stage->width && t->texture.height == stage->height)
        return NOOK_OK;
    release_pictures(live);
    nook_result result =
        nook_texture_create_2d(stage->gpu, GL_R32F, stage->width, stage->height, GL_NEAREST, &t->texture);
    t->mean = malloc(pixels * sizeof *t->mean);
    t->visibility = malloc(pixels * sizeof *t->visibility);
    if (result == NOOK_OK && (!t->mean || !t->visibility))
        result = nook_fail(NOOK_E_MEMORY, "live truth: no memory for %zu pixels", pixels);
    if (result != NOOK_OK)
        release_pictures(live);
    return result;
}

static void remember_reach(nook_live *live)
{
    live->truth.reach[0] = live->views.r_max;
    live->truth.reach[1] = live->views.falloff;
    live->truth.reach[2] = live->views.falloff_tau;
}

static bool reach_changed(const nook_live *live)
{
    const double *reach = live->truth.reach;
    return reach[0] != live->views.r_max || reach[1] != live->views.falloff || reach[2] != live->views.falloff_tau;
}

static nook_result start(nook_live *live)
{
    live_truth *t = &live->truth;
    nook_ao_snapshot snapshot;
    const nook_refine_desc desc = { .rays_max = rays_max };
    nook_ao_frame frame = nook_stage_ao_frame(live->stage);
    frame.same_view = live->view_recorded;
    nook_result result = t->refine ? NOOK_OK : nook_refine_create(&t->refine);
    if (result == NOOK_OK)
        result = fit_pictures(live);
    if (result == NOOK_OK)
        result = live_apply_shared(live);
    if (result == NOOK_OK)
        result = nook_ao_snapshot_take(live->stage->ao, &frame, &snapshot);
    return result == NOOK_OK ? nook_refine_start(t->refine, &desc, &snapshot) : result;
}

void live_truth_start(nook_live *live)
{
    live_truth *t = &live->truth;
    live_truth_stop(live);
    remember_reach(live);
    t->started = start(live) == NOOK_OK;
    t->failed = !t->started;
    if (!t->started)
        live_note(live, "the truth cannot be traced; the log says why");
}

/* A view that needs it, or a frame that was frozen for it. */
static bool wanted(nook_live *live)
{
    bool wanted = live->freeze;
    for (uint32_t i = 0; i < live->views.count && live->frozen && !wanted; i++) {
        const nook_live_view *v = &live->views.views[i];
        wanted = v->mode == NOOK_LIVE_ERROR ||
                 (!v->open && nook_live_mode_occludes(v->mode) && live_setting_of(live, i).technique->exact);
    }
    return wanted;
}

void live_truth_follow(nook_live *live)
{
    live_truth *t = &live->truth;
    bool wants = wanted(live);
    if (wants && !t->started && !t->failed)
        live_truth_start(live);
    else if (!wants && t->started)
        live_truth_stop(live);
}

void live_truth_stop(nook_live *live)
{
    live_truth *t = &live->truth;
    live->stale = live->stale || t->started;
    t->failed = false;
    if (t->refine)
        nook_refine_stop(t->refine);
    t->started = false;
    t->rays = 0;
    t->probed = false;
    memset(t->errors, 0, sizeof t->errors);
}

void live_truth_release(nook_live *live)
{
    nook_refine_destroy(live->truth.refine);
    live->truth.refine = NULL;
    release_pictures(live);
}

/* ---- Errors ------------------------------------------------------------------------------------------------------- */

bool live_truth_update(nook_live *live)
{
    live_truth *t = &live->truth;
    if (!t->started)
        return false;
    if (reach_changed(live)) {
        live_truth_start(live);
        return true;
    }
    if (nook_refine_look(t->refine).rays == t->rays)
        return false;
    t->rays = nook_refine_read(t->refine, t->mean, &t->noise);
    nook_texture_write(live->stage->gpu, t->texture, GL_RED, GL_FLOAT, t->mean,
                       (size_t)t->texture.width * t->texture.height * sizeof *t->mean);
    return true;
}

/* @param open  the view shows visibility 1 everywhere */
static live_error measure(const live_truth *t, const nook_rectangle *part, const float *depth, bool open)
{
    live_error error = { 0 };
    double sum = 0.0, squares = 0.0;
    for (uint32_t y = part->y; y < part->y + part->height; y++) {
        for (uint32_t x = part->x; x < part->x + part->width; x++) {
            size_t i = (size_t)y * t->texture.width + x;
            if (!(depth[i] > 0.0f))
                continue;
            double apart = (open ? 1.0 : (double)t->visibility[i]) - (double)t->mean[i];
            sum += apart, squares += apart * apart;
            error.pixels++;
        }
    }
    if (error.pixels > 0) {
        error.bias = sum / error.pixels;
        error.rmse = sqrt(squares / error.pixels);
    }
    return error;
}

void live_truth_measure(nook_live *live)
{
    live_truth *t = &live->truth;
    uint32_t width, height;
    memset(t->errors, 0, sizeof t->errors);
    if (!t->started || t->rays == 0)
        return;
    const float *depth = nook_refine_depth(t->refine, &width, &height);
    bool any = false;
    for (uint32_t i = 0; i < live->views.count; i++)
        any = any || live->visibility[i].id != 0;
    if (any)
        nook_texture_read(live->stage->gpu, nook_stage_visibility(live->stage), GL_RED, GL_FLOAT, t->visibility,
                          (size_t)width * height * sizeof *t->visibility);
    for (uint32_t i = 0; i < live->views.count; i++) {
        const nook_live_view *v = &live->views.views[i];
        bool open = live->visibility[i].id == 0;
        if (nook_live_mode_occludes(v->mode) && open == v->open && live->visibility[i].id != t->texture.id)
            t->errors[i] = measure(t, &live->places[i], depth, open);
    }
}

nook_texture live_truth_texture(const nook_live *live)
{
    const nook_texture none = { 0 };
    return live->truth.started && live->truth.rays > 0 ? live->truth.texture : none;
}
