/* The volume technique on closed forms: it must not see its own surface, and must combine objects as it says. */
#include "modules/fixture/closed_form.h"
#include "tests/support/ao_fixture.h"
#include <math.h>
#include <stdio.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const double origin[3] = { 0, 0, 0 }, up[3] = { 0, 0, 1 };

static ao_fixture *prepare(void **state, const char *combine, const char *r_max)
{
    ao_fixture *fixture = ao_fixture_begin(state, r_max);
    ao_fixture_param(fixture, "volume.rays", "256");
    ao_fixture_param(fixture, "volume.steps", "512");
    ao_fixture_param(fixture, "volume.stepping", "matched");
    ao_fixture_param(fixture, "volume.threshold", "0.5");
    ao_fixture_param(fixture, "volume.guard", "lifted");
    ao_fixture_param(fixture, "volume.combine", combine);
    return fixture;
}

/** A floor through `at` with a normal, in a mesh whose box moves the voxel grid by `phase` voxels along each axis. */
static double add_tilted_floor(ao_fixture *fixture, const double at[3], const double n[3], double phase)
{
    double t[3], b[3], corner[3], edge_t[3], edge_b[3], size = 0.9, anchor = 1.5 + phase * 3.0 / 48;
    double s = n[2] >= 0.0 ? 1.0 : -1.0, a = -1.0 / (s + n[2]), c = n[0] * n[1] * a;
    t[0] = 1.0 + s * n[0] * n[0] * a, t[1] = s * c, t[2] = -s * n[0];
    b[0] = c, b[1] = s + n[1] * n[1] * a, b[2] = -n[1];
    for (int axis = 0; axis < 3; axis++) {
        corner[axis] = at[axis] - size * (t[axis] + b[axis]);
        edge_t[axis] = 2 * size * t[axis];
        edge_b[axis] = 2 * size * b[axis];
    }
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, corner, edge_t, edge_b);
    /* Two specks fix the box to 3 units from -anchor; the grid's voxels are 3 / 48 wide. */
    for (int side = 0; side < 2; side++) {
        double p = side ? 3.0 - anchor : -anchor;
        nook_fixture_add_triangle(&mesh, (double[]){ p, p, p }, (double[]){ p, p, p }, (double[]){ p, p, p });
    }
    double voxel = ao_fixture_add(fixture, &mesh, 48);
    nook_fixture_mesh_free(&mesh);
    return voxel;
}

static void check_floor_sweep(void **state, const char *guard, const char *stepping, const char *threshold, int every)
{
    ao_fixture *fixture = prepare(state, "union", "0.4");
    ao_fixture_param(fixture, "volume.rays", "64");
    ao_fixture_param(fixture, "volume.guard", guard);
    ao_fixture_param(fixture, "volume.stepping", stepping);
    ao_fixture_param(fixture, "volume.threshold", threshold);
    fixture->view_angle = 0.6;
    for (int k = 0; k < AO_FIXTURE_NORMALS; k++) {
        double n[3];
        ao_fixture_normal(k, n);
        for (int phase = 0; phase < 64; phase += every) {
            ao_fixture_clear(fixture);
            double voxel = add_tilted_floor(fixture, origin, n, phase / 64.0);
            assert_true(fabs(voxel - 3.0 / 48) < 1e-6);
            nook_fixture_occlusion got = ao_fixture_measure(fixture, "volume", origin, n, 0.5);
            if (got.highest >= 1.0 / 255)
                fail_msg("normal %d (%.3f %.3f %.3f), phase %d of 64: A up to %.4f", k, n[0], n[1], n[2], phase,
                         got.highest);
        }
    }
}

static void test_volume_sees_nothing_above_a_floor_at_any_phase_and_tilt(void **state)
{
    check_floor_sweep(state, "lifted", "matched", "0.5", 1);
}

static void test_volume_sees_nothing_above_a_floor_with_the_papers_guard_direction_and_steps(void **state)
{
    check_floor_sweep(state, "slab", "fixed", "0.5", 4);
}

static void test_volume_sees_nothing_above_a_floor_from_a_start_that_is_moved_to_the_eye(void **state)
{
    check_floor_sweep(state, "seen", "matched", "0.5", 8);
}

static void test_volume_sees_nothing_above_a_floor_at_other_thresholds(void **state)
{
    check_floor_sweep(state, "lifted", "matched", "0.2", 8);
    check_floor_sweep(state, "lifted", "matched", "0.8", 8);
}

