/* Surfel volumes on the GPU: what the walk through them computes, and what each of its constants is there for. */
#include "engine/core/angle.h"
#include "tests/support/ao_fixture.h"
#include "tests/support/log_capture.h"
#include "tests/support/surfel_shapes.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const double origin[3] = { 0, 0, 0 }, up[3] = { 0, 0, 1 };
static const double lift = 0.15; /* voxels */

/** What a wide ceiling takes at a height, hard: rays start nearer by the lift. */
static double ceiling(double height, double r_max, double voxel)
{
    double k = (height - lift * voxel) / r_max;
    return 1.0 - k * k;
}

static ao_fixture *prepare(void **state, const char *r_max)
{
    ao_fixture *fixture = *state;
    ao_fixture_clear(fixture);
    nook_ao_reset_params(fixture->view->ao); /* the constants are those of params.def */
    ao_fixture_param(fixture, "ao.filter", "none");
    ao_fixture_param(fixture, "ao.falloff", "hard");
    ao_fixture_param(fixture, "ao.r_max", r_max);
    ao_fixture_param(fixture, "volume.kind", "surfel");
    ao_fixture_param(fixture, "volume.rays", "256");
    ao_fixture_param(fixture, "volume.combine", "union");
    return fixture;
}

/** A wide sheet through the origin across a unit normal in the x-z plane. */
static void add_floor(ao_fixture *fixture, double tilt)
{
    const double across[3] = { 2.6 * cos(tilt), 0, -2.6 * sin(tilt) };
    const double corner[3] = { -0.5 * across[0], -1.3, -0.5 * across[2] };
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, corner, across, (double[]){ 0, 2.6, 0 });
    ao_fixture_add(fixture, &mesh, 64);
    nook_fixture_mesh_free(&mesh);
}

static double measure_floor(ao_fixture *fixture, double tilt)
{
    const double normal[3] = { sin(tilt), 0, cos(tilt) };
    ao_fixture_clear(fixture);
    add_floor(fixture, tilt);
    return ao_fixture_measure(fixture, "volume", origin, normal, 0.3).highest;
}

static void add_sphere(ao_fixture *fixture, const double centre[3], double radius)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_sphere(&mesh, centre, radius, 96);
    ao_fixture_add(fixture, &mesh, 64);
    nook_fixture_mesh_free(&mesh);
}

/* ---- Closed forms ----------------------------------------------------------------------------------------------- */

static void test_open_floors_are_exactly_open_at_any_tilt(void **state)
{
    ao_fixture *fixture = prepare(state, "0.6");
    for (int step = 0; step <= 36; step++)
        assert_true(measure_floor(fixture, step * 0.04) == 0.0);
}

static void test_spheres_are_open_from_outside_and_closed_from_inside(void **state)
{
    ao_fixture *fixture = prepare(state, "10");
    add_sphere(fixture, (double[]){ 0, 0, -1 }, 1.0);
    assert_true(ao_fixture_measure(fixture, "volume", origin, up, 0.3).highest == 0.0);
    ao_fixture_clear(fixture);
    add_sphere(fixture, (double[]){ 0, 0, 1 }, 1.0);
    assert_true(ao_fixture_measure(fixture, "volume", origin, up, 0.3).lowest >= 0.995);
}

static void test_a_corner_is_right_up_to_a_small_part_of_a_voxel(void **state)
{
    static const double distances[] = { 0.02, 0.1, 0.3, 0.6 }; /* of r_max; the first is 0.3 voxels */
    ao_fixture *fixture = prepare(state, "0.6");
    for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
        double k = distances[i];
        nook_fixture_mesh mesh = { 0 };
        nook_fixture_add_quad(&mesh, (double[]){ -1.2, -1.2, 0 }, (double[]){ 2.4, 0, 0 }, (double[]){ 0, 2.4, 0 });
        nook_fixture_add_quad(&mesh, (double[]){ 0.6 * k, -1.2, 0 }, (double[]){ 0, 2.4, 0 }, (double[]){ 0, 0, 1 });
        ao_fixture_clear(fixture);
        ao_fixture_add(fixture, &mesh, 64);
        nook_fixture_mesh_free(&mesh);
        double expected = (acos(k) - k * sqrt(1.0 - k * k)) / NOOK_PI;
        assert_true(fabs(ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean - expected) < 0.01);
    }
}

