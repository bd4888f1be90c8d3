#include "tests/support/voxel_shapes.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Fills the empty voxels that have a 6-connected way to the corner (0, 0, 0). @return the empty voxels without one */
static size_t count_enclosed(const nook_volume *v)
{
    size_t count = test_voxel_count(v), top = 0, enclosed = 0;
    uint8_t *reached = calloc(count, 1);
    size_t *stack = malloc(count * sizeof *stack);
    assert_non_null(reached);
    assert_non_null(stack);
    const uint32_t size[3] = { v->info.width, v->info.height, v->info.depth };
    const size_t step[3] = { 1, size[0], (size_t)size[0] * size[1] };
    reached[0] = 1;
    stack[top++] = 0;
    while (top > 0) {
        size_t i = stack[--top];
        for (int axis = 0; axis < 3; axis++) {
            size_t along = i / step[axis] % size[axis];
            for (int side = 0; side < 2; side++) {
                if (side ? along + 1 == size[axis] : along == 0)
                    continue;
                size_t next = side ? i + step[axis] : i - step[axis];
                if (!reached[next] && v->voxels[next] == 0) {
                    reached[next] = 1;
                    stack[top++] = next;
                }
            }
        }
    }
    for (size_t i = 0; i < count; i++)
        enclosed += !reached[i] && v->voxels[i] == 0;
    free(stack);
    free(reached);
    return enclosed;
}

/* ---- Shapes come out as they are -------------------------------------------------------------------------------- */

static void test_axis_aligned_box_becomes_its_shell(void **state)
{
    (void)state;
    float points[8][3];
    test_make_box(4.0f, 3.0f, 2.0f, points);
    nook_triangles box = test_box_triangles(points);
    nook_volume v = test_voxelize(&box, 16, 1);
    assert_int_equal(v.info.width, 18);
    assert_int_equal(v.info.height, 14);
    assert_int_equal(v.info.depth, 10);
    assert_true(v.info.voxel_size == 0.25);
    assert_true(v.info.origin[0] == -0.25 && v.info.origin[1] == -0.25 && v.info.origin[2] == -0.25);
    for (uint32_t z = 1; z <= 8; z++)
        for (uint32_t y = 1; y <= 12; y++)
            for (uint32_t x = 1; x <= 16; x++) {
                int shell = x == 1 || x == 16 || y == 1 || y == 12 || z == 1 || z == 8;
                assert_int_equal(test_voxel_at(&v, x, y, z), shell ? 255 : 0);
            }
    test_assert_border_empty(&v);
    assert_int_equal(v.info.occupied, test_count_occupied(&v));
    nook_volume_free(&v);
}

static void test_a_body_has_the_same_voxels_at_any_scale(void **state)
{
    (void)state;
    test_sphere *s = test_make_sphere(1.0);
    nook_triangles sphere = test_sphere_triangles(s);
    nook_volume usual = test_voxelize(&sphere, 20, 1);
    for (int exponent = -60; exponent <= 60; exponent += 30) { /* powers of two: nothing is rounded */
        for (size_t i = 0; i < SPHERE_VERTICES; i++)
            for (int axis = 0; axis < 3; axis++)
                s->points[i][axis] = ldexpf(s->points[i][axis], exponent);
        nook_volume v = test_voxelize(&sphere, 20, 1);
        test_assert_same_voxels(&usual, &v);
        assert_true(v.info.voxel_size == ldexp(usual.info.voxel_size, exponent));
        nook_volume_free(&v);
        for (size_t i = 0; i < SPHERE_VERTICES; i++)
            for (int axis = 0; axis < 3; axis++)
                s->points[i][axis] = ldexpf(s->points[i][axis], -exponent);
    }
    nook_volume_free(&usual);
    free(s);
}

static void test_a_point_becomes_one_voxel_wherever_it_is(void **state)
{
    (void)state;
    const float places[] = { 0.0f, 1e-30f, 5.0f, 1e7f };
    const uint32_t indices[3] = { 0, 0, 0 };
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const float point[3] = { places[i], -places[i], places[i] };
        nook_triangles triangle = { point, 0, 1, indices, 3 };
        nook_volume v = test_voxelize(&triangle, 1, 1);
        assert_int_equal(v.info.occupied, 1);
        assert_int_equal(test_voxel_at(&v, 1, 1, 1), 255);
        nook_volume_free(&v);
    }
}

