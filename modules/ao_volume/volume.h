/**
 * volume.h - the technique "volume": rays marched through precomputed voxel volumes, per fragment and occluder.
 *
 * Papaioannou, Menexi, Papadopoulos: Real-time volume-based ambient occlusion, TVCG 2010, section 5.1, with these errors of
 * the paper put right (docs/techniques.md): cosine-weighted rays (C2), guard distance (C7), step length (C9), union of
 * occluders per ray (C5).
 */
#pragma once
#include "modules/ao/technique.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const nook_ao_technique nook_ao_volume_technique;

#ifdef __cplusplus
}
#endif
