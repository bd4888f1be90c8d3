/**
 * medium.h - a grid of cells that take a part of the light that passes them: what a scalar field becomes (engine/asset/scalar_medium.h).
 * Bakers make densities of it, and the reference's rays are stopped in it, by the same rule.
 *
 * Of a way of d metres through a cell exp(-extinction * d) gets through. Cells are boxes of `spacing`, the first one's outer corner
 * lies in the origin; outside of them there is nothing. A metre is one of the medium's own space: a node that scales it makes it larger,
 * not denser.
 */
#pragma once
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_medium {
    uint32_t size[3];        /**< Cells along x, y, z; each at least 1. */
    double spacing[3];       /**< Metres, > 0. */
    const float *extinction; /**< Per metre, finite, >= 0; x fastest, then y, then z. */
} nook_medium;

#define NOOK_MEDIUM_SIDE_MAX 65536u  /**< Cells along an axis: as many are walked by a ray. */
#define NOOK_MEDIUM_SPACING_MIN 1e-9 /**< Metres. */
#define NOOK_MEDIUM_LENGTH_MAX 1e9   /**< Metres, of the whole grid along an axis. */
#define NOOK_MEDIUM_CELLS_MAX \
    (1ull << 28) /**< Of a medium, and of all in a scene: 1 GiB, once in the scene and once in the AO. */

static inline uint64_t nook_medium_cells(const nook_medium *medium)
{
    return (uint64_t)medium->size[0] * medium->size[1] * medium->size[2];
}

#ifdef __cplusplus
}
#endif
