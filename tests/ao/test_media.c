/* Media: what `volume` marches of them, and what the reference sees, against closed forms and each other. */
#include "modules/ao/residency.h"
#include "modules/bake/medium_bake.h"
#include "modules/trace/ray_medium.h"
#include "tests/support/ao_fixture.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 16 }; /* cells */

static const double origin[3] = { 0, 0, 0 }, up[3] = { 0, 0, 1 };

static ao_fixture *prepare(void **state, const char *r_max)
{
    static const char *const values[][2] = {
        { "ao.filter", "none" },      { "ao.falloff", "hard" },     { "volume.rays", "256" },
        { "volume.kind", "density" }, { "reference.rays", "4096" },
    };
    ao_fixture *fixture = ao_fixture_begin(state, r_max);
    nook_ao_reset_params(fixture->view->ao);
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        ao_fixture_param(fixture, values[i][0], values[i][1]);
    ao_fixture_param(fixture, "ao.r_max", r_max);
    return fixture;
}

/* A cube of SIDE^3 cells, `side` metres long, its middle at a height over the origin. @param rising  by how much extinction rises in x */
static void add_cube(ao_fixture *fixture, double side, double height, double extinction, double rising)
{
    static float cells[SIDE * SIDE * SIDE];
    nook_fixture_view *view = fixture->view;
    double step = side / SIDE;
    for (size_t i = 0; i < SIDE * SIDE * SIDE; i++)
        cells[i] = (float)(extinction * (1.0 + rising * (double)(i % SIDE) / SIDE));
    const nook_medium medium = { { SIDE, SIDE, SIDE }, { step, step, step }, cells };
    const nook_matrix at = nook_matrix_translation(-0.5 * side, -0.5 * side, height - 0.5 * side);
    nook_ao_occluder *occluder = &view->occluders[view->occluder_count];
    nook_volume volume;
    nook_ao_written written = { .whole = false };
    *occluder = (nook_ao_occluder){ .mesh = { 0 } };
    memcpy(occluder->world_from_mesh, at.m, sizeof occluder->world_from_mesh);
    assert_int_equal(nook_medium_bake(&medium, SIDE, 1, &volume), NOOK_OK);
    assert_int_equal(nook_ao_reserve_volume(view->ao, &occluder->volume), NOOK_OK);
    assert_true(nook_ao_place_volume(view->ao, occluder->volume, &volume.info));
    while (!written.whole)
        assert_int_equal(nook_ao_write_volume(view->ao, occluder->volume, &volume, SIZE_MAX, &written), NOOK_OK);
    nook_volume_free(&volume);
    assert_int_equal(nook_ao_add_medium(view->ao, &medium, &occluder->mesh), NOOK_OK);
    view->occluder_count++;
}

/* What a point at the origin, looking up, reads. */
static double measure(ao_fixture *fixture, const char *technique)
{
    return ao_fixture_measure(fixture, technique, origin, up, 0.3).mean;
}

static void test_a_homogeneous_cube_around_the_point_takes_what_its_reach_says(void **state)
{
    static const double extinctions[] = { 0.05, 0.5, 2.0, 5.0 };
    ao_fixture *fixture = prepare(state, "1");
    for (size_t i = 0; i < sizeof extinctions / sizeof *extinctions; i++) {
        ao_fixture_clear(fixture);
        add_cube(fixture, 8.0, 0.0, extinctions[i], 0.0);
        double truth = 1.0 - exp(-extinctions[i]); /* every ray goes 1 m through it */
        assert_true(fabs(measure(fixture, "volume") - truth) < 0.003);
        assert_true(fabs(measure(fixture, "reference") - truth) < 0.005);
    }
}

static void test_drawn_boxes_see_a_medium_as_dispatches_do(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    ao_fixture_param(fixture, "volume.path", "raster");
    add_cube(fixture, 8.0, 0.0, 0.5, 0.0);
    assert_true(fabs(measure(fixture, "volume") - (1.0 - exp(-0.5))) < 0.003);
}

