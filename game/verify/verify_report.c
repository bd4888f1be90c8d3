#include "game/verify/verify_report.h"
#include "game/verify/claims.h"
#include <math.h>
#include <string.h>

enum { TALLIES = 16 };

void nook_verify_print_head(FILE *stream)
{
    fprintf(stream, "%-42s %-10s %-9s %-17s %8s %8s %8s %8s %8s %6s  %s\n", "  fixture", "technique", "camera",
            "target", "expected", "initial", "measured", "error", "spread", "within", "verdict");
}

static void print_number(FILE *stream, const char *format, double value)
{
    char text[32];
    snprintf(text, sizeof text, format, value);
    fprintf(stream, " %8s", isnan(value) ? "-" : text);
}

/** What a reader must know beside the verdict. */
static void print_remark(FILE *stream, const nook_verify_row *row)
{
    const nook_verify_check *check = &row->check;
    if (row->verdict == NOOK_VERDICT_UNSEEN)
        fprintf(stream, ": the depth buffer lacks %.4f of A", check->missing);
    else if (row->verdict == NOOK_VERDICT_UNRESOLVED)
        fprintf(stream, ": pixels leave %.4f of A open", check->unresolved);
    else if (row->verdict == NOOK_VERDICT_NOT_CLAIMED)
        fprintf(stream, ": %s", row->reason);
    else if (strncmp(row->target, "own", 3) == 0 && !isnan(row->equation_1))
        fprintf(stream, ", %+.4f to Eq. 1", check->measured - row->equation_1);
    if (row->outside)
        fprintf(stream, ", %llu visibilities outside [0, 1]", (unsigned long long)row->outside);
}

void nook_verify_print_row(FILE *stream, const nook_verify_row *row, const nook_verify_row *before)
{
    const nook_verify_check *check = &row->check;
    if (!before || strcmp(before->what, row->what) != 0)
        fprintf(stream, "%d %s: %s\n", row->number, row->fixture, row->what);
    fprintf(stream, "  %-40s %-10s %-9s %-17s", row->point, row->technique, row->camera ? row->camera : "-",
            row->target);
    print_number(stream, "%.4f", check->expected);
    print_number(stream, "%.4f", row->initial);
    print_number(stream, "%.4f", check->measured);
    print_number(stream, "%+.4f", check->measured - check->expected);
    print_number(stream, "%.4f", nook_verify_is_checked(row->verdict) ? check->spread : row->deviation);
    if (check->claimed)
        fprintf(stream, " %6.3g", check->tolerance);
    else
        fprintf(stream, " %6s", "-");
    fprintf(stream, "  %s", nook_verdict_name(row->verdict));
    print_remark(stream, row);
    fputc('\n', stream);
}

/** Whether an earlier row of the same technique has the same settings. */
static bool said_before(const nook_verify_rows *rows, size_t index)
{
    const nook_verify_row *row = &rows->rows[index];
    for (size_t i = 0; i < index; i++) {
        if (strcmp(rows->rows[i].technique, row->technique) == 0 && strcmp(rows->rows[i].settings, row->settings) == 0)
            return true;
    }
    return false;
}

/** What is judged at other settings than the rest of the technique's rows, and what it gives as it comes. */
static void print_exceptions(FILE *stream, const nook_verify_rows *rows)
{
    bool begun = false;
    for (size_t i = 0; i < rows->count; i++) {
        const nook_verify_row *row = &rows->rows[i];
        if (!row->reason || !nook_verify_is_checked(row->verdict))
            continue;
        fprintf(stream, "%s  %s, %s, %s: %.4f for %.4f, initially %.4f: %s\n", begun ? "" : "\nexceptions\n",
                row->technique, row->fixture, row->point, row->check.measured, row->check.expected, row->initial,
                row->reason);
        begun = true;
    }
}

static void print_tallies(FILE *stream, const nook_verify_rows *rows)
{
    nook_verify_tally tallies[TALLIES];
    size_t count = nook_verify_tally_techniques(rows, tallies, TALLIES);
    if (count > 0)
        fprintf(stream, "\n%-24s %6s %8s %8s %8s %13s %13s %13s\n", "rows 1 to 17", "checks", "bias", "RMSE", "spread",
                "initial: bias", "RMSE", "largest error");
    for (size_t i = 0; i < count; i++) {
        const nook_verify_tally *t = &tallies[i];
        char name[64];
        snprintf(name, sizeof name, "%s%s", t->technique, t->by_screen ? ", sees=screen" : "");
        fprintf(stream, "  %-22s %6zu %+8.4f %8.4f %8.4f", name, t->checks, t->bias, t->rmse, t->spread);
        if (isnan(t->initial_bias))
            fprintf(stream, " %13s %13s", "-", "-");
        else
            fprintf(stream, " %+13.4f %13.4f", t->initial_bias, t->initial_rmse);
        fprintf(stream, " %+13.4f, %s\n", t->largest, t->where);
    }
}

void nook_verify_print_notes(FILE *stream, const nook_verify_rows *rows)
{
    fprintf(stream, "\nsettings of what is measured; those of what is initial are the technique's own\n");
    for (size_t i = 0; i < rows->count; i++) {
        const nook_verify_row *row = &rows->rows[i];
        if (row->number > 17 || said_before(rows, i)) /* rows 18 to 20 name theirs in the table */
            continue;
        const nook_verify_claim *claim = nook_verify_claim_of(row->technique);
        fprintf(stream, "  %-78s %s\n", row->settings,
                row->reason && row->check.claimed ? row->reason
                : claim                           ? claim->says
                                                  : "claims nothing");
    }
    print_exceptions(stream, rows);
    print_tallies(stream, rows);
}

