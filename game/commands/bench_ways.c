#include "game/commands/bench_ways.h"
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static bool has_param(const nook_ao_technique *technique, const char *name)
{
    bool has = false;
    for (uint32_t i = 0; i < technique->param_count; i++)
        has = has || strcmp(technique->params[i].name, name) == 0;
    return has;
}

size_t nook_bench_ways(const nook_ao_technique *technique, const nook_bench_way **out_ways)
{
    static const nook_bench_way joined[NOOK_BENCH_WAYS_MAX] = { { "union", "union", "compute" },
                                                                { "product", "multiply", "compute" },
                                                                { "raster", "multiply", "raster" } },
                                alone[1] = { { "ms", NULL, NULL } };
    const bool joins = has_param(technique, "combine") && has_param(technique, "path");
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
