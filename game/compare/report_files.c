#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/compare/report.h"
#include "modules/measure/colour_map.h"
#include <stdlib.h>
#include <unistd.h>

static const char *make_path(const nook_report *report, const char *prefix, const char *name, const char *extension,
                             char out[NOOK_COMPARE_PATH_MAX])
{
    char file[256];
    snprintf(file, sizeof file, "%s%s%s", prefix, name, extension);
    return nook_path_join(out, NOOK_COMPARE_PATH_MAX, report->out, file);
}

nook_result nook_report_prepare(const char *out)
{
    char probe[NOOK_COMPARE_PATH_MAX];
    nook_result result = nook_directory_make(out);
    if (result == NOOK_OK)
        result = nook_file_write(nook_path_join(probe, sizeof probe, out, ".nook_probe"), "", 0);
    if (result == NOOK_OK)
        unlink(probe);
    return result;
}

static nook_result write_row(const nook_report *report, const nook_compare_row *row, const nook_picture *error,
                             const nook_picture *grey)
{
    char path[NOOK_COMPARE_PATH_MAX];
    const char *name = row->technique->name;
    nook_result result = nook_pfm_write(&row->visibility, make_path(report, "", name, ".pfm", path));
    if (result == NOOK_OK)
        result = nook_picture_write_png(grey, make_path(report, "", name, ".png", path));
    if (result == NOOK_OK)
        result = nook_picture_write_png(&row->lit, make_path(report, "lit_", name, ".png", path));
    if (result == NOOK_OK && !row->technique->exact)
        result = nook_picture_write_png(error, make_path(report, "error_", name, ".png", path));
    return result;
}

static nook_result draw_row(const nook_comparison *comparison, uint32_t index, nook_picture *error, nook_picture *grey)
{
    const nook_grey *visibility = &comparison->rows[index].visibility;
    nook_result result = nook_picture_from_grey(visibility->values, visibility->width, visibility->height, grey);
    if (result != NOOK_OK)
        return result;
    return nook_error_picture(visibility->values, comparison->rows[0].visibility.values, comparison->geometry,
                              visibility->width, visibility->height, NOOK_ERROR_RANGE_DEFAULT, error);
}

static nook_result write_sheet(const nook_report *report, const nook_picture *errors, const nook_picture *greys)
{
    char path[NOOK_COMPARE_PATH_MAX];
    nook_picture sheet;
    nook_result result = nook_report_sheet(report, errors, greys, &sheet);
    if (result != NOOK_OK)
        return result;
    result = nook_picture_write_png(&sheet, make_path(report, "", "compare", ".png", path));
    nook_picture_free(&sheet);
    return result;
}

static nook_result write_json(const nook_report *report)
{
    char path[NOOK_COMPARE_PATH_MAX];
    char *text;
    size_t size;
    nook_result result = nook_report_json(report, &text, &size);
    if (result != NOOK_OK)
        return result;
    result = nook_file_write(make_path(report, "", "compare", ".json", path), text, size);
    free(text);
    return result;
}

nook_result nook_report_write(const nook_report *report)
{
    const nook_comparison *comparison = report->comparison;
    nook_picture errors[NOOK_COMPARE_TECHNIQUES_MAX] = { 0 }, greys[NOOK_COMPARE_TECHNIQUES_MAX] = { 0 };
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < comparison->row_count && result == NOOK_OK; i++) {
        result = draw_row(comparison, i, &errors[i], &greys[i]);
        if (result == NOOK_OK)
            result = write_row(report, &comparison->rows[i], &errors[i], &greys[i]);
    }
    if (result == NOOK_OK)
        result = write_sheet(report, errors, greys);
    if (result == NOOK_OK) /* last: who finds it finds everything it speaks of */
        result = write_json(report);
    for (uint32_t i = 0; i < comparison->row_count; i++) {
        nook_picture_free(&errors[i]);
        nook_picture_free(&greys[i]);
    }
    return result;
}
