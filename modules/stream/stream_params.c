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

nook_result nook_stream_params_assign(const char *where, nook_stream_params *params, const char *name, const char *text)
{
    return nook_param_assign(nook_stream_rows, NOOK_COUNT(nook_stream_rows), where, "volumes", params, name, text);
}
