/**
 * hsao.h - the technique "hsao": horizon-split ambient occlusion.
 *
 * Dimitrov, Bavoil, Sainz: Horizon-split ambient occlusion, I3D 2008: the hemisphere around the normal is split, azimuth by
 * azimuth, at the horizon of the depth buffer. Below it occlusion is known in closed form; above it rays are marched for
 * surfaces that do not continue. With the attenuation and sample rejection of image-space horizon-based AO (Bavoil, Sainz,
 * ShaderX7 2009): each rise of the horizon counts with the falloff at its own distance, samples beyond r_max do not count.
 */
#pragma once
#include "modules/ao/technique.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const nook_ao_technique nook_ao_hsao_technique;

#ifdef __cplusplus
}
#endif
