/* Rows that are kept, read again, joined, written as tables and judged. */
#include "engine/asset/json_tree.h"
#include "engine/core/file.h"
#include "game/measure/journal.h"
#include "game/measure/measure_merge.h"
#include "game/measure/measure_progress.h"
#include "game/measure/measure_verdict.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmocka.h>

enum { PATH_CAPACITY = 2048 };

static nook_result_row make_row(const char *camera, const char *setting, const char *build, double rmse)
{
    return (nook_result_row){ .scene = "a \"scene\", two\nlines.glb",
                              .scene_hash = "0123456789abcdef",
                              .camera = (char *)camera,
                              .width = 64,
                              .height = 36,
                              .r_max = 0.1 / 3.0,
                              .falloff = "quadratic",
                              .setting = (char *)setting,
                              .technique = "ssao",
                              .initial = true,
                              .build = (char *)build,
                              .machine = "m",
                              .date = "2026-01-02T03:04:05Z",
                              .picture = "",
                              .sample = { .ms_median = 12.5,
                                          .gpu_ms_median = NAN,
                                          .frames = 5,
                                          .truth = { .count = 99, .valid = true, .rmse = rmse, .mae = rmse },
                                          .screen = { .rmse = NAN },
                                          .rmse_inside = rmse,
                                          .rmse_outside = NAN,
                                          .rmse_away = rmse,
                                          .reference_noise = 0.001,
                                          .noise_inside = 0.001,
                                          .noise_outside = NAN, /* no such pixel */
                                          .noise_away = 0.001,
                                          .reference_rays = 256 } };
}

/* An empty folder of that name. */
static const char *make_folder(char out[PATH_CAPACITY], const char *name)
{
    char path[PATH_CAPACITY + 64];
    nook_scratch_path(out, PATH_CAPACITY, name);
    unlink(nook_path_join(path, sizeof path, out, NOOK_JOURNAL_NAME));
    return out;
}

static void append(const char *folder, const nook_result_row *row)
{
    nook_journal journal;
    assert_int_equal(nook_journal_open(folder, &journal), NOOK_OK);
    assert_int_equal(nook_journal_append(&journal, row), NOOK_OK);
    nook_journal_close(&journal);
}

static nook_results must_read(const char *folder)
{
    nook_results results;
    assert_int_equal(nook_results_read(folder, &results), NOOK_OK);
    return results;
}

static void test_a_row_comes_back_as_it_was_kept(void **state)
{
    (void)state;
    char folder[PATH_CAPACITY];
    nook_result_row row = make_row("c", "ssao", "b", 0.25);
    append(make_folder(folder, "kept"), &row);
    nook_results results = must_read(folder);
    assert_int_equal(results.row_count, 1);
    const nook_result_row *read = &results.rows[0];
    assert_string_equal(read->scene, row.scene);
    assert_true(read->r_max == row.r_max && read->width == 64 && read->initial);
    assert_true(read->sample.truth.rmse == 0.25 && read->sample.truth.valid && read->sample.truth.count == 99);
    assert_true(isnan(read->sample.gpu_ms_median) && isnan(read->sample.screen.rmse) && !read->sample.screen.valid);
    assert_int_equal(read->sample.reference_rays, 256);
    assert_ptr_equal(nook_results_find(&results, &row), read);
    row.r_max *= 1.0000001;
    assert_null(nook_results_find(&results, &row));
    row = make_row("c", "ssao", "b", 0.25);
    row.machine = "another";
    assert_null(nook_results_find(&results, &row)); /* whose time it is not */
    nook_results_free(&results);
}

static void test_of_two_lines_of_one_row_the_later_counts(void **state)
{
    (void)state;
    char folder[PATH_CAPACITY];
    nook_result_row row = make_row("c", "ssao", "old", 0.25);
    append(make_folder(folder, "twice"), &row);
    row = make_row("c", "ssao samples=4", "old", 0.5);
    append(folder, &row);
    row = make_row("c", "ssao", "new", 0.125);
    append(folder, &row);
    nook_results results = must_read(folder);
    assert_int_equal(results.row_count, 2);
    assert_string_equal(results.rows[0].build, "new");
    assert_true(results.rows[0].sample.truth.rmse == 0.125 && results.rows[1].sample.truth.rmse == 0.5);
    nook_results_free(&results);
}

