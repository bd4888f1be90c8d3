#include "game/settings/setting.h"
#include "engine/core/log.h"
#include "engine/core/suggestion.h"
#include "game/techniques.h"
#include "modules/bake/voxelize.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_MAX_BYTES = 64 };
static const char blanks[] = " \t";

nook_setting nook_setting_initial(const nook_ao_technique *technique)
{
    return (nook_setting){ .technique = technique };
}

/* ---- The tables ------------------------------------------------------------------------------------------------- */

/* What is computed, not how well, and what belongs to measuring. */
static bool is_choice(const nook_param *shared)
{
    static const char *const others[] = { "r_max", "falloff", "falloff_tau", "count" };
    for (size_t i = 0; i < NOOK_COUNT(others); i++) {
        if (strcmp(shared->name, others[i]) == 0)
            return false;
    }
    return true;
}

/* Rows of both tables, the technique's first. @return NULL past the end */
static const nook_param *param_at(const nook_ao_technique *technique, size_t index, bool *out_shared)
{
    size_t count;
    const nook_param *shared = nook_ao_shared_params(&count);
    *out_shared = index >= technique->param_count;
    if (!*out_shared)
        return &technique->params[index];
    index -= technique->param_count;
    return index < count ? &shared[index] : NULL;
}

static const char *name_of(const nook_param *param, bool shared, char out[NAME_MAX_BYTES])
{
    snprintf(out, NAME_MAX_BYTES, "%s%s", shared ? "ao." : "", param->name);
    return out;
}

/* @return its place in the tables, or the number of rows */
static size_t find_param(const nook_ao_technique *technique, const char *name)
{
    char known[NAME_MAX_BYTES];
    const nook_param *param;
    size_t index = 0;
    bool shared;
    for (; (param = param_at(technique, index, &shared)); index++) {
        if (strcmp(name_of(param, shared, known), name) == 0)
            break;
    }
    return index;
}

/* ---- Setting one parameter -------------------------------------------------------------------------------------- */

static nook_result refuse_param(const char *where, const nook_ao_technique *technique, const char *name)
{
    char names[1024] = "resolution", known[NAME_MAX_BYTES], nearest[NAME_MAX_BYTES] = "";
    const size_t prefix = strlen(technique->name); /* "volume.rays", as --param takes it */
    const bool prefixed = strncmp(name, technique->name, prefix) == 0 && name[prefix] == '.';
    nook_suggestion suggestion = nook_suggestion_for(prefixed ? name + prefix + 1 : name);
    const nook_param *param;
    bool shared, volumes = technique->inputs & NOOK_AO_IN_VOLUMES;
    size_t used = volumes ? strlen(names) : 0;
    if (volumes)
        nook_suggestion_offer(&suggestion, "resolution");
    for (size_t i = 0; (param = param_at(technique, i, &shared)); i++) {
        if (shared && !is_choice(param))
            continue;
        name_of(param, shared, known);
        if (used < sizeof names)
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", known);
        int before = suggestion.distance;
        nook_suggestion_offer(&suggestion, known);
        nook_suggestion_offer(&suggestion, param->name); /* "scale" for "ao.scale" */
        if (suggestion.distance < before)
            memcpy(nearest, known, sizeof nearest);
    }
    if (!*nearest && suggestion.nearest)
        snprintf(nearest, sizeof nearest, "resolution");
    if (*nearest)
        return nook_fail(NOOK_E_NOT_FOUND, "%s: %s has no parameter %s; did you mean %s? There are %s", where,
                         technique->name, name, nearest, names);
    return nook_fail(NOOK_E_NOT_FOUND, "%s: %s has no parameter %s; there are %s", where, technique->name, name, names);
}

static nook_result assign_resolution(const char *where, nook_setting *setting, const char *text)
{
    const nook_param resolution = {
        .name = "resolution", .type = NOOK_PARAM_INT, .lowest = 1.0, .highest = NOOK_VOXELIZE_RESOLUTION_MAX
    };
    char owner[NOOK_SETTING_TEXT_MAX];
    int32_t value;
    if (!(setting->technique->inputs & NOOK_AO_IN_VOLUMES))
        return nook_fail(NOOK_E_ARG, "%s: %s reads no volumes, so it has no resolution; leave it out", where,
                         setting->technique->name);
    snprintf(owner, sizeof owner, "%s: %s", where, setting->technique->name);
    nook_result result = nook_param_parse(&resolution, owner, &value, text);
    if (result == NOOK_OK)
        setting->resolution = (uint32_t)value;
    return result;
}

static void take_out(nook_setting *setting, const nook_param *param)
{
    for (uint32_t i = 0; i < setting->param_count; i++) {
        if (setting->params[i].param != param)
            continue;
        setting->param_count--;
        memmove(&setting->params[i], &setting->params[i + 1], (setting->param_count - i) * sizeof setting->params[0]);
        return;
    }
}

