/* Which draws a pass takes, and between which distances it says they lie. */
#include "engine/core/vector.h"
#include "engine/render/internal.h"
#include "tests/support/test_gpu.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

enum { TRIES = 4000 };
static const double aspect = 1.5;

/** The next number in [-1, 1) of a fixed sequence. */
static double next_random(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 4503599627370496.0 - 1.0;
}

/** A scene of one mesh that is only a box, one draw of it, and a camera. */
typedef struct one_box {
    nook_mesh mesh;
    nook_scene scene;
    nook_render_scene uploaded;
    nook_draw draw;
    nook_frame frame;
    batch_view view;
} one_box;

static void link_box(one_box *b)
{
    b->mesh.primitive_count = 1;
    b->scene = (nook_scene){ .meshes = &b->mesh, .mesh_count = 1 };
    b->uploaded = (nook_render_scene){ .scene = &b->scene };
    b->frame = (nook_frame){ .scene = &b->uploaded, .draws = &b->draw, .draw_count = 1 };
}

/** Box, turn, uneven scale and camera at random, all of it moved away from the origin by up to `far_away` metres. */
static void random_box(one_box *b, uint64_t *seed, double far_away)
{
    double place[3], away[3], eye[3], turn[4], scale[3];
    const double up[3] = { 0.0, 1.0, 0.0 }, still[4] = { 0.0, 0.0, 0.0, 1.0 };
    for (int i = 0; i < 3; i++) {
        double corner = next_random(seed), other = next_random(seed);
        b->mesh.bounds_min[i] = (float)fmin(corner, other);
        b->mesh.bounds_max[i] = (float)fmax(corner, other);
        away[i] = far_away * next_random(seed);
        eye[i] = away[i] + next_random(seed);
        place[i] = away[i] + 5.0 * next_random(seed);
        scale[i] = 0.1 + fabs(next_random(seed));
        turn[i] = next_random(seed);
    }
    turn[3] = 0.0;
    nook_vector_normalize(turn, turn); /* half a turn around any axis */
    b->draw.world_from_local = nook_matrix_compose(place, far_away > 0.0 ? still : turn, scale);
    double target[3] = { eye[0] + next_random(seed), eye[1] + 0.5 * next_random(seed), eye[2] + next_random(seed) };
    b->view = (batch_view){ .view_from_world = nook_matrix_look_at(eye, target, up), .cull = true, .z_near = 0.3 };
    b->view.clip_from_view = nook_matrix_perspective_reversed(1.0, aspect, b->view.z_near);
}

/** In double: how far the box reaches into the frustum's side that it reaches into least; < 0: it lies outside. */
static double reach_into(const one_box *b, double *near, double *far)
{
    double reach[5], least = INFINITY, ty = tan(0.5), tx = ty * aspect;
    nook_matrix view_from_mesh = nook_matrix_multiply(&b->view.view_from_world, &b->draw.world_from_local);
    for (int i = 0; i < 5; i++)
        reach[i] = -INFINITY;
    *near = INFINITY, *far = -INFINITY;
    for (int i = 0; i < 8; i++) {
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = (i >> k & 1) ? b->mesh.bounds_max[k] : b->mesh.bounds_min[k];
        nook_matrix_apply_point(&view_from_mesh, p, p);
        const double inside[5] = { -p[2] - b->view.z_near, -p[2] * tx - p[0], -p[2] * tx + p[0], -p[2] * ty - p[1],
                                   -p[2] * ty + p[1] };
        for (int k = 0; k < 5; k++)
            reach[k] = fmax(reach[k], inside[k]);
        *near = fmin(*near, -p[2]);
        *far = fmax(*far, -p[2]);
    }
    for (int i = 0; i < 5; i++)
        least = fmin(least, reach[i]);
    return least;
}

/** Boxes are taken and left as double precision says, but for those that a plane touches. @return how many were taken */
static int compare_with_double(nook_gpu *gpu, double far_away)
{
    uint64_t seed = 5;
    draw_set set = { 0 };
    int taken = 0;
    for (int i = 0; i < TRIES; i++) {
        one_box b;
        double near, far;
        memset(&b, 0, sizeof b);
        link_box(&b);
        random_box(&b, &seed, far_away);
        double reach = reach_into(&b, &near, &far);
        assert_int_equal(nook_batch(gpu, &b.frame, &b.view, &set), NOOK_OK);
        taken += (int)set.instance_count;
        if (reach >= 0.0) /* never a hole in the picture, not even by rounding */
            assert_int_equal(set.instance_count, 1);
        if (reach < -1e-4)
            assert_int_equal(set.instance_count, 0);
        if (set.instance_count == 1) {
            assert_true(fabs(set.near_distance - fmax(near, b.view.z_near)) < 1e-5);
            assert_true(fabs(set.far_distance - far) < 1e-5);
        }
    }
    nook_draw_set_destroy(gpu, &set);
    return taken;
}

static void test_boxes_are_taken_when_they_reach_into_the_frustum(void **state)
{
    int taken = compare_with_double(test_gpu_of(state), 0.0);
    assert_in_range(taken, TRIES / 20, TRIES - TRIES / 20);
}

static void test_boxes_a_million_metres_away_are_taken_alike(void **state)
{
    int taken = compare_with_double(test_gpu_of(state), 1e6);
    assert_in_range(taken, TRIES / 20, TRIES - TRIES / 20);
}

