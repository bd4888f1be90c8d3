#include "game/measure/results.h"
#include "engine/core/log.h"
#include "game/measure/result_columns.h"
#include <stdlib.h>
#include <string.h>

/* ---- Finding ---------------------------------------------------------------------------------------------------- */

static bool same_text(const char *a, const char *b)
{
    return strcmp(a, b) == 0;
}

bool nook_result_row_same_site(const nook_result_row *a, const nook_result_row *b)
{
    return a->width == b->width && a->height == b->height && a->r_max == b->r_max && same_text(a->camera, b->camera) &&
           same_text(a->scene_hash, b->scene_hash) && same_text(a->falloff, b->falloff) &&
           same_text(a->machine, b->machine);
}

static bool same_row(const nook_result_row *a, const nook_result_row *b)
{
    return same_text(a->setting, b->setting) && nook_result_row_same_site(a, b);
}

static bool same_site(const nook_result_site *a, const nook_result_site *b)
{
    return a->width == b->width && a->height == b->height && a->r_max == b->r_max && same_text(a->camera, b->camera) &&
           same_text(a->scene_hash, b->scene_hash) && same_text(a->falloff, b->falloff);
}

const nook_result_row *nook_results_find(const nook_results *results, const nook_result_row *like)
{
    for (size_t i = 0; i < results->row_count; i++) {
        if (same_row(&results->rows[i], like))
            return &results->rows[i];
    }
    return NULL;
}

const nook_result_site *nook_results_find_site(const nook_results *results, const nook_result_site *like)
{
    for (size_t i = 0; i < results->site_count; i++) {
        if (same_site(&results->sites[i], like))
            return &results->sites[i];
    }
    return NULL;
}

/* ---- Adding ----------------------------------------------------------------------------------------------------- */

/* A copy with texts of its own. @param out  record_size bytes; zero on failure */
static nook_result copy(const nook_result_column *columns, size_t count, const void *record, size_t record_size,
                        void *out)
{
    bool whole = true;
    memcpy(out, record, record_size);
    for (size_t i = 0; i < count; i++) {
        char **text = (char **)(void *)((char *)out + columns[i].offset);
        if (columns[i].kind != NOOK_RESULT_TEXT)
            continue;
        *text = strdup(*text);
        whole = whole && *text;
    }
    if (whole)
        return NOOK_OK;
    nook_result_clear(columns, count, out, record_size);
    return nook_fail(NOOK_E_MEMORY, "no memory for the results");
}

/* Makes room for one more at the end. @return NOOK_E_MEMORY; untouched then */
static nook_result grow(void **items, size_t count, size_t *capacity, size_t item_size)
{
    if (count < *capacity)
        return NOOK_OK;
    size_t more = *capacity ? 2 * *capacity : 64;
    void *grown = realloc(*items, more * item_size);
    if (!grown)
        return nook_fail(NOOK_E_MEMORY, "no memory for %zu results", more);
    *items = grown;
    *capacity = more;
    return NOOK_OK;
}

nook_result nook_results_put(nook_results *results, const nook_result_row *row)
{
    size_t count;
    const nook_result_column *columns = nook_result_row_columns(&count);
    nook_result_row own;
    void *rows = results->rows;
    nook_result result = grow(&rows, results->row_count, &results->row_capacity, sizeof own);
    results->rows = rows;
    if (result == NOOK_OK)
        result = copy(columns, count, row, sizeof *row, &own);
    if (result != NOOK_OK)
        return result;
    own.sample.visibility = (nook_grey){ 0 };
    nook_result_row *place = (nook_result_row *)nook_results_find(results, row);
    if (place)
        nook_result_clear(columns, count, place, sizeof *place);
    else
        place = &results->rows[results->row_count++];
    *place = own;
    return NOOK_OK;
}

nook_result nook_results_put_site(nook_results *results, const nook_result_site *site)
{
    size_t count;
    const nook_result_column *columns = nook_result_site_columns(&count);
    nook_result_site own;
    void *sites = results->sites;
    nook_result result = grow(&sites, results->site_count, &results->site_capacity, sizeof own);
    results->sites = sites;
    if (result == NOOK_OK)
        result = copy(columns, count, site, sizeof *site, &own);
    if (result != NOOK_OK)
        return result;
    nook_result_site *place = (nook_result_site *)nook_results_find_site(results, site);
    if (place)
        nook_result_clear(columns, count, place, sizeof *place);
    else
        place = &results->sites[results->site_count++];
    *place = own;
    return NOOK_OK;
}

void nook_results_free(nook_results *results)
{
    size_t row_columns, site_columns;
    const nook_result_column *of_row = nook_result_row_columns(&row_columns);
    const nook_result_column *of_site = nook_result_site_columns(&site_columns);
    for (size_t i = 0; i < results->row_count; i++)
        nook_result_clear(of_row, row_columns, &results->rows[i], sizeof results->rows[i]);
    for (size_t i = 0; i < results->site_count; i++)
        nook_result_clear(of_site, site_columns, &results->sites[i], sizeof results->sites[i]);
    free(results->rows);
    free(results->sites);
    *results = (nook_results){ 0 };
}
