/** alpha_hash.h - what tells one soup's alphas from another's; inside modules/bake only. */
#pragma once
#include "modules/bake/voxelize.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Of parts, their texels, and where on them corners lie. @param seed  the hash so far, and what comes back where there are no parts */
uint64_t nook_alphas_hash(const nook_triangles *triangles, const nook_alphas *alphas, uint64_t seed);

/** Of what a part looks like, wherever its triangles stand in the list. */
uint64_t nook_alpha_part_hash(const nook_alpha_part *part, uint64_t seed);

#ifdef __cplusplus
}
#endif
