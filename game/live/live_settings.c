#include "engine/core/log.h"
#include "game/live/live_internal.h"
#include "game/settings/settings_file.h"
#include "game/techniques.h"
#include "modules/ao/technique.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double shared_value(const nook_ao *ao, const char *name)
{
    double value = 0.0;
    nook_ao_get_param(ao, name, &value);
    return value;
}

/* Floats become the doubles that people would write for them. */
static double shortest(double value)
{
    char text[32];
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtof(text, NULL) == (float)value)
            break;
    }
    return strtod(text, NULL);
}

/* What the AO is set to, for one of its techniques. */
static nook_setting setting_in_use(const nook_ao *ao, const nook_ao_technique *technique)
{
    nook_setting setting = nook_setting_initial(technique);
    const nook_param *param;
    bool shared;
    for (size_t i = 0; (param = nook_setting_param_at(technique, i, &shared)); i++) {
        char name[128], text[NOOK_SETTING_VALUE_MAX];
        nook_setting_param entry = { param, shared, 0.0 };
        snprintf(name, sizeof name, "%s.%s", shared ? "ao" : technique->name, param->name);
        if (nook_ao_get_param(ao, name, &entry.value) != NOOK_OK)
            continue;
        snprintf(name, sizeof name, "%s%s", shared ? "ao." : "", param->name);
        nook_setting_assign("the AO", &setting, name, nook_setting_value(&entry, text));
    }
    return setting;
}

void live_list_techniques(nook_live *live, const char *const *names, uint32_t count)
{
    const nook_ao *ao = live->stage->ao;
    const nook_ao_technique *technique;
    for (uint32_t i = 0; !names && i < LIVE_TECHNIQUES && (technique = nook_ao_technique_at(ao, i)); i++)
        snprintf(live->techniques[live->technique_count++], sizeof live->techniques[0], "%s", technique->name);
    for (uint32_t i = 0; names && i < count && i < LIVE_TECHNIQUES; i++)
        snprintf(live->techniques[live->technique_count++], sizeof live->techniques[0], "%s", names[i]);
}

const nook_ao_technique *live_technique(const nook_live *live, uint32_t number)
{
    return number < live->technique_count ? nook_technique_find(live->techniques[number]) : NULL;
}

void live_take_over(nook_live *live)
{
    const nook_ao *ao = live->stage->ao;
    for (uint32_t i = 0; i < live->technique_count; i++) {
        nook_setting setting = setting_in_use(ao, live_technique(live, i));
        nook_setting_print(&setting, live->remembered[i]);
    }
    live->views.r_max = shortest(shared_value(ao, "ao.r_max"));
    live->views.falloff = shared_value(ao, "ao.falloff");
    live->views.falloff_tau = shortest(shared_value(ao, "ao.falloff_tau"));
}

nook_setting live_setting_of(nook_live *live, uint32_t view)
{
    nook_live_view *v = &live->views.views[view];
    char where[32], name[NOOK_SETTING_TEXT_MAX];
    nook_setting setting = nook_setting_initial(live_technique(live, 0));
    snprintf(where, sizeof where, "view %u", view + 1);
    if (nook_setting_parse(where, v->setting, &setting) == NOOK_OK)
        return setting;
    snprintf(name, sizeof name, "%s", v->setting);
    name[strcspn(name, " ")] = '\0';
    if (nook_setting_parse(where, name, &setting) != NOOK_OK)
        setting = nook_setting_initial(live_technique(live, 0));
    live_set_setting(live, view, &setting);
    live_note(live, "view %u: its setting cannot be read any more; now %s", view + 1, v->setting);
    return setting;
}

uint32_t live_technique_number(const nook_live *live, const char *setting)
{
    size_t length = strcspn(setting, " ");
    for (uint32_t i = 0; i < live->technique_count; i++) {
        if (strncmp(live->techniques[i], setting, length) == 0 && live->techniques[i][length] == '\0')
            return i;
    }
    return LIVE_TECHNIQUES;
}

void live_set_setting(nook_live *live, uint32_t view, const nook_setting *setting)
{
    nook_live_view *v = &live->views.views[view];
    memset(v->setting, 0, sizeof v->setting); /* states are compared as bytes */
    nook_setting_print(setting, v->setting);
    uint32_t number = live_technique_number(live, v->setting);
    if (number < LIVE_TECHNIQUES)
        memcpy(live->remembered[number], v->setting, sizeof v->setting);
}

void live_choose_technique(nook_live *live, uint32_t number)
{
    nook_live_view *v = &live->views.views[live->views.active];
    if (number >= live->technique_count)
        return;
    uint32_t before = live_technique_number(live, v->setting);
    if (before < LIVE_TECHNIQUES)
        memcpy(live->remembered[before], v->setting, sizeof v->setting);
    memcpy(v->setting, live->remembered[number], sizeof v->setting);
    v->open = false;
}

bool nook_live_multiplies(nook_live *live)
{
    bool march = false, multiply = false;
    for (uint32_t i = 0; i < live->views.count; i++) {
        const nook_live_view *view = &live->views.views[i];
        if (view->open || !nook_live_mode_occludes(view->mode))
            continue;
        const nook_setting setting = live_setting_of(live, i);
        march = march || setting.technique->inputs & NOOK_AO_IN_VOLUMES;
        multiply = multiply || nook_setting_multiplies(&setting);
    }
    if (march)
        live->multiplies = multiply;
    return live->multiplies;
}

nook_result live_apply(nook_live *live, const nook_setting *setting)
{
    nook_result result = nook_setting_apply(live->stage->ao, setting);
    return result == NOOK_OK ? live_apply_shared(live) : result;
}

nook_result live_apply_shared(nook_live *live)
{
    const nook_live_views *views = &live->views;
    nook_ao *ao = live->stage->ao;
    nook_result result = nook_ao_set_param(ao, "ao.r_max", views->r_max);
    if (result == NOOK_OK)
        result = nook_ao_set_param(ao, "ao.falloff", views->falloff);
    return result == NOOK_OK ? nook_ao_set_param(ao, "ao.falloff_tau", views->falloff_tau) : result;
}

/* The choice of ao.falloff by its name. */
static void print_falloff(const nook_live *live, char *out, size_t capacity)
{
    size_t count;
    const nook_param *shared = nook_ao_shared_params(&count);
    nook_param_print_value(nook_param_find(shared, count, "falloff"), live->views.falloff, out, capacity);
}

nook_settings_file live_settings_of_active(nook_live *live)
{
    const nook_stage *stage = live->stage;
    nook_settings_file file = { .setting = live_setting_of(live, live->views.active),
                                .r_max = live->views.r_max,
                                .plan = stage->plan,
                                .live = stage->live_scene,
                                .stream = stage->stream_params };
    if (stage->stream)
        file.stream = *nook_stream_params_of(stage->stream);
    print_falloff(live, file.falloff, sizeof file.falloff);
    return file;
}

void nook_live_save_to(nook_live *live, const char *path)
{
    snprintf(live->settings_path, sizeof live->settings_path, "%s", path);
}

nook_result live_save(nook_live *live)
{
    nook_settings_file file = live_settings_of_active(live);
    nook_result result = nook_settings_file_update(live->settings_path, &file);
    live_note(live,
              result == NOOK_OK         ? "saved to %s"
              : result == NOOK_E_FORMAT ? "%s is not written over: mend it first, the log says where"
                                        : "%s could not be written; the log says why",
              live->settings_path);
    return result;
}
