/**
 * journal.h - the one state of a measurement: a file of JSON lines in its folder, appended to row by row.
 *
 * A line is {"row": {...}} or {"site": {...}}; of two lines of one row (or site) the later counts.
 */
#pragma once
#include "game/measure/results.h"

#define NOOK_JOURNAL_NAME "journal.jsonl"

typedef struct nook_journal {
    int file; /**< Descriptor, locked; -1: closed. */
    char path[4096];
} nook_journal;

/**
 * Opens it for appending, and makes folder and file where there are none. A line cut short is cut away.
 * @return NOOK_E_IO, also when another process has it open; *out_journal is closed then
 */
nook_result nook_journal_open(const char *folder, nook_journal *out_journal);
void nook_journal_close(nook_journal *journal); /**< Closed ones are allowed. */

/** Writes one line, at once. Where that fails, the file is as it was and the journal closed: there is no use in measuring on. @return NOOK_E_IO, NOOK_E_MEMORY */
nook_result nook_journal_append(nook_journal *journal, const nook_result_row *row);
nook_result nook_journal_append_site(nook_journal *journal, const nook_result_site *site);
