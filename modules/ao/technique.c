#include "modules/ao/technique.h"
#include <assert.h>

enum { LOCATION_PART = 0 };

nook_result nook_ao_pass_dispatch(const nook_ao_pass *pass, const char *shader_path, uint32_t local_x, uint32_t local_y)
{
    nook_program program;
    nook_result result = nook_program_compute(pass->gpu, shader_path, "", &program);
    if (result == NOOK_OK)
        nook_dispatch(pass->gpu, program, nook_groups(pass->width, local_x), nook_groups(pass->height, local_y), 1);
    return result;
}

nook_result nook_ao_pass_dispatch_parts(const nook_ao_pass *pass, const char *shader_path, uint32_t local_x,
                                        uint32_t local_y, int32_t count, int32_t turns_per_item)
{
    assert(turns_per_item >= 1 && turns_per_item <= NOOK_AO_TURNS_PER_DISPATCH);
    nook_program program;
    nook_result result = nook_program_compute(pass->gpu, shader_path, "", &program);
    if (result != NOOK_OK)
        return result;
    int32_t items = NOOK_AO_TURNS_PER_DISPATCH / turns_per_item;
    for (int32_t first = 0; first < count; first += items) {
        const GLint part[2] = { first, count - first < items ? count : first + items };
        pass->gpu->gl->ProgramUniform2iv(program.id, LOCATION_PART, 1, part);
        nook_dispatch(pass->gpu, program, nook_groups(pass->width, local_x), nook_groups(pass->height, local_y), 1);
    }
    return NOOK_OK;
}
