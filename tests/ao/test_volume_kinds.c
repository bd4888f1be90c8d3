/* Volumes of densities and of distances on the GPU: closed forms, and what each of the constants is there for. */
#include "engine/core/angle.h"
#include "tests/support/ao_fixture.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const double origin[3] = { 0, 0, 0 }, up[3] = { 0, 0, 1 };

static ao_fixture *prepare(void **state, const char *kind, const char *r_max)
{
    static const char *const values[][2] = {
        { "ao.filter", "none" },       { "ao.falloff", "hard" },     { "volume.rays", "256" },
        { "volume.combine", "union" }, { "reference.rays", "1024" },
    };
    ao_fixture *fixture = *state;
    ao_fixture_clear(fixture);
    nook_ao_reset_params(fixture->view->ao); /* the constants are those of params.def */
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        ao_fixture_param(fixture, values[i][0], values[i][1]);
    ao_fixture_param(fixture, "volume.kind", kind);
    ao_fixture_param(fixture, "ao.r_max", r_max);
    return fixture;
}

static nook_fixture_occlusion measure(ao_fixture *fixture)
{
    return ao_fixture_measure(fixture, "volume", origin, up, 0.3);
}

/** A wide sheet through the origin across a unit normal in the x-z plane. @return what a point on it reads */
static double measure_floor(ao_fixture *fixture, double tilt)
{
    const double across[3] = { 2.6 * cos(tilt), 0, -2.6 * sin(tilt) }, normal[3] = { sin(tilt), 0, cos(tilt) };
    const double corner[3] = { -0.5 * across[0], -1.3, -0.5 * across[2] };
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, corner, across, (double[]){ 0, 2.6, 0 });
    ao_fixture_clear(fixture);
    ao_fixture_add(fixture, &mesh, 64);
    nook_fixture_mesh_free(&mesh);
    return ao_fixture_measure(fixture, "volume", origin, normal, 0.3).highest;
}

/** A square of `side` metres overhead, of one alpha, tilted about y, in a volume of its own of 64 voxels a side. */
static void add_pane(ao_fixture *fixture, double height, double side, double tilt, double transparency)
{
    nook_fixture_mesh mesh = { .transparency = transparency };
    const double u[3] = { side * cos(tilt), 0, side * sin(tilt) };
    nook_fixture_add_quad(&mesh, (double[]){ -0.5 * u[0], -0.5 * side, height - 0.5 * u[2] }, u,
                          (double[]){ 0, side, 0 });
    ao_fixture_add(fixture, &mesh, 64);
    nook_fixture_mesh_free(&mesh);
}

static void add_sphere(ao_fixture *fixture, double z)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_sphere(&mesh, (double[]){ 0, 0, z }, 1.0, 96);
    ao_fixture_add(fixture, &mesh, 64);
    nook_fixture_mesh_free(&mesh);
}

static const char *const kinds[] = { "density", "distance" };

static void test_open_floors_are_exactly_open_at_any_tilt(void **state)
{
    for (int kind = 0; kind < 2; kind++) {
        ao_fixture *fixture = prepare(state, kinds[kind], "0.6");
        for (int step = 0; step <= 18; step++)
            assert_true(measure_floor(fixture, step * 0.08) == 0.0);
    }
}

static void test_spheres_are_open_from_outside_and_closed_from_inside(void **state)
{
    for (int kind = 0; kind < 2; kind++) {
        ao_fixture *fixture = prepare(state, kinds[kind], "10");
        add_sphere(fixture, -1.0);
        assert_true(measure(fixture).highest == 0.0);
        ao_fixture_clear(fixture);
        add_sphere(fixture, 1.0);
        assert_true(measure(fixture).lowest >= 0.98);
    }
}

