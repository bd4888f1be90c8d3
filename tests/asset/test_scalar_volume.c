#include "engine/asset/scalar_volume.h"
#include "engine/core/file.h"
#include "tests/support/log_capture.h"
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

/* ---- Files of our own -------------------------------------------------------------------------------------------- */

static void write_scratch(const char *name, const void *bytes, size_t size, char path[512])
{
    nook_scratch_path(path, 512, name);
    assert_int_equal(nook_file_write(path, bytes, size), NOOK_OK);
}

/* Loads a header (text) with `size` data bytes behind it; counts the lines that were logged. */
static nook_result load_text(const char *header, const void *data, size_t size, nook_scalar_volume *out,
                             nook_log_capture *log)
{
    char path[512];
    char bytes[2048];
    int header_size = snprintf(bytes, sizeof bytes, "%s", header);
    assert_true(header_size >= 0 && (size_t)header_size + size <= sizeof bytes);
    if (size > 0)
        memcpy(bytes + header_size, data, size);
    write_scratch("test.nrrd", bytes, (size_t)header_size + size, path);
    nook_log_capture_begin(log);
    nook_result result = nook_scalar_volume_load(path, out);
    nook_log_capture_end();
    remove(path);
    return result;
}

static const uint8_t eight[8] = { 11, 20, 30, 40, 50, 60, 70, 80 };

/* Refused with one line, that names `word`; the output is untouched. */
static void assert_refused_with(const char *header, size_t data_size, const char *word)
{
    nook_scalar_volume volume = { .samples = &volume }, before = volume;
    nook_log_capture log;
    nook_result result = load_text(header, eight, data_size, &volume, &log);
    if (result == NOOK_OK || log.count != 1 || !strstr(log.text, word) || strchr(log.text, '\n'))
        fail_msg("%s-> %d, %d lines: %s", header, result, log.count, log.text);
    assert_memory_equal(&volume, &before, sizeof volume);
}

static void assert_refused(const char *header, const char *word)
{
    assert_refused_with(header, sizeof eight, word);
}

#define GOOD "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\n"

static void test_raw_bytes_become_samples(void **state)
{
    (void)state;
    nook_scalar_volume v;
    nook_log_capture log;
    assert_int_equal(load_text(GOOD "encoding: raw\n\n", eight, 8, &v, &log), NOOK_OK);
    assert_int_equal(log.count, 0);
    assert_int_equal(v.dimension, 3);
    assert_int_equal(v.components, 1);
    assert_int_equal(v.sample_count, 8);
    for (size_t i = 0; i < 8; i++)
        assert_true(nook_scalar_volume_sample(&v, i) == eight[i]);
    assert_true(v.minimum == 11.0 && v.maximum == 80.0);
    assert_true(v.spacing[0] == 1.0 && v.spacing[1] == 1.0 && v.spacing[2] == 1.0);
    nook_scalar_volume_free(&v);
    nook_scalar_volume_free(&v);
    nook_scalar_volume_free(NULL);
}

static void test_field_names_may_be_in_capitals_and_keys_are_free(void **state)
{
    (void)state;
    nook_scalar_volume v;
    nook_log_capture log;
    const char *header = "NRRD0005\n# type: float\nTYPE: uint8\nDimension: 2\nsizes: 4 2\nencoding: raw\n"
                         "key with: colon:=value\nspacings: 2 -3\n\n";
    assert_int_equal(load_text(header, eight, 8, &v, &log), NOOK_OK);
    assert_int_equal(log.count, 1); /* the sign */
    assert_int_equal(log.level, NOOK_LOG_WARNING);
    assert_int_equal(v.size[0], 4);
    assert_int_equal(v.size[1], 2);
    assert_int_equal(v.size[2], 1);
    assert_true(v.spacing[0] == 2.0 && v.spacing[1] == 3.0 && v.spacing[2] == 1.0);
    nook_scalar_volume_free(&v);
}