static void test_flat_plane_becomes_exactly_one_layer(void **state)
{
    (void)state;
    for (int axis = 0; axis < 3; axis++) {
        float points[4][3] = { { 0 } };
        for (int i = 0; i < 4; i++) {
            points[i][axis] = 7.7f;
            points[i][(axis + 1) % 3] = i & 1 ? 10.0f : 0.0f;
            points[i][(axis + 2) % 3] = i & 2 ? 10.0f : 0.0f;
        }
        const uint32_t indices[6] = { 0, 1, 2, 2, 1, 3 };
        nook_triangles plane = { points[0], 0, 4, indices, 6 };
        nook_volume v = test_voxelize(&plane, 20, 1);
        const uint32_t size[3] = { v.info.width, v.info.height, v.info.depth };
        assert_int_equal(size[axis], 3);
        assert_int_equal(v.info.occupied, 20 * 20);
        test_assert_border_empty(&v);
        double centre = v.info.origin[axis] + 1.5 * v.info.voxel_size;
        assert_true(fabs(centre - (double)7.7f) < 1e-12);
        nook_volume_free(&v);
    }
}

static void test_walls_inside_a_scene_stay_one_layer_whatever_their_phase(void **state)
{
    (void)state;
    /* Two far corners fix the grid (32 voxels of 1 m); between them a wall at x = phase that is a little rough, as after rotations in floats. */
    for (int phase = 0; phase <= 64; phase++) {
        enum { CELLS = 8, SIDE = CELLS + 1 };
        float points[SIDE * SIDE + 2][3];
        uint32_t indices[CELLS * CELLS * 6 + 6], n = 0;
        for (uint32_t i = 0; i < SIDE * SIDE; i++) {
            points[i][0] = 10.0f + (float)phase / 64.0f + (i % 2 ? 3e-4f : -3e-4f);
            points[i][1] = (float)(i % SIDE) * 4.0f;
            points[i][2] = (float)(i / SIDE) * 4.0f;
        }
        for (uint32_t c = 0; c < CELLS * CELLS; c++) {
            uint32_t a = c / CELLS * SIDE + c % CELLS;
            const uint32_t quad[6] = { a, a + 1, a + SIDE, a + 1, a + SIDE + 1, a + SIDE };
            memcpy(indices + n, quad, sizeof quad);
            n += 6;
        }
        for (uint32_t i = 0; i < 2; i++) {
            for (int axis = 0; axis < 3; axis++)
                points[SIDE * SIDE + i][axis] = i ? 32.0f : 0.0f;
            for (int k = 0; k < 3; k++)
                indices[n++] = SIDE * SIDE + i;
        }
        nook_triangles scene = { points[0], 0, SIDE * SIDE + 2, indices, n };
        nook_volume v = test_voxelize(&scene, 32, 1);
        assert_int_equal(v.info.occupied, 32 * 32 + 2);
        uint32_t layer = phase < 64 ? 11 : 12;
        for (uint32_t z = 1; z <= 32; z++)
            for (uint32_t y = 1; y <= 32; y++)
                assert_int_equal(test_voxel_at(&v, layer, y, z), 255);
        nook_volume_free(&v);
    }
}

static void test_sphere_voxels_lie_on_the_sphere_and_cover_it(void **state)
{
    (void)state;
    test_sphere *s = test_make_sphere(2.0);
    nook_triangles triangles = test_sphere_triangles(s);
    nook_volume v = test_voxelize(&triangles, 40, 1);
    double half_diagonal = 0.5 * sqrt(3.0) * v.info.voxel_size;
    double sagitta = 2.0 * (1.0 - cos(3.1416 / RINGS / 2.0)) * 2.0; /* the facets lie inside the test_sphere */
    for (uint32_t z = 0; z < v.info.depth; z++)
        for (uint32_t y = 0; y < v.info.height; y++)
            for (uint32_t x = 0; x < v.info.width; x++) {
                if (!test_voxel_at(&v, x, y, z))
                    continue;
                double px = v.info.origin[0] + (x + 0.5) * v.info.voxel_size;
                double py = v.info.origin[1] + (y + 0.5) * v.info.voxel_size;
                double pz = v.info.origin[2] + (z + 0.5) * v.info.voxel_size;
                double r = sqrt(px * px + py * py + pz * pz);
                assert_true(r > 2.0 - half_diagonal - sagitta && r < 2.0 + half_diagonal + 1e-3);
            }
    /* Every line along an axis through the inside meets it: here the middle ones. */
    assert_int_equal(test_voxel_at(&v, 1, 20, 20), 255);
    assert_int_equal(test_voxel_at(&v, 40, 20, 20), 255);
    assert_int_equal(test_voxel_at(&v, 20, 1, 20), 255);
    assert_int_equal(test_voxel_at(&v, 20, 20, 40), 255);
    assert_int_equal(test_voxel_at(&v, 20, 20, 20), 0);
    nook_volume_free(&v);
    free(s);
}