/* Two files called scene.gltf, or one that was edited. */
static void test_sites_of_one_name_and_other_content_are_two(void **state)
{
    (void)state;
    char folder[PATH_CAPACITY];
    nook_journal journal;
    nook_result_site site = { .scene = "scene.gltf",
                              .scene_hash = "0000000000000001",
                              .camera = "c",
                              .falloff = "hard",
                              .truth = "one.png",
                              .screen = "",
                              .geometry = "",
                              .lit = "" };
    assert_int_equal(nook_journal_open(make_folder(folder, "sites"), &journal), NOOK_OK);
    assert_int_equal(nook_journal_append_site(&journal, &site), NOOK_OK);
    site.scene_hash = "0000000000000002";
    site.truth = "two.png";
    assert_int_equal(nook_journal_append_site(&journal, &site), NOOK_OK);
    nook_journal_close(&journal);
    nook_results results = must_read(folder);
    assert_int_equal(results.site_count, 2);
    assert_string_equal(nook_results_find_site(&results, &site)->truth, "two.png");
    site.scene_hash = "0000000000000001";
    assert_string_equal(nook_results_find_site(&results, &site)->truth, "one.png");
    nook_results_free(&results);
}

static void test_a_folder_without_a_journal_has_no_rows(void **state)
{
    (void)state;
    char folder[PATH_CAPACITY];
    nook_results results = must_read(make_folder(folder, "nothing"));
    assert_int_equal(results.row_count, 0);
    nook_results_free(&results);
}

static void test_a_line_cut_short_is_left_out_with_a_word_and_cut_away(void **state)
{
    (void)state;
    char folder[PATH_CAPACITY], path[PATH_CAPACITY + 64];
    nook_log_capture log;
    nook_file file;
    nook_result_row row = make_row("c", "ssao", "b", 0.25);
    append(make_folder(folder, "cut"), &row);
    row = make_row("d", "ssao", "b", 0.5);
    append(folder, &row);
    nook_path_join(path, sizeof path, folder, NOOK_JOURNAL_NAME);
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    assert_int_equal(nook_file_write(path, file.bytes, file.size - 20), NOOK_OK);
    nook_file_free(&file);
    nook_log_capture_begin(&log);
    nook_results results = must_read(folder);
    nook_log_capture_end();
    assert_int_equal(results.row_count, 1);
    assert_int_equal(log.count, 1);
    assert_int_equal(log.errors, 0);
    assert_non_null(strstr(log.text, NOOK_JOURNAL_NAME ":2: a line cut short"));
    nook_results_free(&results);
    nook_log_capture_begin(&log);
    append(folder, &row);
    nook_log_capture_end();
    assert_non_null(strstr(log.text, "cut short"));
    nook_log_capture_begin(&log);
    results = must_read(folder);
    nook_log_capture_end();
    assert_int_equal(results.row_count, 2);
    assert_int_equal(log.count, 0);
    nook_results_free(&results);
}

