/** scalar_medium.h - from the samples of a scalar field to how much light they take: docs/volume_kinds.md, "Scalar fields". */
#pragma once
#include "engine/asset/scalar_volume.h"
#include "engine/asset/scene.h"
#include "engine/core/medium.h"

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_SCALAR_LENGTH_MIN 1e-6 /**< Metres. */
#define NOOK_SCALAR_LENGTH_MAX 1e6
#define NOOK_SCALAR_OPACITY_MAX \
    (1.0 - 1.0 / 1024.0) /**< More is taken for this: what lets nothing through has no extinction. */

/** A sample s is as opaque as clamp((s - low) / (high - low), 0, 1), along `length` metres of it. */
typedef struct nook_scalar_transfer {
    double low, high; /**< Finite, low < high. */
    double length;    /**< Metres, in [NOOK_SCALAR_LENGTH_MIN, NOOK_SCALAR_LENGTH_MAX]. */
} nook_scalar_transfer;

/** Extinction per metre of a sample; 0 of one that is not finite. */
double nook_scalar_extinction(const nook_scalar_transfer *transfer, double sample);

/**
 * A cell for each sample, as large as the samples are apart. Samples that are not finite take nothing, and one warning counts them.
 * @param name   used in messages only
 * @param scene  keeps the warnings; NULL: they are logged only
 * @param out_medium  its extinction is yours to free
 * @return NOOK_E_FORMAT several numbers a sample, or sides that no number of metres is; NOOK_E_RANGE the transfer; NOOK_E_MEMORY. Untouched then
 */
nook_result nook_scalar_medium(const char *name, const nook_scalar_volume *volume, const nook_scalar_transfer *transfer,
                               nook_scene *scene, nook_medium *out_medium);

#ifdef __cplusplus
}
#endif