static void test_twice_the_thickness_lets_through_the_square(void **state)
{
    ao_fixture *thin = prepare(state, "0.4");
    add_cube(thin, 8.0, 0.0, 1.5, 0.0);
    double once = 1.0 - measure(thin, "volume");
    ao_fixture_param(thin, "ao.r_max", "0.8");
    assert_true(fabs(1.0 - measure(thin, "volume") - once * once) < 0.003);
}

/* Voxels of an eighth of r_max. Taken where a ray comes into each, it would be 0.627. */
static void test_what_a_medium_takes_fades_with_the_way_to_it(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    ao_fixture_param(fixture, "ao.falloff", "linear");
    add_cube(fixture, 2.0, 0.0, 2.0, 0.0);
    const double truth = 1.0 - (1.0 - exp(-2.0)) / 2.0; /* the integral of 2 exp(-2 t) (1 - t) over a ray of 1 m */
    assert_true(fabs(measure(fixture, "volume") - truth) < 0.005);
    assert_true(fabs(measure(fixture, "reference") - truth) < 0.01);
}

/*
 * So far stretched along x that directions are 1e-10 along it, to either side. What a medium takes from one end to the other stays: of a ray's
 * metre counts what lies across x. That is 0.3433 by the cosine: the mean of 1 - exp(-0.5 sqrt(1 - x^2)) over the unit disc.
 */
static void test_a_ray_that_hardly_moves_along_an_axis_of_a_medium_stays_in_it(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    add_cube(fixture, 8.0, 0.0, 0.5, 0.0);
    fixture->view->occluders[0].world_from_mesh[0] *= 1e10;
    fixture->view->occluders[0].world_from_mesh[12] *= 1e10;
    assert_true(fabs(measure(fixture, "volume") - 0.3433) < 0.003);
}

static void test_volume_and_reference_see_the_same_cube_overhead(void **state)
{
    static const char *const falloffs[] = { "hard", "linear" };
    ao_fixture *fixture = prepare(state, "2");
    for (int i = 0; i < 2; i++) {
        ao_fixture_param(fixture, "ao.falloff", falloffs[i]);
        ao_fixture_clear(fixture);
        add_cube(fixture, 1.0, 0.9, 1.2, 4.0);
        double reference = measure(fixture, "reference");
        assert_true(reference > 0.02 && reference < 0.9);
        assert_true(fabs(measure(fixture, "volume") - reference) < 0.01);
    }
}

static void test_a_cube_below_or_out_of_reach_darkens_nothing(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    add_cube(fixture, 1.0, -0.6, 50.0, 0.0);
    add_cube(fixture, 1.0, 1.6, 50.0, 0.0);
    assert_true(measure(fixture, "volume") == 0.0);
    assert_true(measure(fixture, "reference") == 0.0);
}

static void test_two_media_in_one_place_multiply(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    add_cube(fixture, 8.0, 0.0, 0.5, 0.0);
    add_cube(fixture, 8.0, 0.0, 0.7, 0.0);
    double truth = 1.0 - exp(-1.2);
    assert_true(fabs(measure(fixture, "reference") - truth) < 0.01);
    ao_fixture_param(fixture, "volume.combine", "union");
    assert_true(fabs(measure(fixture, "volume") - truth) < 0.004);
}

static void test_a_medium_and_a_ceiling_darken_together(void **state)
{
    ao_fixture *fixture = prepare(state, "1");
    nook_fixture_mesh mesh = { 0 };
    ao_fixture_param(fixture, "volume.combine", "union");
    add_cube(fixture, 8.0, 0.0, 0.8, 0.0);
    nook_fixture_add_quad(&mesh, (double[]){ -4, -4, 0.5 }, (double[]){ 8, 0, 0 }, (double[]){ 0, 8, 0 });
    ao_fixture_add(fixture, &mesh, 128);
    nook_fixture_mesh_free(&mesh);
    /* Rays below 60 degrees meet the ceiling within reach: three quarters of them by cosine. */
    double truth = 0.75 + 0.25 * (1.0 - exp(-0.8));
    assert_true(fabs(measure(fixture, "reference") - truth) < 0.01);
    assert_true(fabs(measure(fixture, "volume") - truth) < 0.03);
}

