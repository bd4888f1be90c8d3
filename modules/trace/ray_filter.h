/** ray_filter.h - rays pass through what of a mesh is not there: Embree asks about each hit; inside modules/trace only. */
#pragma once
#include "modules/ao/technique.h"
#include <embree3/rtcore.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_ray_filter nook_ray_filter;

/** @param mesh  with alphas; its arrays are borrowed @return NULL when there is no memory */
nook_ray_filter *nook_ray_filter_create(const nook_ao_mesh_view *mesh);
void nook_ray_filter_destroy(nook_ray_filter *filter); /**< NULL is allowed. Not before what Embree built with it. */

/**
 * A hit counts where a masked part is there; on a blended one with a probability of its alpha, by the bits of ray and triangle: so many
 * rays see on average what each would see if it were weakened by 1 - alpha, and the same ray meets the same triangles every time.
 */
void nook_ray_filter_apply(nook_ray_filter *filter, RTCGeometry geometry);

#ifdef __cplusplus
}
#endif
