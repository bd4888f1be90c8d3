/* Distances of voxel centres to triangles, and what the sphere tracing in shaders/ao/volume_distance.glsl relies on. */
#include "modules/bake/distance_bake.h"
#include "tests/support/log_capture.h"
#include "tests/support/voxel_shapes.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { TRIANGLES = 40, RESOLUTION = 24, SAMPLES = 4000 };
static const double step = 1.0 / NOOK_DISTANCES_PER_VOXEL;

typedef struct soup {
    float points[3 * TRIANGLES][3];
    uint32_t indices[3 * TRIANGLES];
    uint32_t seed;
} soup;

static double next(soup *s)
{
    s->seed = s->seed * 1664525u + 1013904223u;
    return (s->seed >> 8) / 16777216.0;
}

/* Triangles of all sizes, some of them segments and points. */
static nook_triangles make_soup(soup *s, uint32_t seed)
{
    s->seed = seed;
    for (uint32_t t = 0; t < TRIANGLES; t++) {
        double size = pow(10.0, -2.5 * next(s)), centre[3];
        for (int axis = 0; axis < 3; axis++)
            centre[axis] = 2.0 * next(s);
        for (uint32_t k = 0; k < 3; k++) {
            bool again = (t % 7 == 0 && k == 2) || (t % 11 == 0 && k > 0);
            for (int axis = 0; axis < 3; axis++) {
                double p = centre[axis] + size * (next(s) - 0.5);
                s->points[3 * t + k][axis] = again ? s->points[3 * t + k - 1][axis] : (float)p;
            }
            s->indices[3 * t + k] = 3 * t + k;
        }
    }
    return (nook_triangles){ s->points[0], 0, 3 * TRIANGLES, s->indices, 3 * TRIANGLES };
}

static nook_volume make(const nook_triangles *triangles, uint32_t resolution, uint32_t threads)
{
    nook_volume volume;
    const nook_voxelize_desc desc = { .resolution = resolution, .threads = threads, .kind = NOOK_VOLUME_DISTANCE };
    assert_int_equal(nook_voxelize(triangles, &desc, &volume), NOOK_OK);
    return volume;
}

/* By dense sampling of barycentric coordinates and then halving steps: shares no code with the baker. */
static double distance_to(const float corner[3][3], const double p[3])
{
    double best = INFINITY, at[2] = { 0.0, 0.0 };
    for (double size = 1.0; size > 1e-9; size *= 0.5) {
        double middle[2] = { at[0], at[1] };
        for (int i = -4; i <= 4; i++) {
            for (int k = -4; k <= 4; k++) {
                double u = middle[0] + i * size / 4, v = middle[1] + k * size / 4, sum = 0.0;
                u = fmin(fmax(u, 0.0), 1.0);
                v = fmin(fmax(v, 0.0), 1.0 - u);
                for (int axis = 0; axis < 3; axis++) {
                    double a = (double)corner[0][axis];
                    double x = a + u * ((double)corner[1][axis] - a) + v * ((double)corner[2][axis] - a) - p[axis];
                    sum += x * x;
                }
                if (sum < best) {
                    best = sum;
                    at[0] = u, at[1] = v;
                }
            }
        }
    }
    return sqrt(best);
}

/* Voxels from a point (in voxels) to the soup. */
static double true_distance(const soup *s, const nook_volume *v, const double voxel[3])
{
    double p[3], best = INFINITY;
    for (int axis = 0; axis < 3; axis++)
        p[axis] = v->info.origin[axis] + voxel[axis] * v->info.voxel_size;
    for (uint32_t t = 0; t < TRIANGLES; t++)
        best = fmin(best, distance_to(s->points + 3 * t, p));
    return best / v->info.voxel_size;
}

static double stored(const nook_volume *v, int x, int y, int z)
{
    return v->voxels[((size_t)z * v->info.height + (size_t)y) * v->info.width + (size_t)x] * step;
}

static double filtered(const nook_volume *v, const double voxel[3])
{
    double sum = 0.0, base[3], f[3];
    for (int axis = 0; axis < 3; axis++) {
        base[axis] = floor(voxel[axis] - 0.5);
        f[axis] = voxel[axis] - 0.5 - base[axis];
    }
    for (int i = 0; i < 8; i++) {
        double weight = (i & 1 ? f[0] : 1 - f[0]) * (i & 2 ? f[1] : 1 - f[1]) * (i & 4 ? f[2] : 1 - f[2]);
        sum += weight * stored(v, (int)base[0] + (i & 1), (int)base[1] + (i >> 1 & 1), (int)base[2] + (i >> 2 & 1));
    }
    return sum;
}

