#include "modules/ao/technique.h"

nook_result nook_ao_pass_dispatch(const nook_ao_pass *pass, const char *shader_path, uint32_t local_x, uint32_t local_y)
{
    nook_program program;
    nook_result result = nook_program_compute(pass->gpu, shader_path, "", &program);
    if (result == NOOK_OK)
        nook_dispatch(pass->gpu, program, nook_groups(pass->width, local_x), nook_groups(pass->height, local_y), 1);
    return result;
}