/* ---- Holes ------------------------------------------------------------------------------------------------------ */

static void test_closed_rotated_meshes_do_not_leak(void **state)
{
    (void)state;
    test_sphere *s = test_make_sphere(1.0);
    for (int turn = 0; turn < 24; turn++) {
        float points[8][3];
        test_make_box(3.0f, 2.5f, 2.0f, points);
        test_rotate(points, 8, turn * 0.2617993877991494, turn * 0.41);
        nook_triangles box = test_box_triangles(points);
        nook_volume v = test_voxelize(&box, 24, 1);
        double volume = 15.0 / pow(v.info.voxel_size, 3.0);
        assert_true((double)count_enclosed(&v) > 0.5 * volume);
        nook_volume_free(&v);

        test_rotate(s->points, SPHERE_VERTICES, 0.3, 0.7);
        nook_triangles ball = test_sphere_triangles(s);
        v = test_voxelize(&ball, 20, 1);
        assert_true((double)count_enclosed(&v) > 0.5 * 4.18 * 1000.0);
        nook_volume_free(&v);
    }
    free(s);
}

static void test_edges_through_voxel_centres_leave_no_gap(void **state)
{
    (void)state;
    /* At resolution 5 the centre of the octahedron and its edges fall on voxel centres. */
    const float points[6][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
    const uint32_t indices[24] = { 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5 };
    nook_triangles octahedron = { points[0], 0, 6, indices, 24 };
    for (uint32_t resolution = 5; resolution <= 33; resolution += 2) {
        nook_volume v = test_voxelize(&octahedron, resolution, 1);
        uint32_t middle = (resolution + 1) / 2;
        assert_int_equal(test_voxel_at(&v, middle, middle, 1), 255);
        assert_int_equal(test_voxel_at(&v, middle, middle, resolution), 255);
        assert_int_equal(test_voxel_at(&v, 1, middle, middle), 255);
        assert_true(count_enclosed(&v) > 0);
        nook_volume_free(&v);
    }
}

/* A flat grid of quads with lines at `lines` metres both ways, in the plane across `axis`, in a box of 10 m. */
static nook_volume voxelize_lines(int axis, const float *lines, uint32_t count)
{
    float points[4 * 4 + 2][3] = { { 0 } };
    uint32_t indices[3 * 3 * 6 + 6], n = 0, far = count * count;
    for (uint32_t i = 0; i < far; i++) {
        points[i][axis] = 5.5f;
        points[i][(axis + 1) % 3] = lines[i % count];
        points[i][(axis + 2) % 3] = lines[i / count];
    }
    for (uint32_t y = 0; y + 1 < count; y++)
        for (uint32_t x = 0; x + 1 < count; x++) {
            uint32_t a = y * count + x;
            const uint32_t quad[6] = { a, a + 1, a + count, a + 1, a + count + 1, a + count };
            memcpy(indices + n, quad, sizeof quad);
            n += 6;
        }
    for (uint32_t i = 0; i < 6; i++) /* two points that fix the box */
        indices[n++] = far + i / 3;
    for (int k = 0; k < 3; k++)
        points[far + 1][k] = 10.0f;
    nook_triangles triangles = { points[0], 0, far + 2, indices, n };
    return test_voxelize(&triangles, 10, 1);
}

static void test_lines_on_voxel_centres_belong_to_both_sides(void **state)
{
    (void)state;
    static const float inner[] = { 0.0f, 2.5f, 6.5f, 10.0f }, outer[] = { 2.5f, 7.5f };
    for (int axis = 0; axis < 3; axis++) {
        nook_volume v = voxelize_lines(axis, inner, 4);
        assert_int_equal(v.info.occupied, 10 * 10 + 2);
        nook_volume_free(&v);
        v = voxelize_lines(axis, outer, 2);
        assert_int_equal(v.info.occupied, 6 * 6 + 2); /* the border's own voxels too */
        nook_volume_free(&v);
    }
}

static void test_tiny_triangles_make_the_same_shell_as_large_ones(void **state)
{
    (void)state;
    /* The same slanted square, in 2 triangles and in 2 * 200 * 200 that are far smaller than a voxel. */
    enum { CELLS = 200, SIDE = CELLS + 1 };
    float(*points)[3] = malloc(sizeof *points * SIDE * SIDE);
    uint32_t *indices = malloc(sizeof *indices * CELLS * CELLS * 6);
    assert_non_null(points);
    assert_non_null(indices);
    size_t n = 0;
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        points[i][0] = (float)(i % SIDE) / CELLS;
        points[i][1] = (float)(i / SIDE) / CELLS;
        points[i][2] = 0.5f * points[i][0] + 0.25f * points[i][1];
    }
    for (uint32_t c = 0; c < CELLS * CELLS; c++) {
        uint32_t a = c / CELLS * SIDE + c % CELLS;
        const uint32_t quad[6] = { a, a + 1, a + SIDE, a + 1, a + SIDE + 1, a + SIDE };
        memcpy(indices + n, quad, sizeof quad);
        n += 6;
    }
    const uint32_t corners[6] = { 0, CELLS, SIDE * CELLS, CELLS, SIDE * SIDE - 1, SIDE * CELLS };
    nook_triangles fine = { points[0], 0, SIDE * SIDE, indices, n };
    nook_triangles coarse = { points[0], 0, SIDE * SIDE, corners, 6 };
    nook_volume a = test_voxelize(&fine, 32, 1), b = test_voxelize(&coarse, 32, 1);
    assert_true(llabs((long long)a.info.occupied - (long long)b.info.occupied) <= (long long)b.info.occupied / 50);
    nook_volume_free(&a);
    nook_volume_free(&b);
    free(points);
    free(indices);
}

