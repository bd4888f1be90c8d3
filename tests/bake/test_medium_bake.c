/* Densities of a medium: they take as much as its cells do. */
#include "modules/bake/medium_bake.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static uint8_t voxel(const nook_volume *v, uint32_t x, uint32_t y, uint32_t z)
{
    return v->voxels[((size_t)z * v->info.height + y) * v->info.width + x];
}

/* The optical depth along a row of voxels in x. */
static double depth_along(const nook_volume *v, uint32_t y, uint32_t z)
{
    double sum = 0.0;
    for (uint32_t x = 0; x < v->info.width; x++)
        sum += voxel(v, x, y, z) / 255.0 * v->info.depth_of_255;
    return sum;
}

static void test_a_homogeneous_cube_lets_through_what_its_thickness_says(void **state)
{
    (void)state;
    float cells[8 * 8 * 8];
    for (size_t i = 0; i < 8 * 8 * 8; i++)
        cells[i] = 0.7f;
    const nook_medium medium = { { 8, 8, 8 }, { 0.25, 0.25, 0.25 }, cells };
    for (uint32_t resolution = 1; resolution <= 9; resolution++) {
        nook_volume v;
        assert_int_equal(nook_medium_bake(&medium, resolution, 1, &v), NOOK_OK);
        assert_int_equal(v.info.width, (resolution < 8 ? resolution : 8) + 2); /* none finer than the samples */
        assert_true(fabs(depth_along(&v, 1, 1) - 0.7 * 2.0) < 1e-6);
        assert_true(v.info.origin[0] == -v.info.voxel_size);
        nook_volume_free(&v);
    }
}

static void test_what_a_row_takes_stays_whatever_the_resolution(void **state)
{
    (void)state;
    float cells[30];
    double truth = 0.0;
    for (int i = 0; i < 30; i++) {
        cells[i] = (float)(i * 37 % 11);
        truth += (double)cells[i] * 0.1;
    }
    const nook_medium medium = { { 30, 1, 1 }, { 0.1, 3.0, 3.0 }, cells };
    for (uint32_t resolution = 2; resolution <= 30; resolution++) {
        nook_volume v;
        assert_int_equal(nook_medium_bake(&medium, resolution, 1, &v), NOOK_OK);
        double rounding = 0.5 / 255.0 * v.info.depth_of_255 * resolution;
        assert_true(fabs(depth_along(&v, 1, 1) - truth) <= rounding + 1e-5);
        nook_volume_free(&v);
    }
}

static void test_sides_have_voxels_as_long_as_they_are(void **state)
{
    (void)state;
    float cells[4 * 2 * 3];
    for (size_t i = 0; i < 24; i++)
        cells[i] = (float)i;
    const nook_medium medium = { { 4, 2, 3 }, { 0.5, 0.5, 1.0 }, cells };
    nook_volume v;
    assert_int_equal(nook_medium_bake(&medium, 256, 1, &v), NOOK_OK);
    assert_int_equal(v.info.width, 4 + 2);
    assert_int_equal(v.info.height, 2 + 2);
    assert_int_equal(v.info.depth, 6 + 2);
    assert_int_equal(v.info.kind, NOOK_VOLUME_DENSITY);
    assert_true(fabs(v.info.depth_of_255 - 23.0 * 0.5) < 1e-6);
    uint64_t occupied = 0;
    for (uint32_t z = 0; z < 8; z++)
        for (uint32_t y = 0; y < 4; y++)
            for (uint32_t x = 0; x < 6; x++) {
                bool inside = x > 0 && x < 5 && y > 0 && y < 3 && z > 0 && z < 7;
                float cell = inside ? cells[((z - 1) / 2 * 2 + y - 1) * 4 + x - 1] : 0.0f;
                assert_int_equal(voxel(&v, x, y, z), lroundf(255.0f * cell / 23.0f));
                occupied += voxel(&v, x, y, z) > 0;
            }
    assert_int_equal(v.info.occupied, occupied);
    nook_volume_free(&v);
}

static void test_threads_make_no_difference(void **state)
{
    (void)state;
    float cells[20 * 20 * 20];
    for (size_t i = 0; i < 8000; i++)
        cells[i] = (float)(i * 7919 % 1000) * 0.01f;
    const nook_medium medium = { { 20, 20, 20 }, { 0.1, 0.13, 0.17 }, cells };
    nook_volume one, many;
    assert_int_equal(nook_medium_bake(&medium, 17, 1, &one), NOOK_OK);
    assert_int_equal(nook_medium_bake(&medium, 17, 4, &many), NOOK_OK);
    assert_memory_equal(&one.info, &many.info, sizeof one.info);
    assert_memory_equal(one.voxels, many.voxels, (size_t)one.info.width * one.info.height * one.info.depth);
    nook_volume_free(&one);
    nook_volume_free(&many);
}

static void test_what_takes_nothing_is_empty(void **state)
{
    (void)state;
    const float cells[8] = { 0 };
    const nook_medium medium = { { 2, 2, 2 }, { 1, 1, 1 }, cells };
    nook_volume v;
    assert_int_equal(nook_medium_bake(&medium, 64, 1, &v), NOOK_OK);
    assert_int_equal(v.info.occupied, 0);
    assert_true(v.info.depth_of_255 == 0.0);
    nook_volume_free(&v);
}

static void test_what_takes_less_than_a_gpu_tells_from_nothing_is_empty_and_what_takes_most_stays_finite(void **state)
{
    (void)state;
    const float least[1] = { 1e-38f }, most[2] = { 3e38f, 1.5e38f };
    const nook_medium thin = { { 1, 1, 1 }, { 1e-3, 1e-3, 1e-3 }, least };
    const nook_medium thick = { { 2, 1, 1 }, { 10, 10, 10 }, most };
    nook_volume v;
    assert_int_equal(nook_medium_bake(&thin, 1, 1, &v), NOOK_OK);
    assert_int_equal(v.info.occupied, 0);
    assert_true(v.info.depth_of_255 == 0.0);
    nook_volume_free(&v);
    assert_int_equal(nook_medium_bake(&thick, 2, 1, &v), NOOK_OK);
    const uint8_t *row = v.voxels + ((size_t)v.info.height + 1) * v.info.width;
    assert_int_equal(row[1], 255);
    assert_int_equal(row[2], 128);
    assert_true(isfinite((float)v.info.depth_of_255));
    nook_volume_free(&v);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_homogeneous_cube_lets_through_what_its_thickness_says),
        cmocka_unit_test(test_what_a_row_takes_stays_whatever_the_resolution),
        cmocka_unit_test(test_sides_have_voxels_as_long_as_they_are),
        cmocka_unit_test(test_threads_make_no_difference),
        cmocka_unit_test(test_what_takes_nothing_is_empty),
        cmocka_unit_test(test_what_takes_less_than_a_gpu_tells_from_nothing_is_empty_and_what_takes_most_stays_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
