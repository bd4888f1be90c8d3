#include "game/commands/bench_ways.h"
#include <stdio.h>

static const nook_param *find(const nook_ao_technique *technique, const char *name)
{
    return nook_param_find(technique->params, technique->param_count, name);
}

size_t nook_bench_ways(const nook_ao_technique *technique, const nook_bench_way **out_ways)
{
    static const nook_bench_way joined[NOOK_BENCH_WAYS_MAX] = { { "union", "union", "compute" },
                                                                { "product", "multiply", "compute" },
                                                                { "raster", "multiply", "raster" } },
                                alone[1] = { { "ms", NULL, NULL } };
    const bool joins = find(technique, "combine") && find(technique, "path");
    *out_ways = joins ? joined : alone;
    return joins ? NOOK_COUNT(joined) : NOOK_COUNT(alone);
}

static nook_result set(nook_ao *ao, const nook_ao_technique *technique, const char *name, const char *value)
{
    char full[64];
    if (!value)
        return NOOK_OK;
    snprintf(full, sizeof full, "%s.%s", technique->name, name);
    return nook_ao_parse_param(ao, full, value);
}

nook_result nook_bench_way_apply(nook_ao *ao, const nook_ao_technique *technique, const nook_bench_way *way)
{
    nook_result result = set(ao, technique, "combine", way->combine);
    return result == NOOK_OK ? set(ao, technique, "path", way->path) : result;
}
