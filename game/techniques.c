#include "game/techniques.h"
#include "modules/ao/nook_ao.h"
#include "modules/ao_hsao/hsao.h"
#include "modules/ao_reference/reference.h"
#include "modules/ao_ssao/ssao.h"
#include "modules/ao_volume/volume.h"

static const nook_ao_technique *const techniques[] = {
    &nook_ao_volume_technique,
    &nook_ao_ssao_technique,
    &nook_ao_hsao_technique,
    &nook_ao_reference_technique,
};

const nook_ao_technique *const *nook_techniques(size_t *out_count)
{
    *out_count = NOOK_COUNT(techniques);
    return techniques;
}

const nook_param *nook_shared_param(const char *name)
{
    size_t count;
    const nook_param *params = nook_ao_shared_params(&count);
    return nook_param_find(params, count, name);
}
