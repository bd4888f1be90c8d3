/* hao on closed forms: it must not see its own surface, must see what the camera does not, and miss what lies between its tests. */
#include "modules/fixture/closed_form.h"
#include "tests/support/ao_fixture.h"
#include "tests/support/test_mask.h"
#include <math.h>
#include <stdio.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const double origin[3] = { 0, 0, 0 }, up[3] = { 0, 0, 1 };
static const char *const slicemaps[] = { "one", "three" };

/** Hard falloff and as many rays and tests as leave little but the voxels' own error. */
static ao_fixture *prepare(void **state, const char *maps, const char *r_max)
{
    ao_fixture *fixture = ao_fixture_begin(state, r_max);
    ao_fixture_param(fixture, "hao.rays", "256");
    ao_fixture_param(fixture, "hao.tests", "256");
    ao_fixture_param(fixture, "hao.voxels", "128");
    ao_fixture_param(fixture, "hao.slicemaps", maps);
    ao_fixture_param(fixture, "hao.spread", "1");
    ao_fixture_param(fixture, "hao.noise", "space");
    ao_fixture_param(fixture, "hao.guard", "lifted");
    return fixture;
}

static void add(ao_fixture *fixture, nook_fixture_mesh *mesh)
{
    ao_fixture_add(fixture, mesh, 0);
    nook_fixture_mesh_free(mesh);
}

static void add_quad(ao_fixture *fixture, const double corner[3], const double u[3], const double v[3])
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, corner, u, v);
    add(fixture, &mesh);
}

static double measure(ao_fixture *fixture)
{
    return ao_fixture_measure(fixture, "hao", origin, up, 0.3).mean;
}

static void expect(ao_fixture *fixture, double truth, double within)
{
    double got = measure(fixture);
    if (fabs(got - truth) > within)
        fail_msg("A = %.4f, predicted %.4f", got, truth);
}

/* ---- the own surface ---- */

static void add_floor(ao_fixture *fixture, const double at[3], const double n[3])
{
    double t[3], b[3], corner[3], edge_t[3], edge_b[3], size = 0.9;
    double s = n[2] >= 0.0 ? 1.0 : -1.0, a = -1.0 / (s + n[2]), c = n[0] * n[1] * a;
    t[0] = 1.0 + s * n[0] * n[0] * a, t[1] = s * c, t[2] = -s * n[0];
    b[0] = c, b[1] = s + n[1] * n[1] * a, b[2] = -n[1];
    for (int axis = 0; axis < 3; axis++) {
        corner[axis] = at[axis] - size * (t[axis] + b[axis]);
        edge_t[axis] = 2 * size * t[axis];
        edge_b[axis] = 2 * size * b[axis];
    }
    add_quad(fixture, corner, edge_t, edge_b);
}

static void test_an_open_floor_reads_nothing_at_any_tilt_and_place_in_the_voxels(void **state)
{
    for (size_t maps = 0; maps < 2; maps++) {
        ao_fixture *fixture = prepare(state, slicemaps[maps], "0.4");
        ao_fixture_param(fixture, "hao.rays", "64");
        ao_fixture_param(fixture, "hao.tests", "64");
        ao_fixture_param(fixture, "hao.voxels", "64");
        fixture->view_angle = 0.6;
        for (int k = 0; k < AO_FIXTURE_NORMALS; k++) {
            double n[3];
            ao_fixture_normal(k, n);
            for (int phase = 0; phase < 8; phase++) {
                const double at[3] = { 0.0031 * phase, 0.0017 * phase, 0.0041 * phase }; /* a voxel is some 0.03 */
                ao_fixture_clear(fixture);
                add_floor(fixture, at, n);
                nook_fixture_occlusion got = ao_fixture_measure(fixture, "hao", at, n, 0.5);
                if (got.highest != 0.0)
                    fail_msg("%s, normal %d (%.3f %.3f %.3f), phase %d: A up to %.4f", slicemaps[maps], k, n[0], n[1],
                             n[2], phase, got.highest);
            }
        }
    }
}

static void test_without_a_guard_a_floor_darkens_itself(void **state)
{
    ao_fixture *fixture = prepare(state, "three", "0.4");
    ao_fixture_param(fixture, "hao.guard", "none");
    add_floor(fixture, origin, up);
    assert_true(ao_fixture_measure(fixture, "hao", origin, up, 0.5).mean > 0.05);
}

/* ---- masks ---- */

/* A ceiling at 0.4 r_max, and what of it is not opaque. */
static void add_ceiling(ao_fixture *fixture, const nook_alphas *alphas)
{
    nook_fixture_mesh mesh = { .alphas = alphas };
    nook_fixture_add_quad(&mesh, (double[]){ -2, -2, 0.4 }, (double[]){ 4, 0, 0 }, (double[]){ 0, 4, 0 });
    add(fixture, &mesh);
}

