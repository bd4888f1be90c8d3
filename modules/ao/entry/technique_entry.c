/* What the shared library of a technique exports; compiled once for each, with NOOK_TECHNIQUE its name: gtao. */
#include "engine/module/module.h"
#include "modules/ao/technique.h"

#define JOIN(name) nook_ao_##name##_technique
#define DESCRIPTOR_OF(name) JOIN(name)
#define TEXT(name) #name
#define TEXT_OF(name) TEXT(name)

extern const nook_ao_technique DESCRIPTOR_OF(NOOK_TECHNIQUE);

static const nook_module module = {
    .version = NOOK_MODULE_VERSION,
    .name = "ao_" TEXT_OF(NOOK_TECHNIQUE),
    .kind = NOOK_AO_TECHNIQUE_KIND,
    .interface = &DESCRIPTOR_OF(NOOK_TECHNIQUE),
};

NOOK_MODULE_EXPORT const nook_module *nook_module_entry(void);
const nook_module *nook_module_entry(void)
{
    return &module;
}
