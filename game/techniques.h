#pragma once
#include "modules/ao/technique.h"

/** Every technique, in the order of menus; the exact one, the reference, last. @param out_count  rows */
const nook_ao_technique *const *nook_techniques(size_t *out_count);

/** Lists a technique whose code was loaded: in the place of the one of its name, or at the end when there is none. */
void nook_techniques_list(const nook_ao_technique *technique);

/** Of those that all techniques share, by its name in modules/ao/params.def, which it must have. */
const nook_param *nook_shared_param(const char *name);

/** @return the technique of that name, or NULL */
const nook_ao_technique *nook_technique_find(const char *name);

/**
 * Says that there is no technique of that name, which is nearest, and which there are.
 * @param where  names the source in the line: "--techniques", "sweep.txt:12"
 * @return NOOK_E_NOT_FOUND
 */
nook_result nook_technique_refuse(const char *where, const char *name);
