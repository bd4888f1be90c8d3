/* Triangles to surfels: what comes back is the surface. */
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "modules/bake/brick_grid.h"
#include "tests/support/surfel_shapes.h"
#include "tests/support/voxel_shapes.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 16 };
#define FULL NOOK_SURFEL_ALPHA_MAX

/* What 32 bits hold a plane to: radians; and voxels, with half a step of the offset, as far as a voxel's corners are apart. */
static const double normal_error = 0.0115, word_error = 0.5 * NOOK_SURFEL_OFFSET_MAX / 127.0 + 0.0115 * 0.87;

static void count_warnings(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    (void)file, (void)line, (void)text;
    *(int *)user += level == NOOK_LOG_WARNING;
}

/* ---- Words ------------------------------------------------------------------------------------------------------ */

static void test_a_plane_comes_back_from_its_word(void **state)
{
    (void)state;
    srand(7);
    for (int i = 0; i < 20000; i++) {
        nook_surfel_plane plane = { .alpha = 1 + (uint32_t)rand() % 63, .side = (nook_surfel_side)(rand() % 3) };
        double through[3], random[3];
        for (int k = 0; k < 3; k++) {
            random[k] = rand() / (double)RAND_MAX - 0.5;
            through[k] = rand() / (double)RAND_MAX - 0.5;
        }
        if (!nook_vector_normalize(random, plane.normal))
            continue;
        uint32_t word = nook_surfel_pack(&plane, through);
        nook_surfel_plane back = nook_surfel_unpack(word);
        assert_true(nook_surfel_is_sound(word & 0x3fffffffu, 0) && nook_surfel_is_sound(word, word));
        assert_int_equal(back.alpha, plane.alpha);
        assert_int_equal(back.side, plane.side);
        assert_true(nook_vector_dot(back.normal, plane.normal) > cos(normal_error));
        assert_true(fabs(nook_vector_dot(back.normal, through) - back.offset) <=
                    0.5001 * NOOK_SURFEL_OFFSET_MAX / 127.0);
    }
}

static void test_axes_come_back_exactly(void **state)
{
    (void)state;
    for (int i = 0; i < 6; i++) {
        nook_surfel_plane plane = { .alpha = FULL };
        const double middle[3] = { 0.0, 0.0, 0.0 };
        plane.normal[i / 2] = i % 2 ? -1.0 : 1.0;
        nook_surfel_plane back = nook_surfel_unpack(nook_surfel_pack(&plane, middle));
        for (int k = 0; k < 3; k++)
            assert_true(back.normal[k] == plane.normal[k]);
        assert_true(back.offset == 0.0);
    }
}

static void test_words_that_no_plane_has_are_refused(void **state)
{
    (void)state;
    const uint32_t good = 1u << 24;
    assert_true(nook_surfel_is_sound(good, 0));
    assert_true(nook_surfel_is_sound(good | 1u << 30, good | 2u << 30));
    assert_false(nook_surfel_is_sound(0, 0));
    assert_false(nook_surfel_is_sound(0, good));
    assert_false(nook_surfel_is_sound(0x3fu, 0));        /* no alpha */
    assert_false(nook_surfel_is_sound(good | 0x80u, 0)); /* -128 */
    assert_false(nook_surfel_is_sound(good | 0x8000u, 0));
    assert_false(nook_surfel_is_sound(good | 0x800000u, 0));
    assert_false(nook_surfel_is_sound(good | 1u << 30, 0)); /* a side of nothing */
    assert_false(nook_surfel_is_sound(good | 3u << 30, 0)); /* an interval with room for a box */
    assert_true(nook_surfel_is_sound(good | 3u << 30, 62u << 24 | 3u << 30));
    assert_false(nook_surfel_is_sound(good, 63u << 24 | 3u << 30)); /* no such interval */
    assert_true(nook_surfel_is_sound(good, 0x00fff0u));             /* a box that leaves a sixteenth of each axis */
    assert_false(nook_surfel_is_sound(good, 0x00f001u));            /* ... nothing of one */
    assert_false(nook_surfel_is_sound(good, 0x8f0800u));
}

/* ---- Closed forms ----------------------------------------------------------------------------------------------- */

