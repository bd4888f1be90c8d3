#include "game/techniques.h"
#include "engine/core/log.h"
#include "engine/core/suggestion.h"
#include "game/technique_list.h"
#include "modules/ao/nook_ao.h"
#include <assert.h>
#include <stdio.h>
#include <string.h>

const nook_ao_technique *const *nook_techniques(size_t *out_count)
{
    *out_count = nook_listed_techniques.count;
    return nook_listed_techniques.items;
}

/* @return its place, or the count */
static size_t find(const char *name)
{
    size_t i = 0;
    while (i < nook_listed_techniques.count && strcmp(nook_listed_techniques.items[i]->name, name) != 0)
        i++;
    return i;
}

void nook_techniques_list(const nook_ao_technique *technique)
{
    nook_technique_list *list = &nook_listed_techniques;
    size_t at = find(technique->name);
    assert(at < NOOK_TECHNIQUES_MAX);
    list->items[at] = technique;
    list->count += at == list->count;
}

const nook_param *nook_shared_param(const char *name)
{
    size_t count;
    const nook_param *params = nook_ao_shared_params(&count);
    return nook_param_find(params, count, name);
}

const nook_ao_technique *nook_technique_find(const char *name)
{
    size_t at = find(name);
    return at < nook_listed_techniques.count ? nook_listed_techniques.items[at] : NULL;
}

nook_result nook_technique_refuse(const char *where, const char *name)
{
    char names[512] = "";
    size_t used = 0;
    nook_suggestion suggestion = nook_suggestion_for(name);
    for (size_t i = 0; i < nook_listed_techniques.count; i++) {
        const char *listed = nook_listed_techniques.items[i]->name;
        nook_suggestion_offer(&suggestion, listed);
        if (used < sizeof names)
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "", listed);
    }
    if (suggestion.nearest)
        return nook_fail(NOOK_E_NOT_FOUND, "%s: technique '%s': did you mean %s? Choose from %s", where, name,
                         suggestion.nearest, names);
    return nook_fail(NOOK_E_NOT_FOUND, "%s: technique '%s': choose from %s", where, name, names);
}
