/* Panes and masks on the GPU, and what the reference's rays see of them: both hold back half through a checker. */
#include "tests/support/ao_fixture.h"
#include "tests/support/test_mask.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const double origin[3] = { 0, 0, 0 }, up[3] = { 0, 0, 1 };
/* A wide ceiling at 0.4 r_max takes 1 - 0.4^2; surfels begin their rays nearer by the lift, and r_max is 16 voxels of theirs. */
static const double opaque = 0.84, error = 0.02;

static ao_fixture *prepare(void **state, const char *kind)
{
    static const char *const values[][2] = { { "ao.falloff", "hard" },    { "ao.r_max", "1" },
                                             { "volume.rays", "256" },    { "volume.combine", "union" },
                                             { "volume.lift", "0.15" },   { "volume.own_distance", "0.35" },
                                             { "reference.rays", "1024" } };
    ao_fixture *fixture = *state;
    ao_fixture_clear(fixture);
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        ao_fixture_param(fixture, values[i][0], values[i][1]);
    ao_fixture_param(fixture, "volume.kind", kind);
    return fixture;
}

static void add_ceiling(ao_fixture *fixture, const nook_alphas *alphas, double transparency)
{
    nook_fixture_mesh mesh = { .transparency = transparency, .alphas = alphas };
    nook_fixture_add_quad(&mesh, (double[]){ -2, -2, 0.4 }, (double[]){ 4, 0, 0 }, (double[]){ 0, 4, 0 });
    ao_fixture_add(fixture, &mesh, 64);
    nook_fixture_mesh_free(&mesh);
}

/* 2 x 2 fields, repeated: the quad's two triangles have uvs of their own, 0 to `repeat`. */
typedef struct checker {
    uint8_t texels[4];
    float uvs[6][2];
    nook_alpha_part part;
    nook_alphas alphas;
} checker;

static void make_checker(checker *c, float repeat)
{
    static const int corner[6][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 0, 1 } };
    *c = (checker){ .texels = { 0, 255, 255, 0 } };
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 2; k++)
            c->uvs[i][k] = (float)corner[i][k] * repeat;
    c->part = test_mask(0, 6, c->texels, 2);
    c->alphas = (nook_alphas){ &c->part, 1, c->uvs[0] };
}

static double mean_of(ao_fixture *fixture, const char *technique)
{
    return ao_fixture_measure(fixture, technique, origin, up, 0.3).mean;
}

/* Fields of half a voxel, and of four voxels; the second ones are seen as fields, so that a point may lie off the middle of one. */
static void test_a_checker_takes_half_of_what_a_wall_takes(void **state)
{
    ao_fixture *fixture = prepare(state, "surfel");
    static const float repeats[] = { 64, 8 };
    for (size_t i = 0; i < 2; i++) {
        checker c;
        make_checker(&c, repeats[i]);
        ao_fixture_clear(fixture);
        add_ceiling(fixture, &c.alphas, 0.0);
        double truth = mean_of(fixture, "reference");
        assert_true(fabs(truth - opaque / 2) < error);
        assert_true(fabs(mean_of(fixture, "volume") - truth) < error);
    }
}

static void test_glass_takes_its_alpha_of_what_a_wall_takes(void **state)
{
    ao_fixture *fixture = prepare(state, "surfel");
    add_ceiling(fixture, NULL, 0.0);
    assert_true(fabs(mean_of(fixture, "reference") - opaque) < error);
    assert_true(fabs(mean_of(fixture, "volume") - opaque) < error);
    ao_fixture_clear(fixture);
    add_ceiling(fixture, NULL, 0.6);
    assert_true(fabs(mean_of(fixture, "reference") - 0.4 * opaque) < error);
    assert_true(fabs(mean_of(fixture, "volume") - 0.4 * opaque) < error);
    ao_fixture_clear(fixture);
    add_ceiling(fixture, NULL, 1.0);
    assert_true(mean_of(fixture, "reference") == 0.0);
    assert_true(mean_of(fixture, "volume") == 0.0);
}

/* The same ray meets the same panes every time, in packets of any size and whatever thread traces it. */
static void test_the_reference_sees_glass_alike_every_time(void **state)
{
    ao_fixture *fixture = prepare(state, "surfel");
    add_ceiling(fixture, NULL, 0.5);
    double first = mean_of(fixture, "reference");
    for (int i = 0; i < 3; i++)
        assert_true(mean_of(fixture, "reference") == first);
}