/* A wide sheet through the middle of the grid, as two vectors across `normal`. */
static test_sheet wide_sheet(const double normal[3], float half)
{
    double up[3] = { fabs(normal[0]) < 0.6, fabs(normal[0]) >= 0.6, 0.0 }, u[3], v[3];
    nook_vector_cross(normal, up, u);
    assert_true(nook_vector_normalize(u, u));
    nook_vector_cross(normal, u, v);
    float corner[3], along[3], across[3];
    for (int i = 0; i < 3; i++) {
        along[i] = (float)(2.0 * half * u[i]);
        across[i] = (float)(2.0 * half * v[i]);
        corner[i] = (float)(SIDE * 0.5 + 0.137 - half * (u[i] + v[i]));
    }
    return test_make_sheet(SIDE, corner, along, across);
}

static void test_a_tilted_plane_comes_back_from_its_surfels(void **state)
{
    (void)state;
    static const double tilts[][3] = { { 0, 0, 1 },        { 0, 1, 0 },       { 1, 0, 0 },       { 0.05, 0, 1 },
                                       { 1, 1, 0 },        { 1, 1, 1 },       { 0.3, -0.2, 1 },  { -0.7, 0.4, 0.1 },
                                       { 1, -0.02, 0.01 }, { -1, -0.9, 0.8 }, { 0.1, 0.2, -0.9 } };
    const float half = 5.0f; /* inside of the grid at any tilt */
    for (size_t t = 0; t < sizeof tilts / sizeof *tilts; t++) {
        double normal[3] = { 0 }, middle[3] = { SIDE * 0.5 + 0.137, SIDE * 0.5 + 0.137, SIDE * 0.5 + 0.137 };
        assert_true(nook_vector_normalize(tilts[t], normal));
        test_sheet sheet = wide_sheet(normal, half);
        nook_triangles triangles = test_sheet_triangles(&sheet);
        nook_volume v = test_make_surfels(&triangles, SIDE, 1);
        test_to_voxels(&v, middle, middle);
        int full = 0;
        for (uint32_t i = 0; i < 18 * 18 * 18; i++) {
            const uint32_t at[3] = { i % 18, i / 18 % 18, i / 324 };
            const nook_surfel *surfel = test_surfel_at(&v, at[0], at[1], at[2]);
            double from_middle[3], height = 0.0, squared = 0.0;
            for (int k = 0; k < 3; k++) {
                from_middle[k] = at[k] + 0.5 - middle[k];
                height += normal[k] * from_middle[k];
            }
            for (int k = 0; k < 3; k++)
                squared += (from_middle[k] - height * normal[k]) * (from_middle[k] - height * normal[k]);
            double reach =
                0.5 * (fabs(normal[0]) + fabs(normal[1]) + fabs(normal[2])); /* of the voxel along the normal */
            int inside = sqrt(squared) < (double)half - 0.87 - 0.5; /* of the sheet, with all of the voxel's section */
            if (!surfel) {                                          /* cut by less than what a step of alpha tells */
                assert_true(!inside || fabs(height) > reach - 0.2);
                continue;
            }
            nook_surfel_plane plane = nook_surfel_unpack(surfel->plane[0]);
            assert_false(nook_surfel_word_is_plane(surfel->plane[1]));
            assert_true(fabs(nook_vector_dot(plane.normal, normal)) > cos(normal_error));
            assert_true(fabs(height) < reach + 1e-3);
            double foot[3]; /* of the voxel's middle on the true plane */
            for (int k = 0; k < 3; k++)
                foot[k] = at[k] + 0.5 - height * normal[k];
            assert_true(fabs(test_height_over(&plane, at, foot)) < word_error);
            if (inside) {
                assert_int_equal(plane.alpha, FULL);
                assert_int_equal(surfel->plane[1], 0); /* all of it: no box */
                full++;
            }
        }
        assert_true(full >= 8);
        nook_volume_free(&v);
    }
}

static void test_a_thin_wire_covers_little_and_does_not_vanish(void **state)
{
    (void)state;
    const float corner[3] = { 2, 3.4f, 4.5f }, u[3] = { 9, 0, 0 }, v[3] = { 0, 0.05f, 0 };
    test_sheet sheet = test_make_sheet(SIDE, corner, u, v);
    nook_triangles triangles = test_sheet_triangles(&sheet);
    nook_volume volume = test_make_surfels(&triangles, SIDE, 1);
    assert_int_equal(volume.info.occupied, 9);
    assert_true(fabs(test_covered_across_z(test_surfel_at(&volume, 5, 4, 5)) - 0.05) < 0.25 / FULL);
    nook_volume_free(&volume);
}

/* Meshes that are added to one another: at most 64 corners. */
typedef struct soup {
    float points[64][3];
    uint32_t indices[64], point_count, index_count;
} soup;

