#include "engine/core/log.h"
#include "modules/bake/voxelize.h"
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

static nook_volume voxelize(const nook_triangles *triangles, uint32_t resolution, uint32_t threads)
{
    nook_volume volume = { 0 };
    nook_voxelize_desc desc = { .resolution = resolution, .threads = threads };
    assert_int_equal(nook_voxelize(triangles, &desc, &volume), NOOK_OK);
    return volume;
}

static int at(const nook_volume *v, uint32_t x, uint32_t y, uint32_t z)
{
    return v->voxels[((size_t)z * v->info.height + y) * v->info.width + x];
}

static size_t voxel_count(const nook_volume *v)
{
    return (size_t)v->info.width * v->info.height * v->info.depth;
}

static uint64_t count_occupied(const nook_volume *v)
{
    uint64_t count = 0;
    for (size_t i = 0; i < voxel_count(v); i++) {
        assert_true(v->voxels[i] == 0 || v->voxels[i] == 255);
        count += v->voxels[i] == 255;
    }
    return count;
}

static void assert_border_empty(const nook_volume *v)
{
    for (uint32_t z = 0; z < v->info.depth; z++)
        for (uint32_t y = 0; y < v->info.height; y++)
            for (uint32_t x = 0; x < v->info.width; x++)
                if (x == 0 || y == 0 || z == 0 || x + 1 == v->info.width || y + 1 == v->info.height ||
                    z + 1 == v->info.depth)
                    assert_int_equal(at(v, x, y, z), 0);
}

static void assert_same_voxels(const nook_volume *a, const nook_volume *b)
{
    assert_int_equal(a->info.width, b->info.width);
    assert_int_equal(a->info.height, b->info.height);
    assert_int_equal(a->info.depth, b->info.depth);
    assert_memory_equal(a->voxels, b->voxels, voxel_count(a));
}

/* ---- Shapes ----------------------------------------------------------------------------------------------------- */

static const uint32_t box_indices[36] = { 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                          2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 };

static void make_box(float x, float y, float z, float out[8][3])
{
    for (int i = 0; i < 8; i++) {
        out[i][0] = i & 1 ? x : 0.0f;
        out[i][1] = i & 2 ? y : 0.0f;
        out[i][2] = i & 4 ? z : 0.0f;
    }
}

static void rotate(float (*points)[3], uint32_t count, double about_x, double about_y)
{
    for (uint32_t i = 0; i < count; i++) {
        double x = points[i][0], y = points[i][1], z = points[i][2];
        double y1 = cos(about_x) * y - sin(about_x) * z, z1 = sin(about_x) * y + cos(about_x) * z;
        points[i][0] = (float)(cos(about_y) * x + sin(about_y) * z1);
        points[i][1] = (float)y1;
        points[i][2] = (float)(-sin(about_y) * x + cos(about_y) * z1);
    }
}

enum { RINGS = 24, SECTORS = 48, SPHERE_VERTICES = (RINGS + 1) * SECTORS, SPHERE_INDICES = RINGS * SECTORS * 6 };

typedef struct sphere {
    float points[SPHERE_VERTICES][3];
    uint32_t indices[SPHERE_INDICES];
} sphere;

static sphere *make_sphere(double radius)
{
    const double pi = 3.14159265358979323846;
    sphere *s = malloc(sizeof *s);
    assert_non_null(s);
    size_t n = 0;
    for (int r = 0; r <= RINGS; r++)
        for (int c = 0; c < SECTORS; c++) {
            double latitude = pi * r / RINGS, longitude = 2.0 * pi * c / SECTORS;
            float *p = s->points[r * SECTORS + c];
            p[0] = (float)(radius * sin(latitude) * cos(longitude));
            p[1] = (float)(radius * cos(latitude));
            p[2] = (float)(radius * sin(latitude) * sin(longitude));
        }
    for (uint32_t r = 0; r < RINGS; r++)
        for (uint32_t c = 0; c < SECTORS; c++) {
            uint32_t a = r * SECTORS + c, b = r * SECTORS + (c + 1) % SECTORS;
            const uint32_t quad[6] = { a, b, a + SECTORS, b, b + SECTORS, a + SECTORS };
            memcpy(s->indices + n, quad, sizeof quad);
            n += 6;
        }
    return s;
}

static nook_triangles sphere_triangles(const sphere *s)
{
    return (nook_triangles){ s->points[0], 0, SPHERE_VERTICES, s->indices, SPHERE_INDICES };
}

static nook_triangles box_triangles(float (*points)[3])
{
    return (nook_triangles){ points[0], 0, 8, box_indices, 36 };
}

