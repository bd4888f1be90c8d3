#include "game/extremes/extreme_run.h"
#include "engine/core/clock.h"
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/** strcasestr, which is no part of C. */
static bool holds_text(const char *text, const char *part)
{
    size_t size = strlen(part);
    for (; *text; text++) {
        size_t i = 0;
        while (i < size && tolower((unsigned char)text[i]) == tolower((unsigned char)part[i]))
            i++;
        if (i == size)
            return true;
    }
    return size == 0;
}

/** A group's whole name means that group, and not what else speaks of "space" or "volumes". */
static bool names_group(const char *only)
{
    size_t count;
    const nook_extreme_group *const *groups = nook_extreme_groups(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(groups[i]->name, only) == 0)
            return true;
    }
    return false;
}

bool nook_extreme_matches(const nook_extreme_group *group, const nook_extreme *extreme, const char *only)
{
    if (only && names_group(only))
        return strcmp(group->name, only) == 0;
    return !only || holds_text(group->name, only) || holds_text(extreme->name, only);
}

size_t nook_extreme_count(const char *only)
{
    size_t count, matching = 0;
    const nook_extreme_group *const *groups = nook_extreme_groups(&count);
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < groups[i]->count; k++)
            matching += nook_extreme_matches(groups[i], &groups[i]->cases[k], only);
    }
    return matching;
}

bool nook_extreme_row_holds(const nook_extreme_row *row)
{
    bool says_so =
        !row->extreme->limit || row->found.stated_count > 0; /* a limit without a number that was measured is none */
    return row->result == NOOK_OK && says_so && nook_extreme_holds(&row->found);
}

void nook_extreme_run(const nook_extremes *extremes, const nook_extreme_group *group, const nook_extreme *extreme,
                      nook_extreme_row *out_row)
{
    double before = nook_clock_ms();
    *out_row = (nook_extreme_row){ .group = group, .extreme = extreme };
    nook_gpu_check(extremes->gpu, "what was done before the case"); /* is not the case's */
    out_row->result = extreme->run(extremes, &out_row->found);
    if (nook_gpu_check(extremes->gpu, extreme->name) && out_row->result == NOOK_OK)
        out_row->result = NOOK_E_DEVICE; /* the check has logged what it was */
    out_row->ms = nook_clock_ms() - before;
}

nook_result nook_extreme_run_all(const nook_extremes *extremes, const char *only,
                                 void (*begin)(void *user, const nook_extreme_group *, const nook_extreme *),
                                 void (*end)(void *user, const nook_extreme_row *), void *user,
                                 nook_extreme_rows *out_rows)
{
    size_t count, matching = nook_extreme_count(only);
    const nook_extreme_group *const *groups = nook_extreme_groups(&count);
    nook_extreme_rows rows = { .rows = calloc(matching ? matching : 1, sizeof *rows.rows) };
    if (!rows.rows)
        return nook_fail(NOOK_E_MEMORY, "extremes: no memory for %zu rows", matching);
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < groups[i]->count; k++) {
            const nook_extreme *extreme = &groups[i]->cases[k];
            if (!nook_extreme_matches(groups[i], extreme, only))
                continue;
            if (begin)
                begin(user, groups[i], extreme);
            nook_extreme_run(extremes, groups[i], extreme, &rows.rows[rows.count++]);
            if (end)
                end(user, &rows.rows[rows.count - 1]);
        }
    }
    *out_rows = rows;
    return NOOK_OK;
}

void nook_extreme_rows_free(nook_extreme_rows *rows)
{
    free(rows->rows);
    *rows = (nook_extreme_rows){ 0 };
}

nook_extreme_summary nook_extreme_summarize(const nook_extreme_rows *rows)
{
    nook_extreme_summary sum = { .cases = rows->count };
    for (size_t i = 0; i < rows->count; i++) {
        const nook_extreme_row *row = &rows->rows[i];
        bool holds = nook_extreme_row_holds(row);
        sum.groups += i == 0 || row->group != rows->rows[i - 1].group;
        sum.holding += holds;
        sum.failing += !holds;
        sum.limits += row->extreme->limit != NULL;
        sum.checked += row->found.checked;
        sum.outside += row->found.outside;
        sum.seconds += row->ms * 1e-3;
    }
    return sum;
}