static void add_quad(soup *s, const float corner[3], const float u[3], const float v[3])
{
    static const uint32_t order[6] = { 0, 1, 2, 2, 1, 3 };
    for (int k = 0; k < 6; k++)
        s->indices[s->index_count++] = s->point_count + order[k];
    for (int k = 0; k < 4; k++, s->point_count++)
        for (int i = 0; i < 3; i++)
            s->points[s->point_count][i] = corner[i] + (k & 1 ? u[i] : 0.0f) + (k & 2 ? v[i] : 0.0f);
}

/* Fixes a grid of SIDE voxels of 1 m. */
static nook_volume bake_soup(soup *s)
{
    for (int k = 0; k < 2; k++, s->point_count++)
        for (int i = 0; i < 3; i++) {
            s->points[s->point_count][i] = k ? (float)SIDE : 0.0f;
            s->indices[s->index_count++] = s->point_count;
        }
    nook_triangles triangles = { s->points[0], 0, s->point_count, s->indices, s->index_count };
    return test_make_surfels(&triangles, SIDE, 1);
}

static void test_sheets_over_a_quarter_voxel_apart_are_two_planes(void **state)
{
    (void)state;
    for (int tenths = 3; tenths <= 6; tenths++) {
        soup s = { 0 };
        float first[3] = { 1, 1, 4.25f }, second[3] = { 1, 1, 4.25f + (float)tenths / 10.0f };
        const float u[3] = { 8, 0, 0 }, v[3] = { 0, 8, 0 };
        add_quad(&s, first, u, v);
        add_quad(&s, second, u, v);
        nook_volume volume = bake_soup(&s);
        assert_int_equal(volume.info.occupied, 64);
        const nook_surfel *surfel = test_surfel_at(&volume, 5, 5, 5);
        assert_non_null(surfel);
        double heights[2];
        for (int k = 0; k < 2; k++) {
            nook_surfel_plane plane = nook_surfel_unpack(surfel->plane[k]);
            assert_int_equal(plane.alpha, FULL);
            assert_true(fabs(plane.normal[2]) == 1.0);
            heights[k] = plane.offset / plane.normal[2] + 0.5;
        }
        assert_true(fabs(fmin(heights[0], heights[1]) - 0.25) < word_error);
        assert_true(fabs(fmax(heights[0], heights[1]) - 0.25 - tenths / 10.0) < word_error);
        nook_volume_free(&volume);
    }
}

/* Two walls at right angles that meet in the middle of voxels along z. */
static void test_planes_of_an_edge_end_at_each_other(void **state)
{
    (void)state;
    for (int degrees = 0; degrees < 90; degrees += 15) {
        soup s = { 0 };
        float angle = (float)degrees * 0.0174532925f, c = cosf(angle), w = sinf(angle);
        const float corner[3] = { 8.4f, 8.3f, 2 }, along[3] = { 0, 0, 9 };
        const float u[3] = { 5 * c, 5 * w, 0 }, v[3] = { -5 * w, 5 * c, 0 };
        add_quad(&s, corner, u, along);
        add_quad(&s, corner, v, along);
        nook_volume volume = bake_soup(&s);
        for (uint32_t z = 4; z < 11; z++) {
            const uint32_t at[3] = { 9, 9, z };
            const nook_surfel *surfel = test_surfel_at(&volume, 9, 9, z);
            assert_non_null(surfel);
            const double middle[3] = { 9.4, 9.3, z + 0.5 };
            for (int k = 0; k < 2; k++) {
                nook_surfel_plane plane = nook_surfel_unpack(surfel->plane[k]);
                nook_surfel_plane other = nook_surfel_unpack(surfel->plane[1 - k]);
                assert_int_equal(plane.alpha, FULL);
                assert_true(fabs(test_height_over(&plane, at, middle)) < word_error);
                /* Which wall is it? A step along it is on the side where it is, a step back is not. */
                int is_u = fabs(plane.normal[0] * (double)u[0] + plane.normal[1] * (double)u[1]) < 0.1;
                const float *direction = is_u ? u : v;
                double ahead[3] = { middle[0] + 0.03 * (double)direction[0], middle[1] + 0.03 * (double)direction[1],
                                    middle[2] };
                double side = test_height_over(&other, at, ahead);
                assert_int_equal(plane.side, side > 0.0 ? NOOK_SIDE_ABOVE : NOOK_SIDE_BELOW);
                assert_true(fabs(side) > 0.1);
            }
        }
        nook_volume_free(&volume);
    }
}

