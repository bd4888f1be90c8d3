#include "modules/plan/plan_params.h"
#include <string.h>

const nook_param *nook_plan_param_table(size_t *out_count)
{
    *out_count = NOOK_COUNT(nook_plan_rows);
    return nook_plan_rows;
}

nook_plan_params nook_plan_params_initial(void)
{
    nook_plan_params params;
    nook_param_reset(nook_plan_rows, NOOK_COUNT(nook_plan_rows), &params);
    return params;
}

nook_result nook_plan_params_assign(const char *where, nook_plan_params *params, const char *name, const char *text)
{
    const char *own = strcmp(name, "plan") == 0 ? "mode" : name;
    return nook_param_assign(nook_plan_rows, NOOK_COUNT(nook_plan_rows), where, "plan", params, own, text);
}
