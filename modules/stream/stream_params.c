#include "modules/stream/stream_params.h"
#include "engine/core/log.h"
#include <stdio.h>
#include <string.h>

const nook_param *nook_stream_param_table(size_t *out_count)
{
    *out_count = NOOK_COUNT(nook_stream_rows);
    return nook_stream_rows;
}

nook_stream_params nook_stream_params_initial(void)
{
    nook_stream_params params;
    nook_param_reset(nook_stream_rows, NOOK_COUNT(nook_stream_rows), &params);
    return params;
}

static nook_result refuse(const char *where, const char *name)
{
    char names[256] = "";
    size_t used = 0;
    for (size_t i = 0; i < NOOK_COUNT(nook_stream_rows) && used < sizeof names; i++)
        used += (size_t)snprintf(names + used, sizeof names - used, "%svolumes.%s", i ? ", " : "",
                                 nook_stream_rows[i].name);
    return nook_fail(NOOK_E_NOT_FOUND, "%s: volumes have no parameter %s; there are %s", where, name, names);
}

nook_result nook_stream_params_assign(const char *where, nook_stream_params *params, const char *name, const char *text)
{
    static const char prefix[] = "volumes.";
    char owner[512];
    const char *own = strncmp(name, prefix, sizeof prefix - 1) == 0 ? name + sizeof prefix - 1 : name;
    const nook_param *param = nook_param_find(nook_stream_rows, NOOK_COUNT(nook_stream_rows), own);
    if (!param)
        return refuse(where, name);
    snprintf(owner, sizeof owner, "%s: volumes", where);
    return nook_param_parse(param, owner, params, text);
}
