/* volume.sampling = corners: the bits of eight voxels stand for what the hardware's filter reads, and follow the volumes. */
#include "modules/ao_volume/corners.h"
#include "modules/fixture/closed_form.h"
#include "tests/support/ao_fixture.h"
#include "tests/support/test_gpu.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 13, HEIGHT = 7, DEPTH = 5, VOXELS = WIDTH * HEIGHT * DEPTH };

static uint8_t voxel_at(const uint8_t *voxels, int x, int y, int z)
{
    x = x < WIDTH ? x : WIDTH - 1, y = y < HEIGHT ? y : HEIGHT - 1, z = z < DEPTH ? z : DEPTH - 1;
    return voxels[(z * HEIGHT + y) * WIDTH + x];
}

static void expect_corners(nook_gpu *gpu, const volume_corners *corners, const uint8_t *voxels)
{
    uint8_t bytes[VOXELS];
    nook_buffer_read(gpu, corners->buffer, 0, bytes, sizeof bytes);
    for (int i = 0; i < VOXELS; i++) {
        int x = i % WIDTH, y = i / WIDTH % HEIGHT, z = i / (WIDTH * HEIGHT);
        for (int corner = 0; corner < 8; corner++) {
            bool full = voxel_at(voxels, x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)) != 0;
            if (full != (bytes[i] >> corner & 1))
                fail_msg("voxel (%d, %d, %d), corner %d: %d", x, y, z, corner, !full);
        }
    }
}

static void test_corners_hold_the_eight_voxels_of_every_cell_and_follow_the_atlas(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    uint8_t voxels[VOXELS];
    volume_corners corners = { 0 };
    nook_ao_pass pass = { .gpu = gpu };
    assert_int_equal(nook_texture_create_3d(gpu, GL_R8, WIDTH, HEIGHT, DEPTH, GL_LINEAR, &pass.volume_atlas), NOOK_OK);
    for (uint32_t turn = 1; turn <= 2; turn++) {
        for (uint32_t i = 0; i < VOXELS; i++)
            voxels[i] = (i * 2654435761u * turn >> 13) % 3 == 0 ? 255 : 0;
        nook_texture_write(gpu, pass.volume_atlas, GL_RED, GL_UNSIGNED_BYTE, voxels, sizeof voxels);
        pass.volume_atlas_version = turn;
        pass.volume_atlas_change_count = NOOK_AO_CHANGED_ALL;
        assert_int_equal(volume_corners_fit(&corners, &pass), NOOK_OK);
        expect_corners(gpu, &corners, voxels);
    }
    volume_corners_release(&corners, gpu);
    nook_texture_destroy(gpu, &pass.volume_atlas);
}

static void test_corners_are_refused_where_a_buffer_cannot_have_as_many(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    volume_corners corners = { 0 };
    nook_ao_pass pass = { .gpu = gpu };
    const uint32_t most = gpu->max_texture_buffer_size;
    assert_int_equal(nook_texture_create_3d(gpu, GL_R8, 4, 4, 4, GL_LINEAR, &pass.volume_atlas), NOOK_OK);
    gpu->max_texture_buffer_size = 63;
    assert_int_equal(volume_corners_fit(&corners, &pass), NOOK_E_RANGE);
    assert_int_equal(corners.texture.id, 0);
    gpu->max_texture_buffer_size = 64;
    assert_int_equal(volume_corners_fit(&corners, &pass), NOOK_OK);
    gpu->max_texture_buffer_size = most;
    volume_corners_release(&corners, gpu);
    nook_texture_destroy(gpu, &pass.volume_atlas);
}

static ao_fixture *prepare(void **state)
{
    ao_fixture *fixture = *state;
    ao_fixture_clear(fixture);
    fixture->view_angle = 0.3;
    ao_fixture_param(fixture, "ao.falloff", "linear");
    ao_fixture_param(fixture, "ao.r_max", "1");
    ao_fixture_param(fixture, "volume.rays", "256");
    ao_fixture_param(fixture, "volume.steps", "512");
    ao_fixture_param(fixture, "volume.combine", "union");
    return fixture;
}

static double measure(ao_fixture *fixture, const char *sampling)
{
    const double origin[3] = { 0, 0, 0 }, up[3] = { 0, 0, 1 };
    ao_fixture_param(fixture, "volume.sampling", sampling);
    double mean = ao_fixture_measure(fixture, "volume", origin, up, 0.3).mean;
    ao_fixture_param(fixture, "volume.sampling", "filter");
    return mean;
}

/** A box beside the receiver, turned, so that its faces cut the voxels at every angle. */
static void add_turned_box(ao_fixture *fixture, double away)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_box(&mesh, (double[]){ -0.4, -0.5, -0.3 }, (double[]){ 0.4, 0.5, 0.6 }, 63);
    ao_fixture_add(fixture, &mesh, 31);
    nook_fixture_mesh_free(&mesh);
    nook_ao_occluder *occluder = &fixture->view->occluders[fixture->view->occluder_count - 1];
    const double turn[16] = { 0.48, 0.60, -0.64, 0, -0.80, 0.60, 0, 0, 0.384, 0.512, 0.768, 0, away, 0.1, 0.3, 1 };
    memcpy(occluder->world_from_mesh, turn, sizeof turn);
}

static void test_volume_reads_the_same_by_corners_as_by_the_filter(void **state)
{
    ao_fixture *fixture = prepare(state);
    for (int k = 0; k < 4; k++) {
        ao_fixture_clear(fixture);
        add_turned_box(fixture, 0.6 + 0.1 * k);
        double filter = measure(fixture, "filter"), corners = measure(fixture, "corners");
        assert_true(filter > 0.02);
        if (fabs(filter - corners) > 0.002) /* of 256 rays half a ray; the filter weighs in steps of 1/256 */
            fail_msg("A = %.5f by the filter, %.5f by corners", filter, corners);
    }
}

static void test_volume_sees_by_corners_what_was_added_since(void **state)
{
    ao_fixture *fixture = prepare(state);
    add_turned_box(fixture, 0.8);
    double one = measure(fixture, "corners");
    add_turned_box(fixture, -0.8);
    double both = measure(fixture, "corners"), filter = measure(fixture, "filter");
    assert_true(both > one + 0.02);
    assert_true(fabs(both - filter) < 0.002);
}

int main(void)
{
    const struct CMUnitTest gpu_tests[] = {
        cmocka_unit_test(test_corners_hold_the_eight_voxels_of_every_cell_and_follow_the_atlas),
        cmocka_unit_test(test_corners_are_refused_where_a_buffer_cannot_have_as_many),
    };
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_volume_reads_the_same_by_corners_as_by_the_filter),
        cmocka_unit_test(test_volume_sees_by_corners_what_was_added_since),
    };
    int failed = cmocka_run_group_tests_name("corners", gpu_tests, test_gpu_setup, test_gpu_teardown);
    return failed + cmocka_run_group_tests_name("volumes by corners", tests, ao_fixture_setup, ao_fixture_teardown);
}
