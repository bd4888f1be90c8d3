#include "game/compare/run.h"
#include "engine/core/log.h"
#include "game/compare/frame_times.h"
#include "game/compare/surfaces.h"
#include "game/progress.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES_DEFAULT = 5, TIMING_BUDGET_MS = 4000 };

static nook_result time_frames(nook_stage *stage, double budget_ms, nook_compare_row *row)
{
    nook_frame_times times;
    nook_result result = nook_frame_times_measure(stage, row->frames, budget_ms, &times);
    if (result != NOOK_OK)
        return result;
    row->frames = times.frames;
    row->ms_median = times.median;
    row->ms_min = times.min;
    row->ms_max = times.max;
    row->gpu_ms_median = times.gpu_median;
    return NOOK_OK;
}

/* Counting slows the shaders down, so it has a frame of its own; that one warms up what the others share with it. */
static nook_result count_fetches(nook_stage *stage, nook_compare_row *row)
{
    nook_result result = nook_ao_set_param(stage->ao, "ao.count", 1.0);
    if (result == NOOK_OK)
        result = nook_stage_occlude(stage);
    if (result != NOOK_OK)
        return result;
    nook_ao_statistics statistics;
    nook_ao_get_statistics(stage->ao, &statistics);
    row->fetches_per_pixel = statistics.fetches_per_pixel;
    return nook_ao_set_param(stage->ao, "ao.count", 0.0);
}

nook_result nook_compare_read_visibility(nook_stage *stage, nook_grey *out_grey)
{
    nook_ao_texture texture = nook_ao_visibility(stage->ao);
    nook_result result = nook_grey_create(texture.width, texture.height, out_grey);
    if (result != NOOK_OK)
        return result;
    nook_texture gl = { texture.native, GL_TEXTURE_2D, texture.width, texture.height, 1, GL_R32F };
    nook_texture_read(stage->gpu, gl, GL_RED, GL_FLOAT, out_grey->values,
                      (size_t)texture.width * texture.height * sizeof(float));
    return NOOK_OK;
}

static nook_result read_lit(nook_stage *stage, nook_picture *out_picture)
{
    nook_result result = nook_picture_create(stage->width, stage->height, out_picture);
    if (result != NOOK_OK)
        return result;
    result = nook_stage_finish(stage, true, NOOK_VIEW_LIT);
    nook_renderer_read(stage->renderer, &out_picture->pixels->r);
    return result;
}

static nook_result run_technique(nook_stage *stage, double budget_ms, nook_compare_row *row)
{
    row->fetches_per_pixel = NAN;
    nook_result result = nook_ao_set_technique(stage->ao, row->technique->name);
    if (result == NOOK_OK && !row->technique->exact)
        result = count_fetches(stage, row);
    if (result == NOOK_OK && !row->technique->exact)
        result = nook_stage_occlude(stage); /* warms up */
    if (result == NOOK_OK)
        result = time_frames(stage, budget_ms, row);
    if (result == NOOK_OK)
        result = nook_stage_settle(stage);
    if (result == NOOK_OK)
        result = nook_compare_read_visibility(stage, &row->visibility);
    return result == NOOK_OK ? read_lit(stage, &row->lit) : result;
}

static nook_result run_row(nook_stage *stage, nook_comparison *comparison, uint32_t index, uint32_t frames)
{
    nook_compare_row *row = &comparison->rows[index];
    char what[64];
    double budget_ms = frames == 0 ? TIMING_BUDGET_MS : INFINITY;
    row->frames = row->technique->exact ? 1 : frames == 0 ? FRAMES_DEFAULT : frames;
    snprintf(what, sizeof what, "%s the %s", row->technique->exact ? "tracing" : "timing", row->technique->name);
    nook_progress progress = nook_progress_begin(what);
    stage->progress = &progress;
    nook_result result = run_technique(stage, budget_ms, row);
    stage->progress = NULL;
    nook_progress_end(&progress);
    nook_stage_show(stage, row->technique->name);
    if (result != NOOK_OK)
        return result;
    return nook_errors_measure(row->visibility.values, comparison->rows[0].visibility.values, comparison->geometry,
                               (size_t)comparison->width * comparison->height, &row->errors);
}

nook_result nook_compare_run(nook_stage *stage, const nook_camera *camera, const nook_compare_choice *choice,
                             uint32_t frames, nook_comparison *out_comparison)
{
    *out_comparison = (nook_comparison){ .width = stage->width, .height = stage->height };
    nook_result result = nook_stage_begin(stage, camera);
    if (result == NOOK_OK)
        result = nook_geometry_read(stage, &out_comparison->geometry);
    if (result == NOOK_OK)
        result = nook_stage_finish(stage, false, NOOK_VIEW_LIT);
    if (result == NOOK_OK)
        nook_stage_show(stage, "first the truth");
    for (uint32_t i = 0; i < choice->count && result == NOOK_OK; i++) {
        out_comparison->rows[i].technique = choice->techniques[i];
        out_comparison->row_count = i + 1;
        result = run_row(stage, out_comparison, i, frames);
    }
    if (result != NOOK_OK)
        nook_comparison_free(out_comparison);
    return result;
}

void nook_comparison_free(nook_comparison *comparison)
{
    for (uint32_t i = 0; i < comparison->row_count; i++) {
        nook_grey_free(&comparison->rows[i].visibility);
        nook_picture_free(&comparison->rows[i].lit);
    }
    nook_view_pictures_free(&comparison->views);
    free(comparison->geometry);
    *comparison = (nook_comparison){ 0 };
}
