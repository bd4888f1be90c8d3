/** ray_medium.h - rays are stopped in a medium: a box of its own to Embree; inside modules/trace only. */
#pragma once
#include "engine/core/medium.h"
#include <embree3/rtcore.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Where a ray that comes from `origin` is stopped when all but `left` of such rays are: at the optical depth -ln(left).
 * @param direction  of any length; distances are multiples of it
 * @param left       (0, 1]
 * @return in [near, far); INFINITY: it gets through
 */
double nook_medium_stop(const nook_medium *medium, const double origin[3], const double direction[3], double near,
                        double far, double left);

typedef struct nook_ray_medium nook_ray_medium;

/**
 * @param medium  borrowed
 * @param id      tells its chances from those of another one in the same place
 * @return NULL when there is no memory
 */
nook_ray_medium *nook_ray_medium_create(const nook_medium *medium, uint32_t id);
void nook_ray_medium_destroy(nook_ray_medium *medium); /**< NULL is allowed. Not before what Embree built with it. */

/**
 * A geometry, not committed: a ray is stopped with the probability of what the medium takes of it, by the bits of the ray. So many rays see on
 * average what each would see if it were weakened, and the same ray is always stopped in the same place.
 * @param medium  outlives the geometry @return NULL when there is no memory
 */
RTCGeometry nook_ray_medium_geometry(RTCDevice device, nook_ray_medium *medium);

#ifdef __cplusplus
}
#endif
