/* Also leaves reports in the scratch folder for tests/game/test_report_browser.sh, which opens them. */
#include "engine/core/file.h"
#include "game/measure/report.h"
#include "game/measure/report_internal.h"
#include "modules/measure/colour_map.h"
#include "tests/support/log_capture.h"
#include "tests/support/results_fixture.h"
#include "tests/support/scratch.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const char command[] = "./nook measure --scenes \"a & b\"";
static const char *const two_scenes[] = { "hall", "</script><b>&\"" };

static const char *root_folder(void)
{
    const char *root = getenv("NOOK_ROOT");
    return root ? root : ".";
}

static const char *make_folder(const char *name)
{
    static char path[512];
    nook_scratch_path(path, sizeof path, name);
    assert_int_equal(nook_directory_make(path), NOOK_OK);
    return path;
}

/* The report of those results. @return its text, release with nook_file_free */
static nook_file write_report(const nook_results *results, const char *folder)
{
    char path[600];
    nook_file file;
    assert_int_equal(nook_report_html_write(root_folder(), results, folder, command), NOOK_OK);
    assert_int_equal(nook_file_read(nook_path_join(path, sizeof path, folder, "report.html"), &file), NOOK_OK);
    return file;
}

static nook_results make_results(const char *folder, uint32_t scene_count, uint32_t cameras, uint32_t settings)
{
    nook_results results;
    const nook_results_fixture fixture = { .scenes = two_scenes,
                                           .scene_count = scene_count,
                                           .cameras = cameras,
                                           .settings = settings,
                                           .width = 96,
                                           .height = 60,
                                           .folder = folder };
    nook_results_fixture_make(&fixture, &results);
    return results;
}

static size_t count_text(const char *text, const char *what)
{
    size_t count = 0;
    while ((text = strstr(text, what))) {
        count++;
        text += strlen(what);
    }
    return count;
}

/* ---- the file ---- */

static void test_report_is_one_file_without_addresses(void **state)
{
    (void)state;
    const char *folder = make_folder("pages");
    nook_results results = make_results(folder, 2, 2, 6);
    nook_file file = write_report(&results, folder);
    const char *text = (const char *)file.bytes;
    assert_ptr_equal(strstr(text, "<!DOCTYPE html>"), text);
    assert_non_null(strstr(text, "function draw_chart(")); /* the script and the style came in */
    assert_non_null(strstr(text, "border-collapse"));
    assert_null(strstr(text, "{{"));
    assert_null(strstr(text, "http:"));
    assert_null(strstr(text, "https:"));
    assert_null(strstr(text, " src=\""));
    assert_null(strstr(text, "href="));
    assert_int_equal(count_text(text, "\"numbers\": ["), results.row_count);
    assert_int_equal(count_text(text, "data-picture=\""), 2 * 2 * (3 * 6 + 4));
    nook_file_free(&file);
    nook_results_free(&results);
}

static void test_names_cannot_end_an_element_of_the_report(void **state)
{
    (void)state;
    const char *folder = make_folder("escaping");
    nook_results results = make_results(NULL, 2, 1, 1);
    nook_file file = write_report(&results, folder);
    const char *text = (const char *)file.bytes;
    assert_null(strstr(text, "</script><b>"));
    assert_non_null(strstr(text, "\"\\u003c/script>\\u003cb>&\\\"\"")); /* as JSON */
    assert_non_null(strstr(text, "<title>Nook measurements: hall, &lt;/script&gt;&lt;b&gt;&amp;&quot;</title>"));
    assert_non_null(strstr(text, "\"./nook measure --scenes \\\"a & b\\\"\""));
    nook_file_free(&file);
    nook_results_free(&results);
}

static void rename_scene(nook_results *results, const char *name)
{
    for (size_t i = 0; i < results->row_count; i++) {
        free(results->rows[i].scene);
        results->rows[i].scene = strdup(name);
    }
}

static void test_line_ends_that_only_script_knows_are_escaped(void **state)
{
    (void)state;
    const char *folder = make_folder("line_ends");
    nook_results results = make_results(NULL, 1, 1, 1);
    rename_scene(&results, "a\xE2\x80\xA8"
                           "b\xE2\x80\xA9"
                           "c\xE2\x82\xAC <!-- \xE2");
    nook_file file = write_report(&results, folder);
    const char *data = strstr((const char *)file.bytes, "id=\"results\"");
    assert_non_null(strstr(data, "\"a\\u2028b\\u2029c\xE2\x82\xAC \\u003c!-- \xEF\xBF\xBD\""));
    assert_null(strstr(data, "\xE2\x80\xA8"));
    nook_file_free(&file);
    nook_results_free(&results);
}