static void test_space_directions_that_turn_are_warned_about(void **state)
{
    (void)state;
    nook_scalar_volume v;
    nook_log_capture log;
    const char *header = "NRRD0005\ntype: uint8\ndimension: 3\nspace dimension: 3\nsizes: 2 2 2\n"
                         "space directions: (3,4,0) (0,1,0) (0,0,2)\nencoding: raw\n\n";
    assert_int_equal(load_text(header, eight, 8, &v, &log), NOOK_OK);
    assert_int_equal(log.count, 1);
    assert_true(v.spacing[0] == 5.0 && v.spacing[1] == 1.0 && v.spacing[2] == 2.0);
    nook_scalar_volume_free(&v);
}

static void test_headers_that_cannot_be_are_refused(void **state)
{
    (void)state;
    assert_refused("", "not an NRRD");
    assert_refused("NRRD0006\n\n", "not an NRRD");
    assert_refused("NRRD0004\n\n", "no field 'type'");
    assert_refused_with(GOOD "encoding: raw\n", 0, "blank line");
    assert_refused(GOOD "\n", "no field 'encoding'");
    assert_refused(GOOD "encoding: lzma\n\n", "encoding 'lzma'");
    assert_refused(GOOD "encoding: raw\nsizes: 2 2 2\n\n", "twice");
    assert_refused(GOOD "encoding: raw\nnonsense\n\n", "nonsense");
    assert_refused(GOOD "encoding: raw\nnew field: 3\n\n", "new field");
    assert_refused(GOOD "encoding: raw\nlabels:=3\n\n", "needs ': '");
    assert_refused(GOOD "encoding: raw\nbyte skip: many\n\n", "byte skip");
    assert_refused(GOOD "encoding: raw\nbyte skip: -2\n\n", "byte skip");
    assert_refused(GOOD "encoding: gzip\nbyte skip: -1\n\n", "raw data only");
    assert_refused(GOOD "encoding: raw\nendian: middle\n\n", "endian");
    assert_refused(GOOD "encoding: raw\nspacings: 1 0 1\n\n", "spacing");
    assert_refused("NRRD0004\ntype: block\ndimension: 1\nsizes: 8\nencoding: raw\n\n", "type 'block'");
    assert_refused("NRRD0004\ntype: ushort\ndimension: 1\nsizes: 4\nencoding: raw\n\n", "endian");
}

static void test_sizes_that_cannot_be_are_refused(void **state)
{
    (void)state;
#define SIZES(dimension, sizes) "NRRD0004\ntype: uchar\ndimension: " dimension "\nsizes: " sizes "\nencoding: raw\n\n"
    assert_refused(SIZES("0", ""), "dimension");
    assert_refused(SIZES("5", "1 1 1 1 8"), "dimension");
    assert_refused(SIZES("3", "2 2"), "sizes");
    assert_refused(SIZES("3", "2 2 2 2"), "sizes");
    assert_refused(SIZES("3", "2 0 2"), "sizes");
    assert_refused(SIZES("3", "2 -2 2"), "sizes");
    assert_refused(SIZES("3", "2 2.0 2"), "sizes");
    assert_refused(SIZES("3", "2 2 3"), "cut short");
    assert_refused(SIZES("3", "65536 65536 65536"), "more than");
    assert_refused(SIZES("3", "4294967296 4294967296 16"), "more than");
    assert_refused(SIZES("3", "99999999999999999999999999 1 1"), "more than");
    assert_refused(SIZES("4", "17 1 1 1"), "series");
    assert_refused("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1000 1000 1000\nencoding: gzip\n\n", "cut short");
    assert_refused("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: hex\n\n", "cut short");
    assert_refused("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\n\n", "cut short");
#undef SIZES
}

