/** stream_params.h - what may be asked of the streaming: params.def as a struct and as a table. */
#pragma once
#include "engine/core/param.h"

#define NOOK_PARAM_STRUCT nook_stream_params
#define NOOK_PARAM_FILE "modules/stream/params.def"
#define NOOK_PARAM_TABLE nook_stream_rows
#include "engine/core/param_block.inl"

#ifdef __cplusplus
extern "C" {
#endif

/** The rows of params.def; their owner is "volumes". */
const nook_param *nook_stream_param_table(size_t *out_count);
/** Everything at its initial value: no bounds on memory. */
nook_stream_params nook_stream_params_initial(void);
/** @return NOOK_E_RANGE one of them is outside of its range: the line says which */
nook_result nook_stream_params_check(const nook_stream_params *params);
/**
 * Sets one parameter from text.
 * @param where  names the source in the message
 * @param name   "budget", or "volumes.budget"
 * @return NOOK_E_NOT_FOUND (the line lists the names), NOOK_E_ARG, NOOK_E_RANGE; it stays as it was then
 */
nook_result nook_stream_params_assign(const char *where, nook_stream_params *params, const char *name,
                                      const char *text);

#ifdef __cplusplus
}
#endif
