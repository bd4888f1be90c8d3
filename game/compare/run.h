#pragma once
#include "engine/core/result.h"
#include "game/compare/choice.h"
#include "game/compare/second_view.h"
#include "game/compare/views.h"
#include "game/stage.h"
#include "modules/ao/technique.h"
#include "modules/measure/errors.h"
#include "modules/measure/instability.h"
#include "modules/measure/pfm.h"
#include "modules/measure/picture.h"

/** One technique on one frame. */
typedef struct nook_compare_row {
    const nook_ao_technique *technique;
    double ms_median, ms_min, ms_max; /**< Of nook_ao_record, wall clock around glFinish. */
    double gpu_ms_median;             /**< By timer queries; NaN where these lie (software GL). */
    uint32_t frames;                  /**< Timed ones. */
    double fetches_per_pixel;         /**< NaN for techniques that count none. */
    nook_errors errors;               /**< Against the reference; of the reference itself all 0. */
    nook_instability instability;     /**< Between the two views; all 0 when there is no second. */
    nook_grey visibility;             /**< Owned. */
    nook_picture lit;                 /**< Owned. */
} nook_compare_row;

/** What `compare` measures; the files, the table and the JSON are written from it. */
typedef struct nook_comparison {
    nook_compare_row rows[NOOK_COMPARE_TECHNIQUES_MAX]; /**< The reference first. */
    uint32_t row_count;
    uint8_t *geometry; /**< One byte a pixel, bottom row first: not 0 where something was drawn. Owned. */
    uint32_t width, height;
    char camera[256];         /**< What to call the view. */
    nook_second_view second;  /**< Not measured until nook_compare_steadiness. */
    nook_view_pictures views; /**< Of the frame with the last technique, drawn before the second view. */
} nook_comparison;

/**
 * Draws the G-buffer once, then records, times, counts and reads back every chosen technique on it.
 * In a window it shows each picture as it is made.
 * @param frames  timed ones of each technique, the reference is timed once; 0: five, or fewer when they take seconds
 * @return why not; *out_comparison is zero then
 */
nook_result nook_compare_run(nook_stage *stage, const nook_camera *camera, const nook_compare_choice *choice,
                             uint32_t frames, nook_comparison *out_comparison);

/** What the last record made. @param out_grey  owned by the caller @return NOOK_E_MEMORY, NOOK_E_RANGE; untouched then */
nook_result nook_compare_read_visibility(nook_stage *stage, nook_grey *out_grey);

void nook_comparison_free(nook_comparison *comparison); /**< Zeroed ones are allowed. */