/* As on a full disk: ten bytes are written, then no more. */
static void test_a_line_that_finds_no_room_leaves_the_journal_as_it_was(void **state)
{
    (void)state;
    char folder[PATH_CAPACITY], path[PATH_CAPACITY + 64];
    nook_journal journal;
    nook_log_capture log;
    nook_file file;
    struct rlimit before, small;
    nook_result_row row = make_row("c", "ssao", "b", 0.25);
    append(make_folder(folder, "full"), &row);
    assert_int_equal(nook_file_read(nook_path_join(path, sizeof path, folder, NOOK_JOURNAL_NAME), &file), NOOK_OK);
    size_t size = file.size;
    nook_file_free(&file);
    assert_int_equal(nook_journal_open(folder, &journal), NOOK_OK);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    small = (struct rlimit){ size + 10, before.rlim_max };
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    row.camera = "d";
    nook_log_capture_begin(&log);
    nook_result results_of[] = { nook_journal_append(&journal, &row), nook_journal_append(&journal, &row) };
    nook_log_capture_end();
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, handler);
    assert_int_equal(results_of[0], NOOK_E_IO);
    assert_int_equal(results_of[1], NOOK_E_IO);
    assert_int_equal(journal.file, -1);
    assert_int_equal(log.errors, 2);
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    assert_int_equal(file.size, size);
    nook_file_free(&file);
    append(folder, &row);
    nook_results results = must_read(folder);
    assert_int_equal(results.row_count, 2);
    nook_results_free(&results);
}

/* A journal may be a stranger's, and what it names is opened, copied and removed. */
static void test_pictures_outside_of_the_folder_are_forgotten(void **state)
{
    (void)state;
    char folder[PATH_CAPACITY], outside[PATH_CAPACITY + 64];
    nook_journal journal;
    nook_result_row row = make_row("c", "ssao", "b", 0.25);
    make_folder(folder, "foreign");
    row.picture = "pictures/../../outside.png";
    append(folder, &row);
    assert_int_equal(nook_directory_make(nook_path_join(outside, sizeof outside, folder, "pictures")), NOOK_OK);
    nook_path_join(outside, sizeof outside, folder, row.picture);
    assert_int_equal(nook_file_write(outside, "png", 3), NOOK_OK);
    nook_result_site site = { .scene = "s",
                              .scene_hash = "h",
                              .camera = "c",
                              .falloff = "hard",
                              .truth = "../outside.png",
                              .screen = "..",
                              .geometry = outside,
                              .lit = "pictures/a..b.png" };
    assert_int_equal(nook_journal_open(folder, &journal), NOOK_OK);
    assert_int_equal(nook_journal_append_site(&journal, &site), NOOK_OK);
    nook_journal_close(&journal);
    nook_results results = must_read(folder);
    assert_string_equal(results.rows[0].picture, "");
    assert_string_equal(results.sites[0].truth, "");
    assert_string_equal(results.sites[0].screen, "");
    assert_string_equal(results.sites[0].lit, "pictures/a..b.png");
    if (outside[0] == '/')
        assert_string_equal(results.sites[0].geometry, "");
    nook_results_free(&results);
}

static void must_refuse(const char *folder, const char *text, const char *reason)
{
    char path[PATH_CAPACITY + 64];
    nook_log_capture log;
    nook_results results = { .row_count = 77 };
    nook_path_join(path, sizeof path, folder, NOOK_JOURNAL_NAME);
    assert_int_equal(nook_file_write(path, text, strlen(text)), NOOK_OK);
    nook_log_capture_begin(&log);
    nook_result result = nook_results_read(folder, &results);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_FORMAT);
    assert_int_equal(results.row_count, 77);
    assert_int_equal(log.errors, 1);
    assert_non_null(strstr(log.text, reason));
}

static void test_a_damaged_line_is_refused_with_its_number(void **state)
{
    (void)state;
    char folder[PATH_CAPACITY];
    nook_result_row row = make_row("c", "ssao", "b", 0.25);
    append(make_folder(folder, "damaged"), &row);
    must_refuse(folder, "{ \"row\": { \"scene\": 5 } }\n", ":1: no result: scene is not a text");
    must_refuse(folder, "{ \"row\": { \"width\": -5 } }\n", ":1: no result: width is not a whole number");
    must_refuse(folder, "{ \"row\": { \"r_max\": \"1\" } }\n", ":1: no result: r_max is not a number");
    must_refuse(folder, "{ \"row\": 5 }\n", ":1: no result");
    must_refuse(folder, "{ \"row\": {} }\n{ \"what\": 5 }\n", ":2: neither a row nor a site");
    must_refuse(folder, "{ \"row\": {} }\n\nmore\n", NOOK_JOURNAL_NAME ":2");
}

