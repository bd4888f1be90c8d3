#include "engine/core/file.h"
#include "game/measure/report.h"
#include "tests/support/log_capture.h"
#include "tests/support/results_fixture.h"
#include "tests/support/scratch.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char command[] = "./nook measure --suite quick";
static const char before[] =
    "# Measurements\n\nBy hand <!-- measured: begin --> in a line.\n\n<!-- measured: begin -->\n";
static const char after[] = "<!-- measured: end -->\n\nBy hand, too.\n";
static const char *const two_scenes[] = { "hall", "a|b_c" };

static const char *write_document(const char *name, const char *first, const char *middle, const char *last)
{
    static char path[512];
    char text[4096];
    int size = snprintf(text, sizeof text, "%s%s%s", first, middle, last);
    nook_scratch_path(path, sizeof path, name);
    assert_int_equal(nook_file_write(path, text, (size_t)size), NOOK_OK);
    return path;
}

static nook_file write_tables(const nook_results *results, const char *path)
{
    nook_file file;
    assert_int_equal(nook_report_document_write(results, command, path), NOOK_OK);
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    return file;
}

/* The line that starts with that text (with a line end before it: only there), without its end. */
static const char *find_line(const nook_file *file, const char *start)
{
    static char line[1024];
    const char *found = strstr((const char *)file->bytes, start);
    assert_non_null(found);
    found += *found == '\n';
    snprintf(line, sizeof line, "%.*s", (int)strcspn(found, "\n"), found);
    return line;
}

static void test_what_stands_outside_the_marks_stays(void **state)
{
    (void)state;
    const char *path = write_document("outside.md", before, "old tables\n", after);
    nook_results results = nook_results_fixture_numbers(two_scenes, 1, 1, 2);
    nook_file file = write_tables(&results, path);
    const char *text = (const char *)file.bytes;
    assert_memory_equal(text, before, strlen(before));
    assert_string_equal(text + file.size - strlen(after), after);
    assert_null(strstr(text, "old tables"));
    assert_non_null(strstr(text, command));
    assert_non_null(strstr(text, "llvmpipe, a made-up processor"));
    assert_non_null(strstr(text, "### hall, r\\_max 0.5 m (0.1 of the diagonal), hard, 8 x 8, 1 camera\n"));
    nook_file again = write_tables(&results, path); /* the same once more */
    assert_string_equal((const char *)again.bytes, text);
    nook_file_free(&again);
    nook_file_free(&file);
    nook_results_free(&results);
}

static void test_tables_hold_the_numbers(void **state)
{
    (void)state;
    const char *path = write_document("numbers.md", before, "", after);
    nook_results results = nook_results_fixture_numbers(two_scenes, 1, 1, 2);
    nook_sample *volume = &results.rows[0].sample;
    volume->ms_median = 12.34;
    volume->ms_min = 11.5;
    volume->ms_max = 13.25;
    volume->ssim_ceiling = 0.975;
    volume->fetches = 101.0;
    volume->truth.rmse = 0.01236;
    volume->truth.bias = -0.5;
    volume->ssim = NAN;
    volume->bake_ms = 1500.0;
    nook_file file = write_tables(&results, path);
    const char *line = find_line(&file, "| `volume` | ");
    assert_ptr_equal(strstr(line, "| `volume` | 12.3 | 101 | 0.0124 | -0.5000 |"), line);
    assert_non_null(strstr(line, " | - | 0.975 | ")); /* no SSIM, and its ceiling */
    assert_non_null(strstr(line, "| 1.50 |"));
    assert_non_null(
        strstr(find_line(&file, "\n| 12.3 | 11.5 | 13.2 | 101 | 0.0124 "), "`volume` as it comes |")); /* the front */
    assert_non_null(find_line(&file, "| `reference sees=screen` | 54321 |"));
    nook_file_free(&file);
    nook_results_free(&results);
}

static void test_settings_that_miss_a_camera_say_so(void **state)
{
    (void)state;
    const char *path = write_document("partial.md", before, "", after);
    nook_results results = nook_results_fixture_numbers(two_scenes, 1, 2, 2);
    const size_t row_count = results.row_count;
    results.row_count = 8; /* of the second camera only the first setting */
    nook_file file = write_tables(&results, path);
    results.row_count = row_count;
    assert_non_null(find_line(&file, "| `gtao` (1 of 2 cameras) |"));
    assert_non_null(find_line(&file, "| `volume` |"));
    assert_non_null(find_line(&file, "The front: 1 of 1 settings; "));
    nook_file_free(&file);
    nook_results_free(&results);
}

