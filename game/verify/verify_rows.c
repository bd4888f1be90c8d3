#include "game/verify/verify_rows.h"
#include "engine/core/log.h"
#include <math.h>
#include <stdlib.h>

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

/** Error in parts of the tolerance; a tolerance of 0 asks for equality. */
static double strain(const nook_verify_row *row)
{
    double error = fabs(row->check.measured - row->check.expected);
    if (isnan(error) || row->outside)
        return INFINITY;
    return error == 0.0 ? 0.0 : error / row->check.tolerance;
}

nook_verify_summary nook_verify_summarize(const nook_verify_rows *rows)
{
    nook_verify_summary sum = { 0 };
    for (size_t i = 0; i < rows->count; i++) {
        const nook_verify_row *row = &rows->rows[i];
        sum.verdicts[row->verdict]++;
        sum.outside += row->outside;
        if (row->verdict != NOOK_VERDICT_OK && row->verdict != NOOK_VERDICT_OFF)
            continue;
        sum.checks++;
        sum.largest_error = fmax(sum.largest_error, fabs(row->check.measured - row->check.expected));
        if (!sum.worst || strain(row) > strain(sum.worst))
            sum.worst = row;
    }
    return sum;
}
