/* Where in a voxel a plane ends: what its word says, in the finest volume and in levels. */
#include "engine/core/vector.h"
#include "modules/bake/surfel_extent.h"
#include "tests/support/surfel_shapes.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 16 };
#define FULL NOOK_SURFEL_ALPHA_MAX

/* ---- Words ------------------------------------------------------------------------------------------------------ */

static void assert_holds(const nook_surfel_extent *outer, const nook_surfel_extent *inner, int axis, double most)
{
    assert_true(outer->low[axis] <= inner->low[axis] + most && outer->high[axis] >= inner->high[axis] - most);
}

static void test_a_box_comes_back_from_its_word_and_holds_what_was_wanted(void **state)
{
    (void)state;
    srand(11);
    for (int i = 0; i < 20000; i++) {
        nook_surfel_extent wanted, box;
        for (int k = 0; k < 3; k++) {
            double a = rand() / (double)RAND_MAX - 0.5, b = i % 5 ? rand() / (double)RAND_MAX - 0.5 : a;
            wanted.low[k] = fmin(a, b);
            wanted.high[k] = fmax(a, b);
        }
        uint32_t word = nook_surfel_box_pack(&wanted, &box);
        assert_true(nook_surfel_is_box(word) && !nook_surfel_word_is_plane(word));
        for (int k = 0; k < 3; k++) {
            assert_holds(&box, &wanted, k, 0.0);
            assert_true(box.high[k] - box.low[k] < wanted.high[k] - wanted.low[k] + 2.0 / NOOK_EXTENT_BOX_STEPS + 1e-9);
        }
    }
    nook_surfel_extent all = { { -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 } }, box;
    assert_int_equal(nook_surfel_box_pack(&all, &box), 0);
}

static void test_every_interval_has_a_code_of_its_own(void **state)
{
    (void)state;
    uint64_t met = 0;
    for (int axis = 0; axis < 3; axis++)
        for (int low = 0; low < NOOK_EXTENT_STEPS; low++)
            for (int high = low + 1; high <= NOOK_EXTENT_STEPS; high++) {
                nook_surfel_extent wanted = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } }, got;
                wanted.low[axis] = (low + 0.01) / NOOK_EXTENT_STEPS - 0.5;
                wanted.high[axis] = (high - 0.01) / NOOK_EXTENT_STEPS - 0.5;
                uint32_t code = nook_surfel_interval_pack(&wanted, axis, &got);
                assert_true(code < NOOK_EXTENT_CODES && !(met >> code & 1));
                met |= 1ull << code;
                for (int k = 0; k < 3; k++) {
                    assert_true(fabs(got.low[k] - (k == axis ? (double)low / NOOK_EXTENT_STEPS - 0.5 : -0.5)) < 1e-12);
                    assert_true(fabs(got.high[k] - (k == axis ? (double)high / NOOK_EXTENT_STEPS - 0.5 : 0.5)) < 1e-12);
                }
                nook_surfel_plane plane = { .normal = { 0, 0, 1 }, .side = NOOK_SIDE_WITHIN, .interval = code };
                const double through[3] = { 0.0, 0.0, 0.1 };
                nook_surfel_plane back = nook_surfel_unpack(nook_surfel_pack(&plane, through));
                assert_true(back.side == NOOK_SIDE_WITHIN && back.interval == code && back.alpha == FULL);
            }
    assert_true(met == (1ull << NOOK_EXTENT_CODES) - 1);
}

/* ---- A plane by itself ------------------------------------------------------------------------------------------ */

static void test_alpha_and_box_say_what_is_covered_and_where(void **state)
{
    (void)state;
    for (int tenths = 1; tenths <= 10;
         tenths++) { /* a strip along x that covers so much of row 3, from its lower side */
        const float corner[3] = { 2, 3, 4.5f }, u[3] = { 9, 0, 0 }, v[3] = { 0, (float)tenths / 10.0f, 0 };
        test_sheet sheet = test_make_sheet(SIDE, corner, u, v);
        nook_triangles triangles = test_sheet_triangles(&sheet);
        nook_volume volume = test_make_surfels(&triangles, SIDE, 1);
        assert_int_equal(volume.info.occupied, 9);
        for (uint32_t x = 3; x < 12; x++) {
            assert_true(fabs(test_covered_across_z(test_surfel_at(&volume, x, 4, 5)) - tenths / 10.0) < 1.0 / FULL);
            nook_surfel_extent box = nook_surfel_box_unpack(test_surfel_at(&volume, x, 4, 5)->plane[1]);
            assert_true(box.low[1] == -0.5 && box.low[0] == -0.5 && box.high[0] == 0.5);
            assert_true(box.high[1] > tenths / 10.0 - 0.5 - 1e-3 && box.high[1] < tenths / 10.0 - 0.5 + 0.07);
        }
        nook_volume_free(&volume);
    }
}

