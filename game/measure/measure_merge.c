#include "game/measure/measure_merge.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/measure/result_columns.h"
#include <stdio.h>
#include <string.h>

/* In the place of an older one, which belongs to numbers that do not count any more. A picture that is not there is done without. */
static nook_result copy_picture(const char *from, const char *folder, const char *path)
{
    char source[4096], target[4096], parent[4096];
    nook_file file;
    nook_path_join(source, sizeof source, from, path);
    nook_path_join(target, sizeof target, folder, path);
    if (path[0] == '\0' || !nook_file_exists(source))
        return NOOK_OK;
    snprintf(parent, sizeof parent, "%.*s", (int)(nook_path_name(target) - target), target);
    nook_result result = nook_directory_make(parent);
    if (result == NOOK_OK)
        result = nook_file_read(source, &file);
    if (result != NOOK_OK)
        return result;
    result = nook_file_write(target, file.bytes, file.size);
    nook_file_free(&file);
    return result;
}

static nook_result take_row(const nook_result_row *row, const char *from, const char *folder, nook_results *results,
                            nook_journal *journal)
{
    nook_result result = copy_picture(from, folder, row->picture);
    if (result == NOOK_OK)
        result = nook_journal_append(journal, row);
    return result == NOOK_OK ? nook_results_put(results, row) : result;
}

static nook_result take_site(const nook_result_site *site, const char *from, const char *folder, nook_results *results,
                             nook_journal *journal)
{
    const char *const pictures[] = { site->truth, site->screen, site->geometry, site->lit };
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < NOOK_COUNT(pictures) && result == NOOK_OK; i++)
        result = copy_picture(from, folder, pictures[i]);
    if (result == NOOK_OK)
        result = nook_journal_append_site(journal, site);
    return result == NOOK_OK ? nook_results_put_site(results, site) : result;
}

static bool is_wanted(const nook_results *results, const nook_result_row *row, const char *build)
{
    const nook_result_row *ours = nook_results_find(results, row);
    return !ours || (strcmp(ours->build, build) != 0 && strcmp(row->build, build) == 0);
}

nook_result nook_measure_merge(const char *from, const char *folder, const char *build, nook_results *results,
                               nook_journal *journal, size_t *out_taken, size_t *out_left)
{
    char path[4096];
    nook_results others;
    size_t taken = 0, left = 0;
    if (!nook_file_exists(nook_path_join(path, sizeof path, from, NOOK_JOURNAL_NAME)))
        return nook_fail(NOOK_E_NOT_FOUND, "%s: nothing was measured into it; give a folder with %s", from,
                         NOOK_JOURNAL_NAME);
    nook_result result = nook_results_read(from, &others);
    if (result != NOOK_OK)
        return result;
    for (size_t i = 0; i < others.row_count && result == NOOK_OK; i++) {
        if (!is_wanted(results, &others.rows[i], build)) {
            left++;
            continue;
        }
        result = take_row(&others.rows[i], from, folder, results, journal);
        taken++;
    }
    for (size_t i = 0; i < others.site_count && result == NOOK_OK; i++) {
        if (!nook_results_find_site(results, &others.sites[i]))
            result = take_site(&others.sites[i], from, folder, results, journal);
    }
    nook_results_free(&others);
    if (result == NOOK_OK)
        *out_taken = taken, *out_left = left;
    return result;
}

size_t nook_measure_drop_other_builds(nook_results *results, const char *build)
{
    size_t columns_count, kept = 0, before = results->row_count;
    const nook_result_column *columns = nook_result_row_columns(&columns_count);
    for (size_t i = 0; i < before; i++) {
        if (strcmp(results->rows[i].build, build) == 0)
            results->rows[kept++] = results->rows[i];
        else
            nook_result_clear(columns, columns_count, &results->rows[i], sizeof results->rows[i]);
    }
    results->row_count = kept;
    return before - kept;
}
