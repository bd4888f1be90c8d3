#include "engine/core/json.h"
#include "game/measure/report_internal.h"
#include "game/measure/sample_columns.h"
#include <assert.h>
#include <string.h>

enum { COLUMNS_MAX = 64 };

static void write_columns(nook_json *json)
{
    size_t count;
    const nook_sample_column *columns = nook_sample_columns(&count);
    nook_json_key(json, "columns");
    nook_json_begin_array(json);
    for (size_t i = 0; i < count; i++) {
        nook_json_begin_object(json);
        nook_json_member_string(json, "key", columns[i].key);
        nook_json_member_string(json, "over", nook_over_cameras_name(columns[i].over));
        nook_json_end_object(json);
    }
    nook_json_end_array(json);
}

static void write_numbers(nook_json *json, const nook_sample *sample)
{
    double numbers[COLUMNS_MAX];
    size_t count;
    const nook_sample_column *columns = nook_sample_columns(&count);
    assert(count <= COLUMNS_MAX);
    for (size_t i = 0; i < count; i++)
        numbers[i] = nook_sample_number(sample, &columns[i]);
    nook_json_key(json, "numbers");
    nook_json_numbers(json, numbers, count);
}

static void write_place(nook_json *json, const char *scene, const char *scene_hash, const char *camera, uint32_t width,
                        uint32_t height, double r_max, const char *falloff)
{
    nook_json_member_string(json, "scene", scene);
    nook_json_member_string(json, "scene_hash", scene_hash);
    nook_json_member_string(json, "camera", camera);
    nook_json_member_integer(json, "width", width);
    nook_json_member_integer(json, "height", height);
    nook_json_member_number(json, "r_max", r_max);
    nook_json_member_string(json, "falloff", falloff);
}

static void write_row(nook_json *json, const nook_result_row *row)
{
    nook_json_begin_object(json);
    write_place(json, row->scene, row->scene_hash, row->camera, row->width, row->height, row->r_max, row->falloff);
    nook_json_member_number(json, "r_max_part", row->r_max_part);
    nook_json_member_string(json, "setting", row->setting);
    nook_json_member_string(json, "technique", row->technique);
    nook_json_member_bool(json, "initial", row->initial);
    nook_json_member_string(json, "build", row->build);
    nook_json_member_string(json, "machine", row->machine);
    nook_json_member_string(json, "date", row->date);
    nook_json_member_string(json, "picture", row->picture);
    nook_json_member_integer(json, "frames", row->sample.frames);
    nook_json_member_integer(json, "non_finite", (int64_t)row->sample.truth.non_finite);
    nook_json_member_integer(json, "reference_rays", row->sample.reference_rays);
    write_numbers(json, &row->sample);
    nook_json_end_object(json);
}

static void write_site(nook_json *json, const nook_result_site *site)
{
    nook_json_begin_object(json);
    write_place(json, site->scene, site->scene_hash, site->camera, site->width, site->height, site->r_max,
                site->falloff);
    nook_json_member_number(json, "reference_noise", site->reference_noise);
    nook_json_member_integer(json, "reference_rays", site->reference_rays);
    nook_json_member_string(json, "truth", site->truth);
    nook_json_member_string(json, "screen", site->screen);
    nook_json_member_string(json, "geometry", site->geometry);
    nook_json_member_string(json, "lit", site->lit);
    nook_json_end_object(json);
}

/* '<' stands only inside strings of JSON: as an escape it cannot end the script element or open a comment in it. */
static void put_escaped(FILE *out, const char *text)
{
    while (*text) {
        size_t plain = strcspn(text, "<\xE2");
        fwrite(text, 1, plain, out);
        text += plain;
        if (*text == '<') {
            fputs("\\u003c", out);
            text++;
        } else if (strncmp(text, "\xE2\x80\xA8", 3) == 0 || strncmp(text, "\xE2\x80\xA9", 3) == 0) {
            fprintf(out, "\\u202%c", text[2] == '\xA8' ? '8' : '9');
            text += 3;
        } else if (*text) {
            fputc(*text++, out);
        }
    }
}

nook_result nook_report_put_data(FILE *out, const nook_results *results, const char *command)
{
    nook_json json = { 0 };
    nook_json_begin_object(&json);
    nook_json_member_string(&json, "command", command);
    write_columns(&json);
    nook_json_key(&json, "rows");
    nook_json_begin_array(&json);
    for (size_t i = 0; i < results->row_count; i++)
        write_row(&json, &results->rows[i]);
    nook_json_end_array(&json);
    nook_json_key(&json, "sites");
    nook_json_begin_array(&json);
    for (size_t i = 0; i < results->site_count; i++)
        write_site(&json, &results->sites[i]);
    nook_json_end_array(&json);
    nook_json_end_object(&json);
    const char *text;
    nook_result result = nook_json_finish(&json, &text, NULL);
    if (result == NOOK_OK)
        put_escaped(out, text);
    nook_json_free(&json);
    return result;
}