void nook_verify_print_summary(FILE *stream, const nook_verify_rows *rows, double seconds)
{
    nook_verify_summary sum = nook_verify_summarize(rows);
    fprintf(stream, "\n%zu of %zu checks hold; %zu unseen, %zu unresolved, %zu not claimed; largest error %.4f",
            sum.verdicts[NOOK_VERDICT_OK], sum.checks, sum.verdicts[NOOK_VERDICT_UNSEEN],
            sum.verdicts[NOOK_VERDICT_UNRESOLVED], sum.verdicts[NOOK_VERDICT_NOT_CLAIMED], sum.largest_error);
    if (sum.worst)
        fprintf(stream, ", nearest to its bound: %s on %s (%s), %+.4f of %.3g with spread %.4f of %.3g",
                sum.worst->technique, sum.worst->fixture, sum.worst->point,
                sum.worst->check.measured - sum.worst->check.expected, sum.worst->check.tolerance,
                sum.worst->check.spread, sum.worst->check.spread_max);
    fprintf(stream, "; %llu visibilities outside [0, 1]; %.0f s\n", (unsigned long long)sum.outside, seconds);
}

static void write_row(nook_json *json, const nook_verify_row *row)
{
    const nook_verify_check *check = &row->check;
    nook_json_begin_object(json);
    nook_json_member_integer(json, "row", row->number);
    nook_json_member_string(json, "fixture", row->fixture);
    nook_json_member_string(json, "what", row->what);
    nook_json_member_string(json, "point", row->point);
    nook_json_member_string(json, "technique", row->technique);
    nook_json_member_string(json, "camera", row->camera);
    nook_json_member_string(json, "target", row->target);
    nook_json_member_number(json, "expected", check->expected);
    nook_json_member_number(json, "measured", check->measured);
    nook_json_member_number(json, "error", check->measured - check->expected);
    nook_json_member_number(json, "tolerance", check->claimed ? check->tolerance : NAN);
    nook_json_member_number(json, "missing", check->missing);
    nook_json_member_number(json, "equation_1", row->equation_1);
    nook_json_member_number(json, "deviation", row->deviation);
    nook_json_member_number(json, "spread", nook_verify_is_checked(row->verdict) ? check->spread : NAN);
    nook_json_member_number(json, "spread_max", nook_verify_is_checked(row->verdict) ? check->spread_max : NAN);
    nook_json_member_number(json, "initial", row->initial);
    nook_json_member_number(json, "initial_error", row->initial - check->expected);
    nook_json_member_number(json, "initial_deviation", row->initial_deviation);
    nook_json_member_number(json, "unresolved", check->unresolved);
    nook_json_member_integer(json, "outside", (int64_t)row->outside);
    nook_json_member_bool(json, "claimed", check->claimed);
    nook_json_member_string(json, "verdict", nook_verdict_name(row->verdict));
    nook_json_member_string(json, "settings", row->settings);
    nook_json_member_string(json, "reason", row->reason);
    nook_json_end_object(json);
}

static void write_tallies(nook_json *json, const nook_verify_rows *rows)
{
    nook_verify_tally tallies[TALLIES];
    size_t count = nook_verify_tally_techniques(rows, tallies, TALLIES);
    nook_json_key(json, "techniques");
    nook_json_begin_array(json);
    for (size_t i = 0; i < count; i++) {
        nook_json_begin_object(json);
        nook_json_member_string(json, "technique", tallies[i].technique);
        nook_json_member_bool(json, "by_screen", tallies[i].by_screen);
        nook_json_member_integer(json, "checks", (int64_t)tallies[i].checks);
        nook_json_member_number(json, "bias", tallies[i].bias);
        nook_json_member_number(json, "rmse", tallies[i].rmse);
        nook_json_member_number(json, "spread", tallies[i].spread);
        nook_json_member_number(json, "largest_error", tallies[i].largest);
        nook_json_member_string(json, "largest_error_in", tallies[i].where);
        nook_json_member_number(json, "initial_bias", tallies[i].initial_bias);
        nook_json_member_number(json, "initial_rmse", tallies[i].initial_rmse);
        nook_json_end_object(json);
    }
    nook_json_end_array(json);
}

void nook_verify_write_json(nook_json *json, const nook_verify_rows *rows, const char *renderer, double seconds)
{
    nook_verify_summary sum = nook_verify_summarize(rows);
    nook_json_begin_object(json);
    nook_json_member_string(json, "renderer", renderer);
    nook_json_key(json, "rows");
    nook_json_begin_array(json);
    for (size_t i = 0; i < rows->count; i++)
        write_row(json, &rows->rows[i]);
    nook_json_end_array(json);
    write_tallies(json, rows);
    nook_json_member_integer(json, "checks", (int64_t)sum.checks);
    nook_json_member_integer(json, "ok", (int64_t)sum.verdicts[NOOK_VERDICT_OK]);
    nook_json_member_integer(json, "off", (int64_t)sum.verdicts[NOOK_VERDICT_OFF]);
    nook_json_member_integer(json, "unseen", (int64_t)sum.verdicts[NOOK_VERDICT_UNSEEN]);
    nook_json_member_integer(json, "unresolved", (int64_t)sum.verdicts[NOOK_VERDICT_UNRESOLVED]);
    nook_json_member_integer(json, "not_claimed", (int64_t)sum.verdicts[NOOK_VERDICT_NOT_CLAIMED]);
    nook_json_member_number(json, "largest_error", sum.largest_error);
    nook_json_member_integer(json, "outside", (int64_t)sum.outside);
    nook_json_member_number(json, "seconds", seconds);
    nook_json_end_object(json);
}
