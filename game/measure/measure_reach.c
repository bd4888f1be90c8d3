#include "game/measure/measure_reach.h"
#include "engine/core/log.h"
#include "game/interrupt.h"
#include "game/measure/measure_origin.h"
#include "game/measure/measure_pictures.h"
#include "game/measure/measure_views.h"
#include "game/measure/site_time.h"
#include "modules/ao/technique.h"
#include <stdlib.h>
#include <string.h>

/* One r_max and falloff of one scene. */
typedef struct reach {
    nook_measure_run *run;
    nook_stage *stage;
    const nook_result_row *names;
    nook_measure_views *views;
    nook_site **sites; /* one a view; NULL until something is measured there */
    uint32_t *rays;    /* of its truth when its pictures were written */
} reach;

static bool reads_volumes(const nook_setting *setting)
{
    return (setting->technique->inputs & NOOK_AO_IN_VOLUMES) != 0;
}

/* The row of a setting at a view, but for its sample. @param text  NOOK_SETTING_TEXT_MAX bytes that the row borrows */
static nook_result_row make_row(const reach *r, uint32_t view, const nook_setting *setting, char *text)
{
    nook_result_row row = *r->names;
    row.camera = r->views->items[view].name;
    row.technique = (char *)setting->technique->name;
    row.setting = (char *)nook_setting_print(setting, text);
    row.initial = strcmp(row.setting, row.technique) == 0;
    row.picture = "";
    row.date = "";
    return row;
}

static bool is_pending(const reach *r, uint32_t view, const nook_setting *setting)
{
    char text[NOOK_SETTING_TEXT_MAX];
    nook_result_row row = make_row(r, view, setting, text);
    return nook_results_find(r->run->results, &row) == NULL;
}

/* What is still to be measured of one setting at one view. */
typedef struct pending_row {
    uint32_t view;
    const nook_setting *setting;
    nook_site_times times;
} pending_row;

/* ---- Sites ------------------------------------------------------------------------------------------------------ */

static nook_result write_site(reach *r, uint32_t view)
{
    char text[NOOK_SETTING_TEXT_MAX];
    nook_measure_site_paths paths;
    nook_result_site site;
    nook_result_row row = make_row(r, view, &r->run->sweep->settings[0], text);
    nook_result result = nook_measure_site_write(r->stage, r->sites[view], &r->views->items[view].camera, &row,
                                                 r->run->folder, &paths, &site);
    if (result == NOOK_OK)
        result = nook_journal_append_site(r->run->journal, &site);
    if (result == NOOK_OK)
        result = nook_results_put_site(r->run->results, &site);
    r->rays[view] = nook_site_rays(r->sites[view]);
    return result;
}

static nook_result open_site(reach *r, uint32_t view)
{
    if (r->sites[view])
        return NOOK_OK;
    const nook_site_desc desc = { .camera = r->views->items[view].camera,
                                  .camera_name = r->views->items[view].name,
                                  .noise = r->run->sweep->noise,
                                  .rays_max = r->run->sweep->rays_max,
                                  .cache = r->run->cache,
                                  .what = NOOK_MEASURE_ALL,
                                  .scene_hash = strtoull(r->names->scene_hash, NULL, 16) };
    nook_result result = nook_site_open(r->stage, &desc, &r->sites[view]);
    r->run->sites += result == NOOK_OK;
    return result == NOOK_OK && !nook_interrupt_asked() ? write_site(r, view) : result;
}

/* Pictures of truths that have become better since they were written; and none that nobody looks for. */
static nook_result finish_site(reach *r, uint32_t view)
{
    char text[NOOK_SETTING_TEXT_MAX];
    nook_result_row row = make_row(r, view, &r->run->sweep->settings[0], text);
    nook_result result = NOOK_OK;
    if (r->rays[view] != nook_site_rays(r->sites[view]))
        result = write_site(r, view);
    if (result == NOOK_OK && !r->run->sweep->all_pictures && !nook_interrupt_asked())
        result = nook_measure_pictures_prune(r->run->results, &row, r->run->folder);
    return result;
}