static void test_what_is_no_medium_is_refused(void **state)
{
    ao_fixture *fixture = *state;
    nook_ao_mesh mesh;
    float cell = -1.0f;
    nook_medium medium = { { 1, 1, 1 }, { 1, 1, 1 }, &cell };
    assert_int_equal(nook_ao_add_medium(fixture->view->ao, &medium, &mesh), NOOK_E_ARG);
    cell = NAN;
    assert_int_equal(nook_ao_add_medium(fixture->view->ao, &medium, &mesh), NOOK_E_ARG);
    cell = 1.0f;
    medium.spacing[1] = 0.0;
    assert_int_equal(nook_ao_add_medium(fixture->view->ao, &medium, &mesh), NOOK_E_ARG);
    medium.spacing[1] = 1.0;
    for (uint32_t bad = 0; bad <= NOOK_MEDIUM_SIDE_MAX + 1; bad += NOOK_MEDIUM_SIDE_MAX + 1) {
        medium.size[2] = bad;
        assert_int_equal(nook_ao_add_medium(fixture->view->ao, &medium, &mesh), NOOK_E_ARG);
    }
    medium = (nook_medium){ { 1024, 1024, 1024 }, { 1, 1, 1 }, &cell }; /* never read */
    assert_int_equal(nook_ao_add_medium(fixture->view->ao, &medium, &mesh), NOOK_E_ARG);
    medium = (nook_medium){ { 1, 1, 1 }, { 1e300, 1, 1 }, &cell };
    assert_int_equal(nook_ao_add_medium(fixture->view->ao, &medium, &mesh), NOOK_E_ARG);
}

/* ---- The walk of a ray, without any GPU ---------------------------------------------------------------------------- */

static void test_a_ray_is_stopped_where_so_much_is_left(void **state)
{
    (void)state;
    float cells[4 * 4 * 4];
    for (size_t i = 0; i < 64; i++)
        cells[i] = 0.9f;
    const nook_medium medium = { { 4, 4, 4 }, { 1, 1, 1 }, cells };
    static const double directions[][3] = { { 1, 0, 0 }, { 0, -1, 0 }, { 1, 1, 1 }, { -0.3, 2, 0.7 }, { 0, 3, -4 } };
    for (size_t i = 0; i < sizeof directions / sizeof *directions; i++) {
        const double *d = directions[i], length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const double from[3] = { 2.0, 2.0, 2.0 };
        double stop = nook_medium_stop(&medium, from, d, 0.0, 1e9, exp(-0.9 * 1.5)); /* 1.5 m of it */
        assert_true(fabs(stop * length - 1.5) < 1e-6);
        assert_true(isinf(nook_medium_stop(&medium, from, d, 0.0, 1e9, 1e-9))); /* leaves it before */
        assert_true(isinf(nook_medium_stop(&medium, from, d, 0.0, 1.4 / length, exp(-0.9 * 1.5)))); /* ends before */
    }
    assert_true(isinf(nook_medium_stop(&medium, (double[]){ 5, 2, 2 }, (double[]){ 0, 1, 0 }, 0, 1e9, 0.999)));
    assert_true(nook_medium_stop(&medium, (double[]){ -1, 2, 2 }, (double[]){ 1, 0, 0 }, 0, 1e9, 0.999) > 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_homogeneous_cube_around_the_point_takes_what_its_reach_says),
        cmocka_unit_test(test_drawn_boxes_see_a_medium_as_dispatches_do),
        cmocka_unit_test(test_twice_the_thickness_lets_through_the_square),
        cmocka_unit_test(test_what_a_medium_takes_fades_with_the_way_to_it),
        cmocka_unit_test(test_a_ray_that_hardly_moves_along_an_axis_of_a_medium_stays_in_it),
        cmocka_unit_test(test_volume_and_reference_see_the_same_cube_overhead),
        cmocka_unit_test(test_a_cube_below_or_out_of_reach_darkens_nothing),
        cmocka_unit_test(test_two_media_in_one_place_multiply),
        cmocka_unit_test(test_a_medium_and_a_ceiling_darken_together),
        cmocka_unit_test(test_what_is_no_medium_is_refused),
        cmocka_unit_test(test_a_ray_is_stopped_where_so_much_is_left),
    };
    return cmocka_run_group_tests(tests, ao_fixture_setup, ao_fixture_teardown);
}