static void test_a_wall_that_goes_on_behind_another_has_no_side(void **state)
{
    (void)state;
    soup s = { 0 };
    const float floor_corner[3] = { 1, 1, 8.5f }, fu[3] = { 14, 0, 0 }, fv[3] = { 0, 14, 0 };
    const float wall_corner[3] = { 8.5f, 1, 8.5f }, wu[3] = { 0, 0, 6 }, wv[3] = { 0, 14, 0 };
    add_quad(&s, floor_corner, fu, fv);
    add_quad(&s, wall_corner, wu, wv);
    nook_volume volume = bake_soup(&s);
    const nook_surfel *surfel = test_surfel_at(&volume, 9, 7, 9);
    assert_non_null(surfel);
    for (int k = 0; k < 2; k++) {
        nook_surfel_plane plane = nook_surfel_unpack(surfel->plane[k]);
        assert_int_equal(plane.alpha, FULL);
        assert_int_equal(plane.side != NOOK_SIDE_BOTH, fabs(plane.normal[0]) > 0.9);
    }
    nook_volume_free(&volume);
}

/* No plane of the three faces' corner voxel is far from the surface, and all of it is near some plane. */
static void test_the_corner_of_a_box_is_within_a_third_of_a_voxel(void **state)
{
    (void)state;
    float points[8][3];
    test_make_box(9.0f, 8.0f, 7.0f, points);
    test_rotate(points, 8, 0.5, 0.3);
    nook_triangles box = test_box_triangles(points);
    nook_volume v = test_make_surfels(&box, 20, 1);
    int looked = 0;
    for (int corner = 0; corner < 8; corner++) {
        double place[3] = { (double)points[corner][0], (double)points[corner][1], (double)points[corner][2] };
        test_to_voxels(&v, place, place);
        const uint32_t at[3] = { (uint32_t)place[0], (uint32_t)place[1], (uint32_t)place[2] };
        const nook_surfel *surfel = test_surfel_at(&v, at[0], at[1], at[2]);
        if (!surfel) /* the tip is smaller than a step of alpha */
            continue;
        looked++;
        double nearest = INFINITY;
        for (int k = 0; k < 2 && nook_surfel_word_is_plane(surfel->plane[k]); k++) {
            nook_surfel_plane plane = nook_surfel_unpack(surfel->plane[k]);
            nearest = fmin(nearest, fabs(test_height_over(&plane, at, place)));
        }
        assert_true(nearest < 1.0 / 3.0);
    }
    assert_true(looked >= 4);
    nook_volume_free(&v);
}

static void test_a_closed_sphere_is_closed(void **state)
{
    (void)state;
    test_sphere *s = test_make_sphere(1.0);
    nook_triangles sphere = test_sphere_triangles(s);
    nook_volume v = test_make_surfels(&sphere, 24, 1);
    double area = 0.0, missing = 0.0;
    for (uint64_t i = 0; i < v.info.occupied; i++) {
        area += 1.0;
        missing += 1.0 - nook_surfel_unpack(v.surfels[i].plane[0]).alpha / 63.0;
    }
    assert_true(area > 500.0);
    assert_true(missing / area < 0.05);
    nook_volume_free(&v);
    free(s);
}

/* ---- Always the same -------------------------------------------------------------------------------------------- */

static void test_threads_order_and_first_corners_do_not_show(void **state)
{
    (void)state;
    test_sphere *s = test_make_sphere(1.0);
    test_rotate(s->points, SPHERE_VERTICES, 0.4, 1.1);
    nook_triangles sphere = test_sphere_triangles(s);
    nook_volume usual = test_make_surfels(&sphere, 60, 1);
    for (uint32_t threads = 2; threads <= 5; threads++) {
        nook_volume v = test_make_surfels(&sphere, 60, threads);
        test_assert_same_surfels(&usual, &v);
        nook_volume_free(&v);
    }
    srand(3);
    for (uint32_t t = SPHERE_INDICES / 3 - 1; t > 0; t--) {
        uint32_t other = (uint32_t)rand() % (t + 1), kept[3], shift = (uint32_t)rand() % 3;
        memcpy(kept, s->indices + 3 * t, sizeof kept);
        memcpy(s->indices + 3 * t, s->indices + 3 * other, sizeof kept);
        for (uint32_t i = 0; i < 3; i++) /* turned round, and with another corner first */
            s->indices[3 * other + i] = kept[(2 - i + shift) % 3];
    }
    nook_volume v = test_make_surfels(&sphere, 60, 2);
    test_assert_same_surfels(&usual, &v);
    nook_volume_free(&v);
    nook_volume_free(&usual);
    free(s);
}

