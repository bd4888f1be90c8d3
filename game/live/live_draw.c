/* One frame: the G-buffer once, then of each view its AO and its part of the image. */
#include "game/live/live_internal.h"
#include "modules/ao/technique.h"
#include <string.h>

/* ---- The G-buffer ------------------------------------------------------------------------------------------------- */

static nook_result draw_gbuffer(nook_live *live, const nook_camera *camera)
{
    nook_stage *stage = live->stage;
    live_times_begin(live, LIVE_PASS_WORLD);
    nook_result result = nook_stage_update(stage, camera);
    live_times_end(live, LIVE_PASS_WORLD);
    if (result != NOOK_OK)
        return result;
    live_times_begin(live, LIVE_PASS_SHADOW);
    result = nook_frame_shadow(stage->renderer, &stage->frame);
    live_times_end(live, LIVE_PASS_SHADOW);
    if (result != NOOK_OK)
        return result;
    live_times_begin(live, LIVE_PASS_GBUFFER);
    nook_frame_gbuffer(stage->renderer, &stage->frame);
    live_times_end(live, LIVE_PASS_GBUFFER);
    live->camera = *camera;
    live->frame_width = stage->width, live->frame_height = stage->height;
    live->view_recorded = false;
    live->stale = true;
    return nook_stage_check(stage, "the G-buffer");
}

/* ---- The views ---------------------------------------------------------------------------------------------------- */

/* A mode that counts gets its image empty. */
static nook_result bind_counts(nook_live *live, uint32_t view, nook_ao_frame *frame)
{
    static const uint32_t zero = 0;
    const uint32_t mode = live->views.views[view].mode;
    if (!nook_live_mode_counts(mode))
        return NOOK_OK;
    nook_result result = live_fit_counts(live);
    const nook_rectangle *part = &live->places[view];
    const nook_texture *counts = &live->targets.counts;
    if (result != NOOK_OK)
        return result;
    live->stage->gpu->gl->ClearTexSubImage(counts->id, 0, (GLint)part->x, (GLint)part->y, 0, (GLsizei)part->width,
                                           (GLsizei)part->height, 1, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    frame->fetches = (nook_ao_texture){ counts->id, counts->width, counts->height };
    frame->counts = mode == NOOK_LIVE_FETCHES ? NOOK_AO_COUNTS_FETCHES : NOOK_AO_COUNTS_STEPS;
    frame->same_view = 0; /* what is read once for all views belongs to each */
    return NOOK_OK;
}

static nook_result record_view(nook_live *live, uint32_t view, const nook_setting *setting)
{
    nook_ao_frame frame = nook_stage_ao_frame(live->stage);
    const nook_rectangle all = { 0 };
    frame.part = live->views.count == 1 ? all : live->places[view];
    frame.same_view = live->view_recorded;
    live_times_begin(live, (live_pass)(LIVE_PASS_AO + view));
    nook_result result = bind_counts(live, view, &frame);
    if (result == NOOK_OK)
        result = live_apply(live, setting);
    if (result == NOOK_OK && live->coarse)
        result = nook_ao_parse_param(live->stage->ao, "ao.scale", "quarter");
    if (result == NOOK_OK)
        result = nook_ao_get_param(live->stage->ao, "ao.scale", &live->scales[view]);
    if (result == NOOK_OK)
        result = nook_ao_record(live->stage->ao, &frame);
    live_times_end(live, (live_pass)(LIVE_PASS_AO + view));
    live->view_recorded = result == NOOK_OK;
    return result;
}

/* Whether a failure is that of a shader that does not build: who watches them shows why, until it is mended. */
static bool is_forgiven(const nook_live *live)
{
    nook_shader_report report;
    if (!live->shaders_reload)
        return false;
    nook_gpu_shader_report(live->stage->gpu, &report);
    return report.failed > 0;
}

/* Fills in live->visibility of a view. What is exact is too slow for a frame: it is what has been traced behind it. */
static nook_result occlude_view(nook_live *live, uint32_t view)
{
    const nook_live_view *v = &live->views.views[view];
    live->visibility[view] = (nook_texture){ 0 };
    if (v->open || !nook_live_mode_occludes(v->mode))
        return NOOK_OK;
    nook_setting setting = live_setting_of(live, view);
    if (setting.technique->exact) {
        live->visibility[view] = live_truth_texture(live);
        return NOOK_OK;
    }
    nook_result result = record_view(live, view, &setting);
    if (result == NOOK_OK)
        live->visibility[view] = nook_stage_visibility(live->stage);
    return result != NOOK_OK && is_forgiven(live) ? NOOK_OK : result;
}

/* All views' visibility lies in one texture, so that light needs no turns with AO. */
static nook_result occlude_views(nook_live *live)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < live->views.count && result == NOOK_OK; i++)
        result = occlude_view(live, i);
    return result;
}

