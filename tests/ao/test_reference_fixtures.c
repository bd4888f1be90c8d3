/* The ray-traced reference against closed forms (docs/techniques.md, section Fixtures): within 0.005 at 4096 rays. */
#include "engine/core/angle.h"
#include "modules/fixture/closed_form.h"
#include "tests/support/ao_fixture.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const double origin[3] = { 0, 0, 0 }, up[3] = { 0, 0, 1 };
static const double far_away = 1e4; /* stands for infinity: what lies beyond has a solid angle under 1e-3 */
enum { ROUND = 256 };

static ao_fixture *prepare(void **state, const char *falloff, const char *r_max)
{
    ao_fixture *fixture = *state;
    ao_fixture_clear(fixture);
    ao_fixture_param(fixture, "reference.rays", "4096");
    ao_fixture_param(fixture, "ao.falloff", falloff);
    ao_fixture_param(fixture, "ao.r_max", r_max);
    return fixture;
}

/** Adds the mesh, measures at the origin with normal +z, and holds the result to the truth. */
static void expect(ao_fixture *fixture, nook_fixture_mesh *mesh, double truth)
{
    ao_fixture_add(fixture, mesh, 0);
    nook_fixture_mesh_free(mesh);
    nook_fixture_occlusion got = ao_fixture_measure(fixture, "reference", origin, up, 0.05);
    if (fabs(got.mean - truth) >= 0.005)
        fail_msg("A = %.5f, truth %.5f", got.mean, truth);
}

static void add_floor(nook_fixture_mesh *mesh)
{
    nook_fixture_add_quad(mesh, (double[]){ -far_away, -far_away, 0 }, (double[]){ 2 * far_away, 0, 0 },
                          (double[]){ 0, 2 * far_away, 0 });
}

static void add_wall(nook_fixture_mesh *mesh, double x, double height)
{
    nook_fixture_add_quad(mesh, (double[]){ x, -far_away, 0 }, (double[]){ 0, 2 * far_away, 0 },
                          (double[]){ 0, 0, height });
}

static void test_reference_sees_nothing_above_an_open_plane(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_mesh mesh = { 0 };
    add_floor(&mesh);
    ao_fixture_add(fixture, &mesh, 0);
    nook_fixture_mesh_free(&mesh);
    assert_true(ao_fixture_measure(fixture, "reference", origin, up, 0.05).highest == 0.0);
    assert_true(ao_fixture_measure(fixture, "reference", origin, up, 50.0).highest == 0.0);
}

static void test_reference_is_exactly_one_in_a_closed_box(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "100");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_box(&mesh, (double[]){ -1, -0.7, 0 }, (double[]){ 0.4, 1, 2 }, 63);
    ao_fixture_add(fixture, &mesh, 0);
    nook_fixture_mesh_free(&mesh);
    assert_true(ao_fixture_measure(fixture, "reference", origin, up, 0.05).lowest == 1.0);
}

static void test_reference_matches_the_inside_of_a_sphere(void **state)
{
    const struct {
        const char *falloff, *r_max;
        double truth;
    } cases[] = { { "hard", "1.5", nook_form_sphere_inside(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, 0, 0.75) },
                  { "linear", "1.5", nook_form_sphere_inside(NOOK_FORM_COSINE, NOOK_FALLOFF_LINEAR, 0, 0.75) },
                  { "linear", "4", nook_form_sphere_inside(NOOK_FORM_COSINE, NOOK_FALLOFF_LINEAR, 0, 2.0) } };
    for (size_t i = 0; i < NOOK_COUNT(cases); i++) {
        ao_fixture *fixture = prepare(state, cases[i].falloff, cases[i].r_max);
        nook_fixture_mesh mesh = { 0 };
        /* A hair inside: the receiver's plane would cut through the facets around the pole. */
        nook_fixture_add_sphere(&mesh, (double[]){ 0, 0, 1 - 1e-4 }, 1.0, ROUND);
        expect(fixture, &mesh, cases[i].truth);
    }
}

