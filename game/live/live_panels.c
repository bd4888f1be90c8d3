/* The panel of the views: techniques, modes, and every parameter as its params.def has it. */
#include "game/live/live_internal.h"
#include "modules/ao/technique.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CHOICES_SIZE = 1024 };

static const double panel_height = 44.0;   /* letters' heights */
static const double reach_decades = 100.0; /* r_max is shown from 1/100 to 100 times what it was at first */

/* ---- Parameters --------------------------------------------------------------------------------------------------- */

static const char *unit_of(const nook_param *param)
{
    switch (param->unit) {
    case NOOK_UNIT_METRE:
        return "m";
    case NOOK_UNIT_PIXEL:
        return "px";
    case NOOK_UNIT_DEGREE:
        return "deg";
    default:
        return "";
    }
}

/* Scales over more than three decades are logarithmic. */
static bool slide_float(nook_overlay *o, const nook_param *param, double *value)
{
    if (param->lowest > 0.0 && param->highest > 1000.0 * param->lowest)
        return nook_overlay_slider_logarithmic(o, param->name, value, param->lowest, param->highest, unit_of(param));
    return nook_overlay_slider(o, param->name, value, param->lowest, param->highest, unit_of(param));
}

/* @return true when the user has changed it */
static bool edit_param(nook_overlay *o, const nook_param *param, double *value)
{
    bool changed;
    int whole = (int)*value;
    if (param->type == NOOK_PARAM_FLOAT) {
        changed = slide_float(o, param, value);
    } else if (param->type == NOOK_PARAM_INT) {
        changed =
            nook_overlay_slider_int(o, param->name, &whole, (int)param->lowest, (int)param->highest, unit_of(param));
        *value = whole;
    } else {
        changed = nook_overlay_choice(o, param->name, &whole, param->choices);
        *value = whole;
    }
    nook_overlay_tooltip(o, param->help);
    return changed;
}

/* Rows of one table: the technique's, or the shared ones. */
static void edit_params(nook_live *live, nook_setting *setting, bool shared_ones, bool *changed)
{
    const nook_param *param;
    bool shared;
    for (size_t i = 0; (param = nook_setting_param_at(setting->technique, i, &shared)); i++) {
        if (shared != shared_ones)
            continue;
        nook_setting_param entry = { param, shared, nook_setting_get(setting, param) };
        char name[64], text[NOOK_SETTING_VALUE_MAX];
        nook_overlay_push_id(live->overlay, (int)i);
        if (edit_param(live->overlay, param, &entry.value)) {
            snprintf(name, sizeof name, "%s%s", shared ? "ao." : "", param->name);
            *changed |= nook_setting_assign("panel", setting, name, nook_setting_value(&entry, text)) == NOOK_OK;
        }
        nook_overlay_pop_id(live->overlay);
    }
}

/* ---- The active view ---------------------------------------------------------------------------------------------- */

/* "none|volume|ssao|..." */
static void list_techniques(const nook_live *live, char out[CHOICES_SIZE])
{
    size_t used = (size_t)snprintf(out, CHOICES_SIZE, "none");
    for (uint32_t i = 0; i < live->technique_count && used < CHOICES_SIZE; i++)
        used += (size_t)snprintf(out + used, CHOICES_SIZE - used, "|%s", live->techniques[i]);
}

static void edit_technique(nook_live *live, const nook_setting *setting)
{
    nook_live_view *view = &live->views.views[live->views.active];
    char choices[CHOICES_SIZE];
    int chosen = view->open ? 0 : (int)live_technique_number(live, view->setting) + 1;
    list_techniques(live, choices);
    if (nook_overlay_choice(live->overlay, "technique", &chosen, choices)) {
        if (chosen > 0)
            live_choose_technique(live, (uint32_t)chosen - 1);
        else
            view->open = true;
    }
    nook_overlay_tooltip(live->overlay, setting->technique->summary);
}