/* ---- pictures ---- */

static int digit_value(char digit)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *found = strchr(digits, digit);
    assert_non_null(found);
    return (int)(found - digits);
}

/* Up to the next '<'. @return bytes written */
static size_t decode_base64(const char *text, uint8_t *out)
{
    size_t size = 0;
    uint32_t bits = 0, held = 0;
    for (; *text != '<' && *text != '='; text++) {
        bits = bits << 6 | (uint32_t)digit_value(*text);
        held += 6;
        if (held >= 8) {
            held -= 8;
            out[size++] = (uint8_t)(bits >> held);
        }
    }
    return size;
}

/* Whether the report holds the bytes under that name. */
static void assert_holds_picture(const nook_file *report, const char *name, const void *bytes, size_t size)
{
    char start[128];
    snprintf(start, sizeof start, "data-picture=\"%s\">", name);
    const char *found = strstr((const char *)report->bytes, start);
    assert_non_null(found);
    uint8_t *decoded = malloc(report->size);
    assert_non_null(decoded);
    assert_int_equal(decode_base64(found + strlen(start), decoded), size);
    assert_memory_equal(decoded, bytes, size);
    free(decoded);
}

static void test_pictures_are_in_the_report_byte_for_byte(void **state)
{
    (void)state;
    const char *folder = make_folder("bytes");
    nook_results results = make_results(folder, 1, 1, 1);
    nook_file pngs[3], file;
    char path[600];
    for (size_t i = 0; i < 3; i++) { /* of each length modulo 3, so that every ending of base64 is met */
        assert_int_equal(nook_file_read(nook_path_join(path, sizeof path, folder, results.rows[i].picture), &pngs[i]),
                         NOOK_OK);
        size_t size = pngs[i].size + i - pngs[i].size % 3 + 3;
        pngs[i].bytes = realloc(pngs[i].bytes, size);
        assert_non_null(pngs[i].bytes);
        memset(pngs[i].bytes + pngs[i].size, 0xA5, size - pngs[i].size);
        pngs[i].size = size;
        assert_int_equal(nook_file_write(path, pngs[i].bytes, size), NOOK_OK);
    }
    file = write_report(&results, folder);
    for (size_t i = 0; i < 3; i++) {
        assert_holds_picture(&file, results.rows[i].picture, pngs[i].bytes, pngs[i].size);
        nook_file_free(&pngs[i]);
    }
    nook_file_free(&file);
    nook_results_free(&results);
}

static void test_missing_pictures_are_one_line_and_the_report_is_written(void **state)
{
    (void)state;
    const char *folder = make_folder("missing");
    nook_results results = make_results(folder, 1, 1, 3);
    char path[600];
    assert_int_equal(unlink(nook_path_join(path, sizeof path, folder, results.rows[1].picture)), 0);
    assert_int_equal(nook_file_write(nook_path_join(path, sizeof path, folder, results.rows[2].picture), "GIF89a", 6),
                     NOOK_OK);
    nook_log_capture said;
    nook_log_capture_begin(&said);
    nook_file file = write_report(&results, folder);
    nook_log_capture_end();
    assert_int_equal(said.count, 1);
    assert_int_equal(said.level, NOOK_LOG_WARNING);
    assert_non_null(strstr(said.text, "2 of 13 pictures"));
    assert_non_null(strstr(said.text, results.rows[1].picture));
    assert_int_equal(count_text((const char *)file.bytes, "data-picture=\""), 11);
    nook_file_free(&file);
    nook_results_free(&results);
}

/* A picture of that many bytes that begins like one. */
static void write_large_picture(const char *folder, const char *name, size_t size)
{
    char path[600];
    nook_file png;
    nook_path_join(path, sizeof path, folder, name);
    assert_int_equal(nook_file_read(path, &png), NOOK_OK);
    uint8_t *bytes = calloc(1, size);
    assert_non_null(bytes);
    memcpy(bytes, png.bytes, png.size);
    assert_int_equal(nook_file_write(path, bytes, size), NOOK_OK);
    nook_file_free(&png);
    free(bytes);
}

static bool report_names(const nook_file *report, const char *picture)
{
    char start[128];
    snprintf(start, sizeof start, "data-picture=\"%s\">", picture);
    return strstr((const char *)report->bytes, start) != NULL;
}