static nook_result finish_sites(reach *r)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < r->views->count && result == NOOK_OK; i++) {
        if (r->sites[i])
            result = finish_site(r, i);
    }
    return result;
}

/* ---- Rows ------------------------------------------------------------------------------------------------------- */

static nook_result keep_row(reach *r, nook_result_row *row)
{
    char picture[NOOK_MEASURE_PICTURE_MAX], date[NOOK_ORIGIN_DATE_SIZE];
    const nook_grey *visibility = &row->sample.visibility;
    row->picture = (char *)nook_measure_picture_path(row, row->setting, picture);
    row->date = (char *)nook_origin_date(date);
    nook_result result =
        nook_measure_picture_write(r->run->folder, picture, visibility->values, visibility->width, visibility->height);
    if (result == NOOK_OK)
        result = nook_journal_append(r->run->journal, row);
    return result == NOOK_OK ? nook_results_put(r->run->results, row) : result;
}

/* One frame of an exact technique is timed as it is measured. */
static nook_result measure_row(reach *r, const pending_row *pending)
{
    char text[NOOK_SETTING_TEXT_MAX];
    bool in_rounds = pending->times.rounds > 0;
    nook_result_row row = make_row(r, pending->view, pending->setting, text);
    nook_measure_progress_show(&r->run->progress, &row);
    nook_result result =
        nook_site_measure(r->sites[pending->view], pending->setting,
                          in_rounds ? NOOK_MEASURE_ALL & ~NOOK_MEASURE_TIME : NOOK_MEASURE_ALL, &row.sample);
    if (result != NOOK_OK)
        return result;
    if (in_rounds)
        nook_site_times_put(&pending->times, &row.sample);
    if (!nook_interrupt_asked()) /* else its truth may not be what it should be */
        result = keep_row(r, &row);
    nook_grey_free(&row.sample.visibility);
    if (result == NOOK_OK && !nook_interrupt_asked())
        nook_measure_progress_row(&r->run->progress, &row);
    return result;
}

static nook_result measure_rows(reach *r, const pending_row *rows, size_t count)
{
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < count && result == NOOK_OK && !nook_interrupt_asked(); i++)
        result = measure_row(r, &rows[i]);
    return result;
}

/* ---- Times ------------------------------------------------------------------------------------------------------ */

/* Ordered by view: each one's G-buffer is drawn once. */
static nook_result time_round(reach *r, pending_row *rows, size_t count)
{
    uint32_t shown = UINT32_MAX;
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < count && result == NOOK_OK && !nook_interrupt_asked(); i++) {
        char text[NOOK_SETTING_TEXT_MAX];
        pending_row *pending = &rows[i];
        nook_result_row row = make_row(r, pending->view, pending->setting, text);
        if (pending->setting->technique->exact)
            continue;
        nook_measure_progress_show(&r->run->progress, &row);
        if (pending->view != shown)
            result = nook_site_show(r->sites[pending->view]);
        shown = pending->view;
        if (result == NOOK_OK)
            result = nook_site_time_round(r->sites[pending->view], pending->setting, &pending->times);
    }
    return result;
}

/* Sites first: their truths are traced by all cores. */
static nook_result time_rows(reach *r, pending_row *rows, size_t count)
{
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < count && result == NOOK_OK && !nook_interrupt_asked(); i++)
        result = open_site(r, rows[i].view);
    for (int round = 0; round < NOOK_SITE_ROUNDS && result == NOOK_OK; round++)
        result = time_round(r, rows, count);
    return result;
}

/* ---- Volumes of one resolution ---------------------------------------------------------------------------------- */

/* Volumes whose baking is measured come from no cache. */
static nook_result fill(reach *r, uint32_t resolution, bool volumes)
{
    const nook_game_world_desc world = { resolution, r->names->r_max, volumes ? NULL : r->run->cache };
    nook_result result = nook_stage_fill(r->stage, &world);
    double aspect = (double)r->stage->width / r->stage->height;
    return result == NOOK_OK ? nook_measure_views_find(r->stage->scene, aspect, r->views) : result;
}