/* A checker of fields of half a metre: as much of what a wall takes, whatever hao finds of that, as of 1 - 0.4^2 the reference's rays find. */
static void test_a_checker_takes_half_of_what_a_wall_takes(void **state)
{
    const uint8_t texels[] = { 0, 255, 255, 0 };
    const float uvs[6][2] = { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 0 }, { 4, 4 }, { 0, 4 } };
    const nook_alpha_part mask = test_mask(0, 6, texels, 2);
    const nook_alphas alphas = { &mask, 1, uvs[0] };
    for (size_t maps = 0; maps < 2; maps++) {
        ao_fixture *fixture = prepare(state, slicemaps[maps], "1");
        ao_fixture_param(fixture, "reference.rays", "1024");
        add_ceiling(fixture, NULL);
        double whole = measure(fixture);
        ao_fixture_clear(fixture);
        add_ceiling(fixture, &alphas);
        double truth = ao_fixture_measure(fixture, "reference", origin, up, 0.3).mean, masked = measure(fixture);
        print_message("%s: %.4f of %.4f, truth %.4f\n", slicemaps[maps], masked, whole, truth);
        assert_true(fabs(masked / whole - truth / 0.84) < 0.04);
        assert_true(whole > 0.65 && fabs(truth - 0.42) < 0.02);
    }
}

/* Parts by themselves: what a factor or a texture takes away, and what is there, also where it shares a texture and stands behind others. */
static void test_each_part_of_a_mesh_has_its_own_mask(void **state)
{
    const uint8_t texels[] = { 0, 0, 0, 0 };
    const float uvs[24][2] = { { 0 } };
    nook_alpha_part gone = test_mask(0, 6, texels, 2), also_gone = test_mask(6, 6, texels, 2),
                    there = test_mask(12, 6, texels, 2);
    there.cutoff = 0.0f; /* all is at least that */
    const nook_alpha_part parts[] = { gone, also_gone, there };
    const nook_alphas alphas = { parts, 3, uvs[0] };
    static const double corner[4][3] = { { -2, -2, 0.2 }, { -2, -2, 0.3 }, { -2, -2, 0.4 }, { 1.9, 1.9, 0 } };
    double got[2];
    for (int masked = 0; masked < 2; masked++) {
        ao_fixture *fixture = prepare(state, "three", "1");
        nook_fixture_mesh mesh = { .alphas = masked ? &alphas : NULL };
        for (int quad = masked ? 0 : 2; quad < 4; quad++) {
            const double side = quad < 3 ? 4.0 : 0.1;
            nook_fixture_add_quad(&mesh, corner[quad], (double[]){ side, 0, 0 }, (double[]){ 0, side, 0 });
        }
        add(fixture, &mesh);
        got[masked] = measure(fixture);
    }
    assert_true(got[0] > 0.75);
    assert_true(fabs(got[1] - got[0]) < 1e-6);
}

/* ---- closed forms ---- */

static void add_box(ao_fixture *fixture)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_box(&mesh, (double[]){ -0.5, -0.5, 0 }, (double[]){ 0.5, 0.5, 1 }, 63);
    add(fixture, &mesh);
}

static void test_a_closed_box_is_closed_at_any_spread(void **state)
{
    static const char *const spreads[] = { "1", "0.5", "0.1" };
    for (size_t i = 0; i < 3; i++) {
        ao_fixture *fixture = prepare(state, "three", "4");
        ao_fixture_param(fixture, "hao.spread", spreads[i]);
        add_box(fixture);
        assert_true(measure(fixture) == 1.0);
    }
}

static void test_a_corner_reads_a_half(void **state)
{
    for (size_t maps = 0; maps < 2; maps++) {
        ao_fixture *fixture = prepare(state, slicemaps[maps], "0.5");
        add_quad(fixture, (double[]){ -1, -1, 0 }, (double[]){ 2, 0, 0 }, (double[]){ 0, 2, 0 });
        add_quad(fixture, (double[]){ 0.04, -1, 0 }, (double[]){ 0, 2, 0 }, (double[]){ 0, 0, 1 });
        expect(fixture, nook_form_wall(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, 0.04 / 0.5), 0.02);
    }
}

static void test_a_ceiling_reads_what_its_falloff_says(void **state)
{
    static const char *const falloffs[] = { "hard", "linear", "quadratic", "wendland" };
    for (size_t i = 0; i < 4; i++) {
        ao_fixture *fixture = prepare(state, "three", "1");
        ao_fixture_param(fixture, "ao.falloff", falloffs[i]);
        add_quad(fixture, (double[]){ -1.5, -1.5, 0.4 }, (double[]){ 3, 0, 0 }, (double[]){ 0, 3, 0 });
        const double k = 0.4;
        expect(fixture, nook_form_ceiling(NOOK_FORM_COSINE, (nook_falloff)i, 0.0, k), 0.02);
    }
}

static void test_what_the_camera_does_not_see_occludes(void **state)
{
    ao_fixture *fixture = prepare(state, "three", "1"); /* the camera stands at 0.3, below this ceiling */
    add_quad(fixture, (double[]){ -1.5, -1.5, 0.5 }, (double[]){ 3, 0, 0 }, (double[]){ 0, 3, 0 });
    expect(fixture, nook_form_ceiling(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, 0.0, 0.5), 0.02);
}