static void test_no_stored_distance_is_more_than_the_true_one_nor_a_step_less(void **state)
{
    (void)state;
    static soup s;
    nook_triangles triangles = make_soup(&s, 1);
    nook_volume v = make(&triangles, RESOLUTION, 1);
    for (int i = 0; i < SAMPLES / 4; i++) {
        int x = (int)(next(&s) * v.info.width), y = (int)(next(&s) * v.info.height), z = (int)(next(&s) * v.info.depth);
        double truth = true_distance(&s, &v, (double[]){ x + 0.5, y + 0.5, z + 0.5 }), got = stored(&v, x, y, z);
        assert_true(got <= truth);
        assert_true(got > truth - step - 1e-4 || got == UINT8_MAX * step);
    }
    nook_volume_free(&v);
}

static void test_a_filtered_distance_is_at_most_half_a_diagonal_more_than_the_true_one(void **state)
{
    (void)state;
    static soup s;
    double most = 0.0;
    nook_triangles triangles = make_soup(&s, 2);
    nook_volume v = make(&triangles, RESOLUTION, 1);
    for (int i = 0; i < SAMPLES / 4; i++) {
        double voxel[3];
        for (int axis = 0; axis < 3; axis++) {
            double side = (double[]){ v.info.width, v.info.height, v.info.depth }[axis];
            voxel[axis] = 0.5 + next(&s) * (side - 1.0) * 0.9999;
        }
        most = fmax(most, filtered(&v, voxel) - true_distance(&s, &v, voxel));
    }
    assert_true(most <= 0.8661);
    assert_true(most > 0.1); /* such points are there */
    nook_volume_free(&v);
}

static void test_a_filtered_distance_on_a_plane_is_at_most_a_half_at_any_tilt(void **state)
{
    (void)state;
    double most = 0.0;
    for (int k = 0; k < 12; k++) {
        double tilt = 0.13 * k, turn = 0.7 * k;
        float u[3] = { (float)(cos(tilt) * cos(turn)), (float)(cos(tilt) * sin(turn)), (float)-sin(tilt) };
        float w[3] = { (float)-sin(turn), (float)cos(turn), 0 };
        float points[6][3];
        for (int axis = 0; axis < 3; axis++) {
            points[0][axis] = -u[axis] - w[axis], points[1][axis] = u[axis] - w[axis];
            points[2][axis] = u[axis] + w[axis], points[3][axis] = w[axis] - u[axis];
            points[4][axis] = -1.6f - 0.007f * (float)k,
            points[5][axis] = 1.5f; /* the box has another phase each time */
        }
        const uint32_t indices[] = { 0, 1, 2, 0, 2, 3, 4, 4, 4, 5, 5, 5 };
        nook_triangles triangles = { points[0], 0, 6, indices, 12 };
        nook_volume v = make(&triangles, 48, 1);
        for (int i = 0; i < 400; i++) {
            double a = 0.8 * sin(i * 0.7), b = 0.8 * sin(i * 1.3), voxel[3];
            for (int axis = 0; axis < 3; axis++)
                voxel[axis] = (a * (double)u[axis] + b * (double)w[axis] - v.info.origin[axis]) / v.info.voxel_size;
            most = fmax(most, filtered(&v, voxel));
        }
        nook_volume_free(&v);
    }
    assert_true(most <= 0.5);
    assert_true(most > 0.4);
}

static void test_distances_end_where_a_byte_does(void **state)
{
    (void)state;
    /* Two specks at the ends of a diagonal: the middle is far from both. */
    const float points[2][3] = { { 0, 0, 0 }, { 1, 1, 1 } };
    const uint32_t indices[] = { 0, 0, 0, 1, 1, 1 };
    nook_triangles triangles = { points[0], 0, 2, indices, 6 };
    nook_volume v = make(&triangles, 48, 1);
    assert_true(stored(&v, 25, 25, 25) == 255 * step);
    assert_true(stored(&v, 1, 1, 1) <= 0.87);
    assert_true(v.info.occupied <= 16);
    nook_volume_free(&v);
}

