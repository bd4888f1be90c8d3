/* Bins of small voxels, merged into those of large ones, hold what cutting into large ones would have given. */
#include "modules/bake/brick_grid.h"
#include "modules/bake/surfel_cut.h"
#include "tests/support/wavy_ball.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SUMS = 13 };

/* @param to  for each voxel of the slab the sums of all its bins */
static void add_sums(double *to, nook_surfel_bins *bins)
{
    size_t count = nook_surfel_bins_sort(bins);
    assert_true(count != SIZE_MAX && count > 0);
    for (size_t i = 0; i < count; i++) {
        const nook_surfel_bin bin = nook_surfel_bins_get(bins, i);
        double *sums = to + SUMS * (size_t)nook_surfel_bins_voxel(bins, i);
        const double all[SUMS] = { bin.area,      bin.normal[0], bin.normal[1], bin.normal[2], bin.first[0],
                                   bin.first[1],  bin.first[2],  bin.second[0], bin.second[1], bin.second[2],
                                   bin.second[3], bin.second[4], bin.second[5] };
        for (int k = 0; k < SUMS; k++)
            sums[k] += all[k];
    }
}

static nook_surfel_bins *cut_slab(const nook_triangles *triangles, const nook_grid_frame *frame, uint32_t slab,
                                  uint32_t counts[3])
{
    nook_surfel_source source = { .triangles = triangles, .frame = frame };
    nook_brick_counts(&(nook_volume_info){ .width = frame->size[0], .height = frame->size[1], .depth = frame->size[2] },
                      source.counts);
    memcpy(counts, source.counts, sizeof source.counts);
    const nook_surfel_part part = { .slab = (int32_t)slab, .end = counts[0] * counts[1] };
    nook_surfel_bins *bins = nook_surfel_bins_create(1u << 24);
    assert_non_null(bins);
    for (size_t t = 0; t < triangles->index_count / 3; t++)
        assert_int_equal(nook_surfel_cut(&source, t, &part, bins), NOOK_OK);
    return bins;
}

static uint32_t number_in_slab(const uint32_t counts[3], const uint32_t at[3])
{
    return (at[1] / 4 * counts[0] + at[0] / 4) << 6 | nook_brick_bit(at[0], at[1], at[2]);
}

static void place_in_slab(const uint32_t counts[3], uint32_t slab, uint32_t number, uint32_t at[3])
{
    const uint32_t brick = number >> 6, corner[3] = { brick % counts[0], brick / counts[0], slab };
    for (uint32_t axis = 0; axis < 3; axis++)
        at[axis] = 4 * corner[axis] + (number >> axis & 1) + 2 * (number >> (axis + 3) & 1);
    assert_int_equal(number_in_slab(counts, at), number);
}

/* Bins of the slabs before, of and behind the one of the coarse grid, merged into it by a walk over all its voxels. */
static nook_surfel_bins *merge_slab(const nook_triangles *triangles, const nook_grid_frame *fine, uint32_t slab,
                                    const uint32_t coarse_counts[3])
{
    nook_surfel_bins *merged = nook_surfel_bins_create(1u << 24);
    assert_non_null(merged);
    for (uint32_t from = slab ? 2 * slab - 1 : 0; from <= 2 * slab + 1; from++) {
        uint32_t counts[3];
        nook_surfel_bins *bins = cut_slab(triangles, fine, from, counts);
        size_t count = nook_surfel_bins_sort(bins);
        for (size_t i = 0; i < count; i++) {
            uint32_t at[3], up[3];
            int side[3];
            place_in_slab(counts, from, nook_surfel_bins_voxel(bins, i), at);
            for (int axis = 0; axis < 3; axis++) {
                up[axis] = (at[axis] + 1) / 2;
                side[axis] = at[axis] % 2 ? -1 : 1;
            }
            if (up[2] / 4 == slab)
                assert_int_equal(nook_surfel_bins_merge(bins, i, side, merged, number_in_slab(coarse_counts, up)),
                                 NOOK_OK);
        }
        nook_surfel_bins_destroy(bins);
    }
    return merged;
}