static void test_a_box_that_only_touches_a_side_is_taken(void **state)
{
    one_box b;
    draw_set set = { 0 };
    memset(&b, 0, sizeof b);
    link_box(&b);
    b.view = (batch_view){ .view_from_world = nook_matrix_identity(), .cull = true, .z_near = 0.1 };
    b.view.clip_from_view = nook_matrix_perspective_reversed(1.5707963267948966, 1.0, b.view.z_near);
    for (int i = 0; i < 1000; i++) { /* its edge x = z lies in the right side of a frustum of 90 degrees */
        float z = 0.2f + 0.01f * (float)i;
        const float low[3] = { z, -1.0f, -z }, high[3] = { z + 1.0f, 1.0f, 1.0f - z };
        memcpy(b.mesh.bounds_min, low, sizeof low);
        memcpy(b.mesh.bounds_max, high, sizeof high);
        b.draw.world_from_local = nook_matrix_identity();
        assert_int_equal(nook_batch(test_gpu_of(state), &b.frame, &b.view, &set), NOOK_OK);
        assert_int_equal(set.instance_count, 1);
    }
    nook_draw_set_destroy(test_gpu_of(state), &set);
}

static void test_tiny_and_huge_scales_are_taken_and_left_alike(void **state)
{
    const double scales[] = { 1e-30, 1e-18, 1e-6, 1e6, 1e17 };
    draw_set set = { 0 };
    for (size_t i = 0; i < NOOK_COUNT(scales); i++) {
        one_box b;
        memset(&b, 0, sizeof b);
        link_box(&b);
        b.view = (batch_view){ .view_from_world = nook_matrix_identity(), .cull = true, .z_near = 0.1 };
        b.view.clip_from_view = nook_matrix_perspective_reversed(1.0, 1.0, b.view.z_near);
        for (int k = 0; k < 3; k++) {
            b.mesh.bounds_min[k] = (float)(-0.5 / scales[i]);
            b.mesh.bounds_max[k] = (float)(0.5 / scales[i]);
        }
        nook_matrix scale = nook_matrix_scale(scales[i], scales[i], scales[i]);
        nook_matrix ahead = nook_matrix_translation(0, 0, -2), aside = nook_matrix_translation(9, 0, -2);
        b.draw.world_from_local = nook_matrix_multiply(&ahead, &scale);
        assert_int_equal(nook_batch(test_gpu_of(state), &b.frame, &b.view, &set), NOOK_OK);
        assert_int_equal(set.instance_count, 1);
        b.draw.world_from_local = nook_matrix_multiply(&aside, &scale);
        assert_int_equal(nook_batch(test_gpu_of(state), &b.frame, &b.view, &set), NOOK_OK);
        if (scales[i] > 1e-19) /* below, its planes' squares are not floats: it may be drawn for nothing */
            assert_int_equal(set.instance_count, 0);
    }
    nook_draw_set_destroy(test_gpu_of(state), &set);
}

/** @param reach where each mesh begins and ends, metres in front of the eye @param out the batches' meshes in order */
static void order_of(nook_gpu *gpu, const float reach[][2], uint32_t count, bool by_end, uint32_t *out)
{
    nook_mesh meshes[4] = { { .primitive_count = 1 } };
    nook_draw draws[4];
    draw_set set = { 0 };
    for (uint32_t i = 0; i < count; i++) {
        const float low[3] = { -0.5f, -0.5f, -reach[i][1] }, high[3] = { 0.5f, 0.5f, -reach[i][0] };
        meshes[i].primitive_count = 1;
        memcpy(meshes[i].bounds_min, low, sizeof low);
        memcpy(meshes[i].bounds_max, high, sizeof high);
        draws[i] = (nook_draw){ .mesh = i, .world_from_local = nook_matrix_identity() };
    }
    nook_scene scene = { .meshes = meshes, .mesh_count = count };
    nook_render_scene uploaded = { .scene = &scene };
    const nook_frame frame = { .scene = &uploaded, .draws = draws, .draw_count = count };
    batch_view view = { .view_from_world = nook_matrix_identity(), .cull = true, .z_near = 0.1, .by_end = by_end };
    view.clip_from_view = nook_matrix_perspective_reversed(1.0, aspect, view.z_near);
    assert_int_equal(nook_batch(gpu, &frame, &view, &set), NOOK_OK);
    assert_int_equal(set.batch_count, count);
    for (uint32_t i = 0; i < count; i++)
        out[i] = ((const batch *)set.batches.items)[i].mesh;
    nook_draw_set_destroy(gpu, &set);
}

static void test_batches_come_by_where_they_begin_or_by_where_they_end(void **state)
{
    static const float reach[3][2] = { { 0.5f, 50.0f }, { 20.0f, 21.0f }, { 2.0f, 3.0f } }; /* a floor, and two on it */
    static const uint32_t by_begin[3] = { 0, 2, 1 }, by_end[3] = { 2, 1, 0 };
    uint32_t order[3];
    order_of(test_gpu_of(state), reach, 3, false, order);
    assert_memory_equal(order, by_begin, sizeof order);
    order_of(test_gpu_of(state), reach, 3, true, order);
    assert_memory_equal(order, by_end, sizeof order);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boxes_are_taken_when_they_reach_into_the_frustum),
        cmocka_unit_test(test_boxes_a_million_metres_away_are_taken_alike),
        cmocka_unit_test(test_a_box_that_only_touches_a_side_is_taken),
        cmocka_unit_test(test_tiny_and_huge_scales_are_taken_and_left_alike),
        cmocka_unit_test(test_batches_come_by_where_they_begin_or_by_where_they_end),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