static nook_result show_views(nook_live *live)
{
    nook_texture truth = live_truth_texture(live);
    nook_result result = NOOK_OK;
    live_times_begin(live, LIVE_PASS_LIGHT);
    for (uint32_t i = 0; i < live->views.count && result == NOOK_OK; i++) {
        result = live_show_view(live, i, live->visibility[i], truth);
        if (result != NOOK_OK && is_forgiven(live))
            result = NOOK_OK;
    }
    live_times_end(live, LIVE_PASS_LIGHT);
    return result == NOOK_OK ? nook_stage_check(live->stage, "the views") : result;
}

/* Exact views show the truth as it is now. */
static void refresh_truth(nook_live *live)
{
    for (uint32_t i = 0; i < live->views.count; i++) {
        const nook_live_view *v = &live->views.views[i];
        if (!v->open && nook_live_mode_occludes(v->mode) && live_setting_of(live, i).technique->exact)
            live->visibility[i] = live_truth_texture(live);
    }
}

/* What makes the picture, and what undo takes back: which view is active does neither. */
static nook_live_views state_of(const nook_live *live)
{
    nook_live_views state = live->views;
    state.active = 0;
    return state;
}

/* A frame that stands still is not made again: the cores are for its truth. */
static nook_result draw_views(nook_live *live, const nook_live_views *state)
{
    bool changed = live->stale || memcmp(&live->drawn, state, sizeof *state) != 0;
    bool news = live_truth_update(live);
    nook_result result = NOOK_OK;
    if (!changed && !news)
        return NOOK_OK;
    live->stale = true;
    if (changed)
        result = occlude_views(live);
    else
        refresh_truth(live);
    if (result == NOOK_OK)
        result = show_views(live);
    if (result != NOOK_OK)
        return result;
    live_truth_measure(live);
    live->drawn = *state;
    live->stale = false;
    return NOOK_OK;
}

/* In every frame, and not of those alone that are kept for the truth. */
static bool reads_triangles(nook_live *live)
{
    bool reads = false;
    for (uint32_t i = 0; i < live->views.count; i++) {
        const nook_ao_technique *technique = live_setting_of(live, i).technique;
        reads = reads || (!technique->exact && technique->inputs & NOOK_AO_IN_MESHES);
    }
    return reads;
}

/* What stands still is drawn anew until its volumes are there. */
static bool volumes_come(const nook_stage *stage)
{
    return stage->stream && !nook_stream_is_settled(stage->stream);
}

/* The frame that is to be kept is drawn once more. */
static nook_result follow(nook_live *live, const nook_camera *camera)
{
    const nook_stage *stage = live->stage;
    bool resized = live->frame_width != stage->width || live->frame_height != stage->height;
    bool keep = live->freeze || live->hold, kept = keep && live->frozen;
    nook_result result = NOOK_OK;
    if (!kept || resized || volumes_come(stage)) {
        live_truth_stop(live);
        nook_game_world_set_traced(stage->world, keep || reads_triangles(live));
        result = draw_gbuffer(live, kept ? &live->camera : camera);
    }
    live->frozen = keep;
    if (result == NOOK_OK)
        live_truth_follow(live);
    return result;
}

bool nook_live_is_stale(const nook_live *live)
{
    bool keep = live->freeze || live->hold;
    bool resized = live->frame_width != live->stage->width || live->frame_height != live->stage->height;
    if (!keep || !live->frozen || resized || live->stale || live->picture_asked || live->capture ||
        volumes_come(live->stage))
        return true;
    nook_live_views state = state_of(live);
    bool news = live->truth.started && nook_refine_look(live->truth.refine).rays != live->truth.rays;
    return news || memcmp(&live->drawn, &state, sizeof state) != 0 || live_overlay_moves(live);
}

nook_result nook_live_draw(nook_live *live, const nook_camera *camera)
{
    nook_stage *stage = live->stage;
    live_times_frame(live);
    nook_result result = follow(live, camera);
    if (result != NOOK_OK)
        return result;
    live_overlay_build(live); /* before the views: what is changed in a panel is seen in the same frame */
    nook_live_views state = state_of(live);
    nook_live_views_place(&live->views, stage->width, stage->height, live->places);
    result = draw_views(live, &state);
    if (live->held == NOOK_LIVE_SPLITS_MAX && !(live->overlay_used && nook_overlay_busy(live->overlay)))
        nook_live_history_push(&live->history, &state);
    if (result != NOOK_OK)
        return result;
    live_picture_by_key(live);
    live_capture_frame(live);
    return NOOK_OK;
}