static void test_a_body_has_the_same_surfels_at_any_scale(void **state)
{
    (void)state;
    test_sphere *s = test_make_sphere(1.0);
    nook_triangles sphere = test_sphere_triangles(s);
    nook_volume usual = test_make_surfels(&sphere, 20, 1);
    for (int exponent = -60; exponent <= 60; exponent += 30) { /* powers of two: nothing is rounded */
        for (size_t i = 0; i < SPHERE_VERTICES; i++)
            for (int axis = 0; axis < 3; axis++)
                s->points[i][axis] = ldexpf(s->points[i][axis], exponent);
        nook_volume v = test_make_surfels(&sphere, 20, 1);
        test_assert_same_surfels(&usual, &v);
        nook_volume_free(&v);
        for (size_t i = 0; i < SPHERE_VERTICES; i++)
            for (int axis = 0; axis < 3; axis++)
                s->points[i][axis] = ldexpf(s->points[i][axis], -exponent);
    }
    nook_volume_free(&usual);
    free(s);
}

static void test_cut_up_triangles_make_the_planes_of_the_whole(void **state)
{
    (void)state;
    enum { CELLS = 20 };
    const float corner[3] = { 2.3f, 3.1f, 2.2f }, u[3] = { 9, 1.5f, 0.5f }, v[3] = { -1.2f, 8, 3 };
    test_sheet sheet = test_make_sheet(SIDE, corner, u, v);
    nook_triangles triangles = test_sheet_triangles(&sheet);
    nook_volume whole = test_make_surfels(&triangles, SIDE, 1);
    float(*points)[3] = malloc((CELLS + 1) * (CELLS + 1) * sizeof *points + 2 * sizeof *points);
    uint32_t *indices = malloc((CELLS * CELLS * 6 + 6) * sizeof *indices), n = 0, p = 0;
    assert_non_null(points);
    assert_non_null(indices);
    for (int row = 0; row <= CELLS; row++)
        for (int column = 0; column <= CELLS; column++, p++)
            for (int i = 0; i < 3; i++)
                points[p][i] = corner[i] + u[i] * (float)column / CELLS + v[i] * (float)row / CELLS;
    for (uint32_t row = 0; row < CELLS; row++)
        for (uint32_t column = 0; column < CELLS; column++) {
            uint32_t a = row * (CELLS + 1) + column, b = a + 1, c = a + CELLS + 1, d = c + 1;
            const uint32_t cell[6] = { a, b, c, c, b, d };
            memcpy(indices + n, cell, sizeof cell);
            n += 6;
        }
    for (int k = 0; k < 2; k++, p++)
        for (int i = 0; i < 3; i++) {
            points[p][i] = k ? (float)SIDE : 0.0f;
            indices[n++] = p;
        }
    nook_triangles cut = { points[0], 0, p, indices, n };
    nook_volume pieces = test_make_surfels(&cut, SIDE, 1);
    int compared = 0;
    for (uint32_t i = 0; i < 18 * 18 * 18; i++) {
        const nook_surfel *a = test_surfel_at(&whole, i % 18, i / 18 % 18, i / 324);
        const nook_surfel *b = test_surfel_at(&pieces, i % 18, i / 18 % 18, i / 324);
        if (!a || !b) /* one rounds to nothing */
            continue;
        nook_surfel_plane x = nook_surfel_unpack(a->plane[0]), y = nook_surfel_unpack(b->plane[0]);
        assert_true(nook_vector_dot(x.normal, y.normal) > cos(0.017));
        assert_true(fabs(x.offset - y.offset) < 2.0 * word_error);
        assert_true(abs((int)x.alpha - (int)y.alpha) <= 1);
        compared++;
    }
    assert_true(compared > 60);
    nook_volume_free(&whole);
    nook_volume_free(&pieces);
    free(points);
    free(indices);
}

/* ---- What is no surface ----------------------------------------------------------------------------------------- */