/* Levels of what a grid of SIDE << finest voxels of 1 m is made for. */
static void make_levels(const nook_triangles *triangles, uint32_t finest, nook_volume out[NOOK_VOXELIZE_LEVELS])
{
    const nook_voxelize_desc desc = { .resolution = SIDE << finest, .threads = 1, .kind = NOOK_VOLUME_SURFEL };
    memset(out, 0, NOOK_VOXELIZE_LEVELS * sizeof *out);
    assert_int_equal(nook_voxelize_levels(triangles, &desc, (1u << NOOK_VOXELIZE_LEVELS) - 1, out), NOOK_OK);
}

/* Of the voxel of a level that a coordinate lies in: its number, counting the border, and how far into it, 0 to 1. */
static uint32_t voxel_of(double metres, uint32_t level, double *part)
{
    double whole = floor(ldexp(metres, -(int)level));
    *part = ldexp(metres, -(int)level) - whole;
    return (uint32_t)whole + 1;
}

/* What merged bins hold is moments, and a box is made of nothing else. */
static void test_the_box_of_a_level_ends_where_the_sheet_does(void **state)
{
    (void)state;
    static const double ends[] = { 9.3, 10.6, 11.8, 12.9, 6.7 };
    int boxes = 0;
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        const float corner[3] = { 0, 0, 5.3f }, u[3] = { (float)ends[i], 0, 0 }, v[3] = { 0, SIDE, 0 };
        test_sheet sheet = test_make_sheet(SIDE, corner, u, v);
        nook_triangles triangles = test_sheet_triangles(&sheet);
        nook_volume levels[NOOK_VOXELIZE_LEVELS];
        make_levels(&triangles, 0, levels);
        for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
            double part, height, unused;
            uint32_t x = voxel_of(ends[i], level, &part), y = voxel_of(7.5, level, &unused);
            uint32_t z = voxel_of((double)5.3f, level, &height);
            const nook_surfel *last = test_surfel_at(&levels[level], x, y, z);
            assert_non_null(last);
            assert_true(fabs(test_covered_across_z(last) - part) < 1.0 / FULL);
            nook_surfel_extent box = nook_surfel_box_unpack(last->plane[1]);
            assert_true(box.low[0] == -0.5 && box.low[1] == -0.5 && box.high[1] == 0.5);
            assert_true(box.low[2] <= height - 0.5 + 1e-6 && box.high[2] >= height - 0.5 - 1e-6);
            assert_true(box.high[0] > part - 0.5 - 1e-3 && box.high[0] < part - 0.5 + 1.0 / 16.0 + 1e-3);
            boxes += last->plane[1] != 0;
            assert_null(test_surfel_at(&levels[level], x + 1, y, z));
            if (x > 1) { /* the one before is whole */
                const nook_surfel *before = test_surfel_at(&levels[level], x - 1, y, z);
                assert_non_null(before);
                assert_int_equal(before->plane[1], 0);
                assert_int_equal(nook_surfel_unpack(before->plane[0]).alpha, FULL);
            }
            nook_volume_free(&levels[level]);
        }
    }
    assert_true(boxes >= 16); /* but where the rest is less than a sixteenth */
}

/* ---- One of two planes ------------------------------------------------------------------------------------------ */

