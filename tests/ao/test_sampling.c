/* Ray directions: cosine weighted, and every block and all blocks together evenly spread. */
#include "engine/core/angle.h"
#include "engine/core/result.h"
#include "modules/ao/sampling.h"
#include <math.h>
#include <stdlib.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const uint32_t seeds[] = { 0, 1, 2, 1234567, 0xffffffffu };

/** 2^m points from `first` on: each of the boxes 2^-a by 2^(a-m) of the unit square, for every a, holds one. */
static void expect_one_point_in_every_elementary_box(uint32_t first, uint32_t m, uint32_t seed)
{
    uint32_t count = 1u << m;
    uint8_t *hits = malloc(count);
    assert_non_null(hits);
    for (uint32_t a = 0; a <= m; a++) {
        for (uint32_t i = 0; i < count; i++)
            hits[i] = 0;
        for (uint32_t i = 0; i < count; i++) {
            float point[2];
            nook_sobol_point(first + i, seed, point);
            assert_true(point[0] > 0.0f && point[0] < 1.0f && point[1] > 0.0f && point[1] < 1.0f);
            uint32_t column = (uint32_t)(point[0] * (float)(1u << a)),
                     row = (uint32_t)(point[1] * (float)(1u << (m - a)));
            hits[(row << a) + column]++;
        }
        for (uint32_t i = 0; i < count; i++) {
            if (hits[i] != 1)
                fail_msg("seed %u, points %u + %u, boxes of 2^-%u: box %u holds %d", seed, first, count, a, i, hits[i]);
        }
    }
    free(hits);
}

static void test_sampling_puts_one_point_of_a_block_in_every_elementary_box(void **state)
{
    (void)state;
    for (size_t s = 0; s < NOOK_COUNT(seeds); s++) {
        for (uint32_t m = 0; m <= 8; m++) {
            for (uint32_t block = 0; block < NOOK_DIRECTION_BLOCKS; block++)
                expect_one_point_in_every_elementary_box(block << m, m, seeds[s]);
        }
    }
}

static void test_sampling_puts_one_point_of_all_blocks_in_every_elementary_box(void **state)
{
    (void)state;
    for (size_t s = 0; s < NOOK_COUNT(seeds); s++) {
        for (uint32_t m = 0; m <= 8; m++)
            expect_one_point_in_every_elementary_box(0, m + 4, seeds[s]);
    }
}

static float *fill(uint32_t rays, uint32_t seed)
{
    float *directions = malloc((size_t)rays * NOOK_DIRECTION_BLOCKS * 4 * sizeof *directions);
    assert_non_null(directions);
    nook_fill_directions(rays, seed, 0, directions);
    return directions;
}

/** The directions of one block of 2^k parts by their place on the square, counted in 2^-a by 2^-(m-a) boxes. @return boxes that hold none */
static uint32_t count_empty_boxes(uint32_t rays, uint32_t m, uint32_t block, uint32_t a)
{
    uint32_t parts = (1u << m) / rays, empty = 0;
    uint8_t hits[256] = { 0 };
    float *directions = malloc((size_t)rays * NOOK_DIRECTION_BLOCKS * 4 * sizeof *directions);
    assert_non_null(directions);
    assert_true(m <= 8);
    for (uint32_t part = 0; part < parts; part++) {
        nook_fill_directions(rays, seeds[3], part, directions); /* shifted: no point lies on an edge */
        for (uint32_t i = 0; i < rays; i++) {
            const float *d = directions + (block * rays + i) * 4;
            double turn = atan2((double)d[1], (double)d[0]) / (2.0 * NOOK_PI);
            double square[2] = { (double)(d[0] * d[0] + d[1] * d[1]), turn < 0.0 ? turn + 1.0 : turn };
            uint32_t column = (uint32_t)fmin(square[0] * (1u << a), (1u << a) - 1u);
            uint32_t row = (uint32_t)fmin(square[1] * (1u << (m - a)), (1u << (m - a)) - 1u);
            hits[(row << a) + column]++;
        }
    }
    free(directions);
    for (uint32_t i = 0; i < 1u << m; i++)
        empty += hits[i] == 0;
    return empty;
}

/** Without moves between blocks they would all lie in a sixteenth of one axis. */
static void test_sampling_puts_one_point_of_a_block_over_16_parts_in_every_elementary_box(void **state)
{
    (void)state;
    for (uint32_t bits = 0; bits <= 4; bits++) {
        const uint32_t m = bits + 4, first = bits <= 2 ? 0 : m; /* of 8 and 16 rays each along the first axis only */
        for (uint32_t block = 0; block < NOOK_DIRECTION_BLOCKS; block++) {
            for (uint32_t a = first; a <= m; a++)
                assert_int_equal(count_empty_boxes(1u << bits, m, block, a), 0);
        }
    }
}

