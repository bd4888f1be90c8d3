/**
 * sheet.h - the comparison sheet: one row per technique with the lit picture, the visibility and the signed error.
 */
#pragma once
#include "modules/measure/picture.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_sheet_fact {
    const char *label; /**< "RMSE" */
    const char *value; /**< "0.0412" */
} nook_sheet_fact;

typedef struct nook_sheet_row {
    const char *name;               /**< Heading. */
    const char *summary;            /**< One sentence; wrapped. "" for none. */
    const nook_picture *lit;        /**< Borrowed, as are the other two. All pictures of a sheet have one size. */
    const nook_picture *visibility; /**< Grey. */
    const nook_picture *error;    /**< nook_error_picture; NULL: the reference itself, the colour scale stands there. */
    const nook_sheet_fact *facts; /**< fact_count lines under the name. */
    uint32_t fact_count;
    const char *parameters; /**< "rays 16, steps 12"; wrapped. "" for none. */
} nook_sheet_row;

typedef struct nook_sheet {
    const char *title;
    const char *const *lines; /**< line_count lines of small print under the title. */
    uint32_t line_count;
    const nook_sheet_row *rows; /**< The reference first. */
    uint32_t row_count;         /**< At least 1. */
    float error_range;          /**< What the ends of the colour scale mean, as given to nook_error_picture. */
} nook_sheet;

/**
 * Draws the sheet. Panels over 480 x 420 pixels are shrunk to fit; the picture files keep the full size.
 * @return NOOK_E_NOT_FOUND no font (the line names the package); NOOK_E_MEMORY; NOOK_E_RANGE more rows than a picture
 *         holds; *out_picture untouched then
 */
nook_result nook_sheet_draw(const nook_sheet *sheet, nook_picture *out_picture);

#ifdef __cplusplus
}
#endif
