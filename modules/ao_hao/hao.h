/**
 * hao.h - the technique "hao": hybrid ambient occlusion.
 *
 * Reinbothe, Boubekeur, Alexa: Hybrid ambient occlusion, Eurographics 2009 (areas papers). What occludes is voxelised on the GPU whenever
 * it or the view has changed, into a grid of bits around the view, and a few points on each ray are looked up there: nothing is
 * precomputed, and what the camera does not see occludes. Hybrid means that a filter in screen space takes the noise off.
 */
#pragma once
#include "modules/ao/technique.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const nook_ao_technique nook_ao_hao_technique;

#ifdef __cplusplus
}
#endif
