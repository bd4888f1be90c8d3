#include "modules/stream/stream_params.h"

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

nook_result nook_stream_params_check(const nook_stream_params *params)
{
    nook_stream_params taken;
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < NOOK_COUNT(nook_stream_rows) && result == NOOK_OK; i++)
        result = nook_param_set(&nook_stream_rows[i], "volumes", &taken, nook_param_get(&nook_stream_rows[i], params));
    return result;
}

nook_result nook_stream_params_assign(const char *where, nook_stream_params *params, const char *name, const char *text)
{
    return nook_param_assign(nook_stream_rows, NOOK_COUNT(nook_stream_rows), where, "volumes", params, name, text);
}