/* Of four voxels and more, points at which rasterising looks are as good as areas. */
static void test_voxels_and_densities_take_half_through_coarse_fields(void **state)
{
    static const char *const kinds[] = { "binary", "density" };
    for (int i = 0; i < 2; i++) {
        ao_fixture *fixture = prepare(state, kinds[i]);
        checker c;
        make_checker(&c, 4);
        add_ceiling(fixture, &c.alphas, 0.0);
        assert_true(fabs(mean_of(fixture, "volume") - mean_of(fixture, "reference")) < 0.06);
    }
}

/* A grating of bars as wide as its holes. Distances are hit within some half a voxel of a bar's ends, in holes of 16 voxels: docs/volume_kinds.md. */
static void test_distances_take_half_through_a_grating_coarser_than_a_voxel(void **state)
{
    ao_fixture *fixture = prepare(state, "distance");
    checker c;
    make_checker(&c, 2);
    c.texels[2] = 0, c.texels[3] = 255; /* the same in both rows */
    add_ceiling(fixture, &c.alphas, 0.0);
    double truth = mean_of(fixture, "reference"), mean = mean_of(fixture, "volume");
    print_message("distance %.4f, truth %.4f\n", mean, truth);
    assert_true(fabs(mean - truth) < 0.06);
}

/* What is nearer to a wall is one, what is nearer to nothing is nothing: holes of half a voxel. */
static void test_distances_round_a_fine_grating_and_glass_to_a_wall_or_to_nothing(void **state)
{
    ao_fixture *fixture = prepare(state, "distance");
    add_ceiling(fixture, NULL, 0.0);
    const double wall = mean_of(fixture, "volume");
    assert_true(fabs(wall - opaque) < error);
    static const struct {
        double transparency;
        uint8_t texels[4];
        bool there;
    } cases[] = { { 0.0, { 0, 255, 255, 255 }, true },
                  { 0.0, { 0, 255, 0, 0 }, false },
                  { 0.4, { 0 }, true },
                  { 0.6, { 0 }, false } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        checker c;
        make_checker(&c, 64);
        memcpy(c.texels, cases[i].texels, sizeof c.texels);
        ao_fixture_clear(fixture);
        add_ceiling(fixture, cases[i].transparency > 0.0 ? NULL : &c.alphas, cases[i].transparency);
        assert_true(mean_of(fixture, "volume") == (cases[i].there ? wall : 0.0));
    }
}

static void test_parts_out_of_order_are_refused(void **state)
{
    ao_fixture *fixture = prepare(state, "surfel");
    const float positions[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    const uint32_t indices[9] = { 0, 1, 2, 0, 1, 2, 0, 1, 2 };
    const nook_alpha_part glass = { .first_index = 3, .index_count = 3, .alpha = 0.5f };
    const nook_alpha_part mask = { .first_index = 6, .index_count = 3, .alpha = 0.5f, .masked = true };
    const nook_alpha_part parts[] = { glass, mask }, beyond = { .first_index = 9, .index_count = 3 };
    nook_ao_mesh mesh = { 77 };
    nook_ao *ao = fixture->view->ao;
    const nook_alphas wrong[] = { { &glass, 1, NULL }, { parts, 2, NULL }, { &beyond, 1, NULL } };
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(nook_ao_add_mesh_with_alphas(ao, positions, 3, indices, 9, &wrong[i], &mesh), NOOK_E_ARG);
        assert_int_equal(mesh.id, 77);
    }
    assert_int_equal(nook_ao_add_mesh_with_alphas(ao, positions, 3, indices, 6, &wrong[0], &mesh), NOOK_OK);
    nook_ao_remove_mesh(ao, mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_checker_takes_half_of_what_a_wall_takes),
        cmocka_unit_test(test_glass_takes_its_alpha_of_what_a_wall_takes),
        cmocka_unit_test(test_the_reference_sees_glass_alike_every_time),
        cmocka_unit_test(test_voxels_and_densities_take_half_through_coarse_fields),
        cmocka_unit_test(test_distances_take_half_through_a_grating_coarser_than_a_voxel),
        cmocka_unit_test(test_distances_round_a_fine_grating_and_glass_to_a_wall_or_to_nothing),
        cmocka_unit_test(test_parts_out_of_order_are_refused),
    };
    return cmocka_run_group_tests(tests, ao_fixture_setup, ao_fixture_teardown);
}
