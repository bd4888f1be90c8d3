#pragma once
#include "modules/ao/technique.h"

/** Every technique of the program, in the order of menus; the exact one, the reference, last. @param out_count  rows */
const nook_ao_technique *const *nook_techniques(size_t *out_count);

/** Of those that all techniques share, by its name in modules/ao/params.def, which it must have. */
const nook_param *nook_shared_param(const char *name);
