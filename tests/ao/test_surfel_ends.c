/* Where planes end inside of their voxel: rays see every word as modules/bake/surfel_extent.h says it. */
#include "engine/core/angle.h"
#include "modules/bake/surfel_extent.h"
#include "tests/support/ao_fixture.h"
#include "tests/support/surfel_shapes.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const double origin[3] = { 0, 0, 0 }, up[3] = { 0, 0, 1 };
static const double height = 0.5, lift = 0.02, slack = 0.04; /* voxels of 1 m; SIDE_SLACK of the shader */
static const double noise = 0.02;                            /* of 256 rays */

/* A voxel whose middle is 0.5 over the origin. */
static nook_volume bake_voxel(void)
{
    test_sheet sheet = test_make_sheet(8, (float[]){ 3, 3, 4.5f }, (float[]){ 1, 0, 0 }, (float[]){ 0, 1, 0 });
    nook_triangles triangles = test_sheet_triangles(&sheet);
    nook_volume volume = test_make_surfels(&triangles, 8, 1);
    assert_int_equal(volume.info.occupied, 1);
    return volume;
}

static ao_fixture *prepare(void **state)
{
    ao_fixture *fixture = *state;
    ao_fixture_clear(fixture);
    nook_ao_reset_params(fixture->view->ao);
    ao_fixture_param(fixture, "ao.filter", "none");
    ao_fixture_param(fixture, "ao.falloff", "hard");
    ao_fixture_param(fixture, "ao.r_max", "4");
    ao_fixture_param(fixture, "volume.kind", "surfel");
    ao_fixture_param(fixture, "volume.rays", "256");
    ao_fixture_param(fixture, "volume.lift", "0.02");
    ao_fixture_param(fixture, "volume.tolerance", "0"); /* what is at the voxel's faces ends there */
    nook_fixture_mesh mesh = { 0 };                     /* far away: its volume is exchanged */
    nook_fixture_add_quad(&mesh, (double[]){ -2, -2, 9 }, (double[]){ 4, 0, 0 }, (double[]){ 0, 4, 0 });
    ao_fixture_add(fixture, &mesh, 8);
    nook_fixture_mesh_free(&mesh);
    const nook_matrix matrix = nook_matrix_translation(-3.5, -3.5, height - 4.5);
    memcpy(fixture->view->occluders[0].world_from_mesh, matrix.m, sizeof matrix.m);
    return fixture;
}

/* What the origin sees of the volume, 0 to 1, weighted by the cosine. */
static double measure(ao_fixture *fixture, const nook_volume *volume)
{
    void *bytes;
    size_t size;
    nook_ao_volume *id = &fixture->view->occluders[0].volume;
    assert_int_equal(nook_volume_encode(volume, &bytes, &size), NOOK_OK);
    nook_ao_remove_volume(fixture->view->ao, *id);
    assert_int_equal(nook_ao_add_volume(fixture->view->ao, "voxel.nkv", bytes, size, id), NOOK_OK);
    free(bytes);
    return ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
}

/* Form factor of the part of a square across z, at the voxel's middle, that lies in an extent and the slack about its ends. */
static double expected_of(const nook_surfel_extent *extent)
{
    enum { CELLS = 200 };
    const double h = height - lift;
    double low[3], high[3], sum = 0.0;
    for (int axis = 0; axis < 3; axis++) { /* ends at faces are those of the voxel */
        low[axis] = fmax(extent->low[axis] - slack, axis < 2 ? -0.5 : -1.0);
        high[axis] = fmin(extent->high[axis] + slack, axis < 2 ? 0.5 : 1.0);
    }
    if (low[2] > 0.0 || high[2] < 0.0)
        return 0.0;
    for (int i = 0; i < CELLS * CELLS; i++) {
        double x = low[0] + (high[0] - low[0]) * (i % CELLS + 0.5) / CELLS;
        double y = low[1] + (high[1] - low[1]) * (i / CELLS + 0.5) / CELLS;
        double squared = h * h + x * x + y * y;
        sum += h * h / (NOOK_PI * squared * squared);
    }
    return sum * (high[0] - low[0]) * (high[1] - low[1]) / (CELLS * CELLS);
}

