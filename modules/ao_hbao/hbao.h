/**
 * hbao.h - the technique "hbao": classic image-space horizon-based ambient occlusion.
 *
 * Bavoil, Sainz, Dimitrov: Image-space horizon-based ambient occlusion, SIGGRAPH 2008 talks. In every azimuth of the picture the
 * depth buffer gives a horizon above the tangent plane; what lies between them is blocked. It weighs directions by solid angle,
 * without the cosine, and is not an estimate of equation 1 (docs/techniques.md, C18). No gain, no power.
 */
#pragma once
#include "modules/ao/technique.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const nook_ao_technique nook_ao_hbao_technique;

#ifdef __cplusplus
}
#endif
