#pragma once
#include "game/compare/run.h"
#include <stdio.h>

/** What a report says beside the measurements. */
typedef struct nook_report {
    const nook_comparison *comparison;
    const nook_stage *stage;
    const char *scene_path; /**< As it was given. */
    const char *out;        /**< The folder. */
} nook_report;

/**
 * Writes every picture and compare.json, all of them or none; pictures of the run before that this one has not are removed.
 * Told to end (Ctrl-C) it leaves the folder as it was.
 * @return NOOK_E_IO, NOOK_E_MEMORY, NOOK_E_NOT_FOUND
 */
nook_result nook_report_write(const nook_report *report);

/** compare.json. @param out_text  owned by the caller, release with free() @return NOOK_E_MEMORY */
nook_result nook_report_json(const nook_report *report, char **out_text, size_t *out_size);

/** compare.png. @return as nook_sheet_draw */
nook_result nook_report_sheet(const nook_report *report, const nook_picture *errors, const nook_picture *greys,
                              nook_picture *out_picture);

void nook_report_print_table(const nook_report *report, FILE *stream);

/** A parameter's value as text: a number, or the choice's name. @param name  "technique.name" @return out */
const char *nook_report_param(const nook_ao *ao, const char *technique, const nook_param *param, char *out,
                              size_t capacity);