static void test_volume_sees_nothing_above_a_floor_by_corners(void **state)
{
    ao_fixture_param(*state, "volume.sampling", "corners");
    check_floor_sweep(state, "lifted", "matched", "0.5", 2);
    ao_fixture_param(*state, "volume.sampling", "filter");
}

static double measure_box(ao_fixture *fixture, double side, uint32_t resolution)
{
    nook_fixture_mesh mesh = { 0 };
    double half = 0.5 * side;
    nook_fixture_add_box(&mesh, (double[]){ -half, -half, 0 }, (double[]){ half, half, side }, 63);
    ao_fixture_add(fixture, &mesh, resolution);
    nook_fixture_mesh_free(&mesh);
    double mean = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    ao_fixture_clear(fixture);
    return mean;
}

static void test_volume_is_closed_in_a_closed_box_within_eight_voxels(void **state)
{
    ao_fixture *fixture = prepare(state, "union", "8"); /* the box is 4 voxels of 1 wide: its diagonal is 6.9 voxels */
    double closed = measure_box(fixture, 4.0, 4);
    assert_true(closed >= 0.98);
    fixture = prepare(state, "union", "128"); /* and at a common resolution, far larger than a voxel */
    assert_true(measure_box(fixture, 64.0, 64) >= 0.98);
}

static void add_wall(ao_fixture *fixture, double x)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ x, -40, 0 }, (double[]){ 0, 80, 0 }, (double[]){ 0, 0, 40 });
    ao_fixture_add(fixture, &mesh, 256);
    nook_fixture_mesh_free(&mesh);
}

/** A wall at k r_max, hard falloff: fixture 5. */
static double wall_truth(double k)
{
    return nook_form_wall(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, k);
}

static void expect(ao_fixture *fixture, double truth)
{
    double got = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    if (fabs(got - truth) >= 0.02)
        fail_msg("A = %.4f, predicted %.4f", got, truth);
}

/**
 * The foot of a thick wall whose face lies at `phase` of a voxel of 1, a fiftieth of a voxel from it, seen from between wall and floor from so
 * far. The floor itself has no volume.
 */
static double measure_foot(ao_fixture *fixture, const char *guard, double phase, double distance)
{
    nook_fixture_view *view = fixture->view;
    nook_fixture_mesh mesh = { 0 };
    const double eye[3] = { distance * 2 / 3, distance / 3, distance * 2 / 3 };
    ao_fixture_clear(fixture);
    nook_fixture_add_box(&mesh, (double[]){ -4, -24, -24 }, (double[]){ -0.02, 24, 24 }, 63);
    for (int side = 0; side < 2; side++) { /* two specks fix the grid */
        double p = side ? 28.0 - phase : -28.0 - phase;
        nook_fixture_add_triangle(&mesh, (double[]){ p, p, p }, (double[]){ p, p, p }, (double[]){ p, p, p });
    }
    assert_true(fabs(ao_fixture_add(fixture, &mesh, 56) - 1.0) < 1e-6);
    nook_fixture_mesh_free(&mesh);
    ao_fixture_param(fixture, "volume.guard", guard);
    view->view_from_world = nook_matrix_look_at(eye, origin, up);
    view->clip_from_view = nook_matrix_perspective_reversed(1e-3, 1.0, 0.1);
    for (uint32_t i = 0; i < view->width * view->height; i++)
        nook_fixture_view_set_pixel(view, i % view->width, i / view->width, distance, up);
    assert_int_equal(nook_fixture_view_record(view, "volume"), NOOK_OK);
    return nook_fixture_summarize(view, 0, 0, view->width, view->height).mean;
}

static void test_volume_sees_half_of_the_sky_at_the_foot_of_a_wall_when_its_start_is_moved_to_the_eye(void **state)
{
    ao_fixture *fixture = prepare(state, "union", "16");
    double lifted = 0.0, seen = 0.0;
    for (int phase = 0; phase < 16; phase++) {
        lifted = fmax(lifted, fabs(measure_foot(fixture, "lifted", phase / 16.0, 9) - 0.5));
        seen = fmax(seen, fabs(measure_foot(fixture, "seen", phase / 16.0, 9) - 0.5));
    }
    assert_true(lifted > 0.2); /* else the wall's voxels do not cover the start */
    assert_true(seen < 0.02);
}

