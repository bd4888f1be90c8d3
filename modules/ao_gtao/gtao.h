/**
 * gtao.h - the technique "gtao": ground-truth ambient occlusion, the part of it that estimates equation 1.
 *
 * Jimenez, Wu, Pesce, Jarabo: Practical realtime strategies for accurate indirect occlusion, 2016. The sphere of directions is cut
 * into slices through the line of sight; in each the depth buffer gives two horizons, and the cosine-weighted integral between
 * them is known in closed form. No multiple bounces, gain or power. Where the paper fades a sample by its distance, each rise of
 * the horizon counts with the shared falloff at its own distance (docs/techniques.md).
 */
#pragma once
#include "modules/ao/technique.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const nook_ao_technique nook_ao_gtao_technique;

#ifdef __cplusplus
}
#endif
