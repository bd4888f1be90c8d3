/**
 * tune_report.h - what `tune` found: as text, as JSON, and as the settings file.
 */
#pragma once
#include "game/tune/tune_run.h"
#include <stdio.h>

/** Writes the settings file, with what it was found by and what it does in comments. @return NOOK_E_IO, NOOK_E_MEMORY */
nook_result nook_tune_report_write(const nook_tune_result *result, const nook_tune_options *options,
                                   const nook_stage *stage);

/** The last line is the summary in numbers. */
void nook_tune_report_print(const nook_tune_result *result, const nook_tune_options *options, FILE *stream);

/** @return NOOK_E_MEMORY, NOOK_E_IO */
nook_result nook_tune_report_print_json(const nook_tune_result *result, const nook_tune_options *options,
                                        const nook_stage *stage, FILE *stream);