static void edit_mode(nook_live *live)
{
    nook_live_view *view = &live->views.views[live->views.active];
    char choices[CHOICES_SIZE] = "";
    size_t used = 0;
    int mode = (int)view->mode;
    for (uint32_t i = 0; i < nook_live_mode_count() && used < sizeof choices; i++)
        used += (size_t)snprintf(choices + used, sizeof choices - used, "%s%s", i ? "|" : "", nook_live_mode_name(i));
    if (nook_overlay_choice(live->overlay, "shows", &mode, choices))
        view->mode = (uint32_t)mode;
}

static void edit_view(nook_live *live)
{
    nook_overlay *o = live->overlay;
    uint32_t active = live->views.active;
    nook_setting setting = live_setting_of(live, active);
    bool changed = false;
    edit_mode(live);
    edit_technique(live, &setting);
    if (live->views.views[active].open)
        return;
    nook_overlay_separator(o);
    setting = live_setting_of(live, active); /* another technique may have been chosen */
    edit_params(live, &setting, false, &changed);
    if (!setting.technique->exact && nook_overlay_section(o, "resolution and filter", true))
        edit_params(live, &setting, true, &changed);
    if (changed)
        live_set_setting(live, active, &setting);
    if (nook_overlay_button(o, "reset this view")) {
        setting = nook_setting_initial(setting.technique);
        live_set_setting(live, active, &setting);
    }
}

/* ---- What all views share ----------------------------------------------------------------------------------------- */

static void edit_shared(nook_live *live)
{
    nook_live_views *views = &live->views;
    size_t count;
    const nook_param *shared = nook_ao_shared_params(&count), *falloff = nook_param_find(shared, count, "falloff");
    nook_overlay_slider_logarithmic(live->overlay, "r_max", &views->r_max, live->first.r_max / reach_decades,
                                    live->first.r_max * reach_decades, "m");
    nook_overlay_tooltip(live->overlay, "reach of the occlusion, of all views and of the truth");
    edit_param(live->overlay, falloff, &views->falloff);
}

static bool any_shows(const nook_live *live, uint32_t first, uint32_t last)
{
    for (uint32_t i = 0; i < live->views.count; i++) {
        if (live->views.views[i].mode >= first && live->views.views[i].mode <= last)
            return true;
    }
    return false;
}

const char *live_body_name(const nook_live *live, nook_ao_volume volume, nook_ao_mesh mesh)
{
    uint32_t count;
    const nook_world_volume *volumes = nook_game_world_volumes(live->stage->world, &count);
    for (uint32_t i = 0; i < count; i++) {
        if ((volume.id && volumes[i].occluder.volume.id == volume.id) ||
            (!volume.id && volumes[i].occluder.mesh.id == mesh.id))
            return volumes[i].name;
    }
    return "?";
}

static void edit_body(nook_live *live)
{
    nook_live_views *views = &live->views;
    uint32_t count;
    char text[160];
    int body = (int)views->body;
    nook_game_world_occluders(live->stage->world, &count);
    const nook_ao_occluder *chosen = live_chosen_body(live);
    if (!chosen) {
        nook_overlay_text(live->overlay, "there are no bodies with volumes");
        return;
    }
    if (nook_overlay_slider_int(live->overlay, "body", &body, 0, (int)count - 1, ""))
        views->body = (uint32_t)body;
    snprintf(text, sizeof text, "%s", live_body_name(live, chosen->volume, chosen->mesh));
    nook_overlay_text(live->overlay, text);
    if (!any_shows(live, NOOK_LIVE_SLICES, NOOK_LIVE_SLICES))
        return;
    nook_overlay_slider(live->overlay, "cut x", &views->slice[0], 0.0, 1.0, "");
    nook_overlay_slider(live->overlay, "cut y", &views->slice[1], 0.0, 1.0, "");
    nook_overlay_slider(live->overlay, "cut z", &views->slice[2], 0.0, 1.0, "");
}

