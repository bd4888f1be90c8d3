#pragma once
#include "game/measure/results.h"

/**
 * Writes report.html: one file that needs no other and no network. Made from game/measure/report/ (template, style, script) with the
 * results as JSON and the pictures as data inside.
 * @param root    folder of the program's data
 * @param folder  that of the results; pictures are read from it, the report is written into it, whole or not at all
 * @return NOOK_E_IO, NOOK_E_MEMORY, NOOK_E_NOT_FOUND a part of the template is missing
 */
nook_result nook_report_html_write(const char *root, const nook_results *results, const char *folder,
                                   const char *command);

/** Whether the tables can be put into a document. @return as nook_report_document_write */
nook_result nook_report_document_check(const char *path);

/**
 * Puts the tables into a document between the lines "<!-- measured: begin -->" and "<!-- measured: end -->"; the rest of it stays.
 * @return NOOK_E_FORMAT no such lines, NOOK_E_IO; the document is as it was then
 */
nook_result nook_report_document_write(const nook_results *results, const char *command, const char *path);
