/** Parts of report.html, each written where it stands in the file. Failures to write are the stream's, which is asked once at the end. */
#pragma once
#include "game/measure/results.h"
#include <stdio.h>

/** Text for HTML, in elements and in quoted attributes. */
void nook_report_put_html(FILE *out, const char *text);

/**
 * The results as JSON that may stand inside a script element: '<' and the two line ends that JavaScript knows and JSON does not
 * are written as escapes.
 * @return NOOK_E_MEMORY
 */
nook_result nook_report_put_data(FILE *out, const nook_results *results, const char *command);

/**
 * The pictures as base64, each in a script element of its own, so that a browser decodes only what is looked at. What is missing is
 * left out, with one line that says so. Truths first, then initial settings, those on a front, and the rest, as far as
 * NOOK_REPORT_PICTURES_MAX goes.
 * @return NOOK_E_MEMORY
 */
nook_result nook_report_put_pictures(FILE *out, const nook_results *results, const char *folder);

/** Bytes of PNG that a report holds at most: twice that opens slowly. */
#define NOOK_REPORT_PICTURES_MAX ((size_t)48 << 20)
