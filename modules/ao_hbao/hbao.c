#include "modules/ao_hbao/hbao.h"

#define NOOK_PARAM_STRUCT hbao_params
#define NOOK_PARAM_FILE "modules/ao_hbao/params.def"
#include "engine/core/param_block.inl"

static nook_result record(void *state, const void *params, const nook_ao_pass *pass)
{
    (void)state;
    const hbao_params *p = params;
    return nook_ao_pass_dispatch_parts(pass, "shaders/ao/hbao.comp.glsl", 16, 8, p->directions, 2 + p->steps);
}

const nook_ao_technique nook_ao_hbao_technique = {
    .version = NOOK_AO_TECHNIQUE_VERSION,
    .name = "hbao",
    .summary = "Horizons of the depth buffer, solid angle without the cosine; sees only what the camera sees",
    .refines = 1,
    .params = param_table,
    .param_count = NOOK_COUNT(param_table),
    .params_size = sizeof(hbao_params),
    .state_version = 1,
    .record = record,
};
