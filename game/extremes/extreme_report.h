/** extreme_report.h - what the extreme cases found, as a table and as JSON. */
#pragma once
#include "engine/core/json.h"
#include "game/extremes/extreme_run.h"
#include <stdio.h>

/** The table's head, and one line a case under its group's name: what must hold, numbers, verdict, where. */
void nook_extreme_print_head(FILE *stream);
/** @param first_of_group  prints the group's name before it */
void nook_extreme_print_row(FILE *stream, const nook_extreme_row *row, bool first_of_group);
/** The last line: the summary in numbers. */
void nook_extreme_print_summary(FILE *stream, const nook_extreme_rows *rows);

/** Every case that matches `only` with its unit, why its bound, and its limit; runs nothing. */
void nook_extreme_print_list(FILE *stream, const char *only);

/** The whole run as one object: machine, rows with all texts, summary. `json` starts as zero. @param renderer  of the GPU */
void nook_extreme_write_json(nook_json *json, const nook_extreme_rows *rows, const char *renderer, bool quick);
