#include "modules/ao/technique.h"
#include <assert.h>

enum { LOCATION_PART = 0 };

const char *nook_ao_pass_defines(const nook_ao_pass *pass, int either)
{
    static const char *const defines[3][2] = { { "", "#define COUNTING\n" },
                                               { "#define LISTED\n", "#define COUNTING\n#define LISTED\n" },
                                               { "#define EITHER\n", "#define COUNTING\n#define EITHER\n" } };
    const int points = either && pass->lists ? 2 : pass->listed != NULL;
    return defines[points][pass->counting != 0];
}

void nook_ao_pass_groups(const nook_ao_pass *pass, uint32_t local_x, uint32_t local_y, uint32_t out_groups[2])
{
    out_groups[0] = nook_groups(pass->end[0] - pass->origin[0], local_x);
    out_groups[1] = nook_groups(pass->end[1] - pass->origin[1], local_y);
}

static void dispatch(const nook_ao_pass *pass, nook_program program, uint32_t local_x, uint32_t local_y)
{
    uint32_t groups[2];
    nook_ao_pass_groups(pass, local_x, local_y, groups);
    if (pass->listed)
        nook_dispatch_indirect(pass->gpu, program, *pass->listed);
    else
        nook_dispatch(pass->gpu, program, groups[0], groups[1], 1);
}

nook_result nook_ao_pass_dispatch(const nook_ao_pass *pass, const char *shader_path, uint32_t local_x, uint32_t local_y)
{
    nook_program program;
    nook_result result = nook_program_compute(pass->gpu, shader_path, nook_ao_pass_defines(pass, 0), &program);
    if (result == NOOK_OK)
        dispatch(pass, program, local_x, local_y);
    return result;
}

nook_result nook_ao_pass_dispatch_parts(const nook_ao_pass *pass, const char *shader_path, uint32_t local_x,
                                        uint32_t local_y, int32_t count, int32_t turns_per_item)
{
    assert(turns_per_item >= 1 && turns_per_item <= NOOK_AO_TURNS_PER_DISPATCH);
    nook_program program;
    nook_result result = nook_program_compute(pass->gpu, shader_path, nook_ao_pass_defines(pass, 0), &program);
    if (result != NOOK_OK)
        return result;
    int32_t items = NOOK_AO_TURNS_PER_DISPATCH / turns_per_item;
    nook_program_use(pass->gpu, program);
    for (int32_t first = 0; first < count; first += items) {
        const int32_t part[2] = { first, count - first < items ? count : first + items };
        nook_uniform_int(pass->gpu, LOCATION_PART, part, 2);
        dispatch(pass, program, local_x, local_y);
    }
    return NOOK_OK;
}