static void test_a_folder_that_is_being_written_to_is_refused(void **state)
{
    (void)state;
    char folder[PATH_CAPACITY];
    nook_journal first, second;
    nook_log_capture log;
    assert_int_equal(nook_journal_open(make_folder(folder, "locked"), &first), NOOK_OK);
    nook_log_capture_begin(&log);
    nook_result result = nook_journal_open(folder, &second);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_IO);
    assert_int_equal(second.file, -1);
    assert_non_null(strstr(log.text, "--merge"));
    nook_journal_close(&first);
    assert_int_equal(nook_journal_open(folder, &second), NOOK_OK);
    nook_journal_close(&second);
}

static void test_merging_takes_what_is_missing_and_what_is_newer_with_its_pictures(void **state)
{
    (void)state;
    char ours[PATH_CAPACITY], theirs[PATH_CAPACITY], path[PATH_CAPACITY + 64];
    nook_journal journal;
    size_t taken = 0, left = 0;
    nook_result_row rows[] = { make_row("c", "ssao", "old", 0.1), make_row("d", "ssao", "now", 0.2) };
    make_folder(ours, "ours");
    make_folder(theirs, "theirs");
    append(ours, &rows[0]);
    append(ours, &rows[1]);
    nook_result_row others[] = { make_row("c", "ssao", "now", 0.3), make_row("d", "ssao", "now", 0.4),
                                 make_row("e", "ssao", "old", 0.5) };
    others[2].picture = "pictures/e.png";
    assert_int_equal(nook_directory_make(nook_path_join(path, sizeof path, theirs, "pictures")), NOOK_OK);
    assert_int_equal(nook_file_write(nook_path_join(path, sizeof path, theirs, others[2].picture), "png", 3), NOOK_OK);
    for (size_t i = 0; i < NOOK_COUNT(others); i++)
        append(theirs, &others[i]);
    nook_results results = must_read(ours);
    assert_int_equal(nook_journal_open(ours, &journal), NOOK_OK);
    assert_int_equal(nook_measure_merge(theirs, ours, "now", &results, &journal, &taken, &left), NOOK_OK);
    nook_journal_close(&journal);
    assert_int_equal(taken, 2);
    assert_int_equal(left, 1);
    nook_results_free(&results);
    results = must_read(ours); /* the journal has them too */
    assert_int_equal(results.row_count, 3);
    assert_true(nook_results_find(&results, &others[0])->sample.truth.rmse == 0.3);
    assert_true(nook_results_find(&results, &others[1])->sample.truth.rmse == 0.2);
    assert_true(nook_results_find(&results, &others[2])->sample.truth.rmse == 0.5);
    assert_true(nook_file_exists(nook_path_join(path, sizeof path, ours, others[2].picture)));
    assert_int_equal(nook_measure_drop_other_builds(&results, "now"), 1);
    assert_int_equal(results.row_count, 2);
    assert_null(nook_results_find(&results, &others[2]));
    nook_results_free(&results);
}

static void write_picture(const char *folder, const char *picture, const char *text)
{
    char path[PATH_CAPACITY + 64];
    assert_int_equal(nook_directory_make(nook_path_join(path, sizeof path, folder, "pictures")), NOOK_OK);
    assert_int_equal(nook_file_write(nook_path_join(path, sizeof path, folder, picture), text, strlen(text)), NOOK_OK);
}

static void assert_picture(const char *folder, const char *picture, const char *text)
{
    char path[PATH_CAPACITY + 64];
    nook_file file;
    assert_int_equal(nook_file_read(nook_path_join(path, sizeof path, folder, picture), &file), NOOK_OK);
    assert_string_equal((const char *)file.bytes, text);
    nook_file_free(&file);
}