static uint32_t word_across_z(nook_surfel_side side, uint32_t six, double offset)
{
    const nook_surfel_plane plane = { .normal = { 0, 0, 1 }, .side = side, .alpha = six, .interval = six };
    return nook_surfel_pack(&plane, (double[]){ 0, 0, offset });
}

static void test_a_ray_meets_a_plane_within_every_interval(void **state)
{
    ao_fixture *fixture = prepare(state);
    nook_volume volume = bake_voxel();
    for (uint32_t code = 0; code < NOOK_EXTENT_CODES; code++) {
        const nook_surfel_extent extent = nook_surfel_interval_unpack(code);
        if (fabs(extent.low[2]) < slack || fabs(extent.high[2]) < slack) /* ends at the plane itself */
            continue;
        volume.surfels[0].plane[0] = word_across_z(NOOK_SIDE_WITHIN, code, 0.0);
        volume.surfels[0].plane[1] = word_across_z(NOOK_SIDE_BOTH, 1, 0.49); /* 1/63 of what lies behind */
        double got = measure(fixture, &volume), expected = expected_of(&extent);
        if (fabs(got - expected) >= noise)
            fail_msg("code %u: %.4f, expected %.4f", code, got, expected);
    }
    nook_volume_free(&volume);
}

static void test_a_ray_meets_a_plane_by_itself_within_any_box(void **state)
{
    ao_fixture *fixture = prepare(state);
    nook_volume volume = bake_voxel();
    uint32_t random = 3, within = 0, outside = 0;
    for (int round = 0; round < 100; round++) {
        nook_surfel_extent wanted, box;
        for (int axis = 0; axis < 3; axis++) {
            double ends[2];
            for (int k = 0; k < 2; k++) {
                random = random * 1664525u + 1013904223u;
                ends[k] = (random >> 8) / (double)(1 << 24) - 0.5;
            }
            wanted.low[axis] = fmin(ends[0], ends[1]);
            wanted.high[axis] = fmax(ends[0], ends[1]);
        }
        volume.surfels[0].plane[0] = word_across_z(NOOK_SIDE_BOTH, NOOK_SURFEL_ALPHA_MAX, 0.0);
        volume.surfels[0].plane[1] = nook_surfel_box_pack(&wanted, &box);
        double got = measure(fixture, &volume), expected = expected_of(&box);
        if (fabs(got - expected) >= noise)
            fail_msg("box %06x: %.4f, expected %.4f", volume.surfels[0].plane[1], got, expected);
        within += expected > 0.0;
        outside += expected == 0.0;
    }
    assert_true(within > 20 && outside > 20);
    nook_volume_free(&volume);
}

/* Whatever words a file may hold, what comes is a visibility: measuring fails on what is not in 0 to 1. */
static void test_any_words_of_a_file_give_a_visibility(void **state)
{
    ao_fixture *fixture = prepare(state);
    test_sheet sheet = test_make_sheet(8, (float[]){ 0, 0, 2 }, (float[]){ 8, 0, 3 }, (float[]){ 0, 8, 3 });
    nook_triangles triangles = test_sheet_triangles(&sheet);
    nook_volume volume = test_make_surfels(&triangles, 8, 1);
    uint32_t random = 9;
    double least = 1.0, most = 0.0;
    for (int round = 0; round < 40; round++) {
        for (size_t i = 0; i < volume.info.occupied;) {
            uint32_t words[2];
            for (int k = 0; k < 2; k++) {
                random = random * 1664525u + 1013904223u;
                uint32_t high = random & 0xffff0000u;
                random = random * 1664525u + 1013904223u;
                words[k] = high | random >> 16;
            }
            if (i % 2) {
                words[0] &= 0x3fffffffu;
                words[1] &= 0x777777u;
            }
            if (nook_surfel_is_sound(words[0], words[1]))
                memcpy(volume.surfels[i++].plane, words, sizeof words);
        }
        double got = measure(fixture, &volume);
        least = fmin(least, got);
        most = fmax(most, got);
    }
    assert_true(least >= 0.0 && most <= 1.0 && most > least + 0.05);
    nook_volume_free(&volume);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_a_ray_meets_a_plane_within_every_interval, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_a_ray_meets_a_plane_by_itself_within_any_box, ao_fixture_setup,
                                        ao_fixture_teardown),
        cmocka_unit_test_setup_teardown(test_any_words_of_a_file_give_a_visibility, ao_fixture_setup,
                                        ao_fixture_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
