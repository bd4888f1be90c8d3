/** plan_params.h - what may be asked of the planner: params.def as a struct and as a table. */
#pragma once
#include "engine/core/param.h"

#define NOOK_PARAM_STRUCT nook_plan_params
#define NOOK_PARAM_FILE "modules/plan/params.def"
#define NOOK_PARAM_TABLE nook_plan_rows
#include "engine/core/param_block.inl"

#ifdef __cplusplus
extern "C" {
#endif

/** Values of nook_plan_params.mode. */
enum { NOOK_PLAN_OFF, NOOK_PLAN_ON, NOOK_PLAN_MEASURED };

/** The rows of params.def; their owner is "plan". */
const nook_param *nook_plan_param_table(size_t *out_count);
/** Everything at its initial value: off. */
nook_plan_params nook_plan_params_initial(void);
/**
 * Sets one parameter from text.
 * @param where  names the source in the message
 * @param name   "error", or "plan.error", or "plan" alone for the mode
 * @return NOOK_E_NOT_FOUND (the line lists the names), NOOK_E_ARG, NOOK_E_RANGE; it stays as it was then
 */
nook_result nook_plan_params_assign(const char *where, nook_plan_params *params, const char *name, const char *text);

#ifdef __cplusplus
}
#endif
