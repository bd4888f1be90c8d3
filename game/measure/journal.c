#include "game/measure/journal.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/measure/measure_pictures.h"
#include "game/measure/result_columns.h"
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

/* ---- Reading ---------------------------------------------------------------------------------------------------- */

static nook_result read_row(const char *where, const nook_json_tree *tree, uint32_t object, nook_results *results)
{
    size_t count;
    const nook_result_column *columns = nook_result_row_columns(&count);
    nook_result_row row = { 0 };
    nook_result result = nook_result_read_json(where, tree, object, columns, count, &row);
    nook_errors *of_truth = &row.sample.truth, *of_screen = &row.sample.screen;
    of_truth->valid = of_truth->count > 0 && of_truth->non_finite == 0;
    of_screen->valid = of_screen->count > 0 && of_screen->non_finite == 0;
    row.sample.instability.valid = row.sample.instability.pixels > 0 && row.sample.instability.non_finite == 0;
    if (result == NOOK_OK)
        result = nook_results_put(results, &row);
    nook_result_clear(columns, count, &row, sizeof row);
    return result;
}

static nook_result read_site(const char *where, const nook_json_tree *tree, uint32_t object, nook_results *results)
{
    size_t count;
    const nook_result_column *columns = nook_result_site_columns(&count);
    nook_result_site site = { 0 };
    nook_result result = nook_result_read_json(where, tree, object, columns, count, &site);
    if (result == NOOK_OK)
        result = nook_results_put_site(results, &site);
    nook_result_clear(columns, count, &site, sizeof site);
    return result;
}

static nook_result read_line(const char *where, const char *text, size_t length, nook_results *results)
{
    nook_json_tree tree;
    nook_result result = nook_json_tree_read(where, text, length, 4, &tree);
    if (result != NOOK_OK)
        return result;
    uint32_t row = nook_json_tree_find(&tree, 0, "row"), site = nook_json_tree_find(&tree, 0, "site");
    if (row != NOOK_JSON_NONE)
        result = read_row(where, &tree, row, results);
    else if (site != NOOK_JSON_NONE)
        result = read_site(where, &tree, site, results);
    else
        result = nook_fail(NOOK_E_FORMAT, "%s: neither a row nor a site; take the line out", where);
    nook_json_tree_free(&tree);
    return result;
}

static nook_result read_lines(const char *path, const char *text, size_t size, nook_results *results)
{
    nook_result result = NOOK_OK;
    unsigned line = 0;
    for (size_t at = 0; at < size && result == NOOK_OK;) {
        char where[4096 + 32];
        const char *end = memchr(text + at, '\n', size - at);
        snprintf(where, sizeof where, "%s:%u", path, ++line);
        if (!end) {
            nook_log_warning("%s: a line cut short by an interruption; left out", where);
            return NOOK_OK;
        }
        size_t length = (size_t)(end - text) - at;
        result = read_line(where, text + at, length, results);
        at += length + 1;
    }
    return result;
}

/* Those that were removed after their row was written, and paths that lead out of the folder: it may be a foreign journal, and
   pictures are opened, copied and removed. */
static void forget_pictures(const char *folder, nook_results *results)
{
    for (size_t i = 0; i < results->row_count; i++) {
        char path[4096];
        nook_result_row *row = &results->rows[i];
        bool inside = nook_measure_picture_is_inside(row->picture);
        if (!inside || !nook_file_exists(nook_path_join(path, sizeof path, folder, row->picture)))
            row->picture[0] = '\0';
    }
    for (size_t i = 0; i < results->site_count; i++) {
        nook_result_site *site = &results->sites[i];
        char *const pictures[] = { site->truth, site->screen, site->geometry, site->lit };
        for (size_t k = 0; k < NOOK_COUNT(pictures); k++) {
            if (!nook_measure_picture_is_inside(pictures[k]))
                pictures[k][0] = '\0';
        }
    }
}

nook_result nook_results_read(const char *folder, nook_results *out_results)
{
    char path[4096];
    nook_file file;
    nook_results results = { 0 };
    nook_path_join(path, sizeof path, folder, NOOK_JOURNAL_NAME);
    if (!nook_file_exists(path)) {
        *out_results = results;
        return NOOK_OK;
    }
    nook_result result = nook_file_read(path, &file);
    if (result != NOOK_OK)
        return result;
    result = read_lines(path, (const char *)file.bytes, file.size, &results);
    nook_file_free(&file);
    forget_pictures(folder, &results);
    if (result == NOOK_OK)
        *out_results = results;
    else
        nook_results_free(&results);
    return result;
}

/* ---- Appending -------------------------------------------------------------------------------------------------- */

