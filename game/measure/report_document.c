#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/mebibyte.h"
#include "game/measure/report.h"
#include "game/measure/summary.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BEGIN_LINE "<!-- measured: begin -->"
#define END_LINE "<!-- measured: end -->"

/* ---- text ---- */

/* A cell of a table: what would end it or start markup is escaped. */
static void put_cell(FILE *out, const char *text)
{
    for (; *text; text++) {
        if (strchr("|\\`*_<>[]&", *text))
            fputc('\\', out);
        fputc(*text == '\n' ? ' ' : *text, out);
    }
}

/* As code, which keeps the setting as one types it. */
static void put_setting(FILE *out, const char *text)
{
    fputc('`', out);
    for (; *text; text++)
        fputc(*text == '`' || *text == '|' || *text == '\n' ? ' ' : *text, out);
    fputc('`', out);
}

/* " 0.0123 |", and " - |" where there is no number. @param format  of one double */
__attribute__((format(printf, 2, 0))) static void put_number(FILE *out, const char *format, double value)
{
    fputc(' ', out);
    if (isnan(value))
        fputc('-', out);
    else
        fprintf(out, format, value);
    fputs(" |", out);
}

static void put_ms(FILE *out, double value)
{
    put_number(out, value < 100.0 ? "%.3g" : "%.0f", value);
}

/* ---- head ---- */

/* The texts of one kind, each once, with commas. */
static void put_distinct(FILE *out, const nook_results *results, const char *(*text_of)(const nook_result_row *))
{
    bool first = true;
    for (size_t i = 0; i < results->row_count; i++) {
        const char *text = text_of(&results->rows[i]);
        bool seen = false;
        for (size_t j = 0; j < i && !seen; j++)
            seen = strcmp(text_of(&results->rows[j]), text) == 0;
        if (seen)
            continue;
        fputs(first ? "" : ", ", out);
        put_cell(out, text);
        first = false;
    }
}

static const char *machine_of(const nook_result_row *row)
{
    return row->machine;
}

static const char *build_of(const nook_result_row *row)
{
    return row->build;
}

static void put_dates(FILE *out, const nook_results *results)
{
    const char *first = results->rows[0].date, *last = first;
    for (size_t i = 1; i < results->row_count; i++) {
        const char *date = results->rows[i].date;
        first = strcmp(date, first) < 0 ? date : first;
        last = strcmp(date, last) > 0 ? date : last;
    }
    fprintf(out, "%.10s", first);
    if (strncmp(first, last, 10) != 0)
        fprintf(out, " to %.10s", last);
}

static void put_head(FILE *out, const nook_results *results, const char *command)
{
    fputs("Machine: ", out);
    put_distinct(out, results, machine_of);
    fputs(". Build: ", out);
    put_distinct(out, results, build_of);
    fputs(". Measured ", out);
    put_dates(out, results);
    fprintf(out, "; %zu results. Command:\n\n    %s\n\n", results->row_count, command);
    fputs("Numbers stand for all cameras of the scene: ms, fetches, bias, SSIM and its ceiling are means; RMSE, "
          "against the depth "
          "buffer's "
          "own\ngeometry (screen), inside and outside of silhouettes and away from them, noise, flicker and "
          "instability are "
          "roots of mean\nsquares; p99, max, memory and bake time are those of the worst camera. What each is: "
          "[measuring.md](measuring.md#numbers).\n"
          "Settings took turns, three to five each; ms is that of the middle turn: settings within a few percent are "
          "not in "
          "order.\n",
          out);
}

/* ---- tables ---- */

static void put_heading(FILE *out, const nook_summary_view *view)
{
    const nook_result_row *row = view->rows[0].row;
    fputs("\n### ", out);
    put_cell(out, row->scene);
    fprintf(out, ", r\\_max %.3g m", row->r_max);
    if (row->r_max_part > 0.0)
        fprintf(out, " (%.3g of the diagonal)", row->r_max_part);
    fprintf(out, ", %s, %u x %u, %u camera%s\n\n", row->falloff, row->width, row->height, view->cameras,
            view->cameras == 1 ? "" : "s");
    if (!isnan(view->largest_noise) && view->smallest_rmse > 0.0)
        fprintf(out, "Noise of the truth: at most %.2g, %.0f %% of the smallest RMSE (%.4f).\n\n", view->largest_noise,
                100.0 * view->largest_noise / view->smallest_rmse, view->smallest_rmse);
}

static void put_initial_row(FILE *out, const nook_summary_view *view, const nook_summary_row *row)
{
    const nook_sample *sample = &row->sample;
    fputs("| ", out);
    put_setting(out, row->row->setting);
    if (row->cameras < view->cameras)
        fprintf(out, " (%u of %u cameras)", row->cameras, view->cameras);
    fputs(" |", out);
    put_ms(out, sample->ms_median);
    put_number(out, "%.0f", sample->fetches);
    put_number(out, "%.4f", sample->truth.rmse);
    put_number(out, "%+.4f", sample->truth.bias);
    put_number(out, "%.3f", sample->truth.p99);
    put_number(out, "%.3f", sample->truth.max);
    put_number(out, "%.3f", sample->ssim);
    put_number(out, "%.3f", sample->ssim_ceiling);
    put_number(out, "%.4f", sample->screen.rmse);
    put_number(out, "%.4f", sample->rmse_inside);
    put_number(out, "%.4f", sample->rmse_outside);
    put_number(out, "%.4f", sample->rmse_away);
    put_number(out, "%.4f", sample->noise);
    put_number(out, "%.4f", sample->flicker);
    put_number(out, "%.4f", sample->instability.rms);
    put_number(out, "%.2f", sample->volume_bytes / NOOK_MIB);
    put_number(out, "%.2f", sample->texture_bytes / NOOK_MIB);
    put_number(out, "%.2f", sample->bake_ms / 1000.0);
    fputc('\n', out);
}