static void test_reference_matches_an_infinite_ceiling_under_every_falloff(void **state)
{
    static const char *const names[] = { "hard", "linear", "quadratic", "wendland", "exponential" };
    const double k = 0.4, tau = 3.0; /* height / r_max; the initial falloff_tau */
    for (size_t i = 0; i < NOOK_COUNT(names); i++) {
        ao_fixture *fixture = prepare(state, names[i], "2.5");
        nook_fixture_mesh mesh = { 0 };
        nook_fixture_add_quad(&mesh, (double[]){ -50, -50, 1 }, (double[]){ 100, 0, 0 }, (double[]){ 0, 100, 0 });
        expect(fixture, &mesh, nook_form_ceiling(NOOK_FORM_COSINE, (nook_falloff)i, tau, k));
    }
}

static void test_reference_matches_a_corner_at_any_distance_and_falloff(void **state)
{
    for (double x = 0.01; x < 10.0; x *= 10.0) {
        ao_fixture *fixture = prepare(state, "hard", "1e6");
        nook_fixture_mesh mesh = { 0 };
        add_wall(&mesh, x, far_away);
        expect(fixture, &mesh, 0.5);
    }
    const double k = 0.3;
    nook_fixture_mesh mesh = { 0 };
    ao_fixture *fixture = prepare(state, "hard", "1");
    add_wall(&mesh, k, 5);
    expect(fixture, &mesh, nook_form_wall(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, k));
    fixture = prepare(state, "linear", "1");
    add_wall(&mesh, k, 5);
    expect(fixture, &mesh, nook_form_wall(NOOK_FORM_COSINE, NOOK_FALLOFF_LINEAR, k));
}

static void test_reference_matches_a_wall_of_finite_height(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_mesh mesh = { 0 };
    add_wall(&mesh, 1.0, 1.5);
    expect(fixture, &mesh, nook_form_low_wall(NOOK_FORM_COSINE, 1.0, 1.5));
}

static void test_reference_matches_dihedral_corners(void **state)
{
    for (double degrees = 60; degrees <= 120; degrees += 30) {
        ao_fixture *fixture = prepare(state, "hard", "1e6");
        double angle = degrees * NOOK_PI / 180;
        nook_fixture_mesh mesh = { 0 };
        nook_fixture_add_quad(&mesh, (double[]){ 1, -far_away, 0 }, (double[]){ 0, 2 * far_away, 0 },
                              (double[]){ -far_away * cos(angle), 0, far_away * sin(angle) });
        expect(fixture, &mesh, nook_form_dihedral(NOOK_FORM_COSINE, angle));
    }
}

static void test_reference_matches_an_overhang(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ 0.7, -far_away, 1 }, (double[]){ far_away, 0, 0 },
                          (double[]){ 0, 2 * far_away, 0 });
    expect(fixture, &mesh, nook_form_overhang(NOOK_FORM_COSINE, 0.7, 1.0));
}

static void test_reference_matches_the_bottom_of_a_trench(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_mesh mesh = { 0 };
    add_wall(&mesh, -0.6, 1.0);
    add_wall(&mesh, 0.6, 1.0);
    expect(fixture, &mesh, nook_form_trench(NOOK_FORM_COSINE, 1.2, 1.0));
}

static void test_reference_matches_the_bottom_of_a_round_pit(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_tube(&mesh, 1.0, 0.0, 1.0, ROUND);
    expect(fixture, &mesh, nook_form_pit(NOOK_FORM_COSINE, 1.0, 1.0));
}

static void test_reference_matches_a_disc_overhead(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_disc(&mesh, (double[]){ 0, 0, 1 }, 0.8, ROUND);
    expect(fixture, &mesh, nook_form_disc(NOOK_FORM_COSINE, 0.8, 1.0));
}

static void test_reference_matches_spheres_above_and_across_the_horizon(void **state)
{
    static const double centres[][3] = { { 0, 0, 1.5 }, { 1.3, 0, 1 }, { 1.5, 0, 0.4 }, { 1.5, 0, -0.3 } };
    for (size_t i = 0; i < NOOK_COUNT(centres); i++) {
        ao_fixture *fixture = prepare(state, "hard", "1e6");
        nook_fixture_mesh mesh = { 0 };
        nook_fixture_add_sphere(&mesh, centres[i], 1.0, ROUND);
        double distance = hypot(centres[i][0], centres[i][2]);
        expect(fixture, &mesh, nook_form_sphere(NOOK_FORM_COSINE, 1.0, distance, centres[i][2] / distance));
    }
}