/* Keeps the order of the tables. */
static void put_in(nook_setting *setting, const nook_setting_param *entry, size_t place)
{
    bool shared;
    uint32_t at = 0;
    assert(setting->param_count < NOOK_SETTING_PARAMS_MAX);
    for (size_t i = 0; i < place; i++) {
        const nook_param *before = param_at(setting->technique, i, &shared);
        at += at < setting->param_count && setting->params[at].param == before;
    }
    memmove(&setting->params[at + 1], &setting->params[at], (setting->param_count - at) * sizeof setting->params[0]);
    setting->params[at] = *entry;
    setting->param_count++;
}

/* The value as the parameter's block would keep it: a float parameter holds the float nearest to it. */
static nook_result read_value(const char *where, const char *owner, const nook_param *param, const char *text,
                              double *out_value)
{
    char said[NOOK_SETTING_TEXT_MAX];
    nook_param alone = *param;
    int32_t block = 0; /* room for any one value */
    alone.offset = 0;
    snprintf(said, sizeof said, "%s: %s", where, owner);
    nook_result result = nook_param_parse(&alone, said, &block, text);
    if (result == NOOK_OK)
        *out_value = nook_param_get(&alone, &block);
    return result;
}

static bool is_initial(const nook_param *param, double value)
{
    return value == param->initial || (param->type == NOOK_PARAM_FLOAT && value == (double)(float)param->initial);
}

nook_result nook_setting_assign(const char *where, nook_setting *setting, const char *name, const char *text)
{
    if (strcmp(name, "resolution") == 0)
        return assign_resolution(where, setting, text);
    bool shared;
    size_t place = find_param(setting->technique, name);
    const nook_param *param = param_at(setting->technique, place, &shared);
    if (!param)
        return refuse_param(where, setting->technique, name);
    if (shared && !is_choice(param))
        return nook_fail(NOOK_E_ARG, "%s: %s says what is measured, not how well; it is no part of a setting", where,
                         name);
    nook_setting_param entry = { param, shared, 0.0 };
    nook_result result = read_value(where, shared ? "ao" : setting->technique->name, param, text, &entry.value);
    if (result != NOOK_OK)
        return result;
    take_out(setting, param);
    if (!is_initial(param, entry.value))
        put_in(setting, &entry, place);
    return NOOK_OK;
}

const nook_param *nook_setting_param_at(const nook_ao_technique *technique, size_t index, bool *out_shared)
{
    const nook_param *param;
    for (size_t i = 0; (param = param_at(technique, i, out_shared)); i++) {
        if (*out_shared && !is_choice(param))
            continue;
        if (index-- == 0)
            return param;
    }
    return NULL;
}

/* ---- Text ------------------------------------------------------------------------------------------------------- */

/* Cuts the next word off `*at`. @return false when there is none; *at is past the word */
static bool next_word(const char **at, char out[NOOK_SETTING_TEXT_MAX])
{
    *at += strspn(*at, blanks);
    size_t length = strcspn(*at, blanks);
    memcpy(out, *at, length); /* nook_setting_parse has seen that the whole text fits */
    out[length] = '\0';
    *at += length;
    return length > 0;
}

/* One parameter said twice in one line: which of them is meant cannot be known. */
static bool is_repeated(const char *text, const char *until, const char *name)
{
    char word[NOOK_SETTING_TEXT_MAX];
    size_t length = strlen(name);
    while (next_word(&text, word) && text < until) {
        if (strncmp(word, name, length) == 0 && word[length] == '=')
            return true;
    }
    return false;
}