/* A sheet that goes through and half a voxel over it one that ends; the grid's voxels of `level` are as large as those of the lone bake. */
static nook_volume make_two_sheets(double end, uint32_t level)
{
    const float size = (float)(1u << level), side = size * SIDE;
    const float heights[2] = { 4.25f * size, 4.75f * size }, ends[2] = { side, (float)end * size };
    float points[10][3] = { { 0 } };
    uint32_t indices[18], n = 0;
    for (uint32_t sheet = 0; sheet < 2; sheet++) {
        for (uint32_t k = 0; k < 4; k++) {
            points[4 * sheet + k][0] = k & 1 ? ends[sheet] : 0.0f;
            points[4 * sheet + k][1] = k & 2 ? side : 0.0f;
            points[4 * sheet + k][2] = heights[sheet];
        }
        const uint32_t quad[6] = {
            4 * sheet, 4 * sheet + 1, 4 * sheet + 2, 4 * sheet + 2, 4 * sheet + 1, 4 * sheet + 3
        };
        memcpy(indices + n, quad, sizeof quad);
        n += 6;
    }
    for (int axis = 0; axis < 3; axis++)
        points[9][axis] = side; /* specks that hold the box */
    const uint32_t specks[6] = { 8, 8, 8, 9, 9, 9 };
    memcpy(indices + n, specks, sizeof specks);
    const nook_triangles triangles = { points[0], 0, 10, indices, 18 };
    nook_volume levels[NOOK_VOXELIZE_LEVELS];
    make_levels(&triangles, level, levels);
    for (uint32_t k = 0; k < NOOK_VOXELIZE_LEVELS; k++)
        if (k != level)
            nook_volume_free(&levels[k]);
    return levels[level];
}

static void test_one_of_two_planes_ends_within_an_interval(void **state)
{
    (void)state;
    for (uint32_t level = 0; level < 3; level++)
        for (int tenths = 2; tenths <= 8; tenths++) {
            const double part = tenths / 10.0;
            nook_volume volume = make_two_sheets(8.0 + part, level);
            const nook_surfel *surfel = test_surfel_at(&volume, 9, 8, 5);
            assert_non_null(surfel);
            assert_true(nook_surfel_word_is_plane(surfel->plane[1]));
            int met = 0;
            for (int k = 0; k < 2; k++) {
                const nook_surfel_plane plane = nook_surfel_unpack(surfel->plane[k]);
                assert_int_equal(plane.alpha, FULL);
                assert_true(fabs(plane.normal[2]) == 1.0);
                if (plane.offset / plane.normal[2] < 0.0) { /* the one that goes through */
                    assert_true(plane.side != NOOK_SIDE_WITHIN);
                    continue;
                }
                met++;
                assert_int_equal(plane.side, NOOK_SIDE_WITHIN);
                nook_surfel_extent extent = nook_surfel_interval_unpack(plane.interval);
                for (int axis = 0; axis < 3; axis++)
                    assert_true(extent.low[axis] == -0.5 && (axis == 0 || extent.high[axis] == 0.5));
                assert_true(extent.high[0] > part - 0.5 - 1.0 / 60.0 - 1e-3);
                assert_true(extent.high[0] < part - 0.5 + 1.0 / 6.0 + 1e-3);
            }
            assert_int_equal(met, 1);
            assert_true(!nook_surfel_word_is_plane(test_surfel_at(&volume, 10, 8, 5)->plane[1]));
            nook_volume_free(&volume);
        }
}

/* An interval is all there: where that would be more wrong than coverage, as of a twenty-fifth of the section, coverage stays. */
static void test_a_rest_that_no_interval_is_near_to_stays_coverage(void **state)
{
    (void)state;
    nook_volume volume = make_two_sheets(8.04, 0);
    const nook_surfel *surfel = test_surfel_at(&volume, 9, 8, 5);
    assert_non_null(surfel);
    assert_true(nook_surfel_word_is_plane(surfel->plane[1]));
    uint32_t least = FULL;
    for (int k = 0; k < 2; k++) {
        const nook_surfel_plane plane = nook_surfel_unpack(surfel->plane[k]);
        assert_true(plane.side != NOOK_SIDE_WITHIN);
        least = plane.alpha < least ? plane.alpha : least;
    }
    assert_in_range(least, 2, 3); /* of 63: 0.04 */
    nook_volume_free(&volume);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_box_comes_back_from_its_word_and_holds_what_was_wanted),
        cmocka_unit_test(test_every_interval_has_a_code_of_its_own),
        cmocka_unit_test(test_alpha_and_box_say_what_is_covered_and_where),
        cmocka_unit_test(test_the_box_of_a_level_ends_where_the_sheet_does),
        cmocka_unit_test(test_one_of_two_planes_ends_within_an_interval),
        cmocka_unit_test(test_a_rest_that_no_interval_is_near_to_stays_coverage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