static void test_text_that_is_no_number_is_named_in_one_line(void **state)
{
    (void)state;
    static const char text[] = "1 2 3 four\n5 6 7 8", ends[] = "1 2 3 4 5            ";
    nook_scalar_volume v;
    nook_log_capture log;
    assert_int_equal(load_text(GOOD "encoding: ascii\n\n", text, strlen(text), &v, &log), NOOK_E_FORMAT);
    assert_int_equal(log.count, 1);
    assert_non_null(strstr(log.text, "sample 4 of 8, 'four', is not a number"));
    assert_int_equal(load_text(GOOD "encoding: ascii\n\n", ends, strlen(ends), &v, &log), NOOK_E_FORMAT);
    assert_non_null(strstr(log.text, "cut short: 5 of 8"));
}

static void test_data_files_outside_the_folder_are_refused(void **state)
{
    (void)state;
    static const char *const names[] = { "/etc/passwd",
                                         "../x",
                                         "a/../../x",
                                         "..",
                                         "-",
                                         "%s%n 0 3 1",
                                         "%d%d 0 1 1",
                                         "%5000d 0 1 1",
                                         "..\\x",
                                         "%02d 0 3",
                                         "../%d.raw 0 3 1",
                                         "%d 3 0 1",
                                         "%d 0 3 0",
                                         "%d 0 999999999 1",
                                         "x%n",
                                         "%d.raw",
                                         "%d -3 0 1" };
    for (size_t i = 0; i < NOOK_COUNT(names); i++) {
        char header[256];
        snprintf(header, sizeof header, GOOD "encoding: raw\ndata file: %s\n\n", names[i]);
        assert_refused(header, "data file");
        snprintf(header, sizeof header, GOOD "encoding: raw\nDataFile: %s\n\n", names[i]);
        assert_refused(header, "data file");
    }
    assert_refused(GOOD "encoding: raw\ndata file: LIST\n/etc/passwd\n", "data file");
    assert_refused(GOOD "encoding: raw\ndata file: LIST\nx/../../y\n", "data file");
    assert_refused(GOOD "encoding: raw\ndata file: nowhere.raw\n\n", "does not exist");
    assert_refused(GOOD "encoding: raw\ndata file: .\n\n", "regular file");
    /* What other readers may take for the same field. */
    assert_refused(GOOD "encoding: raw\ndata file:=/etc/passwd\n\n", "needs ': '");
    assert_refused(GOOD "encoding: raw\ndata file:/etc/passwd\n\n", "needs ': '");
    assert_refused(GOOD "encoding: raw\n data file: /etc/passwd\n\n", "neither");
    assert_refused(GOOD "encoding: raw\ndata  file: /etc/passwd\n\n", "neither");
}

static void test_every_shorter_file_is_refused(void **state)
{
    (void)state;
    static const char whole[] = GOOD "encoding: raw\n\nabcdefgh";
    nook_log_capture log;
    for (size_t size = 0; size < sizeof whole - 1; size++) {
        char path[512];
        nook_scalar_volume v;
        write_scratch("short.nrrd", whole, size, path);
        nook_log_capture_begin(&log);
        nook_result result = nook_scalar_volume_load(path, &v);
        nook_log_capture_end();
        remove(path);
        assert_int_not_equal(result, NOOK_OK);
        assert_int_equal(log.count, 1);
    }
}

static void test_no_changed_byte_of_a_header_crashes(void **state)
{
    (void)state;
    static const char whole[] = "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 1\nendian: big\nspacings: 1 2 3\n"
                                "encoding: ascii\nunits: \"mm\" \"mm\" \"mm\"\n\n 1 -2 3 4 ";
    static const char others[] = { 0, '\n', '\r', ' ', ':', '=', '%', '-', '9', '"', '(', (char)0xff };
    char bytes[sizeof whole];
    nook_log_capture log;
    for (size_t at = 0; at < sizeof whole - 1; at++)
        for (size_t i = 0; i < sizeof others; i++) {
            char path[512];
            nook_scalar_volume v = { 0 };
            memcpy(bytes, whole, sizeof whole);
            bytes[at] = others[i];
            write_scratch("changed.nrrd", bytes, sizeof whole - 1, path);
            nook_log_capture_begin(&log);
            nook_result result = nook_scalar_volume_load(path, &v);
            nook_log_capture_end();
            remove(path);
            assert_true(result == NOOK_OK || log.count >= 1);
            nook_scalar_volume_free(&v);
        }
}