/** The side of a valley, near enough and facing alike enough to be the own surface but for the rays that come towards it. */
static void test_a_shallow_valley_is_no_part_of_the_own_surface(void **state)
{
    const double edge = 0.012 /* 0.3 voxels */, slope = 0.7;
    ao_fixture *fixture = prepare(state, "0.6");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ -1.2, -1.2, 0 }, (double[]){ 1.2 + edge, 0, 0 }, (double[]){ 0, 2.4, 0 });
    nook_fixture_add_quad(&mesh, (double[]){ edge, -1.2, 0 }, (double[]){ 1.2 * cos(slope), 0, 1.2 * sin(slope) },
                          (double[]){ 0, 2.4, 0 });
    ao_fixture_add(fixture, &mesh, 64);
    nook_fixture_mesh_free(&mesh);
    ao_fixture_param(fixture, "reference.rays", "1024");
    double truth = ao_fixture_measure(fixture, "reference", origin, up, 0.3).mean;
    assert_true(truth > 0.1);
    double got = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    if (fabs(got - truth) >= 0.02)
        fail_msg("A = %.4f, truth %.4f", got, truth);
}

/* ---- What the constants are for --------------------------------------------------------------------------------- */

/** A square of 4 m overhead, across z. */
static void add_ceiling(ao_fixture *fixture, double height)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ -2, -2, height }, (double[]){ 4, 0, 0 }, (double[]){ 0, 4, 0 });
    ao_fixture_add(fixture, &mesh, 64);
    nook_fixture_mesh_free(&mesh);
}

static void test_without_lift_floors_darken_themselves(void **state)
{
    ao_fixture *fixture = prepare(state, "0.6");
    ao_fixture_param(fixture, "volume.own_distance", "0"); /* which would hide it */
    assert_true(measure_floor(fixture, 0.35) == 0.0);
    ao_fixture_param(fixture, "volume.lift", "0");
    assert_true(measure_floor(fixture, 0.35) > 0.1);
}

static void test_without_tolerance_rays_slip_through_between_planes(void **state)
{
    ao_fixture *fixture = prepare(state, "10");
    add_sphere(fixture, (double[]){ 0, 0, 1 }, 1.0);
    assert_true(ao_fixture_measure(fixture, "volume", origin, up, 0.3).lowest >= 0.995);
    ao_fixture_param(fixture, "volume.tolerance", "0");
    assert_true(ao_fixture_measure(fixture, "volume", origin, up, 0.3).lowest < 0.985);
}

static void test_a_sheet_that_faces_exactly_alike_is_the_own_one_only_very_near(void **state)
{
    static const double voxels[] = { 0.1, 0.2, 0.3 };
    for (int i = 0; i < 3; i++) {
        ao_fixture *fixture = prepare(state, "1");
        add_ceiling(fixture, voxels[i] * 4.0 / 64);
        double occlusion = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
        assert_true(i == 0 ? occlusion == 0.0 : occlusion > 0.98);
    }
}

/** A square of 4 m whose normal leans by its cosine to z, in the x-z plane, over the origin by a distance along that normal. */
static void add_leaning_sheet(ao_fixture *fixture, double facing, double distance)
{
    const double lean = sqrt(1.0 - facing * facing);
    const double corner[3] = { distance * lean - 2.0 * facing, -2.0, distance * facing + 2.0 * lean };
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, corner, (double[]){ 4.0 * facing, 0, -4.0 * lean }, (double[]){ 0, 4, 0 });
    ao_fixture_clear(fixture);
    ao_fixture_add(fixture, &mesh, 64);
    nook_fixture_mesh_free(&mesh);
}

