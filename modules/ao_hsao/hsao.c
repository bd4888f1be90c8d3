#include "modules/ao_hsao/hsao.h"

#define NOOK_PARAM_STRUCT hsao_params
#define NOOK_PARAM_FILE "modules/ao_hsao/params.def"
#include "engine/core/param_block.inl"

enum { GROUP_WIDTH = 16, GROUP_HEIGHT = 8, BINDING_VISIBILITY = 0, LOCATION_PART = 0 };

/**
 * llvmpipe ends all loops of an invocation without a word after 65535 turns in sum, and a GPU that works for seconds on one
 * dispatch is reset: the work is cut into dispatches. One azimuth is at the most 16705 turns.
 */
enum { TURNS_PER_DISPATCH = 60000 };

static nook_result record(void *state, const void *params, const nook_ao_pass *pass)
{
    (void)state;
    const hsao_params *p = params;
    nook_program program;
    nook_result result = nook_program_compute(pass->gpu, "shaders/ao/hsao.comp.glsl", "", &program);
    if (result != NOOK_OK)
        return result;
    int32_t turns = 1 + p->steps + p->rays * (1 + p->ray_steps), count = TURNS_PER_DISPATCH / turns;
    nook_bind_image(pass->gpu, BINDING_VISIBILITY, pass->visibility, GL_READ_WRITE);
    for (int32_t first = 0; first < p->directions; first += count) {
        int32_t end = p->directions - first < count ? p->directions : first + count;
        const GLint part[2] = { first, end };
        pass->gpu->gl->ProgramUniform2iv(program.id, LOCATION_PART, 1, part);
        nook_dispatch(pass->gpu, program, nook_groups(pass->width, GROUP_WIDTH),
                      nook_groups(pass->height, GROUP_HEIGHT), 1);
    }
    return NOOK_OK;
}

const nook_ao_technique nook_ao_hsao_technique = {
    .version = NOOK_AO_TECHNIQUE_VERSION,
    .name = "hsao",
    .summary = "Horizons of the depth buffer below, rays above them; sees only what the camera sees",
    .params = param_table,
    .param_count = NOOK_COUNT(param_table),
    .params_size = sizeof(hsao_params),
    .state_version = 1,
    .record = record,
};
