/* One parameter of all of a sweep's settings from the command line. */
#include "engine/core/log.h"
#include "game/measure/sweep.h"
#include "game/techniques.h"
#include "modules/ao/technique.h"
#include <stdlib.h>
#include <string.h>

static const char where[] = "measure --param";

/* "volume.kind=surfel" */
typedef struct assignment {
    const nook_ao_technique *technique; /* whose settings have it; NULL: all of them */
    const char *name, *value;           /* as nook_setting_assign takes them */
} assignment;

/* @param text  is cut apart, and pointed into */
static nook_result read_assignment(char *text, assignment *out)
{
    char *equals = strchr(text, '='), *dot = strchr(text, '.');
    if (!equals || !dot || dot > equals)
        return nook_fail(NOOK_E_ARG, "%s %s; give TECHNIQUE.NAME=VALUE or ao.NAME=VALUE (./nook compare --list-params)",
                         where, text);
    *equals = '\0';
    *out = (assignment){ .name = text, .value = equals + 1 };
    if (strncmp(text, "ao.", 3) == 0)
        return NOOK_OK;
    *dot = '\0';
    out->name = dot + 1;
    out->technique = nook_technique_find(text);
    return out->technique ? NOOK_OK : nook_technique_refuse(where, text);
}

static nook_result assign(const assignment *a, const nook_sweep *sweep, nook_sweep *out)
{
    size_t taken = 0;
    for (size_t i = 0; i < sweep->setting_count; i++) {
        nook_setting setting = sweep->settings[i];
        nook_result result = NOOK_OK;
        if (!a->technique || setting.technique == a->technique) {
            result = nook_setting_assign(where, &setting, a->name, a->value);
            taken++;
        }
        if (result == NOOK_OK)
            result = nook_sweep_add(where, out, &setting);
        if (result != NOOK_OK)
            return result;
    }
    if (a->technique && taken == 0)
        return nook_fail(NOOK_E_NOT_FOUND, "%s %s.%s: the sweep has no setting of %s", where, a->technique->name,
                         a->name, a->technique->name);
    return NOOK_OK;
}

nook_result nook_sweep_param(nook_sweep *sweep, const char *text)
{
    char *copy = strdup(text);
    if (!copy)
        return nook_fail(NOOK_E_MEMORY, "%s %s: no memory", where, text);
    assignment a;
    nook_sweep changed = *sweep;
    changed.settings = NULL;
    changed.setting_count = 0;
    nook_result result = read_assignment(copy, &a);
    if (result == NOOK_OK)
        result = assign(&a, sweep, &changed);
    if (result == NOOK_OK) {
        nook_sweep_free(sweep);
        *sweep = changed;
    } else {
        nook_sweep_free(&changed);
    }
    free(copy);
    return result;
}
