/**
 * peak_memory.h - how much memory a piece of work took at its worst: it runs in a process of its own, which the kernel counts.
 */
#pragma once
#include "engine/core/result.h"
#include <stddef.h>
#include <stdint.h>

/** Of this process, bytes; in a child its own. */
typedef struct nook_memory {
    uint64_t resident; /**< Now. */
    uint64_t peak;     /**< The most that it ever was. */
} nook_memory;

/** @return NOOK_E_IO where the system does not tell */
nook_result nook_memory_read(nook_memory *out_memory);

/** Bytes of growth as the program would take them: under AddressSanitizer more is kept. */
uint64_t nook_peak_memory_ours(uint64_t growth);

/** Fills `out`, which starts as zero. */
typedef nook_result (*nook_child_work)(const void *user, void *out);

/**
 * Runs `work` in a copy of this process and brings its answer back. It must not use the GPU, and nothing it does is seen here but
 * `out`. Memory that is free is given back before, so that the child cannot take it unseen.
 * @param out  plain bytes, untouched on failure
 * @return what `work` returns; NOOK_E_IO no process can be made; NOOK_E_MEMORY it ended without an answer
 */
nook_result nook_run_in_child(nook_child_work work, const void *user, void *out, size_t out_size);