/* Both folders have a picture of the row under one name. */
static void test_a_row_that_is_taken_brings_its_picture_and_one_that_is_left_does_not(void **state)
{
    (void)state;
    char ours[PATH_CAPACITY], theirs[PATH_CAPACITY];
    nook_journal journal;
    size_t taken = 0, left = 0;
    nook_result_row rows[] = { make_row("c", "ssao", "old", 0.1), make_row("d", "ssao", "now", 0.2) };
    nook_result_row others[] = { make_row("c", "ssao", "now", 0.3), make_row("d", "ssao", "now", 0.4) };
    rows[0].picture = others[0].picture = "pictures/c.png";
    rows[1].picture = others[1].picture = "pictures/d.png";
    make_folder(ours, "ours_pictured");
    make_folder(theirs, "theirs_pictured");
    for (size_t i = 0; i < 2; i++) {
        append(ours, &rows[i]);
        append(theirs, &others[i]);
        write_picture(ours, rows[i].picture, "ours");
        write_picture(theirs, others[i].picture, "theirs");
    }
    nook_results results = must_read(ours);
    assert_int_equal(nook_journal_open(ours, &journal), NOOK_OK);
    assert_int_equal(nook_measure_merge(theirs, ours, "now", &results, &journal, &taken, &left), NOOK_OK);
    nook_journal_close(&journal);
    nook_results_free(&results);
    assert_true(taken == 1 && left == 1);
    assert_picture(ours, "pictures/c.png", "theirs");
    assert_picture(ours, "pictures/d.png", "ours");
}

static void test_a_folder_without_rows_cannot_be_merged(void **state)
{
    (void)state;
    char folder[PATH_CAPACITY];
    nook_log_capture log;
    nook_results results = { 0 };
    nook_journal journal = { .file = -1 };
    size_t taken = 5, left = 0;
    nook_log_capture_begin(&log);
    nook_result result =
        nook_measure_merge(make_folder(folder, "empty"), folder, "b", &results, &journal, &taken, &left);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_NOT_FOUND);
    assert_int_equal(taken, 5);
    assert_int_equal(log.errors, 1);
}

static void test_csv_is_quoted_as_rfc_4180_says(void **state)
{
    (void)state;
    char folder[PATH_CAPACITY], path[PATH_CAPACITY + 64];
    nook_file file;
    nook_results results = { 0 };
    nook_result_row row = make_row("c", "ssao", "b", 0.25);
    assert_int_equal(nook_results_put(&results, &row), NOOK_OK);
    make_folder(folder, "tables");
    assert_int_equal(nook_results_write(&results, folder, "./nook measure"), NOOK_OK);
    assert_int_equal(nook_file_read(nook_path_join(path, sizeof path, folder, "measure.csv"), &file), NOOK_OK);
    const char *text = (const char *)file.bytes, *header_end = strstr(text, "\r\n");
    assert_non_null(header_end);
    assert_memory_equal(text, "scene,scene_hash,camera,width,height,r_max,", 43);
    static const char begin[] = "\"a \"\"scene\"\", two\nlines.glb\",0123456789abcdef,c,64,36,0.0333333333,";
    assert_memory_equal(header_end + 2, begin, sizeof begin - 1);
    size_t header_commas = 0, row_commas = 0;
    for (const char *p = text; p < header_end; p++)
        header_commas += *p == ',';
    for (const char *p = header_end; *p; p++)
        row_commas += *p == ',';
    assert_int_equal(row_commas, header_commas + 1); /* the one inside the quotes */
    assert_memory_equal(text + file.size - 2, "\r\n", 2);
    assert_null(strstr(text, "nan"));
    nook_file_free(&file);
    nook_results_free(&results);
}

