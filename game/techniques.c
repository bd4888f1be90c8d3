#include "game/techniques.h"
#include "engine/core/log.h"
#include "game/suggestion.h"
#include "modules/ao/nook_ao.h"
#include "modules/ao_gtao/gtao.h"
#include "modules/ao_hbao/hbao.h"
#include "modules/ao_hsao/hsao.h"
#include "modules/ao_reference/reference.h"
#include "modules/ao_ssao/ssao.h"
#include "modules/ao_volume/volume.h"
#include <stdio.h>
#include <string.h>

/* Those that are linked in, until nook_techniques_replace: the one thing that is not constant here, as the code that is
   loaded is one for the whole program. */
static const nook_ao_technique *techniques[] = {
    &nook_ao_volume_technique, &nook_ao_ssao_technique, &nook_ao_hsao_technique,
    &nook_ao_hbao_technique,   &nook_ao_gtao_technique, &nook_ao_reference_technique,
};

const nook_ao_technique *const *nook_techniques(size_t *out_count)
{
    *out_count = NOOK_COUNT(techniques);
    return techniques;
}

void nook_techniques_replace(const nook_ao_technique *technique)
{
    for (size_t i = 0; i < NOOK_COUNT(techniques); i++) {
        if (strcmp(techniques[i]->name, technique->name) == 0)
            techniques[i] = technique;
    }
}

const nook_param *nook_shared_param(const char *name)
{
    size_t count;
    const nook_param *params = nook_ao_shared_params(&count);
    return nook_param_find(params, count, name);
}

const nook_ao_technique *nook_technique_find(const char *name)
{
    for (size_t i = 0; i < NOOK_COUNT(techniques); i++) {
        if (strcmp(techniques[i]->name, name) == 0)
            return techniques[i];
    }
    return NULL;
}

nook_result nook_technique_refuse(const char *where, const char *name)
{
    char names[512] = "";
    size_t used = 0;
    nook_suggestion suggestion = nook_suggestion_for(name);
    for (size_t i = 0; i < NOOK_COUNT(techniques); i++) {
        nook_suggestion_offer(&suggestion, techniques[i]->name);
        if (used < sizeof names)
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "", techniques[i]->name);
    }
    if (suggestion.nearest)
        return nook_fail(NOOK_E_NOT_FOUND, "%s: technique '%s': did you mean %s? Choose from %s", where, name,
                         suggestion.nearest, names);
    return nook_fail(NOOK_E_NOT_FOUND, "%s: technique '%s': choose from %s", where, name, names);
}