/** r_max of 16 voxels of 1/16: at 0.4 r_max a wide ceiling takes 0.84. */
static void test_a_ceiling_takes_what_its_height_says(void **state)
{
    for (int kind = 0; kind < 2; kind++) {
        ao_fixture *fixture = prepare(state, kinds[kind], "1");
        add_pane(fixture, 0.4, 4.0, 0.0, 0.0);
        assert_true(fabs(measure(fixture).mean - 0.84) < 0.02);
    }
}

/* ---- Panes ------------------------------------------------------------------------------------------------------- */

/** Seen from far below its edge: all that a ray meets is the pane. A row of tilts, so that none lies as voxels do. */
static void test_a_pane_takes_its_alpha_once_and_not_in_every_voxel(void **state)
{
    static const double tilts[] = { 0.0, 0.1, 0.3, 0.6 };
    ao_fixture *fixture = prepare(state, "density", "8");
    for (size_t i = 0; i < sizeof tilts / sizeof *tilts; i++) {
        ao_fixture_clear(fixture);
        add_pane(fixture, 0.8, 4.0, tilts[i], 0.0);
        double opaque = measure(fixture).mean;
        ao_fixture_clear(fixture);
        add_pane(fixture, 0.8, 4.0, tilts[i], 0.6);
        assert_true(opaque > 0.6);
        assert_true(fabs(measure(fixture).mean / opaque - 0.4) < 0.01);
    }
}

static void test_two_panes_multiply_in_one_volume_and_in_two(void **state)
{
    ao_fixture *fixture = prepare(state, "density", "8");
    add_pane(fixture, 0.4, 8.0, 0.0, 0.0);
    double opaque = measure(fixture).mean;
    ao_fixture_clear(fixture);
    add_pane(fixture, 0.4, 8.0, 0.0, 0.6);
    add_pane(fixture, 0.8, 16.0, 0.0, 0.5);
    assert_true(fabs(measure(fixture).mean / opaque - (1.0 - 0.6 * 0.5)) < 0.01);

    ao_fixture_clear(fixture);
    nook_fixture_mesh mesh = { .transparency = 0.6 };
    for (int i = 1; i <= 2; i++) /* twice 1 m apart is 8 voxels */
        nook_fixture_add_quad(&mesh, (double[]){ -4, -4, 0.4 * i }, (double[]){ 8, 0, 0 }, (double[]){ 0, 8, 0 });
    ao_fixture_add(fixture, &mesh, 64);
    nook_fixture_mesh_free(&mesh);
    assert_true(fabs(measure(fixture).mean - (1.0 - 0.6 * 0.6)) < 0.02);
}

/* ---- What the constants are for --------------------------------------------------------------------------------- */

static void test_without_lift_floors_of_distances_darken_themselves(void **state)
{
    ao_fixture *fixture = prepare(state, "distance", "0.6");
    double worst = 0.0;
    ao_fixture_param(fixture, "volume.lift", "0");
    ao_fixture_param(fixture, "volume.own_share", "1"); /* which would hide it */
    for (int step = 0; step <= 6; step++)
        worst = fmax(worst, measure_floor(fixture, 0.05 + step * 0.1));
    assert_true(worst > 0.05);
    ao_fixture_param(prepare(state, "distance", "0.6"), "volume.own_share", "1");
    for (int step = 0; step <= 6; step++)
        assert_true(measure_floor(fixture, 0.05 + step * 0.1) == 0.0);
}

/** @param value  with which the constant does nothing */
static void compare_rough_floor(void **state, const char *kind, const char *name, const char *value)
{
    ao_rough_floor got = ao_fixture_measure_rough_floor(prepare(state, kind, "0.6"), 3, name, value);
    assert_true(got.without < got.with - 0.02);
    assert_true(fabs(got.with - got.truth) < fabs(got.without - got.truth));
}

static void test_without_own_share_rough_floors_of_distances_darken_themselves(void **state)
{
    compare_rough_floor(state, "distance", "volume.own_share", "1");
}