/* @param out_rows  as many as settings times views @param out_volumes  whether any of them reads volumes @return how many */
static size_t list_pending(const reach *r, uint32_t resolution, pending_row *out_rows, bool *out_volumes)
{
    const nook_sweep *sweep = r->run->sweep;
    size_t count = 0;
    *out_volumes = false;
    for (size_t k = 0; k < sweep->setting_count * r->views->count; k++) {
        uint32_t view = (uint32_t)(k / sweep->setting_count);
        const nook_setting *setting = &sweep->settings[k % sweep->setting_count];
        if (setting->resolution != resolution || !is_pending(r, view, setting))
            continue;
        out_rows[count++] = (pending_row){ .view = view, .setting = setting };
        *out_volumes = *out_volumes || reads_volumes(setting);
    }
    return count;
}

/* All settings of one resolution, also those that read no volumes: they take turns. Interrupted, what was only timed is lost. */
static nook_result measure_group(reach *r, uint32_t resolution)
{
    size_t most = r->run->sweep->setting_count * r->views->count;
    bool volumes;
    pending_row *rows = calloc(most, sizeof *rows);
    if (!rows)
        return nook_fail(NOOK_E_MEMORY, "no memory for %zu rows", most);
    size_t count = list_pending(r, resolution, rows, &volumes);
    nook_result result = count > 0 ? fill(r, resolution, volumes) : NOOK_OK;
    if (result == NOOK_OK)
        result = time_rows(r, rows, count);
    if (result == NOOK_OK)
        result = measure_rows(r, rows, count);
    free(rows);
    return result;
}

/* A group stands where its first setting does. */
static bool is_first_of_group(const nook_sweep *sweep, size_t index)
{
    for (size_t i = 0; i < index; i++) {
        if (sweep->settings[i].resolution == sweep->settings[index].resolution)
            return false;
    }
    return true;
}

static nook_result measure_groups(reach *r)
{
    const nook_sweep *sweep = r->run->sweep;
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < sweep->setting_count && result == NOOK_OK; i++) {
        if (is_first_of_group(sweep, i) && !nook_interrupt_asked())
            result = measure_group(r, sweep->settings[i].resolution);
    }
    return result == NOOK_OK ? finish_sites(r) : result;
}

/* ---- The whole of it -------------------------------------------------------------------------------------------- */

static size_t count_pending(const reach *r, uint32_t view)
{
    size_t pending = 0;
    for (size_t i = 0; i < r->run->sweep->setting_count; i++)
        pending += is_pending(r, view, &r->run->sweep->settings[i]);
    return pending;
}

/* Counts what is there. @return how many rows are not */
static size_t count_reused(const reach *r)
{
    nook_measure_run *run = r->run;
    size_t all = 0;
    for (uint32_t view = 0; view < r->views->count; view++) {
        size_t pending = count_pending(r, view);
        run->sites += pending == 0; /* the others when they are opened */
        run->reused += run->sweep->setting_count - pending;
        nook_measure_progress_reused(&run->progress, run->sweep->setting_count - pending);
        all += pending;
    }
    return all;
}

static nook_result measure_pending(reach *r)
{
    nook_ao *ao = r->stage->ao;
    nook_result result = nook_ao_set_param(ao, "ao.r_max", r->names->r_max);
    if (result == NOOK_OK)
        result = nook_ao_parse_param(ao, "ao.falloff", r->names->falloff);
    return result == NOOK_OK ? measure_groups(r) : result;
}

nook_result nook_measure_reach(nook_measure_run *run, nook_stage *stage, nook_measure_views *views,
                               const nook_result_row *names)
{
    reach r = { .run = run, .stage = stage, .names = names, .views = views };
    if (count_reused(&r) == 0)
        return NOOK_OK;
    r.sites = calloc(views->count, sizeof(nook_site *));
    r.rays = calloc(views->count, sizeof *r.rays);
    nook_result result =
        r.sites && r.rays ? measure_pending(&r) : nook_fail(NOOK_E_MEMORY, "no memory for %u cameras", views->count);
    for (uint32_t i = 0; r.sites && i < views->count; i++)
        nook_site_close(r.sites[i]);
    free(r.sites);
    free(r.rays);
    return result;
}
