#include "modules/ao_gtao/gtao.h"

#define NOOK_PARAM_STRUCT gtao_params
#define NOOK_PARAM_FILE "modules/ao_gtao/params.def"
#include "engine/core/param_block.inl"

static nook_result record(void *state, const void *params, const nook_ao_pass *pass)
{
    (void)state;
    const gtao_params *p = params;
    int32_t turns_per_slice = 1 + 2 * (1 + p->steps);
    return nook_ao_pass_dispatch_parts(pass, "shaders/ao/gtao.comp.glsl", 16, 8, p->slices, turns_per_slice);
}

const nook_ao_technique nook_ao_gtao_technique = {
    .version = NOOK_AO_TECHNIQUE_VERSION,
    .name = "gtao",
    .summary =
        "Slices through the line of sight, cosine-weighted arcs of the depth buffer; sees only what the camera sees",
    .refines = 1,
    .params = param_table,
    .param_count = NOOK_COUNT(param_table),
    .params_size = sizeof(gtao_params),
    .state_version = 1,
    .record = record,
};