static void test_json_has_rows_machine_date_and_command(void **state)
{
    (void)state;
    char folder[PATH_CAPACITY], path[PATH_CAPACITY + 64];
    nook_file file;
    nook_json_tree tree;
    nook_results results = { 0 };
    nook_result_row row = make_row("c", "ssao", "b", 0.25);
    nook_result_site site = { .scene = "s",
                              .scene_hash = "h",
                              .camera = "c",
                              .falloff = "hard",
                              .truth = "t.png",
                              .screen = "",
                              .geometry = "",
                              .lit = "",
                              .reference_noise = 0.5 };
    assert_int_equal(nook_results_put(&results, &row), NOOK_OK);
    assert_int_equal(nook_results_put_site(&results, &site), NOOK_OK);
    make_folder(folder, "tables");
    assert_int_equal(nook_results_write(&results, folder, "./nook measure 'x y'"), NOOK_OK);
    assert_int_equal(nook_file_read(nook_path_join(path, sizeof path, folder, "measure.json"), &file), NOOK_OK);
    assert_int_equal(nook_json_tree_read(path, (const char *)file.bytes, file.size, 8, &tree), NOOK_OK);
    assert_true(nook_json_tree_string_is(&tree, nook_json_tree_find(&tree, 0, "command"), "./nook measure 'x y'"));
    assert_true(nook_json_tree_string_is(&tree, nook_json_tree_find(&tree, 0, "machine"), "m"));
    assert_true(nook_json_tree_string_is(&tree, nook_json_tree_find(&tree, 0, "build"), "b"));
    assert_int_not_equal(nook_json_tree_find(&tree, 0, "date"), NOOK_JSON_NONE);
    uint32_t rows = nook_json_tree_find(&tree, 0, "rows"), sites = nook_json_tree_find(&tree, 0, "sites");
    assert_int_equal(tree.values[rows].count, 1);
    assert_int_equal(tree.values[sites].count, 1);
    assert_true(nook_json_tree_number(&tree, nook_json_tree_find(&tree, rows + 1, "rmse")) == 0.25);
    assert_true(nook_json_tree_string_is(&tree, nook_json_tree_find(&tree, sites + 1, "truth"), "t.png"));
    nook_json_tree_free(&tree);
    nook_file_free(&file);
    nook_results_free(&results);
}

static void test_results_are_believed_only_when_the_truth_is_quieter_than_a_quarter_of_every_error(void **state)
{
    (void)state;
    nook_results results = { 0 };
    nook_result_row row = make_row("c", "ssao", "b", 0.25);
    assert_null(nook_measure_judge(&results).worst);
    assert_int_equal(nook_results_put(&results, &row), NOOK_OK);
    nook_measure_verdict verdict = nook_measure_judge(&results);
    assert_true(fabs(verdict.largest_part - 0.004) < 1e-15 && verdict.over == 0 && verdict.non_finite == 0);
    assert_string_equal(verdict.worst_error, "RMSE");
    row = make_row("d", "ssao", "b", 0.003); /* 0.001 is a third of it */
    assert_int_equal(nook_results_put(&results, &row), NOOK_OK);
    verdict = nook_measure_judge(&results);
    assert_int_equal(verdict.over, 1);
    assert_string_equal(verdict.worst->camera, "d");
    row = make_row("e", "ssao", "b", NAN);
    row.sample.truth.non_finite = 3;
    row.sample.screen.non_finite = 100;
    row.sample.noise_non_finite = 10;
    row.sample.flicker_non_finite = 1000;
    row.sample.instability.non_finite = 20000;
    row.sample.outside = 7;
    row.sample.screen = (nook_errors){ .count = 9, .non_finite = 100, .valid = true, .rmse = 0.5, .mae = 0.5 };
    row.sample.screen_noise = 0.4;
    assert_int_equal(nook_results_put(&results, &row), NOOK_OK);
    verdict = nook_measure_judge(&results);
    assert_int_equal(verdict.over, 2);
    assert_true(isinf(verdict.largest_part) && verdict.non_finite == 21113 && verdict.outside == 7);
    row.sample.truth = (nook_errors){ .count = 9, .valid = true, .rmse = 0.1, .mae = 0.1 };
    row.sample.rmse_inside = row.sample.rmse_away = 0.1;
    assert_int_equal(nook_results_put(&results, &row), NOOK_OK);
    verdict = nook_measure_judge(&results);
    assert_true(verdict.largest_part == 0.8);
    assert_string_equal(verdict.worst_error, "RMSE against the screen's truth");
    nook_results_free(&results);
}