static void test_reference_matches_parallel_and_perpendicular_rectangles(void **state)
{
    const double a = 1.2, b = 0.7, c = 0.9;
    nook_fixture_mesh mesh = { 0 };
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_add_quad(&mesh, (double[]){ 0, 0, c }, (double[]){ a, 0, 0 }, (double[]){ 0, b, 0 });
    expect(fixture, &mesh, nook_form_level_rectangle(NOOK_FORM_COSINE, a, b, c));
    fixture = prepare(state, "hard", "1e6");
    nook_fixture_add_quad(&mesh, (double[]){ c, 0, 0 }, (double[]){ 0, b, 0 }, (double[]){ 0, 0, a });
    expect(fixture, &mesh, nook_form_upright_rectangle(NOOK_FORM_COSINE, b, a, c));
}

static void test_reference_takes_the_union_of_objects(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "100");
    const double low[3] = { -0.5, -0.5, 0 }, high[3] = { 0.5, 0.5, 1 };
    double sum = 0.0;
    for (int face = 0; face < 6; face++) {
        ao_fixture_clear(fixture);
        nook_fixture_mesh mesh = { 0 };
        nook_fixture_add_box(&mesh, low, high, 1u << face);
        expect(fixture, &mesh, face == 5 ? 0.23946 : face == 4 ? 0.0 : 0.19014);
        sum += ao_fixture_measure(fixture, "reference", origin, up, 0.05).mean;
    }
    assert_true(fabs(sum - 1.0) < 0.005);
}

static void test_reference_follows_transforms_of_an_instance(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_disc(&mesh, (double[]){ 0, 0, 0 }, 1.0, ROUND);
    ao_fixture_add(fixture, &mesh, 0);
    nook_fixture_mesh_free(&mesh);
    /* Scaled to radius 0.8, mirrored in z, lifted to height 1, the whole world 3000 km away. */
    const double m[16] = { 0.8, 0, 0, 0, 0, 0.8, 0, 0, 0, 0, -2, 0, 3e6, -3e6, 1 + 1e6, 1 }, at[3] = { 3e6, -3e6, 1e6 };
    memcpy(fixture->view->occluders[0].world_from_mesh, m, sizeof m);
    assert_true(fabs(ao_fixture_measure(fixture, "reference", at, up, 0.05).mean -
                     nook_form_disc(NOOK_FORM_COSINE, 0.8, 1.0)) < 0.005);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reference_sees_nothing_above_an_open_plane),
        cmocka_unit_test(test_reference_is_exactly_one_in_a_closed_box),
        cmocka_unit_test(test_reference_matches_the_inside_of_a_sphere),
        cmocka_unit_test(test_reference_matches_an_infinite_ceiling_under_every_falloff),
        cmocka_unit_test(test_reference_matches_a_corner_at_any_distance_and_falloff),
        cmocka_unit_test(test_reference_matches_a_wall_of_finite_height),
        cmocka_unit_test(test_reference_matches_dihedral_corners),
        cmocka_unit_test(test_reference_matches_an_overhang),
        cmocka_unit_test(test_reference_matches_the_bottom_of_a_trench),
        cmocka_unit_test(test_reference_matches_the_bottom_of_a_round_pit),
        cmocka_unit_test(test_reference_matches_a_disc_overhead),
        cmocka_unit_test(test_reference_matches_spheres_above_and_across_the_horizon),
        cmocka_unit_test(test_reference_matches_parallel_and_perpendicular_rectangles),
        cmocka_unit_test(test_reference_takes_the_union_of_objects),
        cmocka_unit_test(test_reference_follows_transforms_of_an_instance),
    };
    return cmocka_run_group_tests(tests, ao_fixture_setup, ao_fixture_teardown);
}