static void test_the_same_wall_twice_darkens_once(void **state)
{
    ao_fixture *fixture = prepare(state, "three", "1");
    add_quad(fixture, (double[]){ 0.2, -2, 0 }, (double[]){ 0, 4, 0 }, (double[]){ 0, 0, 2 });
    double once = measure(fixture);
    add_quad(fixture, (double[]){ 0.2, -2, 0 }, (double[]){ 0, 4, 0 }, (double[]){ 0, 0, 2 });
    assert_true(measure(fixture) == once && once > 0.1);
}

/* A test lies anywhere in its share of the ray, so that a layer of one voxel is met in the proportion of the two. Under a ceiling both
   grow alike with the slant. */
static void test_a_sheet_thinner_than_the_tests_are_apart_is_missed_in_that_proportion(void **state)
{
    ao_fixture *fixture = prepare(state, "three", "1");
    const double height = 0.5, voxel = exp2(ceil(8.0 * log2(2.001 / 126)) / 8.0); /* r_max to both sides of the point */
    ao_fixture_param(fixture, "hao.tests", "4");
    ao_fixture_param(fixture, "hao.rays", "1024");
    for (int i = 0; i < 2; i++)
        add_quad(fixture, (double[]){ -1.5, -1.5, i * height }, (double[]){ 3, 0, 0 }, (double[]){ 0, 3, 0 });
    /* The grid ends at the top of the ceiling's voxel; rays are followed for two voxels more. */
    double top = (floor(height / voxel + 0.001) + 3.0) * voxel, met = 4.0 * voxel / top;
    expect(fixture, met * nook_form_ceiling(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, 0.0, height), 0.02);
}

static void test_more_tests_than_a_dispatch_can_turn_are_cut_without_a_seam(void **state)
{
    ao_fixture *fixture = prepare(state, "three", "1");
    add_quad(fixture, (double[]){ -1.5, -1.5, 0.4 }, (double[]){ 3, 0, 0 }, (double[]){ 0, 3, 0 });
    ao_fixture_param(fixture, "hao.rays", "1024"); /* 1024 rays of 257 turns are five dispatches */
    expect(fixture, nook_form_ceiling(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, 0.0, 0.4), 0.01);
}

static void test_noise_by_tiles_and_by_space_mean_the_same(void **state)
{
    ao_fixture *fixture = prepare(state, "three", "1");
    add_quad(fixture, (double[]){ 0.2, -2, 0 }, (double[]){ 0, 4, 0 }, (double[]){ 0, 0, 2 });
    double space = measure(fixture);
    ao_fixture_param(fixture, "hao.noise", "tile");
    expect(fixture, space, 0.01);
}

static void test_a_finer_grid_brings_a_thin_contact_nearer_to_the_truth(void **state)
{
    double last = 1.0;
    const double truth = nook_form_wall(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, 0.1);
    for (int resolution = 32; resolution <= 512; resolution *= 4) {
        char text[16];
        ao_fixture *fixture = prepare(state, "three", "1");
        snprintf(text, sizeof text, "%d", resolution);
        ao_fixture_param(fixture, "hao.voxels", text);
        add_quad(fixture, (double[]){ -3, -3, 0 }, (double[]){ 6, 0, 0 }, (double[]){ 0, 6, 0 });
        add_quad(fixture, (double[]){ 0.1, -3, 0 }, (double[]){ 0, 6, 0 }, (double[]){ 0, 0, 3 });
        double error = fabs(measure(fixture) - truth);
        assert_true(error < last);
        last = error;
    }
    assert_true(last < 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_checker_takes_half_of_what_a_wall_takes),
        cmocka_unit_test(test_each_part_of_a_mesh_has_its_own_mask),
        cmocka_unit_test(test_an_open_floor_reads_nothing_at_any_tilt_and_place_in_the_voxels),
        cmocka_unit_test(test_without_a_guard_a_floor_darkens_itself),
        cmocka_unit_test(test_a_closed_box_is_closed_at_any_spread),
        cmocka_unit_test(test_a_corner_reads_a_half),
        cmocka_unit_test(test_a_ceiling_reads_what_its_falloff_says),
        cmocka_unit_test(test_what_the_camera_does_not_see_occludes),
        cmocka_unit_test(test_the_same_wall_twice_darkens_once),
        cmocka_unit_test(test_a_sheet_thinner_than_the_tests_are_apart_is_missed_in_that_proportion),
        cmocka_unit_test(test_more_tests_than_a_dispatch_can_turn_are_cut_without_a_seam),
        cmocka_unit_test(test_noise_by_tiles_and_by_space_mean_the_same),
        cmocka_unit_test(test_a_finer_grid_brings_a_thin_contact_nearer_to_the_truth),
    };
    return cmocka_run_group_tests(tests, ao_fixture_setup, ao_fixture_teardown);
}