static void test_a_leaning_sheet_is_the_own_one_as_far_as_a_surface_that_turns_so(void **state)
{
    static const double facing = 0.8, voxels[] = { 0.27, 0.33 }; /* 0.3: OWN_FLAT and a quarter of the sine, 0.6 */
    for (int i = 0; i < 2; i++) {
        ao_fixture *fixture = prepare(state, "1");
        add_leaning_sheet(fixture, facing, voxels[i] * 4.0 / 64);
        double occlusion = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
        assert_true(i == 0 ? occlusion < 0.01 : fabs(occlusion - 0.5 * (1.0 + facing)) < 0.01);
    }
}

/** The part of the light that comes towards a leaning sheet, at less than so large a cosine to its normal. */
static double light_below(double facing, double cosine)
{
    enum { STEPS = 500 };
    uint32_t below = 0;
    for (int i = 0; i < STEPS * STEPS; i++) {
        double squared = (i / STEPS + 0.5) / STEPS, angle = 2.0 * NOOK_PI * (i % STEPS + 0.5) / STEPS;
        double slope = sqrt(squared) * cos(angle) * sqrt(1.0 - facing * facing) + sqrt(1.0 - squared) * facing;
        below += slope > 0.0 && slope < cosine;
    }
    return below / (double)(STEPS * STEPS);
}

static void test_what_leans_over_the_start_within_the_tolerance_is_the_own_surface(void **state)
{
    static const struct {
        double facing, cosine; /* of the rays that meet it: all, or where it is 0.05 voxel away the flat ones */
        const char *tolerance; /* voxels */
    } cases[] = { { 0.3, 0.5, "0.1" }, { 0.3, 1.0, "0.02" }, { 0.05, 1.0, "0.1" } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ao_fixture *fixture = prepare(state, "1");
        add_leaning_sheet(fixture, cases[i].facing, (0.05 + lift * cases[i].facing) * 4.0 / 64);
        ao_fixture_param(fixture, "volume.tolerance", cases[i].tolerance);
        double expected = light_below(cases[i].facing, cases[i].cosine);
        double got = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
        if (fabs(got - expected) >= 0.03) /* planes are known to a fifteenth of 0.05 voxel */
            fail_msg("case %zu: A = %.4f, expected %.4f", i, got, expected);
    }
}

static void test_without_own_distance_rough_floors_darken_themselves(void **state)
{
    ao_rough_floor got = ao_fixture_measure_rough_floor(prepare(state, "0.6"), 4, "volume.own_distance", "0");
    assert_true(got.without < got.with - 0.05);
    assert_true(fabs(got.with - got.truth) < fabs(got.without - got.truth));
    /* A little coarser: what leans over the start is left out by another rule, which alone is as near; docs/surfel_bricks.md has both. */
    got = ao_fixture_measure_rough_floor(prepare(state, "0.6"), 3, "volume.own_distance", "0");
    assert_true(got.without < got.truth - 0.015);
    assert_true(got.with > got.truth && got.with < got.truth + 0.03);
}

/* ---- Matrices --------------------------------------------------------------------------------------------------- */

static void set_matrix(ao_fixture *fixture, uint32_t occluder, const nook_matrix *matrix)
{
    memcpy(fixture->view->occluders[occluder].world_from_mesh, matrix->m, sizeof matrix->m);
}

static void test_distances_are_metres_whatever_the_matrix_does(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    ao_fixture_param(fixture, "ao.falloff", "linear");
    add_ceiling(fixture, 0.1);
    nook_matrix matrix = nook_matrix_identity();
    matrix.m[10] = 4.0; /* to a height of 0.4 */
    matrix.m[4] = 0.7;  /* sheared along itself */
    matrix.m[0] = -1.5;
    set_matrix(fixture, 0, &matrix);
    double occlusion = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    const double lifted = 0.6 + lift * 4.0 * 4.0 / 64.0; /* rays start so much nearer: voxels are stretched, too */
    assert_true(fabs(occlusion - lifted * lifted) < 0.003);
}