static void test_triangles_that_are_not_finite_are_left_out_and_counted(void **state)
{
    (void)state;
    int warnings = 0;
    test_sheet sheet = test_make_sheet(SIDE, (float[3]){ 2, 2, 2.5f }, (float[3]){ 5, 0, 0 }, (float[3]){ 0, 5, 0 });
    nook_triangles triangles = test_sheet_triangles(&sheet);
    nook_volume usual = test_make_surfels(&triangles, SIDE, 1);
    float points[7][3];
    uint32_t indices[15];
    memcpy(points, sheet.points, sizeof sheet.points);
    memcpy(indices, sheet.indices, sizeof sheet.indices);
    points[6][0] = NAN, points[6][1] = INFINITY, points[6][2] = 1.0f;
    indices[12] = 0, indices[13] = 6, indices[14] = 3;
    triangles = (nook_triangles){ points[0], 0, 7, indices, 15 };
    nook_log_set_sink(count_warnings, &warnings);
    nook_volume v = test_make_surfels(&triangles, SIDE, 1);
    nook_log_set_sink(NULL, NULL);
    assert_int_equal(warnings, 1);
    test_assert_same_surfels(&usual, &v);
    nook_volume_free(&usual);
    nook_volume_free(&v);
}

static void test_what_has_no_area_has_no_surfels(void **state)
{
    (void)state;
    const float points[3][3] = { { 0, 0, 0 }, { 1, 2, 3 }, { 2, 4, 6 } };
    const uint32_t indices[6] = { 0, 1, 2, 1, 1, 1 };
    nook_triangles line = { points[0], 0, 3, indices, 6 };
    nook_volume v = test_make_surfels(&line, 10, 2);
    assert_int_equal(v.info.occupied, 0);
    for (size_t i = 0; i < nook_brick_total(&v.info); i++)
        assert_int_equal(v.bricks[i].skip, 3); /* as long as the grid: nothing anywhere */
    nook_volume_free(&v);
}

/* ---- Bricks ----------------------------------------------------------------------------------------------------- */

static void test_skips_are_the_distance_to_the_nearest_brick(void **state)
{
    (void)state;
    const uint32_t counts[3] = { 9, 7, 5 };
    srand(11);
    for (int round = 0; round < 20; round++) {
        nook_brick bricks[9 * 7 * 5] = { 0 };
        for (int k = 0; k < 1 + round / 4; k++)
            bricks[rand() % (9 * 7 * 5)].mask[rand() % 2] = 1u << (rand() % 32) | 1u;
        uint64_t set = nook_bricks_number(bricks, counts);
        uint32_t surfels = 0;
        for (int i = 0; i < 9 * 7 * 5; i++) {
            int nearest = 9;
            for (int k = 0; k < 9 * 7 * 5; k++) {
                int x = abs(i % 9 - k % 9), y = abs(i / 9 % 7 - k / 9 % 7), z = abs(i / 63 - k / 63);
                int distance = x > y ? x : y;
                distance = z > distance ? z : distance;
                if ((bricks[k].mask[0] || bricks[k].mask[1]) && distance < nearest)
                    nearest = distance;
            }
            assert_int_equal(bricks[i].skip, nearest);
            assert_int_equal(bricks[i].first_surfel, surfels);
            for (int bit = 0; bit < 64; bit++)
                surfels += bricks[i].mask[bit / 32] >> (bit % 32) & 1;
        }
        assert_int_equal(set, surfels);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_plane_comes_back_from_its_word),
        cmocka_unit_test(test_axes_come_back_exactly),
        cmocka_unit_test(test_words_that_no_plane_has_are_refused),
        cmocka_unit_test(test_a_tilted_plane_comes_back_from_its_surfels),
        cmocka_unit_test(test_a_thin_wire_covers_little_and_does_not_vanish),
        cmocka_unit_test(test_sheets_over_a_quarter_voxel_apart_are_two_planes),
        cmocka_unit_test(test_planes_of_an_edge_end_at_each_other),
        cmocka_unit_test(test_a_wall_that_goes_on_behind_another_has_no_side),
        cmocka_unit_test(test_the_corner_of_a_box_is_within_a_third_of_a_voxel),
        cmocka_unit_test(test_a_closed_sphere_is_closed),
        cmocka_unit_test(test_threads_order_and_first_corners_do_not_show),
        cmocka_unit_test(test_a_body_has_the_same_surfels_at_any_scale),
        cmocka_unit_test(test_cut_up_triangles_make_the_planes_of_the_whole),
        cmocka_unit_test(test_triangles_that_are_not_finite_are_left_out_and_counted),
        cmocka_unit_test(test_what_has_no_area_has_no_surfels),
        cmocka_unit_test(test_skips_are_the_distance_to_the_nearest_brick),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
