/* The ray-traced reference against closed forms (docs/techniques.md, section Fixtures): within 0.005 at 4096 rays. */
#include "tests/support/ao_fixture.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const double pi = 3.14159265358979323846;
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
    static const struct {
        const char *falloff, *r_max;
        double truth;
    } cases[] = { { "hard", "1.5", 0.5625 }, { "linear", "1.5", 0.1875 }, { "linear", "4", 1 - 2.0 / (3 * 2.0) } };
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
    const double k = 0.4, tau = 3.0; /* height / r_max; the initial falloff_tau */
    double wendland = 0.0, exponential = 0.0;
    for (int i = 0; i < 200000; i++) { /* c = cos: distance k / c, A = integral of rho 2 c dc over [k, 1] */
        double c = k + (1.0 - k) * (i + 0.5) / 200000, q = 1.0 - k / c;
        wendland += q * q * q * q * (4.0 * k / c + 1.0) * 2.0 * c * (1.0 - k) / 200000;
        exponential += exp(-tau * k / c) * 2.0 * c * (1.0 - k) / 200000;
    }
    const struct {
        const char *falloff;
        double truth;
    } cases[] = { { "hard", 1 - k * k },
                  { "linear", (1 - k) * (1 - k) },
                  { "quadratic", 1 - k * k + 2 * k * k * log(k) },
                  { "wendland", wendland },
                  { "exponential", exponential } };
    for (size_t i = 0; i < NOOK_COUNT(cases); i++) {
        ao_fixture *fixture = prepare(state, cases[i].falloff, "2.5");
        nook_fixture_mesh mesh = { 0 };
        nook_fixture_add_quad(&mesh, (double[]){ -50, -50, 1 }, (double[]){ 100, 0, 0 }, (double[]){ 0, 100, 0 });
        expect(fixture, &mesh, cases[i].truth);
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
    const double k = 0.3, s = sqrt(1 - k * k);
    nook_fixture_mesh mesh = { 0 };
    ao_fixture *fixture = prepare(state, "hard", "1");
    add_wall(&mesh, k, 5);
    expect(fixture, &mesh, (acos(k) - k * s) / pi);
    fixture = prepare(state, "linear", "1");
    add_wall(&mesh, k, 5);
    expect(fixture, &mesh, (acos(k) + k * s - 2 * k * log((1 + s) / k)) / pi);
}

static void test_reference_matches_a_wall_of_finite_height(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_mesh mesh = { 0 };
    add_wall(&mesh, 1.0, 1.5);
    expect(fixture, &mesh, 0.5 * (1 - 1 / sqrt(1 + 1.5 * 1.5)));
}

static void test_reference_matches_dihedral_corners(void **state)
{
    for (double degrees = 60; degrees <= 120; degrees += 30) {
        ao_fixture *fixture = prepare(state, "hard", "1e6");
        double angle = degrees * pi / 180;
        nook_fixture_mesh mesh = { 0 };
        nook_fixture_add_quad(&mesh, (double[]){ 1, -far_away, 0 }, (double[]){ 0, 2 * far_away, 0 },
                              (double[]){ -far_away * cos(angle), 0, far_away * sin(angle) });
        expect(fixture, &mesh, cos(angle / 2) * cos(angle / 2));
    }
}

static void test_reference_matches_an_overhang(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ 0.7, -far_away, 1 }, (double[]){ far_away, 0, 0 },
                          (double[]){ 0, 2 * far_away, 0 });
    expect(fixture, &mesh, 0.5 * (1 - 0.7 / sqrt(0.7 * 0.7 + 1)));
}

static void test_reference_matches_the_bottom_of_a_trench(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_mesh mesh = { 0 };
    add_wall(&mesh, -0.6, 1.0);
    add_wall(&mesh, 0.6, 1.0);
    expect(fixture, &mesh, 1 - 0.6 / sqrt(0.36 + 1));
}

static void test_reference_matches_the_bottom_of_a_round_pit(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_tube(&mesh, 1.0, 0.0, 1.0, ROUND);
    expect(fixture, &mesh, 0.5);
}

static void test_reference_matches_a_disc_overhead(void **state)
{
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_disc(&mesh, (double[]){ 0, 0, 1 }, 0.8, ROUND);
    expect(fixture, &mesh, 0.64 / 1.64);
}

/** Fixture 14, for a unit sphere whose centre lies at distance h in a direction of cosine nl. */
static double sphere_crossing_horizon(double h, double nl)
{
    double k2 = 1 - h * h * nl * nl;
    return ((nl * acos(-nl * sqrt((h * h - 1) / (1 - nl * nl))) - sqrt(k2 * (h * h - 1))) / (h * h) +
            atan(sqrt(k2 / (h * h - 1)))) /
           pi;
}

static void test_reference_matches_spheres_above_and_across_the_horizon(void **state)
{
    const struct {
        double centre[3];
        double truth;
    } cases[] = { { { 0, 0, 1.5 }, 1 / 2.25 },
                  { { 1.3, 0, 1 }, 1 / pow(1.3 * 1.3 + 1, 1.5) },
                  { { 1.5, 0, 0.4 }, sphere_crossing_horizon(sqrt(2.41), 0.4 / sqrt(2.41)) },
                  { { 1.5, 0, -0.3 }, sphere_crossing_horizon(sqrt(2.34), -0.3 / sqrt(2.34)) } };
    for (size_t i = 0; i < NOOK_COUNT(cases); i++) {
        ao_fixture *fixture = prepare(state, "hard", "1e6");
        nook_fixture_mesh mesh = { 0 };
        nook_fixture_add_sphere(&mesh, cases[i].centre, 1.0, ROUND);
        expect(fixture, &mesh, cases[i].truth);
    }
}

static void test_reference_matches_parallel_and_perpendicular_rectangles(void **state)
{
    const double a = 1.2, b = 0.7, c = 0.9, x = a / c, y = b / c;
    double parallel =
        (x / sqrt(1 + x * x) * atan(y / sqrt(1 + x * x)) + y / sqrt(1 + y * y) * atan(x / sqrt(1 + y * y))) / (2 * pi);
    double perpendicular = (atan(b / c) - c / sqrt(a * a + c * c) * atan(b / sqrt(a * a + c * c))) / (2 * pi);
    nook_fixture_mesh mesh = { 0 };
    ao_fixture *fixture = prepare(state, "hard", "1e6");
    nook_fixture_add_quad(&mesh, (double[]){ 0, 0, c }, (double[]){ a, 0, 0 }, (double[]){ 0, b, 0 });
    expect(fixture, &mesh, parallel);
    fixture = prepare(state, "hard", "1e6");
    nook_fixture_add_quad(&mesh, (double[]){ c, 0, 0 }, (double[]){ 0, b, 0 }, (double[]){ 0, 0, a });
    expect(fixture, &mesh, perpendicular);
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
    assert_true(fabs(ao_fixture_measure(fixture, "reference", at, up, 0.05).mean - 0.64 / 1.64) < 0.005);
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
