#include "modules/ao_hsao/hsao.h"

#define NOOK_PARAM_STRUCT hsao_params
#define NOOK_PARAM_FILE "modules/ao_hsao/params.def"
#include "engine/core/param_block.inl"

static nook_result record(void *state, const void *params, const nook_ao_pass *pass)
{
    (void)state;
    const hsao_params *p = params;
    int32_t turns_per_azimuth = 1 + p->steps + p->rays * (1 + p->ray_steps);
    return nook_ao_pass_dispatch_parts(pass, "shaders/ao/hsao.comp.glsl", 16, 8, p->directions, turns_per_azimuth);
}

const nook_ao_technique nook_ao_hsao_technique = {
    .version = NOOK_AO_TECHNIQUE_VERSION,
    .name = "hsao",
    .summary = "Horizons of the depth buffer below, rays above them; sees only what the camera sees",
    .refines = 1,
    .params = param_table,
    .param_count = NOOK_COUNT(param_table),
    .params_size = sizeof(hsao_params),
    .state_version = 1,
    .record = record,
};