static nook_result parse_assignments(const char *where, const char *text, nook_setting *setting)
{
    char word[NOOK_SETTING_TEXT_MAX];
    const char *at = text;
    while (next_word(&at, word)) {
        char *equals = strchr(word, '=');
        if (!equals || equals == word)
            return nook_fail(NOOK_E_ARG, "%s: '%s': give name=value, without blanks", where, word);
        *equals = '\0';
        if (is_repeated(text, at, word))
            return nook_fail(NOOK_E_ARG, "%s: %s stands there twice; leave one of them", where, word);
        nook_result result = nook_setting_assign(where, setting, word, equals + 1);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

nook_result nook_setting_parse(const char *where, const char *text, nook_setting *out_setting)
{
    char name[NOOK_SETTING_TEXT_MAX];
    const char *at = text;
    if (strlen(text) >= NOOK_SETTING_TEXT_MAX)
        return nook_fail(NOOK_E_ARG, "%s: a setting of %zu bytes; at most %d", where, strlen(text),
                         NOOK_SETTING_TEXT_MAX - 1);
    if (!next_word(&at, name))
        return nook_fail(NOOK_E_ARG, "%s: an empty setting; give a technique, then name=value", where);
    const nook_ao_technique *technique = nook_technique_find(name);
    if (!technique)
        return nook_technique_refuse(where, name);
    nook_setting setting = nook_setting_initial(technique);
    nook_result result = parse_assignments(where, at, &setting);
    if (result == NOOK_OK)
        *out_setting = setting;
    return result;
}

/* The fewest digits, from six on, that read back as the same value. */
static void print_float(double value, char *out, size_t capacity)
{
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(out, capacity, "%.*g", digits, value);
        if (strtof(out, NULL) == (float)value)
            break;
    }
}

const char *nook_setting_value(const nook_setting_param *entry, char out[NOOK_SETTING_VALUE_MAX])
{
    if (entry->param->type == NOOK_PARAM_FLOAT)
        print_float(entry->value, out, NOOK_SETTING_VALUE_MAX);
    else if (entry->param->type == NOOK_PARAM_INT)
        snprintf(out, NOOK_SETTING_VALUE_MAX, "%.0f", entry->value);
    else
        nook_param_print_value(entry->param, entry->value, out, NOOK_SETTING_VALUE_MAX);
    return out;
}

const char *nook_setting_print(const nook_setting *setting, char *out)
{
    const size_t capacity = NOOK_SETTING_TEXT_MAX;
    char value[NOOK_SETTING_VALUE_MAX];
    size_t used = (size_t)snprintf(out, capacity, "%s", setting->technique->name);
    for (uint32_t i = 0; i < setting->param_count && used < capacity; i++) {
        const nook_setting_param *entry = &setting->params[i];
        used += (size_t)snprintf(out + used, capacity - used, " %s%s=%s", entry->shared ? "ao." : "",
                                 entry->param->name, nook_setting_value(entry, value));
    }
    if (setting->resolution > 0 && used < capacity)
        used += (size_t)snprintf(out + used, capacity - used, " resolution=%u", setting->resolution);
    assert(used < capacity);
    return out;
}

/* ---- Use -------------------------------------------------------------------------------------------------------- */

double nook_setting_get(const nook_setting *setting, const nook_param *param)
{
    for (uint32_t i = 0; i < setting->param_count; i++) {
        if (setting->params[i].param == param)
            return setting->params[i].value;
    }
    return param->initial;
}

/* Choices of modules/ao_volume/params.def; tests/settings/test_setting.c compares them with its table. */
enum { COMBINE_MULTIPLY = 0, PATH_COMPUTE = 0 };

bool nook_setting_values_multiply(double combine, double path)
{
    return combine == COMBINE_MULTIPLY || path != PATH_COMPUTE;
}

bool nook_setting_multiplies(const nook_setting *setting)
{
    const nook_ao_technique *technique = setting->technique;
    const nook_param *combine = nook_param_find(technique->params, technique->param_count, "combine");
    const nook_param *path = nook_param_find(technique->params, technique->param_count, "path");
    return combine && path &&
           nook_setting_values_multiply(nook_setting_get(setting, combine), nook_setting_get(setting, path));
}

nook_result nook_setting_apply(nook_ao *ao, const nook_setting *setting)
{
    const nook_param *param;
    bool shared;
    nook_result result = nook_ao_set_technique(ao, setting->technique->name);
    for (size_t i = 0; result == NOOK_OK && (param = param_at(setting->technique, i, &shared)); i++) {
        char name[2 * NAME_MAX_BYTES];
        if (shared && !is_choice(param))
            continue;
        snprintf(name, sizeof name, "%s.%s", shared ? "ao" : setting->technique->name, param->name);
        result = nook_ao_set_param(ao, name, nook_setting_get(setting, param));
    }
    return result;
}

void nook_setting_renew(nook_setting *setting)
{
    const nook_ao_technique *technique = nook_technique_find(setting->technique->name);
    uint32_t kept = 0;
    size_t shared_count;
    const nook_param *shared = nook_ao_shared_params(&shared_count);
    assert(technique); /* techniques are replaced, never taken away */
    for (uint32_t i = 0; i < setting->param_count; i++) {
        nook_setting_param entry = setting->params[i];
        const nook_param *param = entry.shared
                                      ? nook_param_find(shared, shared_count, entry.param->name)
                                      : nook_param_find(technique->params, technique->param_count, entry.param->name);
        if (!param || param->type != entry.param->type)
            continue;
        entry.value = fmin(fmax(entry.value, param->lowest), param->highest);
        entry.param = param;
        setting->params[kept++] = entry;
    }
    setting->param_count = kept;
    setting->technique = technique;
}
