#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/compare/output.h"
#include "game/compare/report.h"
#include "modules/measure/colour_map.h"
#include <stdlib.h>
#include <string.h>

static const char *make_path(const nook_output *output, const char *prefix, const char *name, const char *extension,
                             char out[NOOK_OUTPUT_PATH_MAX])
{
    char file[256];
    snprintf(file, sizeof file, "%s%s%s", prefix, name, extension);
    return nook_output_path(output, file, out);
}

static nook_result write_row(const nook_output *output, const nook_compare_row *row, const nook_picture *error,
                             const nook_picture *grey)
{
    char path[NOOK_OUTPUT_PATH_MAX];
    const char *name = row->technique->name;
    nook_result result = nook_pfm_write(&row->visibility, make_path(output, "", name, ".pfm", path));
    if (result == NOOK_OK)
        result = nook_picture_write_png(grey, make_path(output, "", name, ".png", path));
    if (result == NOOK_OK)
        result = nook_picture_write_png(&row->lit, make_path(output, "lit_", name, ".png", path));
    if (result == NOOK_OK && !row->technique->exact)
        result = nook_picture_write_png(error, make_path(output, "error_", name, ".png", path));
    return result;
}

static nook_result write_views(const nook_output *output, const nook_view_pictures *views)
{
    char path[NOOK_OUTPUT_PATH_MAX];
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < views->list.count && result == NOOK_OK; i++)
        result = nook_picture_write_png(&views->items[i],
                                        make_path(output, "view_", nook_view_name(views->list.items[i]), ".png", path));
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

static nook_result write_sheet(const nook_report *report, const nook_output *output, const nook_picture *errors,
                               const nook_picture *greys)
{
    char path[NOOK_OUTPUT_PATH_MAX];
    nook_picture sheet;
    nook_result result = nook_report_sheet(report, errors, greys, &sheet);
    if (result != NOOK_OK)
        return result;
    result = nook_picture_write_png(&sheet, make_path(output, "", "compare", ".png", path));
    nook_picture_free(&sheet);
    return result;
}

static nook_result write_json(const nook_report *report, const nook_output *output)
{
    char path[NOOK_OUTPUT_PATH_MAX];
    char *text;
    size_t size;
    nook_result result = nook_report_json(report, &text, &size);
    if (result != NOOK_OK)
        return result;
    result = nook_file_write(make_path(output, "", "compare", ".json", path), text, size);
    free(text);
    return result;
}

static nook_result write_all(const nook_report *report, const nook_output *output)
{
    const nook_comparison *comparison = report->comparison;
    nook_picture errors[NOOK_COMPARE_TECHNIQUES_MAX] = { 0 }, greys[NOOK_COMPARE_TECHNIQUES_MAX] = { 0 };
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < comparison->row_count && result == NOOK_OK && !nook_output_interrupted(); i++) {
        result = draw_row(comparison, i, &errors[i], &greys[i]);
        if (result == NOOK_OK)
            result = write_row(output, &comparison->rows[i], &errors[i], &greys[i]);
    }
    if (result == NOOK_OK && !nook_output_interrupted())
        result = write_sheet(report, output, errors, greys);
    if (result == NOOK_OK && !nook_output_interrupted())
        result = write_views(output, &comparison->views);
    if (result == NOOK_OK && !nook_output_interrupted())
        result = write_json(report, output);
    for (uint32_t i = 0; i < comparison->row_count; i++) {
        nook_picture_free(&errors[i]);
        nook_picture_free(&greys[i]);
    }
    return result;
}

static bool ends_with(const char *text, const char *end)
{
    size_t length = strlen(text), end_length = strlen(end);
    return length >= end_length && strcmp(text + length - end_length, end) == 0;
}

static bool is_view(const char *name)
{
    char file[256];
    for (int i = 0; i < NOOK_VIEW_COUNT; i++) {
        snprintf(file, sizeof file, "%s.png", nook_view_name((nook_view)i));
        if (strcmp(name, file) == 0)
            return true;
    }
    return false;
}

/* Whether that is the name of a picture that a comparison writes, whichever techniques it was of. */
static bool is_picture(void *user, const char *name)
{
    static const char *const prefixes[] = { "lit_", "error_" };
    const nook_ao_technique *technique;
    if (strncmp(name, "view_", 5) == 0)
        return is_view(name + 5);
    for (size_t i = 0; i < NOOK_COUNT(prefixes); i++) {
        if (strncmp(name, prefixes[i], strlen(prefixes[i])) == 0) {
            name += strlen(prefixes[i]);
            break;
        }
    }
    for (uint32_t i = 0; (technique = nook_ao_technique_at(user, i)); i++) {
        size_t length = strlen(technique->name);
        if (strncmp(name, technique->name, length) == 0 && strlen(name) == length + 4)
            return ends_with(name, ".png") || ends_with(name, ".pfm");
    }
    return false;
}

nook_result nook_report_write(const nook_report *report)
{
    nook_output output;
    nook_result result = nook_output_open(report->out, &output);
    if (result != NOOK_OK)
        return result;
    result = write_all(report, &output);
    if (result == NOOK_OK && !nook_output_interrupted())
        return nook_output_commit(&output, "compare.json", is_picture, report->stage->ao);
    nook_output_discard(&output);
    return result;
}