static void test_missing_file_and_directory_are_refused(void **state)
{
    (void)state;
    nook_scalar_volume v;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_scalar_volume_load("no such file.nrrd", &v), NOOK_E_NOT_FOUND);
    assert_int_equal(nook_scalar_volume_load(".", &v), NOOK_E_IO);
    nook_log_capture_end();
    assert_int_equal(log.count, 2);
}

static void test_bare_samples_need_exactly_their_bytes(void **state)
{
    (void)state;
    char path[512];
    nook_scalar_volume v;
    nook_log_capture log;
    const uint32_t two[3] = { 2, 2, 2 }, three[3] = { 3, 1, 1 }, none[3] = { 2, 0, 2 },
                   huge[3] = { 4000000000u, 4000000000u, 4000000000u };
    write_scratch("bare.raw", eight, 8, path);
    assert_int_equal(nook_scalar_volume_load_raw(path, NOOK_SAMPLE_U8, two, &v), NOOK_OK);
    assert_true(nook_scalar_volume_sample(&v, 7) == 80.0 && v.minimum == 11.0);
    nook_scalar_volume_free(&v);
    nook_log_capture_begin(&log);
    assert_int_equal(nook_scalar_volume_load_raw(path, NOOK_SAMPLE_U16, two, &v), NOOK_E_FORMAT);
    assert_int_equal(nook_scalar_volume_load_raw(path, NOOK_SAMPLE_U8, three, &v), NOOK_E_FORMAT);
    assert_int_equal(nook_scalar_volume_load_raw(path, NOOK_SAMPLE_U8, none, &v), NOOK_E_FORMAT);
    assert_int_equal(nook_scalar_volume_load_raw(path, NOOK_SAMPLE_U8, huge, &v), NOOK_E_FORMAT);
    nook_log_capture_end();
    assert_int_equal(log.count, 4);
    remove(path);
}

/* ---- The shared files ---------------------------------------------------------------------------------------------- */

static const char *shared_folder(void)
{
    const char *folder = getenv("NOOK_SHARED");
    if (!folder || !nook_directory_exists(folder)) {
        print_message("NOOK_SHARED is not set or names no folder: no shared scenes\n");
        skip();
    }
    return folder;
}

static uint32_t crc32_of(const void *data, size_t size)
{
    const uint8_t *bytes = data;
    uint32_t crc = UINT32_MAX;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0);
    }
    return ~crc;
}

/* Splits at tabs, in place; keeps empty fields. @return how many */
static int split_tabs(char *line, char **fields, int most)
{
    int count = 0;
    for (char *at = line; at && count < most;) {
        char *tab = strchr(at, '\t');
        fields[count++] = at;
        if (tab)
            *tab++ = 0;
        at = tab;
    }
    return count;
}

static char *read_text(const char *folder, const char *name)
{
    char path[1024];
    nook_file file;
    nook_path_join(path, sizeof path, folder, name);
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    return (char *)file.bytes;
}

static const char *type_of_row(const char *name)
{
    return strcmp(name, ">f8") == 0 ? "float64" : strcmp(name, ">u2") == 0 ? "uint16" : name;
}

static void shape_text(const nook_scalar_volume *v, char out[64])
{
    int at = v->components > 1 ? snprintf(out, 64, "%ux", v->components) : 0;
    for (uint32_t axis = 0; axis < (v->components > 1 ? v->dimension - 1 : v->dimension); axis++)
        at += snprintf(out + at, (size_t)(64 - at), "%s%u", axis ? "x" : "", v->size[axis]);
}

