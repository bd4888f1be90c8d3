#include "engine/core/file.h"
#include "game/measure/measure_origin.h"
#include "game/measure/result_columns.h"
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- CSV (RFC 4180) --------------------------------------------------------------------------------------------- */

static void put_text(FILE *out, const char *text)
{
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, out);
        return;
    }
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', out);
        fputc(*text, out);
    }
    fputc('"', out);
}

static void put_cell(FILE *out, const nook_result_column *column, const nook_result_row *row)
{
    const void *member = (const char *)row + column->offset;
    double number;
    switch (column->kind) {
    case NOOK_RESULT_TEXT:
        put_text(out, *(char *const *)member);
        break;
    case NOOK_RESULT_NUMBER:
        number = *(const double *)member;
        if (isfinite(number))
            fprintf(out, "%.9g", number);
        break;
    case NOOK_RESULT_WHOLE:
        fprintf(out, "%" PRIu32, *(const uint32_t *)member);
        break;
    case NOOK_RESULT_COUNT:
        fprintf(out, "%" PRIu64, *(const uint64_t *)member);
        break;
    case NOOK_RESULT_FLAG:
        fputc(*(const bool *)member ? '1' : '0', out);
        break;
    }
}

static nook_result put_csv(const void *user, FILE *out)
{
    const nook_results *results = user;
    size_t count;
    const nook_result_column *columns = nook_result_row_columns(&count);
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s%s", i > 0 ? "," : "", columns[i].name);
    fputs("\r\n", out);
    for (size_t r = 0; r < results->row_count; r++) {
        for (size_t i = 0; i < count; i++) {
            if (i > 0)
                fputc(',', out);
            put_cell(out, &columns[i], &results->rows[r]);
        }
        fputs("\r\n", out);
    }
    return NOOK_OK;
}

static nook_result write_csv(const nook_results *results, const char *folder)
{
    char path[4096];
    return nook_file_write_text(nook_path_join(path, sizeof path, folder, "measure.csv"), put_csv, results);
}

/* ---- JSON ------------------------------------------------------------------------------------------------------- */

static const nook_result_row *find_newest(const nook_results *results)
{
    const nook_result_row *newest = NULL;
    for (size_t i = 0; i < results->row_count; i++) {
        if (!newest || strcmp(results->rows[i].date, newest->date) > 0)
            newest = &results->rows[i];
    }
    return newest;
}

static void put_json(nook_json *json, const nook_results *results, const char *command)
{
    char date[NOOK_ORIGIN_DATE_SIZE];
    size_t count;
    const nook_result_row *newest = find_newest(results);
    nook_json_begin_object(json);
    nook_json_member_string(json, "command", command);
    nook_json_member_string(json, "date", nook_origin_date(date));
    nook_json_member_string(json, "machine", newest ? newest->machine : "");
    nook_json_member_string(json, "build", newest ? newest->build : "");
    const nook_result_column *columns = nook_result_row_columns(&count);
    nook_json_key(json, "rows");
    nook_json_begin_array(json);
    for (size_t i = 0; i < results->row_count; i++)
        nook_result_write_json(json, columns, count, &results->rows[i]);
    nook_json_end_array(json);
    columns = nook_result_site_columns(&count);
    nook_json_key(json, "sites");
    nook_json_begin_array(json);
    for (size_t i = 0; i < results->site_count; i++)
        nook_result_write_json(json, columns, count, &results->sites[i]);
    nook_json_end_array(json);
    nook_json_end_object(json);
}

static nook_result write_json(const nook_results *results, const char *folder, const char *command)
{
    char path[4096];
    nook_json json = { 0 };
    const char *text;
    size_t size;
    put_json(&json, results, command);
    nook_result result = nook_json_finish(&json, &text, &size);
    if (result == NOOK_OK)
        result = nook_file_write(nook_path_join(path, sizeof path, folder, "measure.json"), text, size);
    nook_json_free(&json);
    return result;
}

nook_result nook_results_write(const nook_results *results, const char *folder, const char *command)
{
    nook_result result = nook_directory_make(folder);
    if (result == NOOK_OK)
        result = write_csv(results, folder);
    return result == NOOK_OK ? write_json(results, folder, command) : result;
}
