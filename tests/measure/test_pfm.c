#include "engine/core/file.h"
#include "modules/measure/pfm.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[] = "/tmp/nook_test_pfm_XXXXXX";
static char path[sizeof folder + 16];

static int make_folder(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/test.pfm", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder);
}

static void test_pfm_round_trip_keeps_every_bit(void **state)
{
    (void)state;
    nook_grey grey, read;
    assert_int_equal(nook_grey_create(7, 3, &grey), NOOK_OK);
    for (int i = 0; i < 21; i++)
        grey.values[i] = (float)i / 3.0f;
    grey.values[5] = -INFINITY;
    grey.values[6] = NAN;
    grey.values[7] = 0x1p-149f;
    assert_int_equal(nook_pfm_write(&grey, path), NOOK_OK);
    assert_int_equal(nook_pfm_read(path, &read), NOOK_OK);
    assert_int_equal(read.width, 7);
    assert_int_equal(read.height, 3);
    assert_memory_equal(read.values, grey.values, 21 * sizeof(float));
    nook_grey_free(&grey);
    nook_grey_free(&read);
}

static void test_pfm_file_is_header_and_little_endian_rows_from_the_bottom(void **state)
{
    (void)state;
    nook_grey grey;
    nook_file file;
    assert_int_equal(nook_grey_create(1, 2, &grey), NOOK_OK);
    grey.values[0] = 1.0f; /* the bottom row */
    grey.values[1] = -2.0f;
    assert_int_equal(nook_pfm_write(&grey, path), NOOK_OK);
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    const uint8_t expected[] = "Pf\n1 2\n-1.0\n\0\0\x80\x3f\0\0\0\xc0";
    assert_int_equal(file.size, sizeof expected - 1);
    assert_memory_equal(file.bytes, expected, file.size);
    nook_file_free(&file);
    nook_grey_free(&grey);
}

static void test_pfm_read_takes_big_endian_files(void **state)
{
    (void)state;
    nook_grey grey;
    static const uint8_t bytes[] = "Pf\n1 1\n1.0\n\x3f\x80\0\0";
    assert_int_equal(nook_file_write(path, bytes, sizeof bytes - 1), NOOK_OK);
    assert_int_equal(nook_pfm_read(path, &grey), NOOK_OK);
    assert_true(grey.values[0] == 1.0f);
    nook_grey_free(&grey);
}

static void assert_refused(const void *bytes, size_t size, nook_result expected)
{
    float keep;
    nook_grey grey = { &keep, 11, 12 };
    assert_int_equal(nook_file_write(path, bytes, size), NOOK_OK);
    assert_int_equal(nook_pfm_read(path, &grey), expected);
    assert_ptr_equal(grey.values, &keep);
    assert_int_equal(grey.width, 11);
}

static void test_pfm_read_refuses_what_is_no_grey_float_map(void **state)
{
    (void)state;
    static const char *const broken[] = { "",
                                          "P",
                                          "PF\n1 1\n-1.0\n....",
                                          "Pf",
                                          "Pf\n1 1",
                                          "Pf\n1 1\n-1.0",
                                          "Pf\n1 1\n0.0\n....",
                                          "Pf\n1 1\nnan\n....",
                                          "Pf\n-1 1\n-1.0\n....",
                                          "Pf\n0 1\n-1.0\n",
                                          "Pf\n99999 99999\n-1.0\n....",
                                          "Pf\n1 1\n-1.0\n...",
                                          "Pf\n1 1\n-1.0\n....." };
    for (size_t i = 0; i < NOOK_COUNT(broken); i++)
        assert_refused(broken[i], strlen(broken[i]), NOOK_E_FORMAT);
}

static void test_pfm_read_reports_a_missing_file(void **state)
{
    (void)state;
    nook_grey grey;
    unlink(path);
    assert_int_equal(nook_pfm_read(path, &grey), NOOK_E_NOT_FOUND);
}

static void test_grey_create_refuses_absurd_sizes(void **state)
{
    (void)state;
    nook_grey grey;
    assert_int_equal(nook_grey_create(0, 4, &grey), NOOK_E_RANGE);
    assert_int_equal(nook_grey_create(4, NOOK_PFM_SIDE_MAX + 1, &grey), NOOK_E_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pfm_round_trip_keeps_every_bit),
        cmocka_unit_test(test_pfm_file_is_header_and_little_endian_rows_from_the_bottom),
        cmocka_unit_test(test_pfm_read_takes_big_endian_files),
        cmocka_unit_test(test_pfm_read_refuses_what_is_no_grey_float_map),
        cmocka_unit_test(test_pfm_read_reports_a_missing_file),
        cmocka_unit_test(test_grey_create_refuses_absurd_sizes),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