static void test_neither_threads_nor_the_order_of_triangles_change_a_distance(void **state)
{
    (void)state;
    static soup s;
    uint32_t turned[3 * TRIANGLES];
    nook_triangles triangles = make_soup(&s, 3), other = triangles;
    for (uint32_t i = 0; i < 3 * TRIANGLES; i++)
        turned[i] = s.indices[3 * TRIANGLES - 1 - i];
    other.indices = turned;
    nook_volume one = make(&triangles, RESOLUTION, 1), many = make(&triangles, RESOLUTION, 3);
    nook_volume reversed = make(&other, RESOLUTION, 2);
    size_t size = (size_t)one.info.width * one.info.height * one.info.depth;
    assert_memory_equal(one.voxels, many.voxels, size);
    assert_memory_equal(one.voxels, reversed.voxels, size);
    assert_true(one.info.content_hash == many.info.content_hash);
    const nook_voxelize_desc binary = { .resolution = RESOLUTION };
    assert_true(one.info.content_hash != nook_voxelize_hash(&triangles, &binary));
    nook_volume_free(&one);
    nook_volume_free(&many);
    nook_volume_free(&reversed);
}

static void test_the_grid_lies_where_that_of_the_voxels_does(void **state)
{
    (void)state;
    static soup s;
    nook_triangles triangles = make_soup(&s, 4);
    nook_volume binary, v = make(&triangles, RESOLUTION, 1);
    assert_int_equal(nook_voxelize(&triangles, &(nook_voxelize_desc){ .resolution = RESOLUTION }, &binary), NOOK_OK);
    assert_memory_equal(v.info.origin, binary.info.origin, sizeof v.info.origin);
    assert_true(v.info.voxel_size == binary.info.voxel_size && v.info.width == binary.info.width);
    nook_volume_free(&v);
    nook_volume_free(&binary);
}

/* ---- Files ------------------------------------------------------------------------------------------------------ */

static void test_a_file_of_distances_comes_back_as_it_was(void **state)
{
    (void)state;
    static soup s;
    nook_triangles triangles = make_soup(&s, 5);
    nook_volume v = make(&triangles, 12, 1), back;
    void *bytes;
    size_t size;
    assert_int_equal(nook_volume_encode(&v, &bytes, &size), NOOK_OK);
    assert_int_equal(nook_volume_decode("distances", bytes, size, &back), NOOK_OK);
    assert_int_equal(back.info.kind, NOOK_VOLUME_DISTANCE);
    assert_true(back.info.occupied == v.info.occupied);
    assert_memory_equal(back.voxels, v.voxels, (size_t)v.info.width * v.info.height * v.info.depth);
    free(bytes);
    nook_volume_free(&v);
    nook_volume_free(&back);
}

static void test_what_no_distances_are_is_refused(void **state)
{
    (void)state;
    static soup s;
    nook_triangles triangles = make_soup(&s, 6);
    nook_volume v = make(&triangles, 12, 1);
    void *bytes = &v;
    size_t size = 7;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    size_t middle = ((size_t)(v.info.depth / 2) * v.info.height + v.info.height / 2) * v.info.width + v.info.width / 2;
    uint8_t before = v.voxels[middle];
    v.voxels[middle] = v.voxels[middle - 1] > 120 ? 60 : 250; /* a jump of several voxels from one to the next */
    assert_int_equal(nook_volume_encode(&v, &bytes, &size), NOOK_E_ARG);
    v.voxels[middle] = before;
    v.info.occupied++;
    assert_int_equal(nook_volume_encode(&v, &bytes, &size), NOOK_E_ARG);
    nook_log_capture_end();
    assert_int_equal(log.count, 2);
    assert_ptr_equal(bytes, &v);
    assert_int_equal(size, 7);
    nook_volume_free(&v);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_stored_distance_is_more_than_the_true_one_nor_a_step_less),
        cmocka_unit_test(test_a_filtered_distance_is_at_most_half_a_diagonal_more_than_the_true_one),
        cmocka_unit_test(test_a_filtered_distance_on_a_plane_is_at_most_a_half_at_any_tilt),
        cmocka_unit_test(test_distances_end_where_a_byte_does),
        cmocka_unit_test(test_neither_threads_nor_the_order_of_triangles_change_a_distance),
        cmocka_unit_test(test_the_grid_lies_where_that_of_the_voxels_does),
        cmocka_unit_test(test_a_file_of_distances_comes_back_as_it_was),
        cmocka_unit_test(test_what_no_distances_are_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