/* Fills the empty voxels that have a 6-connected way to the corner (0, 0, 0). @return the empty voxels without one */
static size_t count_enclosed(const nook_volume *v)
{
    size_t count = voxel_count(v), top = 0, enclosed = 0;
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
    make_box(4.0f, 3.0f, 2.0f, points);
    nook_triangles box = box_triangles(points);
    nook_volume v = voxelize(&box, 16, 1);
    assert_int_equal(v.info.width, 18);
    assert_int_equal(v.info.height, 14);
    assert_int_equal(v.info.depth, 10);
    assert_true(v.info.voxel_size == 0.25);
    assert_true(v.info.origin[0] == -0.25 && v.info.origin[1] == -0.25 && v.info.origin[2] == -0.25);
    for (uint32_t z = 1; z <= 8; z++)
        for (uint32_t y = 1; y <= 12; y++)
            for (uint32_t x = 1; x <= 16; x++) {
                int shell = x == 1 || x == 16 || y == 1 || y == 12 || z == 1 || z == 8;
                assert_int_equal(at(&v, x, y, z), shell ? 255 : 0);
            }
    assert_border_empty(&v);
    assert_int_equal(v.info.occupied, count_occupied(&v));
    nook_volume_free(&v);
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
        nook_volume v = voxelize(&plane, 20, 1);
        const uint32_t size[3] = { v.info.width, v.info.height, v.info.depth };
        assert_int_equal(size[axis], 3);
        assert_int_equal(v.info.occupied, 20 * 20);
        assert_border_empty(&v);
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
        nook_volume v = voxelize(&scene, 32, 1);
        assert_int_equal(v.info.occupied, 32 * 32 + 2);
        uint32_t layer = phase < 64 ? 11 : 12;
        for (uint32_t z = 1; z <= 32; z++)
            for (uint32_t y = 1; y <= 32; y++)
                assert_int_equal(at(&v, layer, y, z), 255);
        nook_volume_free(&v);
    }
}

static void test_sphere_voxels_lie_on_the_sphere_and_cover_it(void **state)
{
    (void)state;
    sphere *s = make_sphere(2.0);
    nook_triangles triangles = sphere_triangles(s);
    nook_volume v = voxelize(&triangles, 40, 1);
    double half_diagonal = 0.5 * sqrt(3.0) * v.info.voxel_size;
    double sagitta = 2.0 * (1.0 - cos(3.1416 / RINGS / 2.0)) * 2.0; /* the facets lie inside the sphere */
    for (uint32_t z = 0; z < v.info.depth; z++)
        for (uint32_t y = 0; y < v.info.height; y++)
            for (uint32_t x = 0; x < v.info.width; x++) {
                if (!at(&v, x, y, z))
                    continue;
                double px = v.info.origin[0] + (x + 0.5) * v.info.voxel_size;
                double py = v.info.origin[1] + (y + 0.5) * v.info.voxel_size;
                double pz = v.info.origin[2] + (z + 0.5) * v.info.voxel_size;
                double r = sqrt(px * px + py * py + pz * pz);
                assert_true(r > 2.0 - half_diagonal - sagitta && r < 2.0 + half_diagonal + 1e-3);
            }
    /* Every line along an axis through the inside meets it: here the middle ones. */
    assert_int_equal(at(&v, 1, 20, 20), 255);
    assert_int_equal(at(&v, 40, 20, 20), 255);
    assert_int_equal(at(&v, 20, 1, 20), 255);
    assert_int_equal(at(&v, 20, 20, 40), 255);
    assert_int_equal(at(&v, 20, 20, 20), 0);
    nook_volume_free(&v);
    free(s);
}

/* ---- Holes ------------------------------------------------------------------------------------------------------ */

