#include "game/extremes/edge_estimator.h"
#include "game/techniques.h"
#include <assert.h>
#include <stdio.h>
#include <string.h>

static void add(nook_edge_estimator *out, const nook_ao_technique *technique, const char *kind, int length)
{
    *out = (nook_edge_estimator){ .technique = technique, .hangs = strcmp(technique->name, "hao") == 0 };
    snprintf(out->name, sizeof out->name, "%s%s%.*s", technique->name, length ? "." : "", length, kind);
}

size_t nook_edge_estimators(nook_edge_estimator out[NOOK_EDGE_ESTIMATORS_MAX])
{
    size_t techniques, count = 0;
    const nook_ao_technique *const *all = nook_techniques(&techniques);
    for (size_t i = 0; i < techniques; i++) {
        const nook_param *kind =
            all[i]->volume_kind ? nook_param_find(all[i]->params, all[i]->param_count, "kind") : NULL;
        assert(count < NOOK_EDGE_ESTIMATORS_MAX);
        add(&out[count++], all[i], "", 0);
        for (const char *name = kind ? strchr(kind->choices, '|') : NULL; name; name = strchr(name, '|')) {
            size_t length = strcspn(++name, "|");
            assert(count < NOOK_EDGE_ESTIMATORS_MAX);
            add(&out[count++], all[i], name, (int)length);
        }
    }
    return count;
}

const char *nook_edge_estimator_split(const char *name, char *out_technique)
{
    const size_t length = strcspn(name, ".");
    assert(length < NOOK_EDGE_ESTIMATOR_NAME_MAX);
    memcpy(out_technique, name, length);
    out_technique[length] = '\0';
    return name[length] ? name + length + 1 : NULL;
}