static void test_thin_wire_and_crumbs_do_not_vanish(void **state)
{
    (void)state;
    /* A sliver of a thousandth of a voxel along a slanted line, and a crumb far from it. */
    const float points[6][3] = { { 0.0f, 0.0f, 0.0f },    { 32.0f, 9.3f, 5.7f },    { 32.0f, 9.301f, 5.7f },
                                 { 20.1f, 20.1f, 20.1f }, { 20.11f, 20.1f, 20.1f }, { 20.1f, 20.11f, 20.1f } };
    const uint32_t indices[6] = { 0, 1, 2, 3, 4, 5 };
    nook_triangles soup = { points[0], 0, 6, indices, 6 };
    nook_volume v = test_voxelize(&soup, 32, 1);
    uint32_t empty_run = 0;
    for (uint32_t x = 1; x <= 32; x++) {
        int found = 0;
        for (uint32_t z = 1; z <= 8; z++)
            for (uint32_t y = 1; y <= 12; y++)
                found |= test_voxel_at(&v, x, y, z);
        empty_run = found ? 0 : empty_run + 1;
        assert_true(empty_run <= 1);
    }
    assert_int_equal(test_voxel_at(&v, 21, 21, 21), 255);
    nook_volume_free(&v);
}

static void test_largest_resolution_fills_its_volume_and_goes_through_a_file(void **state)
{
    (void)state;
    float points[8][3];
    test_make_box(1.0f, 1.0f, 1.0f / NOOK_VOXELIZE_RESOLUTION_MAX, points);
    nook_triangles plate = test_box_triangles(points);
    nook_volume v = test_voxelize(&plate, NOOK_VOXELIZE_RESOLUTION_MAX, 1), read;
    assert_int_equal(v.info.width, NOOK_VOLUME_SIDE_MAX);
    assert_int_equal(v.info.height, NOOK_VOLUME_SIDE_MAX);
    assert_int_equal(v.info.depth, 3);
    assert_int_equal(v.info.occupied, NOOK_VOXELIZE_RESOLUTION_MAX * NOOK_VOXELIZE_RESOLUTION_MAX);
    test_assert_border_empty(&v);
    void *bytes;
    size_t size;
    assert_int_equal(nook_volume_encode(&v, &bytes, &size), NOOK_OK);
    assert_int_equal(nook_volume_decode("plate", bytes, size, &read), NOOK_OK);
    test_assert_same_voxels(&v, &read);
    free(bytes);
    nook_volume_free(&read);
    nook_volume_free(&v);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_axis_aligned_box_becomes_its_shell),
        cmocka_unit_test(test_a_body_has_the_same_voxels_at_any_scale),
        cmocka_unit_test(test_a_point_becomes_one_voxel_wherever_it_is),
        cmocka_unit_test(test_flat_plane_becomes_exactly_one_layer),
        cmocka_unit_test(test_walls_inside_a_scene_stay_one_layer_whatever_their_phase),
        cmocka_unit_test(test_sphere_voxels_lie_on_the_sphere_and_cover_it),
        cmocka_unit_test(test_closed_rotated_meshes_do_not_leak),
        cmocka_unit_test(test_edges_through_voxel_centres_leave_no_gap),
        cmocka_unit_test(test_lines_on_voxel_centres_belong_to_both_sides),
        cmocka_unit_test(test_tiny_triangles_make_the_same_shell_as_large_ones),
        cmocka_unit_test(test_thin_wire_and_crumbs_do_not_vanish),
        cmocka_unit_test(test_largest_resolution_fills_its_volume_and_goes_through_a_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