static void test_closed_rotated_meshes_do_not_leak(void **state)
{
    (void)state;
    sphere *s = make_sphere(1.0);
    for (int turn = 0; turn < 24; turn++) {
        float points[8][3];
        make_box(3.0f, 2.5f, 2.0f, points);
        rotate(points, 8, turn * 0.2617993877991494, turn * 0.41);
        nook_triangles box = box_triangles(points);
        nook_volume v = voxelize(&box, 24, 1);
        double volume = 15.0 / pow(v.info.voxel_size, 3.0);
        assert_true((double)count_enclosed(&v) > 0.5 * volume);
        nook_volume_free(&v);

        rotate(s->points, SPHERE_VERTICES, 0.3, 0.7);
        nook_triangles ball = sphere_triangles(s);
        v = voxelize(&ball, 20, 1);
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
        nook_volume v = voxelize(&octahedron, resolution, 1);
        uint32_t middle = (resolution + 1) / 2;
        assert_int_equal(at(&v, middle, middle, 1), 255);
        assert_int_equal(at(&v, middle, middle, resolution), 255);
        assert_int_equal(at(&v, 1, middle, middle), 255);
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
    return voxelize(&triangles, 10, 1);
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
    nook_volume a = voxelize(&fine, 32, 1), b = voxelize(&coarse, 32, 1);
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
    nook_volume v = voxelize(&soup, 32, 1);
    uint32_t empty_run = 0;
    for (uint32_t x = 1; x <= 32; x++) {
        int found = 0;
        for (uint32_t z = 1; z <= 8; z++)
            for (uint32_t y = 1; y <= 12; y++)
                found |= at(&v, x, y, z);
        empty_run = found ? 0 : empty_run + 1;
        assert_true(empty_run <= 1);
    }
    assert_int_equal(at(&v, 21, 21, 21), 255);
    nook_volume_free(&v);
}

/* ---- Soups ------------------------------------------------------------------------------------------------------ */

static void test_degenerate_triangles_are_segments_and_points(void **state)
{
    (void)state;
    const float points[3][3] = { { 0, 0, 0 }, { 8, 0, 0 }, { 4, 6, 0 } };
    const uint32_t segment[3] = { 0, 1, 0 }, point[3] = { 2, 2, 2 };
    nook_triangles soup = { points[0], 0, 3, segment, 3 };
    nook_volume v = voxelize(&soup, 8, 1);
    assert_int_equal(v.info.width, 10);
    assert_int_equal(v.info.height, 3);
    assert_int_equal(v.info.occupied, 8);
    nook_volume_free(&v);

    soup.indices = point;
    v = voxelize(&soup, 8, 1);
    assert_int_equal(v.info.occupied, 1);
    assert_int_equal(voxel_count(&v), 27);
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
    nook_volume a = voxelize(&once, 50, 1), b = voxelize(&twice, 50, 1);
    assert_same_voxels(&a, &b);
    assert_border_empty(&a);
    assert_true(a.info.content_hash != b.info.content_hash);
    nook_volume_free(&a);
    nook_volume_free(&b);
}

static void test_winding_does_not_matter(void **state)
{
    (void)state;
    float points[8][3];
    uint32_t flipped[36];
    make_box(1.0f, 0.8f, 0.6f, points);
    rotate(points, 8, 0.5, 0.9);
    for (int i = 0; i < 36; i++)
        flipped[i] = box_indices[35 - i];
    nook_triangles box = box_triangles(points), inside_out = { points[0], 0, 8, flipped, 36 };
    nook_volume a = voxelize(&box, 33, 1), b = voxelize(&inside_out, 33, 1);
    assert_same_voxels(&a, &b);
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
    nook_volume a = voxelize(&clean, 16, 1), b = voxelize(&dirty, 16, 1);
    assert_int_equal(lines, 1);
    assert_same_voxels(&a, &b);
    dirty.index_count = 3;
    nook_volume untouched = { .voxels = (uint8_t *)&lines };
    nook_voxelize_desc desc = { .resolution = 16 };
    assert_int_equal(nook_voxelize(&dirty, &desc, &untouched), NOOK_E_ARG);
    assert_ptr_equal(untouched.voxels, &lines);
    nook_log_set_sink(NULL, NULL);
    nook_volume_free(&a);
    nook_volume_free(&b);
}

static void test_enormous_and_far_coordinates_are_fine(void **state)
{
    (void)state;
    const float points[6][3] = { { -3e38f, -3e38f, -3e38f }, { 3e38f, 3e38f, 3e38f }, { 3e38f, -3e38f, 0.0f },
                                 { 1e-40f, 0, 0 },           { 0, 1e-40f, 0 },        { 0, 0, 1e-40f } };
    const uint32_t indices[6] = { 0, 1, 2, 3, 4, 5 };
    nook_triangles large = { points[0], 0, 6, indices, 3 }, small = { points[0], 0, 6, indices + 3, 3 };
    nook_volume v = voxelize(&large, 64, 1);
    assert_true(isfinite(v.info.voxel_size) && isfinite(v.info.origin[0]) && v.info.occupied > 64);
    nook_volume_free(&v);
    v = voxelize(&small, 64, 1);
    assert_int_equal(v.info.occupied, 1);
    nook_volume_free(&v);
}

/* ---- Invariances ------------------------------------------------------------------------------------------------ */

static void test_translation_by_whole_voxels_gives_the_same_pattern(void **state)
{
    (void)state;
    /* Coordinates in 1/1024 m and a box of 32 m, so that floats hold the moved ones exactly. */
    sphere *s = make_sphere(15.0);
    for (uint32_t i = 0; i < SPHERE_VERTICES; i++)
        for (int axis = 0; axis < 3; axis++)
            s->points[i][axis] = roundf(s->points[i][axis] * 1024.0f) / 1024.0f;
    s->points[0][1] = 16.0f;
    s->points[SPHERE_VERTICES - 1][1] = -16.0f;
    nook_triangles triangles = sphere_triangles(s);
    nook_volume a = voxelize(&triangles, 64, 1);
    for (uint32_t i = 0; i < SPHERE_VERTICES; i++) {
        s->points[i][0] += 7.0f;
        s->points[i][1] -= 1000.0f;
        s->points[i][2] += 0.5f;
    }
    nook_volume b = voxelize(&triangles, 64, 1);
    assert_same_voxels(&a, &b);
    assert_true(b.info.origin[0] == a.info.origin[0] + 7.0);
    assert_true(b.info.origin[1] == a.info.origin[1] - 1000.0);
    nook_volume_free(&a);
    nook_volume_free(&b);
    free(s);
}

static void test_result_does_not_depend_on_threads(void **state)
{
    (void)state;
    sphere *s = make_sphere(1.0);
    nook_triangles triangles = sphere_triangles(s);
    nook_volume one = voxelize(&triangles, 100, 1);
    for (uint32_t threads = 0; threads <= 4; threads++) {
        nook_volume many = voxelize(&triangles, 100, threads);
        assert_same_voxels(&one, &many);
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
    make_box(1.0f, 2.0f, 3.0f, points);
    for (int i = 0; i < 8; i++) {
        memcpy(spaced[i], points[i], sizeof points[i]);
        spaced[i][3] = spaced[i][4] = NAN;
    }
    nook_triangles packed = box_triangles(points), wide = packed;
    wide.positions = spaced[0];
    wide.stride = sizeof spaced[0];
    nook_volume a = voxelize(&packed, 12, 1), b = voxelize(&wide, 12, 1);
    assert_same_voxels(&a, &b);
    assert_true(a.info.content_hash == b.info.content_hash);
    nook_volume_free(&a);
    nook_volume_free(&b);
}

static void test_hash_tells_content_and_resolution_apart(void **state)
{
    (void)state;
    float points[8][3];
    make_box(1.0f, 2.0f, 3.0f, points);
    nook_triangles box = box_triangles(points);
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
    make_box(1.0f, 1.0f, 1.0f, points);
    const nook_triangles box = box_triangles(points);
    nook_voxelize_desc desc = { .resolution = 0 };
    nook_volume v;
    int lines = 0;
    nook_log_set_sink(swallow, &lines);
    assert_int_equal(nook_voxelize(&box, &desc, &v), NOOK_E_RANGE);
    desc.resolution = 511;
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
        cmocka_unit_test(test_axis_aligned_box_becomes_its_shell),
        cmocka_unit_test(test_flat_plane_becomes_exactly_one_layer),
        cmocka_unit_test(test_walls_inside_a_scene_stay_one_layer_whatever_their_phase),
        cmocka_unit_test(test_sphere_voxels_lie_on_the_sphere_and_cover_it),
        cmocka_unit_test(test_closed_rotated_meshes_do_not_leak),
        cmocka_unit_test(test_edges_through_voxel_centres_leave_no_gap),
        cmocka_unit_test(test_lines_on_voxel_centres_belong_to_both_sides),
        cmocka_unit_test(test_tiny_triangles_make_the_same_shell_as_large_ones),
        cmocka_unit_test(test_thin_wire_and_crumbs_do_not_vanish),
        cmocka_unit_test(test_degenerate_triangles_are_segments_and_points),
        cmocka_unit_test(test_open_double_and_intersecting_soup_is_fine),
        cmocka_unit_test(test_winding_does_not_matter),
        cmocka_unit_test(test_triangles_that_are_not_finite_are_left_out),
        cmocka_unit_test(test_enormous_and_far_coordinates_are_fine),
        cmocka_unit_test(test_translation_by_whole_voxels_gives_the_same_pattern),
        cmocka_unit_test(test_result_does_not_depend_on_threads),
        cmocka_unit_test(test_stride_is_skipped),
        cmocka_unit_test(test_hash_tells_content_and_resolution_apart),
        cmocka_unit_test(test_voxelize_refuses_what_it_cannot_take),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