static void test_sampling_puts_one_point_of_all_blocks_of_a_part_in_every_elementary_box(void **state)
{
    (void)state;
    for (uint32_t m = 0; m <= 4; m++) {
        for (uint32_t part = 0; part < 64; part++)
            expect_one_point_in_every_elementary_box(part << (m + 4), m + 4, 0);
    }
}

static void test_sampling_directions_are_unit_and_above_the_horizon(void **state)
{
    (void)state;
    for (uint32_t rays = 1; rays <= 4096; rays = rays * 4 + 1) {
        float *directions = fill(rays, rays);
        for (uint32_t i = 0; i < rays * NOOK_DIRECTION_BLOCKS; i++) {
            const float *d = directions + (size_t)i * 4;
            assert_true(fabs((double)d[0] * d[0] + (double)d[1] * d[1] + (double)d[2] * d[2] - 1.0) < 1e-6);
            assert_true(d[2] > 0.0f && d[3] == 0.0f);
        }
        free(directions);
    }
}

static void test_sampling_directions_differ_from_seed_to_seed(void **state)
{
    (void)state;
    for (size_t s = 1; s < NOOK_COUNT(seeds); s++) {
        float a[2], b[2];
        nook_sobol_point(5, seeds[s - 1], a);
        nook_sobol_point(5, seeds[s], b);
        assert_true(a[0] != b[0] && a[1] != b[1]);
    }
}

static void test_sampling_of_each_block_integrates_the_cosine_hemisphere(void **state)
{
    (void)state;
    enum { RAYS = 1024 };
    for (size_t s = 0; s < NOOK_COUNT(seeds); s++) {
        float *directions = fill(RAYS, seeds[s]);
        for (uint32_t block = 0; block < NOOK_DIRECTION_BLOCKS; block++) {
            double z = 0.0, x2 = 0.0, xy = 0.0, cap = 0.0, wall = 0.0;
            for (uint32_t i = 0; i < RAYS; i++) {
                const float *d = directions + ((size_t)block * RAYS + i) * 4;
                z += (double)d[2] / RAYS;
                x2 += (double)d[0] * d[0] / RAYS;
                xy += (double)d[0] * d[1] / RAYS;
                cap += d[2] > 0.8f ? 1.0 / RAYS : 0.0;         /* a disc overhead: sin^2 of its angle */
                wall += d[0] > 0.5f * d[2] ? 1.0 / RAYS : 0.0; /* a half-plane over p: (1 - e / sqrt(e^2 + H^2)) / 2 */
            }
            assert_true(fabs(z - 2.0 / 3.0) < 1e-3);
            assert_true(fabs(x2 - 0.25) < 1e-3);
            assert_true(fabs(xy) < 2e-3);
            assert_true(fabs(cap - 0.36) < 2e-3);
            assert_true(fabs(wall - (1.0 - 0.5 / sqrt(1.25)) / 2.0) < 1e-2); /* a slanted edge cuts many boxes */
        }
        free(directions);
    }
}

static void test_sampling_maps_the_square_onto_the_hemisphere_by_area(void **state)
{
    (void)state;
    const float point[2] = { 0.36f, 0.25f };
    float d[3];
    nook_cosine_direction(point, d);
    assert_true(fabs((double)d[0]) < 1e-6 && fabs(d[1] - 0.6) < 1e-6 && fabs(d[2] - 0.8) < 1e-6);
    assert_true(fabs(atan2((double)d[1], (double)d[0]) - 0.5 * NOOK_PI) < 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sampling_puts_one_point_of_a_block_in_every_elementary_box),
        cmocka_unit_test(test_sampling_puts_one_point_of_all_blocks_in_every_elementary_box),
        cmocka_unit_test(test_sampling_puts_one_point_of_a_block_over_16_parts_in_every_elementary_box),
        cmocka_unit_test(test_sampling_puts_one_point_of_all_blocks_of_a_part_in_every_elementary_box),
        cmocka_unit_test(test_sampling_directions_are_unit_and_above_the_horizon),
        cmocka_unit_test(test_sampling_directions_differ_from_seed_to_seed),
        cmocka_unit_test(test_sampling_of_each_block_integrates_the_cosine_hemisphere),
        cmocka_unit_test(test_sampling_maps_the_square_onto_the_hemisphere_by_area),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