/* @param out  of both ways: for each voxel of a slab of the large grid the sums of all its bins @return voxels */
static size_t sum_both(const nook_triangles *triangles, const nook_grid_frame *fine, uint32_t slab, double *out[2])
{
    const nook_grid_frame coarse = nook_grid_level(fine, 1);
    uint32_t counts[3];
    nook_surfel_bins *cut = cut_slab(triangles, &coarse, slab, counts);
    nook_surfel_bins *merged = merge_slab(triangles, fine, slab, counts);
    const size_t voxels = (size_t)counts[0] * counts[1] * 64;
    for (int way = 0; way < 2; way++) {
        out[way] = calloc(voxels, SUMS * sizeof(double));
        assert_non_null(out[way]);
        add_sums(out[way], way ? merged : cut);
    }
    nook_surfel_bins_destroy(cut);
    nook_surfel_bins_destroy(merged);
    return voxels;
}

/* Triangles with corners at multiples of 1/1024 voxel, each within a large voxel and across small ones: nothing is snapped. */
static void test_merged_sums_of_what_lies_in_a_large_voxel_are_those_of_cutting_into_it(void **state)
{
    (void)state;
    enum { SIDE = 16, COUNT = 400 };
    float points[3 * COUNT + 2][3] = { { 0 } };
    uint32_t indices[3 * COUNT + 3], random = 7;
    for (uint32_t i = 0; i < 3 * COUNT; i++) {
        for (uint32_t axis = 0; axis < 3; axis++) {
            random = random * 1664525u + 1013904223u;
            const uint32_t voxel = i / 3 * (3 + 2 * axis) % (SIDE / 2);
            points[i][axis] = 2.0f * (float)voxel + (float)(16 + (random >> 8) % 2016) / 1024.0f;
        }
        indices[i] = i;
    }
    for (int axis = 0; axis < 3; axis++)
        points[3 * COUNT + 1][axis] = SIDE; /* a speck from end to end holds the box */
    memcpy(indices + 3 * COUNT, (const uint32_t[]){ 3 * COUNT, 3 * COUNT + 1, 3 * COUNT }, 3 * sizeof *indices);
    const nook_triangles triangles = { points[0], 0, 3 * COUNT + 2, indices, 3 * COUNT + 3 };
    const nook_voxelize_desc desc = { .resolution = SIDE, .kind = NOOK_VOLUME_SURFEL };
    nook_grid_frame fine;
    double area = 0.0;
    assert_int_equal(nook_grid_place(&triangles, &desc, &fine), NOOK_OK);
    for (uint32_t slab = 0; slab < (SIDE / 2 + 2 + 3) / 4; slab++) {
        double *sums[2];
        size_t voxels = sum_both(&triangles, &fine, slab, sums);
        for (size_t i = 0; i < voxels * SUMS; i++) {
            assert_true(fabs(sums[0][i] - sums[1][i]) < 1e-8); /* 3000 pieces, each rounded by 2^-35 */
            area += i % SUMS == 0 ? sums[0][i] : 0.0;
        }
        free(sums[0]);
        free(sums[1]);
    }
    assert_true(area > 0.05 * COUNT);
}

/*
 * Layers of the small voxels end 1/1000 of one below their faces, those of the large ones 1/1000 of theirs. Pieces between, half of that
 * wide, are in the voxel beside; of a surface nearly along the layer that is more. And corners are snapped to another grid.
 */
static void test_merged_sums_are_those_of_cutting_but_at_the_ends_of_layers(void **state)
{
    (void)state;
    test_wavy_ball *b = test_make_wavy_ball(0.05f);
    const nook_triangles triangles = test_wavy_ball_triangles(b);
    const nook_voxelize_desc desc = { .resolution = 64, .kind = NOOK_VOLUME_SURFEL };
    nook_grid_frame fine;
    assert_int_equal(nook_grid_place(&triangles, &desc, &fine), NOOK_OK);
    double whole[2] = { 0.0, 0.0 }, apart = 0.0, most = 0.0;
    for (uint32_t slab = 0; slab < (64 / 2 + 2 + 3) / 4; slab++) {
        double *sums[2];
        size_t voxels = sum_both(&triangles, &fine, slab, sums);
        for (size_t i = 0; i < voxels * SUMS; i++) {
            double difference = fabs(sums[0][i] - sums[1][i]);
            most = fmax(most, difference);
            if (i % SUMS > 0)
                continue;
            apart += difference;
            whole[0] += sums[0][i];
            whole[1] += sums[1][i];
        }
        free(sums[0]);
        free(sums[1]);
    }
    assert_true(fabs(whole[0] - whole[1]) < 1e-4 * whole[0]);
    assert_true(apart < 0.002 * whole[0] && most < 0.01);
    free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_merged_sums_of_what_lies_in_a_large_voxel_are_those_of_cutting_into_it),
        cmocka_unit_test(test_merged_sums_are_those_of_cutting_but_at_the_ends_of_layers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
