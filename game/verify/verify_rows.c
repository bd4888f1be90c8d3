#include "game/verify/verify_rows.h"
#include "engine/core/log.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

nook_result nook_verify_rows_add(nook_verify_rows *rows, const nook_verify_row *row)
{
    if (rows->count == rows->capacity) {
        size_t wanted = rows->capacity ? rows->capacity * 2 : 64;
        nook_verify_row *grown = realloc(rows->rows, wanted * sizeof *grown);
        if (!grown)
            return nook_fail(NOOK_E_MEMORY, "verify: no room for %zu rows", wanted);
        rows->rows = grown, rows->capacity = wanted;
    }
    nook_verify_row *added = &rows->rows[rows->count++];
    *added = *row;
    added->verdict = row->outside ? NOOK_VERDICT_OFF : nook_verify_judge(&row->check);
    if (rows->listener.row)
        rows->listener.row(rows->listener.user, added);
    return NOOK_OK;
}

void nook_verify_rows_free(nook_verify_rows *rows)
{
    free(rows->rows);
    *rows = (nook_verify_rows){ 0 };
}

/** In parts of the bound; a bound of 0 asks for equality. */
static double part_of(double error, double bound)
{
    return error == 0.0 ? 0.0 : error / bound;
}

/** Error or spread, whichever is nearer to its bound. */
static double strain(const nook_verify_row *row)
{
    const nook_verify_check *check = &row->check;
    double error = fabs(check->measured - check->expected);
    if (isnan(error) || isnan(check->spread) || row->outside)
        return INFINITY;
    return fmax(part_of(error, check->tolerance), part_of(check->spread, check->spread_max));
}

nook_verify_summary nook_verify_summarize(const nook_verify_rows *rows)
{
    nook_verify_summary sum = { 0 };
    for (size_t i = 0; i < rows->count; i++) {
        const nook_verify_row *row = &rows->rows[i];
        sum.verdicts[row->verdict]++;
        sum.outside += row->outside;
        if (!nook_verify_is_checked(row->verdict))
            continue;
        sum.checks++;
        sum.largest_error = fmax(sum.largest_error, fabs(row->check.measured - row->check.expected));
        if (!sum.worst || strain(row) > strain(sum.worst))
            sum.worst = row;
    }
    return sum;
}

/** That of a row, a new one when there is room; NULL. */
static nook_verify_tally *find_tally(const nook_verify_row *row, nook_verify_tally *tallies, size_t capacity,
                                     size_t *count)
{
    bool by_screen = row->camera && isnan(row->initial);
    for (size_t i = 0; i < *count; i++) {
        if (strcmp(tallies[i].technique, row->technique) == 0 && tallies[i].by_screen == by_screen)
            return &tallies[i];
    }
    if (*count == capacity)
        return NULL;
    tallies[*count] = (nook_verify_tally){ .technique = row->technique, .by_screen = by_screen };
    return &tallies[(*count)++];
}

size_t nook_verify_tally_techniques(const nook_verify_rows *rows, nook_verify_tally *tallies, size_t capacity)
{
    size_t count = 0;
    for (size_t i = 0; i < rows->count; i++) {
        const nook_verify_row *row = &rows->rows[i];
        nook_verify_tally *tally = NULL;
        if (row->number <= 17 && nook_verify_is_checked(row->verdict))
            tally = find_tally(row, tallies, capacity, &count);
        if (!tally)
            continue;
        double error = row->check.measured - row->check.expected, initial = row->initial - row->check.expected;
        if (!tally->where || fabs(error) > fabs(tally->largest))
            tally->largest = error, tally->where = row->fixture;
        tally->checks++;
        tally->bias += error, tally->rmse += error * error, tally->spread += row->check.spread * row->check.spread;
        tally->initial_bias += initial, tally->initial_rmse += initial * initial;
    }
    for (size_t i = 0; i < count; i++) {
        double checks = (double)tallies[i].checks;
        tallies[i].bias /= checks, tallies[i].initial_bias /= checks;
        tallies[i].rmse = sqrt(tallies[i].rmse / checks);
        tallies[i].spread = sqrt(tallies[i].spread / checks);
        tallies[i].initial_rmse = sqrt(tallies[i].initial_rmse / checks);
    }
    return count;
}