/* One row of index.tsv: file kind sizes type encoding - - - min max crc32 spacing bytes */
static void check_row(const char *shared, char **row)
{
    char path[1024], shape[64];
    nook_scalar_volume v;
    nook_path_join(path, sizeof path, shared, "scenes");
    nook_path_join(path + strlen(path), sizeof path - strlen(path), "/", row[0]);
    assert_int_equal(nook_scalar_volume_load(path, &v), NOOK_OK);
    shape_text(&v, shape);
    double low = atof(row[8]), high = atof(row[9]);
    uint32_t crc = crc32_of(v.samples, v.sample_count * nook_sample_type_size(v.type));
    if (strcmp(shape, row[2]) != 0 || strcmp(nook_sample_type_name(v.type), type_of_row(row[3])) != 0 ||
        crc != (uint32_t)strtoul(row[10], NULL, 16) || fabs(v.minimum - low) > 1e-6 * fabs(low) ||
        fabs(v.maximum - high) > 1e-6 * fabs(high))
        fail_msg("%s: %s %s, %g to %g, crc %08x", row[0], shape, nook_sample_type_name(v.type), v.minimum, v.maximum,
                 crc);
    nook_scalar_volume_free(&v);
}

static void test_all_nrrd_files_of_the_index_load_as_it_says(void **state)
{
    (void)state;
    const char *shared = shared_folder();
    char *index = read_text(shared, "scenes/index.tsv"), *save = NULL;
    int rows = 0;
    for (char *line = strtok_r(index, "\n", &save); line; line = strtok_r(NULL, "\n", &save)) {
        char *row[16];
        if (split_tabs(line, row, 16) < 13 || strcmp(row[1], "nrrd") != 0)
            continue;
        check_row(shared, row);
        rows++;
    }
    free(index);
    assert_true(rows > 0);
}

static nook_scalar_volume load_shared(const char *shared, const char *name)
{
    char path[1024];
    nook_scalar_volume v;
    snprintf(path, sizeof path, "%s/scenes/nrrd-tests/%s", shared, name);
    assert_int_equal(nook_scalar_volume_load(path, &v), NOOK_OK);
    return v;
}

static void test_spacing_comes_from_either_field_and_nan_means_one(void **state)
{
    (void)state;
    const char *shared = shared_folder();
    nook_scalar_volume v = load_shared(shared, "space_directions.nrrd");
    assert_true(v.spacing[0] == 0.5 && v.spacing[1] == 0.75 && v.spacing[2] == 2.0);
    nook_scalar_volume_free(&v);
    v = load_shared(shared, "spacings_and_keyvalues.nrrd");
    assert_true(v.spacing[0] == 0.5 && v.spacing[1] == 0.75 && v.spacing[2] == 2.0);
    nook_scalar_volume_free(&v);
    v = load_shared(shared, "spacing_nan.nrrd");
    assert_true(v.spacing[0] == 1.0 && v.spacing[1] == 1.0 && v.spacing[2] == 1.0);
    nook_scalar_volume_free(&v);
}

static void test_samples_that_are_not_finite_are_counted_and_not_in_the_range(void **state)
{
    (void)state;
    nook_scalar_volume v = load_shared(shared_folder(), "f32_with_nan_inf.nrrd");
    assert_int_equal(v.not_finite, 3);
    assert_true(isnan(nook_scalar_volume_sample(&v, 0)));
    assert_true(isfinite(v.minimum) && isfinite(v.maximum));
    nook_scalar_volume_free(&v);
}

static void test_trailing_bytes_are_warned_about(void **state)
{
    (void)state;
    const char *shared = shared_folder();
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_scalar_volume v = load_shared(shared, "trailing_bytes.nrrd");
    nook_log_capture_end();
    assert_int_equal(log.count, 1);
    assert_int_equal(log.level, NOOK_LOG_WARNING);
    nook_scalar_volume_free(&v);
}