static void put_initial_table(FILE *out, const nook_summary_view *view)
{
    fputs("Every technique as it comes, and the truths:\n\n"
          "| technique | ms | fetches | RMSE | bias | p99 | max | SSIM | ceiling | screen | inside | outside | away | "
          "noise | "
          "flicker "
          "| instability | volumes MiB | textures MiB | bake s |\n"
          "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
          out);
    for (size_t i = 0; i < view->row_count; i++) {
        const nook_summary_row *row = &view->rows[i];
        if (row->row->initial || strcmp(row->row->technique, NOOK_SUMMARY_REFERENCE) == 0)
            put_initial_row(out, view, row);
    }
}

static int compare_ms(const void *a, const void *b)
{
    const nook_summary_row *const *first = a, *const *second = b;
    double x = (*first)->sample.ms_median, y = (*second)->sample.ms_median;
    return (x > y) - (x < y);
}

static void put_front_row(FILE *out, const nook_summary_row *row)
{
    const nook_sample *sample = &row->sample;
    fputs("|", out);
    put_ms(out, sample->ms_median);
    put_ms(out, sample->ms_min);
    put_ms(out, sample->ms_max);
    put_number(out, "%.0f", sample->fetches);
    put_number(out, "%.4f", sample->truth.rmse);
    put_number(out, "%+.4f", sample->truth.bias);
    put_number(out, "%.3f", sample->truth.p99);
    put_number(out, "%.3f", sample->ssim);
    fputc(' ', out);
    put_setting(out, row->row->setting);
    fputs(row->row->initial ? " as it comes |\n" : " |\n", out);
}

static nook_result put_front_table(FILE *out, const nook_summary_view *view)
{
    const nook_summary_row **front = malloc(view->row_count * sizeof(const nook_summary_row *));
    size_t count = 0;
    if (!front)
        return nook_fail(NOOK_E_MEMORY, "no memory for the front of %zu settings", view->row_count);
    for (size_t i = 0; i < view->row_count; i++) {
        if (view->rows[i].on_front)
            front[count++] = &view->rows[i];
    }
    qsort(front, count, sizeof(const nook_summary_row *), compare_ms);
    fprintf(out,
            "\nThe front: %zu of %zu settings; no other beats them in both time and RMSE. Where the times of two, from "
            "min to max, overlap,\nwhich is faster is open:\n\n"
            "| ms | min | max | fetches | RMSE | bias | p99 | SSIM | setting |\n"
            "|---:|---:|---:|---:|---:|---:|---:|---:|---|\n",
            count, view->compared);
    for (size_t i = 0; i < count; i++)
        put_front_row(out, front[i]);
    free(front);
    return NOOK_OK;
}

static nook_result put_views(FILE *out, const nook_results *results)
{
    nook_summary summary;
    nook_result result = nook_summary_create(results, &summary);
    if (result != NOOK_OK)
        return result;
    for (size_t i = 0; i < summary.view_count && result == NOOK_OK; i++) {
        put_heading(out, &summary.views[i]);
        put_initial_table(out, &summary.views[i]);
        result = put_front_table(out, &summary.views[i]);
    }
    nook_summary_free(&summary);
    return result;
}

/* ---- the document ---- */

/* Where a line that is exactly `line` starts, from `text` on. */
static const char *find_line(const char *text, const char *line)
{
    size_t length = strlen(line);
    while (text) {
        if (strncmp(text, line, length) == 0 && strchr("\r\n", text[length]))
            return text;
        text = strchr(text, '\n');
        text = text ? text + 1 : NULL;
    }
    return NULL;
}

/* @param out_begin, out_end  the two lines in its text */
static nook_result find_marks(const char *path, const char *text, const char **out_begin, const char **out_end)
{
    const char *begin = find_line(text, BEGIN_LINE), *end = begin ? find_line(begin, END_LINE) : NULL;
    if (!end)
        return nook_fail(NOOK_E_FORMAT,
                         "%s: has no lines '" BEGIN_LINE "' and '" END_LINE "'; the tables go between them", path);
    *out_begin = begin;
    *out_end = end;
    return NOOK_OK;
}

nook_result nook_report_document_check(const char *path)
{
    nook_file file;
    const char *begin, *end;
    nook_result result = nook_file_read(path, &file);
    if (result != NOOK_OK)
        return result;
    result = find_marks(path, (const char *)file.bytes, &begin, &end);
    nook_file_free(&file);
    return result == NOOK_OK ? nook_file_probe(path) : result;
}

/* What a document is made of. */
typedef struct document {
    const char *path, *old; /* what stands in it now */
    const nook_results *results;
    const char *command;
} document;

static nook_result put_document(const void *user, FILE *out)
{
    const document *d = user;
    const char *begin, *end;
    nook_result result = find_marks(d->path, d->old, &begin, &end);
    if (result != NOOK_OK)
        return result;
    fwrite(d->old, 1, (size_t)(begin - d->old), out);
    fputs(BEGIN_LINE "\n\n", out);
    if (d->results->row_count) {
        put_head(out, d->results, d->command);
        result = put_views(out, d->results);
    } else {
        fputs("Nothing has been measured.\n", out);
    }
    fprintf(out, "\n%s", end);
    return result;
}

nook_result nook_report_document_write(const nook_results *results, const char *command, const char *path)
{
    nook_file old;
    nook_result result = nook_file_read(path, &old);
    if (result != NOOK_OK)
        return result;
    const document made = { path, (const char *)old.bytes, results, command };
    result = nook_file_write_text(path, put_document, &made);
    nook_file_free(&old);
    return result;
}