static void test_a_sheared_box_occludes_as_its_triangles_do(void **state)
{
    ao_fixture *fixture = prepare(state, "2");
    ao_fixture_param(fixture, "reference.rays", "1024");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_box(&mesh, (double[]){ -0.4, -0.3, 0.2 }, (double[]){ 0.5, 0.6, 0.9 }, 63);
    ao_fixture_add(fixture, &mesh, 32);
    nook_fixture_mesh_free(&mesh);
    static const double entries[][3] = { { 0.5, 0.0, 0.0 }, { 0.0, 0.8, -0.3 }, { -0.6, 0.3, 0.2 } };
    for (size_t i = 0; i < 3; i++) {
        nook_matrix matrix = nook_matrix_identity();
        matrix.m[4] = entries[i][0], matrix.m[8] = entries[i][1], matrix.m[1] = entries[i][2];
        matrix.m[0] = 0.6;
        set_matrix(fixture, 0, &matrix);
        double truth = ao_fixture_measure(fixture, "reference", origin, up, 0.1).mean;
        assert_true(truth > 0.1);
        assert_true(fabs(ao_fixture_measure(fixture, "volume", origin, up, 0.1).mean - truth) <
                    0.02); /* most of it: the lift */
    }
}

/* ---- Coverage, and several volumes ------------------------------------------------------------------------------ */

/** A ceiling of strips, half of it open: so many of them in a voxel. Of four alpha is a half, of one it is known where it lies. */
static void add_half_ceiling(ao_fixture *fixture, double height, int strips)
{
    const double strip = 40.0 / (64 * strips);
    nook_fixture_mesh mesh = { 0 };
    for (int i = 0; i < 64 * strips; i++)
        nook_fixture_add_quad(&mesh, (double[]){ -20 + (i + 0.25) * strip, -20, height },
                              (double[]){ 0.5 * strip, 0, 0 }, (double[]){ 0, 40, 0 });
    for (int side = -1; side <= 1; side += 2) { /* specks that hold the box */
        const double p[3] = { side * 20.0, side * 20.0, height };
        nook_fixture_add_triangle(&mesh, p, p, p);
    }
    ao_fixture_add(fixture, &mesh, 64);
    nook_fixture_mesh_free(&mesh);
}

static void test_half_covered_voxels_stop_half_of_the_light(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    const double half = 32.0 / 63.0; /* of 6 bits */
    add_half_ceiling(fixture, 0.5, 4);
    double one = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    assert_true(fabs(one - half * ceiling(0.5, 1.0, 40.0 / 64)) < 0.001);
    add_half_ceiling(fixture, 0.5, 4);
    double two = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    assert_true(fabs(two - (2.0 - half) * half * ceiling(0.5, 1.0, 40.0 / 64)) < 0.001);
}

/**
 * What a ceiling of even strips takes, hard, by the cosine over the hemisphere.
 * @param x      of the receiver; voxels, as all lengths; strips lie about x = 0.5, 1.5, ...
 * @param width  of a strip
 */
static double ceiling_of_strips(double x, double width, double height, double r_max)
{
    enum { STEPS = 500 };
    uint32_t hits = 0;
    for (int i = 0; i < STEPS * STEPS; i++) {
        double squared = (i / STEPS + 0.5) / STEPS, angle = 2.0 * NOOK_PI * (i % STEPS + 0.5) / STEPS;
        double up_part = sqrt(1.0 - squared), along = height / up_part;
        double place = x + sqrt(squared) * cos(angle) * along;
        hits += along < r_max && fabs(place - floor(place) - 0.5) < 0.5 * width;
    }
    return hits / (double)(STEPS * STEPS);
}

