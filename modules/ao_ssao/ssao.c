#include "modules/ao_ssao/ssao.h"
#include "modules/ao/direction_texture.h"

#define NOOK_PARAM_STRUCT ssao_params
#define NOOK_PARAM_FILE "modules/ao_ssao/params.def"
#include "engine/core/param_block.inl"

enum { BINDING_DIRECTIONS = 4 };

typedef struct ssao_state {
    nook_direction_texture directions;
} ssao_state;

static void destroy(void *state, nook_gpu *gpu)
{
    ssao_state *s = state;
    nook_direction_texture_release(&s->directions, gpu);
}

static nook_result record(void *state, const void *params, const nook_ao_pass *pass)
{
    ssao_state *s = state;
    const ssao_params *p = params;
    nook_result result = nook_direction_texture_fit(&s->directions, pass->gpu, (uint32_t)p->samples, pass->seed, 0);
    if (result != NOOK_OK)
        return result;
    nook_bind_texture(pass->gpu, BINDING_DIRECTIONS, s->directions.texture);
    return nook_ao_pass_dispatch(pass, "shaders/ao/ssao.comp.glsl", 16, 8);
}

const nook_ao_technique nook_ao_ssao_technique = {
    .version = NOOK_AO_TECHNIQUE_VERSION,
    .name = "ssao",
    .summary = "Points around the fragment tested against the depth buffer; sees only what the camera sees",
    .refines = 1,
    .params = param_table,
    .param_count = NOOK_COUNT(param_table),
    .params_size = sizeof(ssao_params),
    .state_size = sizeof(ssao_state),
    .state_version = 2,
    .destroy = destroy,
    .record = record,
};