static void edit_ranges(nook_live *live)
{
    nook_live_views *views = &live->views;
    if (any_shows(live, NOOK_LIVE_ERROR, NOOK_LIVE_ERROR))
        nook_overlay_slider_logarithmic(live->overlay, "full colour at error", &views->error_range, 0.005, 1.0, "");
    if (any_shows(live, NOOK_LIVE_OCCLUDERS, NOOK_LIVE_OCCLUDERS))
        nook_overlay_slider_logarithmic(live->overlay, "full colour at occluders", &views->counts_range, 1.0, 256.0,
                                        "");
    if (any_shows(live, NOOK_LIVE_FETCHES, NOOK_LIVE_FETCHES))
        nook_overlay_slider_logarithmic(live->overlay, "full colour at fetches", &views->fetches_range, 10.0, 1e5, "");
    if (any_shows(live, NOOK_LIVE_STEPS, NOOK_LIVE_STEPS))
        nook_overlay_slider_logarithmic(live->overlay, "full colour at steps", &views->steps_range, 10.0, 1e5, "");
    if (any_shows(live, NOOK_LIVE_SLICES, NOOK_LIVE_VOXELS))
        edit_body(live);
}

/* ---- The panel ---------------------------------------------------------------------------------------------------- */

static void edit_count(nook_live *live)
{
    int count = (int)live->views.count, active = (int)live->views.active;
    if (nook_overlay_slider_int(live->overlay, "views", &count, 1, NOOK_LIVE_VIEWS_MAX, ""))
        nook_live_views_set_count(&live->views, (uint32_t)count);
    if (live->views.count == 3 && nook_overlay_button(live->overlay, "turn"))
        nook_live_views_turn(&live->views);
    if (live->views.count == 1)
        return;
    char choices[CHOICES_SIZE] = "";
    size_t used = 0;
    for (uint32_t i = 0; i < live->views.count; i++)
        used += (size_t)snprintf(choices + used, sizeof choices - used, "%s%u", i ? "|" : "", i + 1);
    if (nook_overlay_choice(live->overlay, "of them", &active, choices))
        live->views.active = (uint32_t)active;
}

static void offer_history(nook_live *live)
{
    nook_overlay *o = live->overlay;
    uint32_t active = live->views.active;
    if (nook_overlay_button(o, "undo"))
        nook_live_history_undo(&live->history, &live->views);
    nook_overlay_same_line(o);
    if (nook_overlay_button(o, "redo"))
        nook_live_history_redo(&live->history, &live->views);
    nook_overlay_same_line(o);
    if (nook_overlay_button(o, "reset all"))
        live->views = live->first;
    nook_overlay_same_line(o);
    if (nook_overlay_button(o, "save"))
        live_save(live);
    nook_overlay_tooltip(o, "the active view's setting, r_max and falloff, for --settings");
    if (active < live->views.count)
        live->views.active = active;
    nook_overlay_input(o, "file", live->settings_path, sizeof live->settings_path);
}

void live_panel_views(nook_live *live, bool times)
{
    const double letters = live_shown_height(live) / nook_overlay_letter_height(live->overlay);
    const nook_overlay_panel panel = { .title = "Views",
                                       .x = -8.0 * live->scale,
                                       .y = 8.0 * live->scale,
                                       .width = LIVE_PANEL_WIDTH,
                                       .height = fmin(panel_height, letters - 2.0),
                                       .open = &live->panels };
    if (nook_overlay_panel_begin(live->overlay, &panel)) {
        edit_count(live);
        edit_view(live);
        nook_overlay_separator(live->overlay);
        edit_shared(live);
        edit_ranges(live);
        nook_overlay_separator(live->overlay);
        offer_history(live);
        if (times)
            live_times_section(live);
    }
    nook_overlay_panel_end(live->overlay);
}