static void test_strips_within_voxels_darken_what_lies_under_them(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    const double voxel = 40.0 / 64, slack = 0.04; /* voxels by which planes reach past their ends: SIDE_SLACK */
    ao_fixture_param(fixture, "reference.rays", "1024");
    ao_fixture_param(fixture, "volume.lift", "0.02"); /* else what is near is nearer by half */
    add_half_ceiling(fixture, 0.2, 1);
    for (int half = 0; half < 2; half++) { /* under a strip, and between two */
        const double x = half ? 1.0 : 0.5, receiver[3] = { x * voxel, 0.1, 0.0 };
        double truth = ao_fixture_measure(fixture, "reference", receiver, up, 0.3).mean;
        assert_true(fabs(truth - ceiling_of_strips(x, 0.5, 0.2 / voxel, 1.0 / voxel)) < 0.01);
        assert_true(half ? truth < 0.35 : truth > 0.6); /* coverage alone would take 0.49 of both */
        double expected = ceiling_of_strips(x, 0.5 + 2.0 * slack, 0.2 / voxel - 0.02, 1.0 / voxel);
        double got = ao_fixture_measure(fixture, "volume", receiver, up, 0.3).mean;
        if (fabs(got - expected) >= 0.02)
            fail_msg("x = %.1f: %.4f, expected %.4f, truth %.4f", x, got, expected, truth);
    }
}

static void test_the_nearer_of_two_volumes_counts_in_any_order(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    ao_fixture_param(fixture, "ao.falloff", "linear");
    add_ceiling(fixture, 0.4);
    double near = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    add_ceiling(fixture, 0.7);
    double last = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    nook_ao_occluder first = fixture->view->occluders[0];
    fixture->view->occluders[0] = fixture->view->occluders[1];
    fixture->view->occluders[1] = first;
    assert_true(ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean == last);
    assert_true(fabs(last - near) < 1e-6);
    ao_fixture_param(fixture, "volume.combine", "multiply");
    double product = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    const double a = 0.6 + lift * 4.0 / 64, b = 0.3 + lift * 4.0 / 64;
    assert_true(fabs(product - (1.0 - (1.0 - a * a) * (1.0 - b * b))) < 0.003); /* C5 */
}

static void test_hundreds_of_volumes_do_not_hide_the_one_behind_them(void **state)
{
    enum { MANY = 298 };
    ao_fixture *fixture = prepare(state, "1");
    ao_fixture_param(fixture, "volume.rays", "16");
    add_ceiling(fixture, 0.4);
    double alone = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    ao_fixture_clear(fixture);
    /* Each ray crosses all of them and meets nothing: a speck in each of two corners. */
    nook_fixture_mesh air = { 0 };
    for (int side = 0; side < 2; side++) {
        const double z = side ? 0.9 : -0.1, p = side ? 1.9 : -1.9;
        nook_fixture_add_triangle(&air, (double[]){ p, p, z }, (double[]){ p + 0.01, p, z },
                                  (double[]){ p, p + 0.01, z });
    }
    ao_fixture_add(fixture, &air, 64);
    nook_fixture_mesh_free(&air);
    const nook_matrix identity = nook_matrix_identity();
    for (int i = 1; i < MANY; i++)
        assert_int_equal(nook_fixture_view_add_instance(fixture->view, 0, &identity), NOOK_OK);
    add_ceiling(fixture, 0.4);
    assert_true(ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean == alone);
}

/* ---- Kinds ------------------------------------------------------------------------------------------------------ */

static void test_each_kind_marches_what_is_there_in_it(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    add_ceiling(fixture, 0.4);
    double surfels = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    assert_true(fabs(surfels - ceiling(0.4, 1.0, 4.0 / 64)) < 0.002);
    ao_fixture_param(fixture, "volume.kind", "binary");
    double voxels = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    assert_true(fabs(voxels - 0.84) < 0.05 && voxels != surfels);
}