/* All ways out of the wall's voxels are longer: half a voxel is the least. */
static void test_a_start_is_not_moved_past_the_eye(void **state)
{
    ao_fixture *fixture = prepare(state, "union", "16");
    double most = 0.0;
    for (int phase = 0; phase < 16; phase++) {
        double lifted = measure_foot(fixture, "lifted", phase / 16.0, 0.3);
        assert_true(measure_foot(fixture, "seen", phase / 16.0, 0.3) == lifted);
        most = fmax(most, fabs(lifted - 0.5));
    }
    assert_true(most > 0.2); /* as above: from farther away it would be moved */
}

static void test_volume_union_counts_a_wall_once_and_multiply_squares_it(void **state)
{
    double one = wall_truth(0.1);
    for (int product = 0; product < 2; product++) {
        ao_fixture *fixture = prepare(state, product ? "multiply" : "union", "20");
        add_wall(fixture, 2);
        add_wall(fixture, 2);
        expect(fixture, product ? nook_form_product((double[]){ one, one }, 2) : one);
    }
}

static void test_volume_union_adds_opposite_walls_and_multiply_falls_short(void **state)
{
    double one = wall_truth(0.1);
    for (int product = 0; product < 2; product++) {
        ao_fixture *fixture = prepare(state, product ? "multiply" : "union", "20");
        add_wall(fixture, 2);
        add_wall(fixture, -2);
        expect(fixture, product ? nook_form_product((double[]){ one, one }, 2) : 2 * one);
    }
}

static void test_volume_combines_the_six_faces_of_a_cube_as_predicted(void **state)
{
    const double product = nook_form_product((double[]){ 0.23946, 0.19014, 0.19014, 0.19014, 0.19014 }, 5);
    for (int multiply = 0; multiply < 2; multiply++) {
        ao_fixture *fixture = prepare(state, multiply ? "multiply" : "union", "1000");
        for (int face = 0; face < 6; face++) {
            nook_fixture_mesh mesh = { 0 };
            nook_fixture_add_box(&mesh, (double[]){ -32, -32, 0 }, (double[]){ 32, 32, 64 }, 1u << face);
            ao_fixture_add(fixture, &mesh, 128);
            nook_fixture_mesh_free(&mesh);
        }
        expect(fixture, multiply ? product : 1.0);
    }
}

static void test_volume_steps_longer_than_a_shell_lose_what_theory_says(void **state)
{
    /* C9 under a wide ceiling with the paper's fixed steps: A = 2q - q^2 of what is within reach, q = shell / step. */
    const double height = 20.0, r_max = 80.0, voxel = 1.0;
    ao_fixture *fixture = prepare(state, "union", "80");
    ao_fixture_param(fixture, "volume.stepping", "fixed");
    ao_fixture_param(fixture, "volume.guard", "slab");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ -128, -128, height }, (double[]){ 256, 0, 0 }, (double[]){ 0, 256, 0 });
    double size = ao_fixture_add(fixture, &mesh, 256);
    nook_fixture_mesh_free(&mesh);
    assert_true(fabs(size - voxel) < 1e-6);
    for (int steps = 20; steps <= 40; steps += 20) {
        char text[16];
        snprintf(text, sizeof text, "%d", steps);
        ao_fixture_param(fixture, "volume.steps", text);
        double predicted = nook_form_stepped_ceiling(voxel * steps / r_max, height / r_max);
        double got = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
        if (fabs(got - predicted) >= 0.02)
            fail_msg("%d steps: A = %.4f, predicted %.4f", steps, got, predicted);
    }
}

static void test_volume_reports_unbiased_distances(void **state)
{
    /* Linear falloff turns a wrong distance into a wrong A: a ceiling at 0.4 r_max gives (1 - 0.4)^2. */
    ao_fixture *fixture = prepare(state, "union", "50");
    ao_fixture_param(fixture, "ao.falloff", "linear");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ -128, -128, 20 }, (double[]){ 256, 0, 0 }, (double[]){ 0, 256, 0 });
    ao_fixture_add(fixture, &mesh, 256);
    nook_fixture_mesh_free(&mesh);
    double got = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    if (fabs(got - 0.36) >= 0.01)
        fail_msg("A = %.4f, truth 0.3600", got);
}