/* Where the last whole line ends; -1 when that cannot be told. */
static off_t find_end(int file)
{
    char block[4096];
    off_t end = lseek(file, 0, SEEK_END);
    while (end > 0) {
        size_t size = end < (off_t)sizeof block ? (size_t)end : sizeof block;
        if (pread(file, block, size, end - (off_t)size) != (ssize_t)size)
            return -1;
        for (size_t i = size; i > 0; i--) {
            if (block[i - 1] == '\n')
                return end - (off_t)(size - i);
        }
        end -= (off_t)size;
    }
    return end;
}

/* Takes away what an interruption left of a line. */
static nook_result cut_last_line(const nook_journal *journal)
{
    off_t size = lseek(journal->file, 0, SEEK_END), end = find_end(journal->file);
    if (end < 0 || (end < size && ftruncate(journal->file, end) != 0))
        return nook_fail(NOOK_E_IO, "%s: cannot be written: %s", journal->path, strerror(errno));
    if (end < size)
        nook_log_warning("%s: its last line was cut short by an interruption; left out", journal->path);
    return NOOK_OK;
}

nook_result nook_journal_open(const char *folder, nook_journal *out_journal)
{
    nook_journal journal = { .file = -1 };
    *out_journal = journal;
    nook_result result = nook_directory_make(folder);
    if (result != NOOK_OK)
        return result;
    nook_path_join(journal.path, sizeof journal.path, folder, NOOK_JOURNAL_NAME);
    journal.file = open(journal.path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (journal.file < 0)
        return nook_fail(NOOK_E_IO, "%s: cannot open: %s", journal.path, strerror(errno));
    if (flock(journal.file, LOCK_EX | LOCK_NB) != 0) {
        close(journal.file);
        return nook_fail(NOOK_E_IO,
                         "%s: another measurement writes there; give another --out and join them with --merge",
                         journal.path);
    }
    result = cut_last_line(&journal);
    if (result != NOOK_OK) {
        close(journal.file);
        return result;
    }
    *out_journal = journal;
    return NOOK_OK;
}

void nook_journal_close(nook_journal *journal)
{
    if (journal->file >= 0)
        close(journal->file);
    journal->file = -1;
}

/* The writer's indented text as one line: a line end inside it stands between two values, never in a text. */
static size_t join_lines(const char *text, size_t size, char *out)
{
    size_t used = 0;
    for (size_t i = 0; i < size; i++) {
        if (text[i] != '\n') {
            out[used++] = text[i];
            continue;
        }
        while (i + 1 < size && text[i + 1] == ' ')
            i++;
    }
    out[used++] = '\n';
    return used;
}

/* Whole or not at all: half a line with another behind it would make the whole folder unreadable. */
static nook_result write_line(nook_journal *journal, const char *line, size_t length)
{
    off_t end = lseek(journal->file, 0, SEEK_END);
    errno = 0;
    if (end >= 0 && write(journal->file, line, length) == (ssize_t)length)
        return NOOK_OK;
    const char *reason = errno ? strerror(errno) : "the disk is full";
    if (end >= 0 && ftruncate(journal->file, end) != 0)
        nook_log_warning("%s: its last line is cut short, and cannot be cut away", journal->path);
    nook_journal_close(journal); /* nothing may be written behind it */
    return nook_fail(NOOK_E_IO, "%s: cannot write: %s; make room and give the same command again", journal->path,
                     reason);
}

static nook_result append(nook_journal *journal, const char *key, const nook_result_column *columns, size_t count,
                          const void *record)
{
    nook_json json = { 0 };
    const char *text;
    size_t size;
    char *line = NULL;
    if (journal->file < 0)
        return nook_fail(NOOK_E_IO, "%s: cannot be written any more", journal->path);
    nook_json_begin_object(&json);
    nook_json_key(&json, key);
    nook_result_write_json(&json, columns, count, record);
    nook_json_end_object(&json);
    nook_result result = nook_json_finish(&json, &text, &size);
    if (result == NOOK_OK && !(line = malloc(size + 1)))
        result = nook_fail(NOOK_E_MEMORY, "no memory for a line of %s", journal->path);
    if (result == NOOK_OK) {
        result = write_line(journal, line, join_lines(text, size, line));
    }
    free(line);
    nook_json_free(&json);
    return result;
}

nook_result nook_journal_append(nook_journal *journal, const nook_result_row *row)
{
    size_t count;
    const nook_result_column *columns = nook_result_row_columns(&count);
    return append(journal, "row", columns, count, row);
}

nook_result nook_journal_append_site(nook_journal *journal, const nook_result_site *site)
{
    size_t count;
    const nook_result_column *columns = nook_result_site_columns(&count);
    return append(journal, "site", columns, count, site);
}
