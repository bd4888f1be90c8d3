#include "game/extremes/extreme_report.h"
#include <string.h>

/** "holds", "FAILS", or "limit" for what holds up to a stated boundary. */
static const char *verdict(const nook_extreme_row *row)
{
    if (row->result != NOOK_OK)
        return "ERROR";
    if (!nook_extreme_row_holds(row))
        return "FAILS";
    return row->extreme->limit ? "limit" : "holds";
}

void nook_extreme_print_head(FILE *stream)
{
    fprintf(stream, "%-92s %10s %10s  %-22s %-7s %s\n", "what must hold", "measured", "bound", "unit", "verdict",
            "where");
}

void nook_extreme_print_row(FILE *stream, const nook_extreme_row *row, bool first_of_group)
{
    if (first_of_group)
        fprintf(stream, "%s\n", row->group->name);
    fprintf(stream, "  %-90s", row->extreme->name);
    if (row->result == NOOK_OK)
        fprintf(stream, " %10.3g %10.3g", row->found.measured, row->found.bound);
    else
        fprintf(stream, " %10s %10s", "-", "-");
    fprintf(stream, "  %-22s %-7s %s", row->extreme->unit, verdict(row), row->found.where);
    if (row->found.outside > 0)
        fprintf(stream, " (%llu of %llu visibilities outside [0, 1])", (unsigned long long)row->found.outside,
                (unsigned long long)row->found.checked);
    fputc('\n', stream);
    for (size_t i = 0; i < row->found.stated_count && row->result == NOOK_OK; i++) {
        const nook_extreme_stated *stated = &row->found.stated[i];
        fprintf(stream, "    limit: %-81s %10.4g %10.4g  within %-15.3g %s\n", stated->what, stated->measured,
                stated->stated, stated->tolerance, nook_extreme_stated_holds(stated) ? "as stated" : "NOT AS STATED");
    }
}

void nook_extreme_print_summary(FILE *stream, const nook_extreme_rows *rows)
{
    nook_extreme_summary sum = nook_extreme_summarize(rows);
    fprintf(stream,
            "%zu cases in %zu groups: %zu hold, %zu do not; %zu state a limit; %llu of %llu visibilities outside "
            "[0, 1]; %.0f s\n",
            sum.cases, sum.groups, sum.holding, sum.failing, sum.limits, (unsigned long long)sum.outside,
            (unsigned long long)sum.checked, sum.seconds);
}

void nook_extreme_print_list(FILE *stream, const char *only)
{
    size_t count;
    const nook_extreme_group *const *groups = nook_extreme_groups(&count);
    for (size_t i = 0; i < count; i++) {
        bool named = false;
        for (size_t k = 0; k < groups[i]->count; k++) {
            const nook_extreme *extreme = &groups[i]->cases[k];
            if (!nook_extreme_matches(groups[i], extreme, only))
                continue;
            if (!named)
                fprintf(stream, "%s\n", groups[i]->name);
            named = true;
            fprintf(stream, "  %s [%s]\n      %s\n", extreme->name, extreme->unit, extreme->why);
            if (extreme->limit)
                fprintf(stream, "      limit: %s\n", extreme->limit);
        }
    }
    fprintf(stream, "%zu cases\n", nook_extreme_count(only));
}

static void write_stated(nook_json *json, const nook_extreme_found *found)
{
    nook_json_key(json, "stated");
    nook_json_begin_array(json);
    for (size_t i = 0; i < found->stated_count; i++) {
        const nook_extreme_stated *stated = &found->stated[i];
        nook_json_begin_object(json);
        nook_json_member_string(json, "what", stated->what);
        nook_json_member_number(json, "stated", stated->stated);
        nook_json_member_number(json, "tolerance", stated->tolerance);
        nook_json_member_number(json, "measured", stated->measured);
        nook_json_member_bool(json, "holds", nook_extreme_stated_holds(stated));
        nook_json_end_object(json);
    }
    nook_json_end_array(json);
}

static void write_row(nook_json *json, const nook_extreme_row *row)
{
    const nook_extreme_found *found = &row->found;
    nook_json_begin_object(json);
    nook_json_member_string(json, "group", row->group->name);
    nook_json_member_string(json, "name", row->extreme->name);
    nook_json_member_string(json, "unit", row->extreme->unit);
    nook_json_member_string(json, "why", row->extreme->why);
    nook_json_member_string(json, "limit", row->extreme->limit);
    nook_json_member_bool(json, "ran", row->result == NOOK_OK);
    nook_json_member_bool(json, "holds", nook_extreme_row_holds(row));
    nook_json_member_number(json, "measured", found->measured);
    nook_json_member_number(json, "bound", found->bound);
    nook_json_member_integer(json, "visibilities", (int64_t)found->checked);
    nook_json_member_integer(json, "outside", (int64_t)found->outside);
    nook_json_member_string(json, "where", found->where);
    write_stated(json, found);
    nook_json_member_number(json, "ms", row->ms);
    nook_json_end_object(json);
}

void nook_extreme_write_json(nook_json *json, const nook_extreme_rows *rows, const char *renderer, bool quick)
{
    nook_extreme_summary sum = nook_extreme_summarize(rows);
    nook_json_begin_object(json);
    nook_json_member_string(json, "renderer", renderer);
    nook_json_member_bool(json, "quick", quick);
    nook_json_key(json, "cases");
    nook_json_begin_array(json);
    for (size_t i = 0; i < rows->count; i++)
        write_row(json, &rows->rows[i]);
    nook_json_end_array(json);
    nook_json_member_integer(json, "holding", (int64_t)sum.holding);
    nook_json_member_integer(json, "failing", (int64_t)sum.failing);
    nook_json_member_integer(json, "limits", (int64_t)sum.limits);
    nook_json_member_integer(json, "visibilities", (int64_t)sum.checked);
    nook_json_member_integer(json, "outside", (int64_t)sum.outside);
    nook_json_member_number(json, "seconds", sum.seconds);
    nook_json_end_object(json);
}
