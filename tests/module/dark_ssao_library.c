/* What a test compiles into ao_ssao.so: the technique ssao as one who writes DARK_VALUE everywhere. */
#include "engine/module/module.h"
#include "modules/ao/technique.h"

#define NOOK_PARAM_STRUCT dark_params
#define NOOK_PARAM_FILE "modules/ao_ssao/params.def"
#include "engine/core/param_block.inl"

#ifndef DARK_VALUE /* for those who look at this file alone */
#define DARK_VALUE 0.0f
#endif

static nook_result record(void *state, const void *params, const nook_ao_pass *pass)
{
    const float texel[4] = { DARK_VALUE, 0.0f, 0.0f, 0.0f };
    (void)state, (void)params;
#ifdef DARK_CRASHES
    __builtin_trap();
#endif
    pass->gpu->gl->ClearTexImage(pass->visibility.id, 0, GL_RGBA, GL_FLOAT, texel);
    return NOOK_OK;
}

static const nook_ao_technique technique = { .version = NOOK_AO_TECHNIQUE_VERSION,
                                             .name = "ssao",
                                             .summary = "Dark",
                                             .params = param_table,
                                             .param_count = NOOK_COUNT(param_table),
                                             .params_size = sizeof(dark_params),
                                             .state_version = 9,
                                             .record = record };
static const nook_module module = {
    .version = NOOK_MODULE_VERSION, .name = "ao_ssao", .kind = NOOK_AO_TECHNIQUE_KIND, .interface = &technique
};

NOOK_MODULE_EXPORT const nook_module *nook_module_entry(void);
const nook_module *nook_module_entry(void)
{
    return &module;
}
