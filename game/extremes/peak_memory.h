/**
 * peak_memory.h - how much memory a piece of work took at its worst: of the whole process, as the kernel counts it.
 */
#pragma once
#include <stdint.h>

typedef struct nook_peak_memory {
    uint64_t before; /**< Bytes, resident or at their peak. */
} nook_peak_memory;

/**
 * Forgets the peak so far. Where the kernel does not let one (it wants /proc/self/clear_refs), growth is measured from the
 * old peak and may be too small, never too large.
 */
nook_peak_memory nook_peak_memory_begin(void);
/** Bytes by which the peak since then exceeds what was resident; 0 where the system does not tell. */
uint64_t nook_peak_memory_growth(const nook_peak_memory *begun);