static void test_a_volume_has_each_kind_once(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    nook_ao *ao = fixture->view->ao;
    test_sheet sheet = test_make_sheet(8, (float[]){ 1, 1, 4 }, (float[]){ 5, 0, 0 }, (float[]){ 0, 5, 0 });
    nook_triangles triangles = test_sheet_triangles(&sheet);
    nook_volume baked = test_make_surfels(&triangles, 8, 1);
    void *bytes;
    size_t size;
    nook_ao_volume volume;
    nook_log_capture line;
    assert_int_equal(nook_volume_encode(&baked, &bytes, &size), NOOK_OK);
    assert_int_equal(nook_ao_add_volume(ao, "sheet.nkv", bytes, size, &volume), NOOK_OK);
    nook_log_capture_begin(&line);
    assert_int_equal(nook_ao_extend_volume(ao, volume, "again.nkv", bytes, size), NOOK_E_ARG);
    nook_ao_remove_volume(ao, volume);
    assert_int_equal(nook_ao_extend_volume(ao, volume, "late.nkv", bytes, size), NOOK_E_NOT_FOUND);
    nook_log_capture_end();
    assert_int_equal(line.count, 2);
    free(bytes);
    nook_volume_free(&baked);
}

static void test_what_is_not_there_in_the_kind_is_left_out(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    test_sheet sheet = test_make_sheet(8, (float[]){ 1, 1, 4 }, (float[]){ 5, 0, 0 }, (float[]){ 0, 5, 0 });
    nook_triangles triangles = test_sheet_triangles(&sheet);
    nook_volume baked = test_make_surfels(&triangles, 8, 1);
    void *bytes;
    size_t size;
    add_ceiling(fixture, 0.4);
    nook_ao_occluder *occluder = &fixture->view->occluders[0];
    nook_ao_remove_volume(fixture->view->ao, occluder->volume);
    assert_int_equal(nook_volume_encode(&baked, &bytes, &size), NOOK_OK);
    assert_int_equal(nook_ao_add_volume(fixture->view->ao, "sheet.nkv", bytes, size, &occluder->volume), NOOK_OK);
    nook_matrix matrix = nook_matrix_translation(-4, -4, -3.5); /* the sheet 0.5 overhead */
    set_matrix(fixture, 0, &matrix);
    assert_true(ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean > 0.5);
    ao_fixture_param(fixture, "volume.kind", "binary");
    assert_true(ao_fixture_measure(fixture, "volume", origin, up, 0.3).highest == 0.0);
    free(bytes);
    nook_volume_free(&baked);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_open_floors_are_exactly_open_at_any_tilt, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_spheres_are_open_from_outside_and_closed_from_inside, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_a_corner_is_right_up_to_a_small_part_of_a_voxel, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_a_shallow_valley_is_no_part_of_the_own_surface, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_without_lift_floors_darken_themselves, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_without_tolerance_rays_slip_through_between_planes, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_a_sheet_that_faces_exactly_alike_is_the_own_one_only_very_near,
                                        ao_fixture_setup, ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_a_leaning_sheet_is_the_own_one_as_far_as_a_surface_that_turns_so,
                                        ao_fixture_setup, ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_what_leans_over_the_start_within_the_tolerance_is_the_own_surface,
                                        ao_fixture_setup, ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_without_own_distance_rough_floors_darken_themselves, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_distances_are_metres_whatever_the_matrix_does, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_a_sheared_box_occludes_as_its_triangles_do, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_strips_within_voxels_darken_what_lies_under_them, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_half_covered_voxels_stop_half_of_the_light, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_the_nearer_of_two_volumes_counts_in_any_order, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_hundreds_of_volumes_do_not_hide_the_one_behind_them, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_a_volume_has_each_kind_once, ao_fixture_setup, ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_what_is_not_there_in_the_kind_is_left_out, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_each_kind_marches_what_is_there_in_it, ao_fixture_setup,
                                        ao_fixture_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
