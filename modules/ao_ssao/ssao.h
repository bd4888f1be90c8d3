/**
 * ssao.h - the technique "ssao": points around the fragment tested against the depth buffer.
 *
 * Mittring: Finding next gen: CryEngine 2, SIGGRAPH 2007. In its honest form: the range check is the shared falloff at the
 * distance of the surface that hides the point, no gain, no power. It is not an estimate of equation 1 (docs/techniques.md).
 */
#pragma once
#include "modules/ao/technique.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const nook_ao_technique nook_ao_ssao_technique;

#ifdef __cplusplus
}
#endif
