/**
 * reference.h - the technique "reference": ray-cast truth from the same G-buffer, on the CPU through Embree.
 *
 * Cosine-weighted rays against the triangles of every occluder (nook_ao_add_mesh): A = mean of rho(first hit). The points
 * are Sobol's, shifted per pixel, so that the error falls much faster than 1 / sqrt(rays).
 */
#pragma once
#include "modules/ao/technique.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Raise it when a picture of the same rays changes: truths that were kept (game/measure/truth.h) are then traced anew. */
#define NOOK_REFERENCE_VERSION 2u

extern const nook_ao_technique nook_ao_reference_technique;

#ifdef __cplusplus
}
#endif
