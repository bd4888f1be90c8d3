#include "engine/asset/scalar_medium.h"
#include "engine/asset/scene_internal.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

double nook_scalar_extinction(const nook_scalar_transfer *transfer, double sample)
{
    if (!isfinite(sample))
        return 0.0;
    /* Halved, so that the widest window does not overflow. */
    double opacity = (0.5 * sample - 0.5 * transfer->low) / (0.5 * transfer->high - 0.5 * transfer->low);
    opacity = fmin(fmax(opacity, 0.0), NOOK_SCALAR_OPACITY_MAX);
    return -log1p(-opacity) / transfer->length;
}

static nook_result check(const char *name, const nook_scalar_volume *volume, const nook_scalar_transfer *transfer)
{
    if (!isfinite(transfer->low) || !isfinite(transfer->high) || !(transfer->low < transfer->high))
        return nook_fail(NOOK_E_RANGE, "%s: its window is %g to %g; give two finite numbers, the lower one first", name,
                         transfer->low, transfer->high);
    if (!(transfer->length >= NOOK_SCALAR_LENGTH_MIN && transfer->length <= NOOK_SCALAR_LENGTH_MAX))
        return nook_fail(NOOK_E_RANGE, "%s: its length is %g; give metres in [%g, %g]", name, transfer->length,
                         NOOK_SCALAR_LENGTH_MIN, NOOK_SCALAR_LENGTH_MAX);
    if (volume->components != 1)
        return nook_fail(NOOK_E_FORMAT, "%s: %u numbers a sample; a density needs one", name, volume->components);
    if (volume->sample_count > NOOK_MEDIUM_CELLS_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: %zu samples; a density has up to %llu, make it coarser", name,
                         volume->sample_count, NOOK_MEDIUM_CELLS_MAX);
    for (int axis = 0; axis < 3; axis++) {
        double side = volume->spacing[axis] * volume->size[axis];
        if (volume->size[axis] > NOOK_MEDIUM_SIDE_MAX)
            return nook_fail(NOOK_E_FORMAT, "%s: %u samples along an axis; a density has up to %u", name,
                             volume->size[axis], NOOK_MEDIUM_SIDE_MAX);
        if (!(volume->spacing[axis] >= NOOK_MEDIUM_SPACING_MIN && side <= NOOK_MEDIUM_LENGTH_MAX))
            return nook_fail(
                NOOK_E_FORMAT, "%s: %u samples %g apart; a density has spacings of %g and sides up to %g metres", name,
                volume->size[axis], volume->spacing[axis], NOOK_MEDIUM_SPACING_MIN, NOOK_MEDIUM_LENGTH_MAX);
    }
    return NOOK_OK;
}

nook_result nook_scalar_medium(const char *name, const nook_scalar_volume *volume, const nook_scalar_transfer *transfer,
                               nook_scene *scene, nook_medium *out_medium)
{
    nook_result result = check(name, volume, transfer);
    if (result != NOOK_OK)
        return result;
    float *extinction = malloc((volume->sample_count + 1) * sizeof *extinction);
    if (!extinction)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu samples", name, volume->sample_count);
    if (volume->not_finite > 0)
        nook_scene_warn(scene, "%s: %zu samples are not finite; they darken nothing", name, volume->not_finite);
    bool any = false;
    for (size_t i = 0; i < volume->sample_count; i++) {
        extinction[i] = (float)nook_scalar_extinction(transfer, nook_scalar_volume_sample(volume, i));
        any = any || extinction[i] > 0.0f;
    }
    if (!any)
        nook_scene_warn(scene, "%s: no sample reaches into its window of %g to %g; it darkens nothing", name,
                        transfer->low, transfer->high);
    *out_medium = (nook_medium){ .extinction = extinction };
    for (int axis = 0; axis < 3; axis++) {
        out_medium->size[axis] = volume->size[axis];
        out_medium->spacing[axis] = volume->spacing[axis];
    }
    return NOOK_OK;
}
