#include "game/compare/choice.h"
#include "engine/core/log.h"
#include "engine/core/suggestion.h"
#include "game/compare/camera.h"
#include "game/techniques.h"
#include "modules/ao/nook_ao.h"
#include "modules/plan/plan_params.h"
#include <stdio.h>
#include <string.h>

/* ---- Techniques ------------------------------------------------------------------------------------------------- */

static void choose(nook_compare_choice *choice, const nook_ao_technique *technique)
{
    for (uint32_t i = 0; i < choice->count; i++) {
        if (choice->techniques[i] == technique)
            return;
    }
    if (choice->count < NOOK_COMPARE_TECHNIQUES_MAX)
        choice->techniques[choice->count++] = technique;
}

nook_result nook_compare_choose(const char *list, nook_compare_choice *out_choice)
{
    nook_compare_choice choice = { 0 };
    size_t count;
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    for (size_t i = 0; i < count; i++) {
        if (techniques[i]->exact)
            choose(&choice, techniques[i]);
    }
    for (size_t i = 0; !list && i < count; i++)
        choose(&choice, techniques[i]);
    for (const char *at = list; at; at = *at ? at + 1 : NULL) {
        size_t length = strcspn(at, ",");
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        const nook_ao_technique *technique = nook_technique_find(name);
        if (!technique)
            return nook_technique_refuse("--techniques", name);
        choose(&choice, technique);
        at += length;
    }
    *out_choice = choice;
    return NOOK_OK;
}

/* ---- Parameters ------------------------------------------------------------------------------------------------- */

/* The table of "ao" or of a technique. */
typedef struct param_owner {
    char name[64];
    const nook_param *params;
    size_t count;
} param_owner;

static nook_result find_owner(const char *name, param_owner *out)
{
    const nook_ao_technique *technique = nook_technique_find(name);
    param_owner owner = { .name = "ao" };
    if (technique) {
        snprintf(owner.name, sizeof owner.name, "%s", technique->name);
        owner.params = technique->params;
        owner.count = technique->param_count;
    } else if (strcmp(name, owner.name) == 0) {
        owner.params = nook_ao_shared_params(&owner.count);
    } else if (strcmp(name, "plan") == 0) {
        snprintf(owner.name, sizeof owner.name, "plan");
        owner.params = nook_plan_param_table(&owner.count);
    } else {
        return nook_technique_refuse("parameters as technique.name=value, ao for what all share", name);
    }
    *out = owner;
    return NOOK_OK;
}

static nook_result refuse_param(const param_owner *owner, const char *name)
{
    char names[1024] = "";
    size_t used = 0;
    nook_suggestion suggestion = nook_suggestion_for(name);
    for (size_t i = 0; i < owner->count; i++) {
        nook_suggestion_offer(&suggestion, owner->params[i].name);
        if (used < sizeof names)
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "", owner->params[i].name);
    }
    if (suggestion.nearest)
        return nook_fail(NOOK_E_NOT_FOUND, "%s.%s: no such parameter; did you mean %s.%s? There are %s", owner->name,
                         name, owner->name, suggestion.nearest, names);
    return nook_fail(NOOK_E_NOT_FOUND, "%s.%s: no such parameter; there are %s", owner->name, name, names);
}

nook_result nook_compare_check_param(const char *name, size_t length, const char *value)
{
    const char *dot = memchr(name, '.', length);
    size_t owner_length = dot ? (size_t)(dot - name) : length;
    char owner_name[64], rest[64] = "";
    param_owner owner = { .count = 0 };
    snprintf(owner_name, sizeof owner_name, "%.*s", (int)owner_length, name);
    nook_result result = find_owner(owner_name, &owner);
    if (result != NOOK_OK)
        return result;
    if (dot)
        snprintf(rest, sizeof rest, "%.*s", (int)(length - owner_length - 1), dot + 1);
    const nook_param *param = nook_param_find(owner.params, owner.count, rest);
    if (!param)
        return refuse_param(&owner, rest);
    nook_param alone = *param;
    int32_t block = 0; /* room for any one value */
    alone.offset = 0;
    return nook_param_parse(&alone, owner.name, &block, value);
}

/* ---- All of it -------------------------------------------------------------------------------------------------- */

static nook_result check_assignment(const char *text)
{
    const char *equals = strchr(text, '=');
    if (!equals)
        return nook_fail(NOOK_E_ARG, "--param %s: give technique.name=value", text);
    return nook_compare_check_param(text, (size_t)(equals - text), equals + 1);
}

/* One parameter said in two ways: which of them is meant cannot be known. */
static nook_result refuse_second_way(const nook_compare_options *options, const char *assignment)
{
    const struct {
        const char *option, *param;
        bool given;
    } ways[] = { { "r-max", "ao.r_max=", options->r_max > 0.0 },
                 { "falloff", "ao.falloff=", options->falloff != NULL },
                 { "ao-scale", "ao.scale=", options->ao_scale != NULL },
                 { "reference-rays", "reference.rays=", options->reference_rays > 0 },
                 { "plan", "plan.mode=", options->plan >= 0 } };
    for (size_t i = 0; i < NOOK_COUNT(ways); i++) {
        if (ways[i].given && strncmp(assignment, ways[i].param, strlen(ways[i].param)) == 0)
            return nook_fail(NOOK_E_ARG, "--param %s: --%s sets the same parameter; give one of the two", assignment,
                             ways[i].option);
    }
    return NOOK_OK;
}

nook_result nook_compare_options_check(const nook_compare_options *options, nook_compare_choice *out_choice)
{
    static const char falloff[] = "ao.falloff";
    nook_result result = NOOK_OK;
    if (options->falloff)
        result = nook_compare_check_param(falloff, strlen(falloff), options->falloff);
    for (size_t i = 0; i < options->params.count && result == NOOK_OK; i++) {
        result = check_assignment(options->params.items[i]);
        if (result == NOOK_OK)
            result = refuse_second_way(options, options->params.items[i]);
    }
    if (result == NOOK_OK && options->camera)
        result = nook_camera_check(options->camera);
    return result == NOOK_OK ? nook_compare_choose(options->techniques, out_choice) : result;
}

nook_result nook_compare_options_settle(nook_compare_options *options, nook_compare_choice *choice)
{
    nook_settings_file *file = &options->file;
    if (!options->settings)
        return NOOK_OK;
    nook_result result = nook_settings_file_read(options->settings, file);
    if (result != NOOK_OK)
        return result;
    if (file->stream.budget > 0.0f)
        nook_log_info("%s: volumes.budget is for ./nook play; what is measured has all volumes", options->settings);
    if (options->r_max == 0.0)
        options->r_max = file->r_max;
    if (!options->falloff && *file->falloff)
        options->falloff = file->falloff;
    if (options->resolution == 0)
        options->resolution = (int32_t)file->setting.resolution;
    return options->techniques ? NOOK_OK : nook_compare_choose(file->setting.technique->name, choice);
}
