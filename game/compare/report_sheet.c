#include "engine/core/file.h"
#include "game/compare/report.h"
#include "modules/measure/colour_map.h"
#include "modules/measure/sheet.h"
#include <math.h>
#include <string.h>

enum { FACTS_MAX = 8, LINES = 4, LINE = 512, TEXT = 64, PARAMETERS = 512 };

/* The texts of one row; the sheet borrows them. */
typedef struct row_text {
    char values[FACTS_MAX][TEXT];
    nook_sheet_fact facts[FACTS_MAX];
    uint32_t fact_count;
    char parameters[PARAMETERS];
} row_text;

static void add_fact(row_text *text, const char *label, const char *format, double value)
{
    char *out = text->values[text->fact_count];
    if (isfinite(value))
        snprintf(out, TEXT, format, value);
    else
        snprintf(out, TEXT, "not finite");
    text->facts[text->fact_count++] = (nook_sheet_fact){ label, out };
}

static void list_parameters(row_text *text, const nook_ao *ao, const nook_ao_technique *technique)
{
    size_t used = 0;
    for (uint32_t i = 0; i < technique->param_count && used < PARAMETERS; i++) {
        char value[TEXT];
        nook_report_param(ao, technique->name, &technique->params[i], value, sizeof value);
        used += (size_t)snprintf(text->parameters + used, PARAMETERS - used, "%s%s %s", i ? ", " : "",
                                 technique->params[i].name, value);
    }
}

static void add_steadiness(row_text *text, const nook_instability *instability)
{
    if (instability->pixels == 0) {
        text->facts[text->fact_count++] = (nook_sheet_fact){ "unsteady", "no overlap" };
        return;
    }
    add_fact(text, "unsteady", "%.4f", instability->rms);
    if (isfinite(instability->relative)) {
        char *out = text->values[text->fact_count - 1];
        snprintf(out, TEXT, "%.4f, %.0f %%", instability->rms, 100.0 * instability->relative);
    }
}

static void describe_row(row_text *text, const nook_report *report, const nook_compare_row *row)
{
    add_fact(text, "time", row->ms_median < 1000.0 ? "%.1f ms" : "%.0f ms", row->ms_median);
    if (!row->technique->exact) {
        add_fact(text, "RMSE", "%.4f", row->errors.rmse);
        add_fact(text, "bias", "%+.4f", row->errors.bias);
        add_fact(text, "99 % within", "%.4f", row->errors.p99);
        add_fact(text, "largest", "%.4f", row->errors.max);
        add_fact(text, "fetches", "%.1f / pixel", row->fetches_per_pixel);
    }
    if (report->comparison->second.measured)
        add_steadiness(text, &row->instability);
    list_parameters(text, report->stage->ao, row->technique);
}

static nook_sheet_row sheet_row(const row_text *text, const nook_compare_row *row, const nook_picture *grey,
                                const nook_picture *error)
{
    return (nook_sheet_row){ .name = row->technique->name,
                             .summary = row->technique->summary,
                             .lit = &row->lit,
                             .visibility = grey,
                             .error = error,
                             .facts = text->facts,
                             .fact_count = text->fact_count,
                             .parameters = text->parameters };
}

static const char *shared(const nook_report *report, const char *name, char *out, size_t capacity)
{
    size_t count;
    const nook_param *params = nook_ao_shared_params(&count);
    return nook_report_param(report->stage->ao, "ao", nook_param_find(params, count, name), out, capacity);
}

static void describe_second(const nook_second_view *second, char *out, size_t capacity)
{
    snprintf(
        out, capacity,
        "unsteady: RMS change of visibility at the %llu points that a camera turned %g degrees to the %s sees too; "
        "100 %%: unrelated pictures",
        (unsigned long long)second->shared, fabs(second->degrees), second->degrees > 0.0 ? "right" : "left");
}

static void describe_frame(const nook_report *report, char lines[LINES][LINE])
{
    const nook_comparison *comparison = report->comparison;
    char r_max[TEXT], falloff[TEXT], scale[TEXT], filter[TEXT];
    snprintf(lines[0], sizeof lines[0], "%llu triangles, %u x %u pixels, camera %s",
             (unsigned long long)report->stage->scene->triangle_count, comparison->width, comparison->height,
             comparison->camera);
    snprintf(lines[1], sizeof lines[1],
             "r_max %s m, falloff %s, trace at %s resolution, filter %s; errors over %llu pixels with geometry",
             shared(report, "r_max", r_max, TEXT), shared(report, "falloff", falloff, TEXT),
             shared(report, "scale", scale, TEXT), shared(report, "filter", filter, TEXT),
             (unsigned long long)comparison->rows[0].errors.count);
    snprintf(lines[2], sizeof lines[2], "%s", report->stage->gpu->renderer);
    describe_second(&comparison->second, lines[3], sizeof lines[3]);
}

nook_result nook_report_sheet(const nook_report *report, const nook_picture *errors, const nook_picture *greys,
                              nook_picture *out_picture)
{
    const nook_comparison *comparison = report->comparison;
    row_text texts[NOOK_COMPARE_TECHNIQUES_MAX] = { 0 };
    nook_sheet_row rows[NOOK_COMPARE_TECHNIQUES_MAX];
    char frame[LINES][LINE];
    describe_frame(report, frame);
    const char *const lines[] = { frame[0], frame[1], frame[2], frame[3] };
    for (uint32_t i = 0; i < comparison->row_count; i++) {
        describe_row(&texts[i], report, &comparison->rows[i]);
        rows[i] = sheet_row(&texts[i], &comparison->rows[i], &greys[i], i == 0 ? NULL : &errors[i]);
    }
    const nook_sheet sheet = { nook_path_name(report->scene_path),
                               lines,
                               comparison->second.measured ? LINES : LINES - 1,
                               rows,
                               comparison->row_count,
                               NOOK_ERROR_RANGE_DEFAULT };
    return nook_sheet_draw(&sheet, out_picture);
}
