#pragma once
#include "engine/core/result.h"
#include <stdint.h>

struct nook_stage;

/** How long recording the chosen technique takes. */
typedef struct nook_frame_times {
    double median, min, max; /**< Milliseconds of nook_ao_record, wall clock around glFinish. */
    double gpu_median;       /**< By timer queries; NaN where these lie (software GL). */
    uint32_t frames;         /**< Timed ones. */
} nook_frame_times;

/**
 * Times the chosen technique on the stage's G-buffer. Warm it up first: the first record compiles.
 * @param frames     at most so many, at least one; > 0
 * @param budget_ms  no other is begun when that much has gone by; may be infinite
 * @return NOOK_E_MEMORY, or why recording failed; *out_times untouched then
 */
nook_result nook_frame_times_measure(struct nook_stage *stage, uint32_t frames, double budget_ms,
                                     nook_frame_times *out_times);