static void test_pictures_over_the_limit_are_left_out_last_choices_first(void **state)
{
    (void)state;
    const char *folder = make_folder("limit");
    nook_results results = make_results(folder, 1, 1, 4);
    const nook_result_row *initial = &results.rows[4], *other = &results.rows[10]; /* gtao; ssao rays=2, on no front */
    assert_true(initial->initial && !other->initial);
    write_large_picture(folder, initial->picture, NOOK_REPORT_PICTURES_MAX / 2);
    write_large_picture(folder, other->picture, NOOK_REPORT_PICTURES_MAX / 2);
    nook_log_capture said;
    nook_log_capture_begin(&said);
    nook_file file = write_report(&results, folder);
    nook_log_capture_end();
    assert_int_equal(said.count, 1);
    assert_non_null(strstr(said.text, "1 of 16 pictures"));
    assert_true(report_names(&file, initial->picture));
    assert_false(report_names(&file, other->picture));
    assert_true(report_names(&file, results.rows[11].picture)); /* what still fits comes after it */
    nook_file_free(&file);
    nook_results_free(&results);
}

/* ---- what can go wrong ---- */

static void test_empty_results_give_a_report(void **state)
{
    (void)state;
    const char *folder = make_folder("empty");
    nook_file file = write_report(&(nook_results){ 0 }, folder);
    assert_non_null(strstr((const char *)file.bytes, "\"rows\": []"));
    nook_file_free(&file);
}

static void test_missing_template_leaves_the_old_report(void **state)
{
    (void)state;
    char path[600];
    const char *folder = make_folder("old");
    nook_path_join(path, sizeof path, folder, "report.html");
    assert_int_equal(nook_file_write(path, "old", 3), NOOK_OK);
    nook_log_capture said;
    nook_log_capture_begin(&said);
    nook_result result = nook_report_html_write(folder, &(nook_results){ 0 }, folder, command);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_NOT_FOUND);
    assert_int_equal(said.errors, 1);
    assert_non_null(strstr(said.text, "template.html"));
    nook_file file;
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    assert_string_equal((const char *)file.bytes, "old");
    nook_file_free(&file);
}

static void test_folder_that_is_none_is_refused(void **state)
{
    (void)state;
    nook_log_capture said;
    nook_log_capture_begin(&said);
    nook_result result = nook_report_html_write(root_folder(), &(nook_results){ 0 }, "/nowhere/at all", command);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_IO);
    assert_int_equal(said.errors, 1);
}

/* ---- for the browser ---- */

static void test_large_report_is_written(void **state)
{
    (void)state;
    const char *folder = make_folder("large");
    nook_results results = make_results(NULL, 2, 5, 100);
    nook_file file = write_report(&results, folder);
    assert_int_equal(results.row_count, 3010);
    assert_int_equal(count_text((const char *)file.bytes, "\"numbers\": ["), 3010);
    nook_file_free(&file);
    nook_results_free(&results);
}

/* The script draws errors in the colours of modules/measure/colour_map.h: they are held together there. */
static void test_colours_are_written_for_the_browser(void **state)
{
    (void)state;
    char path[512], text[8192];
    int size = 0;
    for (int difference = -255; difference <= 255; difference += 15) {
        nook_rgb colour = nook_error_colour((float)difference / 255.0f, NOOK_ERROR_RANGE_DEFAULT);
        size += snprintf(text + size, sizeof text - (size_t)size, "%d %d %d %d\n", difference, colour.r, colour.g,
                         colour.b);
    }
    assert_true(size > 0 && size < (int)sizeof text);
    nook_scratch_path(path, sizeof path, "colours");
    assert_int_equal(nook_file_write(path, text, (size_t)size), NOOK_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_report_is_one_file_without_addresses),
        cmocka_unit_test(test_names_cannot_end_an_element_of_the_report),
        cmocka_unit_test(test_line_ends_that_only_script_knows_are_escaped),
        cmocka_unit_test(test_pictures_are_in_the_report_byte_for_byte),
        cmocka_unit_test(test_missing_pictures_are_one_line_and_the_report_is_written),
        cmocka_unit_test(test_pictures_over_the_limit_are_left_out_last_choices_first),
        cmocka_unit_test(test_empty_results_give_a_report),
        cmocka_unit_test(test_missing_template_leaves_the_old_report),
        cmocka_unit_test(test_folder_that_is_none_is_refused),
        cmocka_unit_test(test_large_report_is_written),
        cmocka_unit_test(test_colours_are_written_for_the_browser),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