static void test_volume_means_the_same_with_more_rays_than_one_dispatch_holds(void **state)
{
    static const char *const combines[] = { "union", "multiply" }, *const rays[] = { "64", "1024" };
    for (size_t k = 0; k < NOOK_COUNT(combines); k++) {
        ao_fixture *fixture = prepare(state, combines[k], "1");
        ao_fixture_param(fixture, "volume.stepping", "fixed");
        ao_fixture_param(fixture, "volume.steps", "256");
        nook_fixture_mesh mesh = { 0 };
        nook_fixture_add_box(&mesh, (double[]){ -1, -1, 0 }, (double[]){ 0.3, 1, 1 }, 63); /* rays cross its inside */
        ao_fixture_add(fixture, &mesh, 48);
        ao_fixture_add(fixture, &mesh, 48);
        nook_fixture_mesh_free(&mesh);
        double means[2];
        for (size_t i = 0; i < 2; i++) {
            ao_fixture_param(fixture, "volume.rays", rays[i]);
            means[i] = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
        }
        assert_true(means[0] > 0.1 && means[0] < 0.9);
        if (fabs(means[0] - means[1]) >= 0.005)
            fail_msg("%s: A = %.4f with 64 rays, %.4f with 1024", combines[k], means[0], means[1]);
    }
}

static double counted_fetches(ao_fixture *fixture)
{
    nook_ao_statistics statistics;
    ao_fixture_param(fixture, "ao.count", "1");
    ao_fixture_measure(fixture, "volume", origin, up, 0.3);
    nook_ao_get_statistics(fixture->view->ao, &statistics);
    ao_fixture_param(fixture, "ao.count", "0");
    return statistics.fetches_per_pixel;
}

static void test_volume_pays_only_for_occluders_within_reach(void **state)
{
    ao_fixture *fixture = prepare(state, "union", "1");
    ao_fixture_param(fixture, "volume.rays",
                     "32"); /* one dispatch, with 64 occluders as with one: each reads the receiver */
    ao_fixture_param(fixture, "volume.steps", "64");
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_box(&mesh, (double[]){ 0.5, -0.5, 0 }, (double[]){ 1.5, 0.5, 1 }, 63);
    ao_fixture_add(fixture, &mesh, 32);
    double alone = counted_fetches(fixture);
    assert_true(alone > 2 + 2 + 32); /* depth and normal, prepared and read; a direction a ray; and the volume */
    nook_fixture_view *view = fixture->view;
    for (int i = 1; i < 64; i++) { /* the same box, 4 m and farther away all around */
        nook_ao_occluder *occluder = &view->occluders[view->occluder_count++];
        *occluder = view->occluders[0];
        occluder->world_from_mesh[12] = 4.0 * (i % 8 - 4) + (i % 8 < 4 ? -2.0 : 4.0);
        occluder->world_from_mesh[13] = 4.0 * (i / 8.0);
    }
    assert_true(counted_fetches(fixture) == alone);
    nook_fixture_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_volume_sees_nothing_above_a_floor_at_any_phase_and_tilt),
        cmocka_unit_test(test_volume_sees_nothing_above_a_floor_with_the_papers_guard_direction_and_steps),
        cmocka_unit_test(test_volume_sees_nothing_above_a_floor_from_a_start_that_is_moved_to_the_eye),
        cmocka_unit_test(test_volume_sees_nothing_above_a_floor_at_other_thresholds),
        cmocka_unit_test(test_volume_sees_nothing_above_a_floor_by_corners),
        cmocka_unit_test(test_volume_is_closed_in_a_closed_box_within_eight_voxels),
        cmocka_unit_test(test_volume_sees_half_of_the_sky_at_the_foot_of_a_wall_when_its_start_is_moved_to_the_eye),
        cmocka_unit_test(test_a_start_is_not_moved_past_the_eye),
        cmocka_unit_test(test_volume_union_counts_a_wall_once_and_multiply_squares_it),
        cmocka_unit_test(test_volume_union_adds_opposite_walls_and_multiply_falls_short),
        cmocka_unit_test(test_volume_combines_the_six_faces_of_a_cube_as_predicted),
        cmocka_unit_test(test_volume_steps_longer_than_a_shell_lose_what_theory_says),
        cmocka_unit_test(test_volume_reports_unbiased_distances),
        cmocka_unit_test(test_volume_means_the_same_with_more_rays_than_one_dispatch_holds),
        cmocka_unit_test(test_volume_pays_only_for_occluders_within_reach),
    };
    return cmocka_run_group_tests(tests, ao_fixture_setup, ao_fixture_teardown);
}
