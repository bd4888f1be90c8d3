/**
 * pfm.h - Portable Float Map, the grey kind ("Pf"): how visibility is stored for others to measure.
 *
 * Text header "Pf", width height, scale; then 32-bit floats, bottom row first. A negative scale says little-endian.
 */
#pragma once
#include "engine/core/result.h"
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_PFM_SIDE_MAX 32768u

/** A float picture: grey, bottom row first, as OpenGL reads it and PFM stores it. */
typedef struct nook_grey {
    float *values; /**< width * height; owned, release with nook_grey_free. */
    uint32_t width, height;
} nook_grey;

/** Zeros. @return NOOK_E_RANGE a side is 0 or over NOOK_PFM_SIDE_MAX; NOOK_E_MEMORY; *out_grey untouched then */
nook_result nook_grey_create(uint32_t width, uint32_t height, nook_grey *out_grey);
void nook_grey_free(nook_grey *grey); /**< NULL and zeroed ones are allowed. */

/** @return NOOK_E_IO, NOOK_E_MEMORY; an existing file is as it was then */
nook_result nook_pfm_write(const nook_grey *grey, const char *path);

/** Reads a grey file of either byte order. @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_FORMAT, NOOK_E_MEMORY; untouched then */
nook_result nook_pfm_read(const char *path, nook_grey *out_grey);

#ifdef __cplusplus
}
#endif