/* Whichever of them it is: all are told as errors. */
static void test_every_error_is_held_against_the_noise_of_its_own_pixels(void **state)
{
    (void)state;
    const char *error;
    nook_sample sample = make_row("c", "ssao", "b", 0.25).sample;
    assert_true(fabs(nook_measure_noise_part(&sample, false, NULL) - 0.004) < 1e-15);
    sample.truth.mae = 0.002; /* most pixels are right */
    assert_true(fabs(nook_measure_noise_part(&sample, false, &error) - 0.5 * sqrt(2.0 / acos(-1.0))) < 1e-12);
    assert_string_equal(error, "MAE");
    sample.noise_inside = 0.125;
    assert_true(nook_measure_noise_part(&sample, false, &error) == 0.5);
    assert_string_equal(error, "RMSE inside");
    sample.rmse_away = 0.001;
    assert_true(nook_measure_noise_part(&sample, false, &error) == 1.0);
    assert_string_equal(error, "RMSE away");
    sample.noise_outside = 0.5;
    sample.rmse_outside = 0.25;
    assert_true(nook_measure_noise_part(&sample, false, &error) == 2.0);
    assert_string_equal(error, "RMSE outside");
    sample.screen = (nook_errors){ .count = 9, .valid = true, .rmse = 0.5, .mae = 0.01 };
    sample.screen_noise = 0.01;
    assert_true(fabs(nook_measure_noise_part(&sample, true, &error) - sqrt(2.0 / acos(-1.0))) < 1e-12);
    assert_string_equal(error, "MAE against the screen's truth");
}

static void test_time_left_follows_from_the_rows_that_were_measured(void **state)
{
    (void)state;
    char out[32];
    assert_string_equal(nook_measure_time_left(0, 5, 1000.0, out), "");
    assert_string_equal(nook_measure_time_left(5, 0, 1000.0, out), "");
    assert_string_equal(nook_measure_time_left(10, 50, 10000.0, out), ", under a minute left");
    assert_string_equal(nook_measure_time_left(10, 121, 10000.0, out), ", 3 min left");
    assert_string_equal(nook_measure_time_left(1, 119, 60000.0, out), ", 119 min left");
    assert_string_equal(nook_measure_time_left(1, 241, 60000.0, out), ", 5 h left");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_row_comes_back_as_it_was_kept),
        cmocka_unit_test(test_of_two_lines_of_one_row_the_later_counts),
        cmocka_unit_test(test_sites_of_one_name_and_other_content_are_two),
        cmocka_unit_test(test_a_folder_without_a_journal_has_no_rows),
        cmocka_unit_test(test_a_line_cut_short_is_left_out_with_a_word_and_cut_away),
        cmocka_unit_test(test_a_line_that_finds_no_room_leaves_the_journal_as_it_was),
        cmocka_unit_test(test_pictures_outside_of_the_folder_are_forgotten),
        cmocka_unit_test(test_a_damaged_line_is_refused_with_its_number),
        cmocka_unit_test(test_a_folder_that_is_being_written_to_is_refused),
        cmocka_unit_test(test_merging_takes_what_is_missing_and_what_is_newer_with_its_pictures),
        cmocka_unit_test(test_a_row_that_is_taken_brings_its_picture_and_one_that_is_left_does_not),
        cmocka_unit_test(test_a_folder_without_rows_cannot_be_merged),
        cmocka_unit_test(test_csv_is_quoted_as_rfc_4180_says),
        cmocka_unit_test(test_json_has_rows_machine_date_and_command),
        cmocka_unit_test(test_results_are_believed_only_when_the_truth_is_quieter_than_a_quarter_of_every_error),
        cmocka_unit_test(test_every_error_is_held_against_the_noise_of_its_own_pixels),
        cmocka_unit_test(test_time_left_follows_from_the_rows_that_were_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
