/** alpha_hash.h - what tells one soup's alphas from another's; inside modules/bake only. */
#pragma once
#include "modules/bake/voxelize.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Of parts, their texels, and where on them corners lie. @param seed  the hash so far, and what comes back where there are no parts */
uint64_t nook_alphas_hash(const nook_triangles *triangles, const nook_alphas *alphas, uint64_t seed);

#ifdef __cplusplus
}
#endif
