#include "engine/core/log.h"
#include "tests/support/voxel_shapes.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void swallow(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    (void)level, (void)file, (void)line, (void)text;
    ++*(int *)user;
}

/* ---- Soups ------------------------------------------------------------------------------------------------------ */

static void test_degenerate_triangles_are_segments_and_points(void **state)
{
    (void)state;
    const float points[3][3] = { { 0, 0, 0 }, { 8, 0, 0 }, { 4, 6, 0 } };
    const uint32_t segment[3] = { 0, 1, 0 }, point[3] = { 2, 2, 2 };
    nook_triangles soup = { points[0], 0, 3, segment, 3 };
    nook_volume v = test_voxelize(&soup, 8, 1);
    assert_int_equal(v.info.width, 10);
    assert_int_equal(v.info.height, 3);
    assert_int_equal(v.info.occupied, 8);
    nook_volume_free(&v);

    soup.indices = point;
    v = test_voxelize(&soup, 8, 1);
    assert_int_equal(v.info.occupied, 1);
    assert_int_equal(test_voxel_count(&v), 27);
    assert_true(v.info.voxel_size > 0.0);
    nook_volume_free(&v);
}

static void test_open_double_and_intersecting_soup_is_fine(void **state)
{
    (void)state;
    uint64_t seed = 20100711;
    float points[300][3];
    uint32_t indices[600];
    for (uint32_t i = 0; i < 300; i++) {
        for (int axis = 0; axis < 3; axis++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            points[i][axis] = (float)(seed >> 40) / 16777216.0f;
        }
        indices[i] = indices[300 + i] = i; /* every triangle twice */
    }
    nook_triangles once = { points[0], 0, 300, indices, 300 }, twice = { points[0], 0, 300, indices, 600 };
    nook_volume a = test_voxelize(&once, 50, 1), b = test_voxelize(&twice, 50, 1);
    test_assert_same_voxels(&a, &b);
    test_assert_border_empty(&a);
    assert_true(a.info.content_hash != b.info.content_hash);
    nook_volume_free(&a);
    nook_volume_free(&b);
}

static void test_winding_does_not_matter(void **state)
{
    (void)state;
    float points[8][3];
    uint32_t flipped[36];
    test_make_box(1.0f, 0.8f, 0.6f, points);
    test_rotate(points, 8, 0.5, 0.9);
    for (int i = 0; i < 36; i++)
        flipped[i] = test_box_indices[35 - i];
    nook_triangles box = test_box_triangles(points), inside_out = { points[0], 0, 8, flipped, 36 };
    nook_volume a = test_voxelize(&box, 33, 1), b = test_voxelize(&inside_out, 33, 1);
    test_assert_same_voxels(&a, &b);
    nook_volume_free(&a);
    nook_volume_free(&b);
}

