/** verify_report.h - the rows of verify as a table and as JSON. */
#pragma once
#include "engine/core/json.h"
#include "game/verify/verify_rows.h"
#include <stdio.h>

void nook_verify_print_head(FILE *stream);
/** @param before  the row above it, whose fixture's heading need not be repeated; NULL for the first */
void nook_verify_print_row(FILE *stream, const nook_verify_row *row, const nook_verify_row *before);
/** The claims, settings and reasons behind the rows, each once. */
void nook_verify_print_notes(FILE *stream, const nook_verify_rows *rows);
/** The last line. */
void nook_verify_print_summary(FILE *stream, const nook_verify_rows *rows, double seconds);

/** Everything as one object. `json` starts as zero. @param renderer  of the GPU */
void nook_verify_write_json(nook_json *json, const nook_verify_rows *rows, const char *renderer, double seconds);