static void test_without_own_distance_rough_floors_of_densities_darken_themselves(void **state)
{
    compare_rough_floor(state, "density", "volume.own_distance", "0");
}

/* ---- Several volumes -------------------------------------------------------------------------------------------- */

static void test_the_nearer_of_two_volumes_counts_in_any_order(void **state)
{
    for (int kind = 0; kind < 2; kind++) {
        ao_fixture *fixture = prepare(state, kinds[kind], "1");
        ao_fixture_param(fixture, "ao.falloff", "linear");
        add_pane(fixture, 0.4, 4.0, 0.0, 0.0);
        double near = measure(fixture).mean;
        add_pane(fixture, 0.7, 4.0, 0.0, 0.0);
        double last = measure(fixture).mean;
        nook_ao_occluder first = fixture->view->occluders[0];
        fixture->view->occluders[0] = fixture->view->occluders[1];
        fixture->view->occluders[1] = first;
        assert_true(measure(fixture).mean == last);
        assert_true(fabs(last - near) < 1e-6);
        ao_fixture_param(fixture, "volume.combine", "multiply");
        assert_true(measure(fixture).mean > last + 0.01); /* C5 */
    }
}

static void test_distances_are_metres_whatever_the_matrix_does(void **state)
{
    nook_matrix matrix = nook_matrix_identity();
    matrix.m[10] = 1.6; /* to a height of 0.4 */
    matrix.m[4] = 0.7;  /* sheared along itself */
    matrix.m[0] = -1.5;
    for (int kind = 0; kind < 2; kind++) {
        ao_fixture *fixture = prepare(state, kinds[kind], "1");
        ao_fixture_param(fixture, "ao.falloff", "linear");
        add_pane(fixture, 0.25, 4.0, 0.0, 0.0);
        memcpy(fixture->view->occluders[0].world_from_mesh, matrix.m, sizeof matrix.m);
        assert_true(fabs(measure(fixture).mean - 0.36) < 0.06); /* voxels are 0.1 m high here */
    }
}

/* So far stretched along x that directions are 1e-10 along it, to either side. */
static void test_a_ray_that_hardly_moves_along_an_axis_meets_what_is_overhead(void **state)
{
    static const char *const walked[] = { "density", "distance", "surfel" };
    for (int kind = 0; kind < 3; kind++) {
        ao_fixture *fixture = prepare(state, walked[kind], "1");
        add_pane(fixture, 0.5, 4.0, 0.0, 0.0);
        fixture->view->occluders[0].world_from_mesh[0] = 1e10;
        double occlusion = measure(fixture).mean;
        if (!(fabs(occlusion - 0.75) < 0.03)) /* of it 0.02 by a lift of 0.15 voxels of 1/16 m */
            fail_msg("%s: %.4f", walked[kind], occlusion);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_open_floors_are_exactly_open_at_any_tilt),
        cmocka_unit_test(test_spheres_are_open_from_outside_and_closed_from_inside),
        cmocka_unit_test(test_a_ceiling_takes_what_its_height_says),
        cmocka_unit_test(test_a_pane_takes_its_alpha_once_and_not_in_every_voxel),
        cmocka_unit_test(test_two_panes_multiply_in_one_volume_and_in_two),
        cmocka_unit_test(test_without_lift_floors_of_distances_darken_themselves),
        cmocka_unit_test(test_without_own_share_rough_floors_of_distances_darken_themselves),
        cmocka_unit_test(test_without_own_distance_rough_floors_of_densities_darken_themselves),
        cmocka_unit_test(test_the_nearer_of_two_volumes_counts_in_any_order),
        cmocka_unit_test(test_distances_are_metres_whatever_the_matrix_does),
        cmocka_unit_test(test_a_ray_that_hardly_moves_along_an_axis_meets_what_is_overhead),
    };
    return cmocka_run_group_tests(tests, ao_fixture_setup, ao_fixture_teardown);
}