static void test_first_axis_of_four_is_components(void **state)
{
    (void)state;
    nook_scalar_volume v = load_shared(shared_folder(), "four_d_rgb.nrrd");
    assert_int_equal(v.components, 3);
    assert_int_equal(v.size[0], 8);
    assert_int_equal(v.size[2], 6);
    for (size_t voxel = 0; voxel < 8 * 7 * 6; voxel++) {
        double value = (double)(voxel % 251); /* expected.txt */
        assert_true(nook_scalar_volume_sample(&v, voxel * 3) == value);
        assert_true(nook_scalar_volume_sample(&v, voxel * 3 + 1) == 255.0 - value);
        assert_true(nook_scalar_volume_sample(&v, voxel * 3 + 2) == floor(value / 2.0));
    }
    nook_scalar_volume_free(&v);
}

/* One row of malformed/manifest.tsv: file, what is wrong with it, verdict. */
static void check_verdict(const char *shared, const char *name, const char *verdict)
{
    char path[1024];
    const uint32_t four[3] = { 4, 4, 4 };
    nook_scalar_volume v = { 0 };
    nook_log_capture log;
    snprintf(path, sizeof path, "%s/scenes/malformed/%s", shared, name);
    nook_log_capture_begin(&log);
    nook_result result = strncmp(name, "raw_", 4) == 0 ? nook_scalar_volume_load_raw(path, NOOK_SAMPLE_U8, four, &v)
                                                       : nook_scalar_volume_load(path, &v);
    nook_log_capture_end();
    bool loaded = result == NOOK_OK, clean = log.count == 0, one_error = log.count == 1 && log.level == NOOK_LOG_ERROR;
    bool met = false;
    if (strcmp(verdict, "load") == 0)
        met = loaded && clean;
    else if (strncmp(verdict, "accept either", 13) == 0)
        met = loaded || one_error;
    else if (strcmp(verdict, "reject or load with warning") == 0)
        met = loaded ? log.count > 0 && log.level == NOOK_LOG_WARNING : one_error;
    else if (strncmp(verdict, "reject", 6) == 0)
        met = !loaded && one_error;
    if (!met)
        fail_msg("%s: wanted '%s', got %d and %d lines: %s", name, verdict, result, log.count, log.text);
    nook_scalar_volume_free(&v);
}

static void test_every_malformed_file_meets_its_verdict(void **state)
{
    (void)state;
    const char *shared = shared_folder();
    char *manifest = read_text(shared, "scenes/malformed/manifest.tsv"), *save = NULL;
    int rows = 0;
    for (char *line = strtok_r(manifest, "\n", &save); line; line = strtok_r(NULL, "\n", &save)) {
        char *row[4];
        if (split_tabs(line, row, 4) < 3 || (strncmp(row[0], "nrrd_", 5) != 0 && strncmp(row[0], "raw_", 4) != 0))
            continue;
        check_verdict(shared, row[0], row[2]);
        rows++;
    }
    free(manifest);
    assert_true(rows > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_raw_bytes_become_samples),
        cmocka_unit_test(test_field_names_may_be_in_capitals_and_keys_are_free),
        cmocka_unit_test(test_space_directions_that_turn_are_warned_about),
        cmocka_unit_test(test_headers_that_cannot_be_are_refused),
        cmocka_unit_test(test_sizes_that_cannot_be_are_refused),
        cmocka_unit_test(test_text_that_is_no_number_is_named_in_one_line),
        cmocka_unit_test(test_data_files_outside_the_folder_are_refused),
        cmocka_unit_test(test_every_shorter_file_is_refused),
        cmocka_unit_test(test_no_changed_byte_of_a_header_crashes),
        cmocka_unit_test(test_missing_file_and_directory_are_refused),
        cmocka_unit_test(test_bare_samples_need_exactly_their_bytes),
        cmocka_unit_test(test_all_nrrd_files_of_the_index_load_as_it_says),
        cmocka_unit_test(test_spacing_comes_from_either_field_and_nan_means_one),
        cmocka_unit_test(test_samples_that_are_not_finite_are_counted_and_not_in_the_range),
        cmocka_unit_test(test_trailing_bytes_are_warned_about),
        cmocka_unit_test(test_first_axis_of_four_is_components),
        cmocka_unit_test(test_every_malformed_file_meets_its_verdict),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