static void test_front_goes_from_fast_to_slow_and_from_wrong_to_right(void **state)
{
    (void)state;
    const char *path = write_document("front.md", before, "", after);
    nook_results results = nook_results_fixture_numbers(two_scenes, 1, 2, 8);
    nook_file file = write_tables(&results, path);
    const char *row = strstr((const char *)file.bytes, "\nThe front: ");
    assert_non_null(row);
    row = strstr(row, "|---|\n");
    assert_non_null(row);
    double last_ms = 0.0, last_rmse = INFINITY, ms, fetches, rmse;
    int count = 0;
    for (row += 6; sscanf(row, "| %lf | %*f | %*f | %lf | %lf |", &ms, &fetches, &rmse) == 3;
         row = strchr(row, '\n') + 1, count++) {
        assert_true(ms >= last_ms && rmse <= last_rmse);
        last_ms = ms;
        last_rmse = rmse;
    }
    assert_true(count > 3);
    nook_file_free(&file);
    nook_results_free(&results);
}

static void test_names_cannot_break_the_tables(void **state)
{
    (void)state;
    const char *path = write_document("names.md", before, "", after);
    nook_results results = nook_results_fixture_numbers(two_scenes, 2, 1, 1);
    free(results.rows[0].setting);
    results.rows[0].setting = strdup("volume `x|y");
    nook_file file = write_tables(&results, path);
    assert_non_null(find_line(&file, "### a\\|b\\_c, "));
    assert_non_null(find_line(&file, "| `volume  x y` | "));
    nook_file_free(&file);
    nook_results_free(&results);
}

static void test_nothing_measured_is_said(void **state)
{
    (void)state;
    const char *path = write_document("empty.md", before, "old tables\n", after);
    nook_file file = write_tables(&(nook_results){ 0 }, path);
    assert_non_null(strstr((const char *)file.bytes, "Nothing has been measured."));
    nook_file_free(&file);
}

/* @return what the failure said */
static const char *assert_refused(const char *path, nook_result expected)
{
    static nook_log_capture said;
    nook_results results = nook_results_fixture_numbers(two_scenes, 1, 1, 1);
    nook_log_capture_begin(&said);
    nook_result result = nook_report_document_write(&results, command, path);
    nook_log_capture_end();
    assert_int_equal(result, expected);
    assert_int_equal(said.errors, 1);
    nook_results_free(&results);
    return said.text;
}

static void test_document_without_marks_is_refused_and_stays(void **state)
{
    (void)state;
    static const char *const texts[] = { "# Nothing\n", "<!-- measured: end -->\n<!-- measured: begin -->\n",
                                         "<!-- measured: begin --> x\n<!-- measured: end -->\n",
                                         "<!-- measured: begin -->\n", "" };
    for (size_t i = 0; i < NOOK_COUNT(texts); i++) {
        const char *path = write_document("marks.md", texts[i], "", "");
        assert_non_null(strstr(assert_refused(path, NOOK_E_FORMAT), "measured: begin"));
        nook_file file;
        assert_int_equal(nook_file_read(path, &file), NOOK_OK);
        assert_string_equal((const char *)file.bytes, texts[i]);
        nook_file_free(&file);
    }
}

static void test_document_that_is_none_is_refused(void **state)
{
    (void)state;
    char path[512];
    assert_refused(nook_scratch_path(path, sizeof path, "none.md"), NOOK_E_NOT_FOUND);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_stands_outside_the_marks_stays),
        cmocka_unit_test(test_tables_hold_the_numbers),
        cmocka_unit_test(test_settings_that_miss_a_camera_say_so),
        cmocka_unit_test(test_front_goes_from_fast_to_slow_and_from_wrong_to_right),
        cmocka_unit_test(test_names_cannot_break_the_tables),
        cmocka_unit_test(test_nothing_measured_is_said),
        cmocka_unit_test(test_document_without_marks_is_refused_and_stays),
        cmocka_unit_test(test_document_that_is_none_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