static void test_triangles_that_are_not_finite_are_left_out(void **state)
{
    (void)state;
    const float points[6][3] = {
        { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { NAN, 0, 0 }, { INFINITY, 5, 5 }, { 0, 0, 9 }
    };
    const uint32_t good[3] = { 0, 1, 2 }, mixed[9] = { 3, 1, 2, 0, 1, 2, 5, 1, 4 };
    nook_triangles clean = { points[0], 0, 6, good, 3 }, dirty = { points[0], 0, 6, mixed, 9 };
    int lines = 0;
    nook_log_set_sink(swallow, &lines);
    nook_volume a = test_voxelize(&clean, 16, 1), b = test_voxelize(&dirty, 16, 1);
    assert_int_equal(lines, 1);
    test_assert_same_voxels(&a, &b);
    dirty.index_count = 3;
    nook_volume untouched = { .voxels = (uint8_t *)&lines };
    nook_voxelize_desc desc = { .resolution = 16 };
    assert_int_equal(nook_voxelize(&dirty, &desc, &untouched), NOOK_E_ARG);
    assert_ptr_equal(untouched.voxels, &lines);
    nook_log_set_sink(NULL, NULL);
    nook_volume_free(&a);
    nook_volume_free(&b);
}

static void test_enormous_and_tiny_coordinates_are_fine(void **state)
{
    (void)state;
    const float points[9][3] = { { -3e38f, -3e38f, -3e38f },
                                 { 3e38f, 3e38f, 3e38f },
                                 { 3e38f, -3e38f, 0.0f },
                                 { 0x1p-130f, 0, 0 },
                                 { 0, 0x1p-130f, 0 },
                                 { 0, 0, 0x1p-130f },
                                 { 1, 0, 0 },
                                 { 0, 1, 0 },
                                 { 0, 0, 1 } };
    const uint32_t indices[9] = { 0, 1, 2, 3, 4, 5, 6, 7, 8 };
    nook_triangles large = { points[0], 0, 9, indices, 3 }, small = { points[0], 0, 9, indices + 3, 3 },
                   usual = { points[0], 0, 9, indices + 6, 3 };
    nook_volume v = test_voxelize(&large, 64, 1);
    assert_true(isfinite(v.info.voxel_size) && isfinite(v.info.origin[0]) && v.info.occupied > 64);
    nook_volume_free(&v);
    v = test_voxelize(&small, 64, 1); /* denormal floats */
    nook_volume same = test_voxelize(&usual, 64, 1);
    test_assert_same_voxels(&v, &same);
    assert_true(v.info.occupied > 64);
    nook_volume_free(&v);
    nook_volume_free(&same);
}

/* ---- Invariances ------------------------------------------------------------------------------------------------ */

static void test_translation_by_whole_voxels_gives_the_same_pattern(void **state)
{
    (void)state;
    /* Coordinates in 1/1024 m and a box of 32 m, so that floats hold the moved ones exactly. */
    test_sphere *s = test_make_sphere(15.0);
    for (uint32_t i = 0; i < SPHERE_VERTICES; i++)
        for (int axis = 0; axis < 3; axis++)
            s->points[i][axis] = roundf(s->points[i][axis] * 1024.0f) / 1024.0f;
    s->points[0][1] = 16.0f;
    s->points[SPHERE_VERTICES - 1][1] = -16.0f;
    nook_triangles triangles = test_sphere_triangles(s);
    nook_volume a = test_voxelize(&triangles, 64, 1);
    for (uint32_t i = 0; i < SPHERE_VERTICES; i++) {
        s->points[i][0] += 7.0f;
        s->points[i][1] -= 1000.0f;
        s->points[i][2] += 0.5f;
    }
    nook_volume b = test_voxelize(&triangles, 64, 1);
    test_assert_same_voxels(&a, &b);
    assert_true(b.info.origin[0] == a.info.origin[0] + 7.0);
    assert_true(b.info.origin[1] == a.info.origin[1] - 1000.0);
    nook_volume_free(&a);
    nook_volume_free(&b);
    free(s);
}

static void test_result_does_not_depend_on_threads(void **state)
{
    (void)state;
    test_sphere *s = test_make_sphere(1.0);
    nook_triangles triangles = test_sphere_triangles(s);
    nook_volume one = test_voxelize(&triangles, 100, 1);
    for (uint32_t threads = 0; threads <= 4; threads++) {
        nook_volume many = test_voxelize(&triangles, 100, threads);
        test_assert_same_voxels(&one, &many);
        assert_memory_equal(&one.info.origin, &many.info.origin, sizeof one.info.origin);
        assert_true(one.info.content_hash == many.info.content_hash);
        assert_int_equal(one.info.occupied, many.info.occupied);
        nook_volume_free(&many);
    }
    nook_volume_free(&one);
    free(s);
}

static void test_stride_is_skipped(void **state)
{
    (void)state;
    float points[8][3], spaced[8][5];
    test_make_box(1.0f, 2.0f, 3.0f, points);
    for (int i = 0; i < 8; i++) {
        memcpy(spaced[i], points[i], sizeof points[i]);
        spaced[i][3] = spaced[i][4] = NAN;
    }
    nook_triangles packed = test_box_triangles(points), wide = packed;
    wide.positions = spaced[0];
    wide.stride = sizeof spaced[0];
    nook_volume a = test_voxelize(&packed, 12, 1), b = test_voxelize(&wide, 12, 1);
    test_assert_same_voxels(&a, &b);
    assert_true(a.info.content_hash == b.info.content_hash);
    nook_volume_free(&a);
    nook_volume_free(&b);
}

static void test_hash_tells_content_and_resolution_apart(void **state)
{
    (void)state;
    float points[8][3];
    test_make_box(1.0f, 2.0f, 3.0f, points);
    nook_triangles box = test_box_triangles(points);
    nook_voxelize_desc desc = { .resolution = 12 }, threaded = { .resolution = 12, .threads = 3 },
                       finer = { .resolution = 13 };
    uint64_t hash = nook_voxelize_hash(&box, &desc);
    assert_true(hash == nook_voxelize_hash(&box, &threaded));
    assert_true(hash != nook_voxelize_hash(&box, &finer));
    points[7][2] = nextafterf(points[7][2], 9.0f);
    assert_true(hash != nook_voxelize_hash(&box, &desc));
    points[7][2] = 3.0f;
    assert_true(hash == nook_voxelize_hash(&box, &desc));
    box.index_count = 33;
    assert_true(hash != nook_voxelize_hash(&box, &desc));
}

static void test_voxelize_refuses_what_it_cannot_take(void **state)
{
    (void)state;
    float points[8][3];
    test_make_box(1.0f, 1.0f, 1.0f, points);
    const nook_triangles box = test_box_triangles(points);
    nook_voxelize_desc desc = { .resolution = 0 };
    nook_volume v;
    int lines = 0;
    nook_log_set_sink(swallow, &lines);
    assert_int_equal(nook_voxelize(&box, &desc, &v), NOOK_E_RANGE);
    desc.resolution = 513;
    assert_int_equal(nook_voxelize(&box, &desc, &v), NOOK_E_RANGE);
    desc.resolution = 8;
    nook_triangles bad = box;
    bad.vertex_count = 7;
    assert_int_equal(nook_voxelize(&bad, &desc, &v), NOOK_E_ARG);
    bad = box;
    bad.index_count = 35;
    assert_int_equal(nook_voxelize(&bad, &desc, &v), NOOK_E_ARG);
    bad = box;
    bad.stride = 8;
    assert_int_equal(nook_voxelize(&bad, &desc, &v), NOOK_E_ARG);
    bad = (nook_triangles){ 0 };
    assert_int_equal(nook_voxelize(&bad, &desc, &v), NOOK_E_ARG);
    nook_log_set_sink(NULL, NULL);
    assert_int_equal(lines, 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_degenerate_triangles_are_segments_and_points),
        cmocka_unit_test(test_open_double_and_intersecting_soup_is_fine),
        cmocka_unit_test(test_winding_does_not_matter),
        cmocka_unit_test(test_triangles_that_are_not_finite_are_left_out),
        cmocka_unit_test(test_enormous_and_tiny_coordinates_are_fine),
        cmocka_unit_test(test_translation_by_whole_voxels_gives_the_same_pattern),
        cmocka_unit_test(test_result_does_not_depend_on_threads),
        cmocka_unit_test(test_stride_is_skipped),
        cmocka_unit_test(test_hash_tells_content_and_resolution_apart),
        cmocka_unit_test(test_voxelize_refuses_what_it_cannot_take),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
