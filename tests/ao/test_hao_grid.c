/* Where the technique hao puts its voxels: around all that can occlude what the view shows, and still while the view moves. */
#include "engine/core/vector.h"
#include "modules/ao_hao/grid_internal.h"
#include <math.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

enum { RESOLUTION = 128 };

static uint32_t seed;

static double between(double low, double high)
{
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(seed >> 8) / 16777216.0;
}

static void point_between(double low, double high, double out[3])
{
    for (int axis = 0; axis < 3; axis++)
        out[axis] = between(low, high);
}

/** A camera in the box from -5 to 5, looking anywhere, in a picture that may be off-centre and flipped. */
static hao_view random_view(void)
{
    double eye[3], target[3];
    const double up[3] = { 0, 1, 0 };
    point_between(-5, 5, eye);
    point_between(-5, 5, target);
    nook_matrix view_from_world = nook_matrix_look_at(eye, target, up), world_from_view;
    assert_true(nook_matrix_inverse_affine(&view_from_world, &world_from_view));
    nook_matrix axes = between(0, 1) < 0.5 ? hao_diagonal_axes() : nook_matrix_identity();
    return (hao_view){ .grid_from_view = nook_matrix_multiply(&axes, &world_from_view),
                       .ray_scale = { between(0.1, 1.5), between(-1.0, -0.1) },
                       .ray_offset = { between(-0.5, 0.5), between(-0.5, 0.5) },
                       .r_max = between(0.1, 2.0),
                       .far = 100.0 };
}

static hao_box random_box(void)
{
    hao_box box = hao_nothing;
    double point[3];
    for (int i = 0; i < 2; i++) {
        point_between(-4, 4, point);
        hao_box_add_point(&box, point);
    }
    return box;
}

/** A point that the view shows, in the grid's axes. */
static void seen_point(const hao_view *view, double out[3])
{
    double depth = between(0.0, 12.0);
    const double p[3] = { (between(-1, 1) * view->ray_scale[0] + view->ray_offset[0]) * depth,
                          (between(-1, 1) * view->ray_scale[1] + view->ray_offset[1]) * depth, -depth };
    nook_matrix_apply_point(&view->grid_from_view, p, out);
}

static bool holds(const hao_box *box, const double p[3], double by)
{
    bool inside = true;
    for (int axis = 0; axis < 3; axis++)
        inside = inside && p[axis] >= box->min[axis] - by && p[axis] <= box->max[axis] + by;
    return inside;
}

static void test_whatever_is_within_r_max_of_a_point_in_the_picture_has_its_voxel(void **state)
{
    (void)state;
    int met = 0;
    seed = 1;
    for (int k = 0; k < 400; k++) {
        hao_view view = random_view();
        hao_box scene = random_box();
        hao_grid grid;
        hao_grid_place(&view, &scene, RESOLUTION, &grid);
        for (int i = 0; i < 400; i++) {
            double receiver[3], occluder[3], apart[3];
            seen_point(&view, receiver);
            point_between(-1, 1, apart);
            nook_vector_add_scaled(receiver, view.r_max / sqrt(3.0), apart, occluder); /* within r_max at the corners */
            if (!holds(&scene, occluder, 0.0))
                continue;
            met++;
            assert_true(grid.size[0] > 0);
            assert_true(holds(&grid.box, occluder, 1e-9));
        }
    }
    assert_true(met > 2000); /* or nothing was looked at */
}

static void test_voxels_lie_at_whole_multiples_of_a_size_that_is_a_power_of_an_eighth_of_two(void **state)
{
    (void)state;
    seed = 2;
    for (int k = 0; k < 1000; k++) {
        hao_view view = random_view();
        hao_box scene = random_box();
        hao_grid grid;
        hao_grid_place(&view, &scene, RESOLUTION, &grid);
        double eighths = 8.0 * log2(grid.voxel_size);
        assert_true(fabs(eighths - round(eighths)) < 1e-9);
        for (int axis = 0; axis < 3 && grid.size[0] > 0; axis++) {
            double low = grid.first[axis] * grid.voxel_size, high = low + grid.size[axis] * grid.voxel_size;
            assert_true(grid.first[axis] == floor(grid.first[axis]));
            assert_in_range(grid.size[axis], 1, RESOLUTION);
            assert_true(low <= grid.box.min[axis] && high >= grid.box.max[axis] - 0.0011 * grid.voxel_size);
        }
    }
}

static void test_a_point_of_the_world_keeps_its_place_in_the_voxels_while_the_camera_moves(void **state)
{
    (void)state;
    const hao_box scene = { { -4, -4, -4 }, { 4, 4, 4 } };
    const double point[3] = { 1.2345, 0.678, -0.91 }, up[3] = { 0, 1, 0 };
    double place[3] = { 0 }, size = 0.0;
    int same = 0;
    for (int k = 0; k < 64; k++) {
        const double eye[3] = { 0.02 * k, 0.5, 3 }, target[3] = { 0.02 * k, 0.3, 0 };
        nook_matrix view_from_world = nook_matrix_look_at(eye, target, up), world_from_view;
        assert_true(nook_matrix_inverse_affine(&view_from_world, &world_from_view));
        hao_view view = { .grid_from_view = world_from_view, .ray_scale = { 0.8, 0.5 }, .r_max = 0.5, .far = 100.0 };
        hao_grid grid;
        hao_grid_place(&view, &scene, RESOLUTION, &grid);
        double in_view[3], in_voxels[3];
        nook_matrix_apply_point(&view_from_world, point, in_view);
        nook_matrix_apply_point(&grid.voxel_from_view, in_view, in_voxels);
        for (int axis = 0; axis < 3; axis++) {
            double within = in_voxels[axis] - floor(in_voxels[axis]);
            if (grid.voxel_size == size)
                assert_true(fabs(within - place[axis]) < 1e-6);
            place[axis] = within;
        }
        same += grid.voxel_size == size;
        size = grid.voxel_size;
    }
    assert_true(same > 50);
}

static void test_nothing_in_reach_is_no_grid(void **state)
{
    (void)state;
    const double eye[3] = { 0, 0, 0 }, target[3] = { 0, 0, -1 }, up[3] = { 0, 1, 0 };
    nook_matrix view_from_world = nook_matrix_look_at(eye, target, up), world_from_view;
    assert_true(nook_matrix_inverse_affine(&view_from_world, &world_from_view));
    hao_view view = { .grid_from_view = world_from_view, .ray_scale = { 0.5, 0.5 }, .r_max = 1.0, .far = 100.0 };
    const hao_box behind = { { -1, -1, 2.5 }, { 1, 1, 4 } }, beside_the_eye = { { -1, -1, 0.2 }, { 1, 1, 4 } };
    hao_grid grid;
    hao_grid_place(&view, &hao_nothing, RESOLUTION, &grid);
    assert_int_equal(grid.size[0], 0);
    hao_grid_place(&view, &behind, RESOLUTION, &grid);
    assert_int_equal(grid.size[0], 0);
    hao_grid_place(&view, &beside_the_eye, RESOLUTION, &grid);
    assert_true(grid.size[0] > 0);
}

static void test_a_scene_without_size_has_voxels(void **state)
{
    (void)state;
    const hao_box point = { { 0, 0, -2 }, { 0, 0, -2 } }, flat = { { -1, -1, -2 }, { 1, 1, -2 } };
    hao_view view = { .grid_from_view = nook_matrix_identity(), .ray_scale = { 0.5, 0.5 }, .r_max = 1.0, .far = 100.0 };
    hao_grid grid;
    hao_grid_place(&view, &point, RESOLUTION, &grid);
    assert_true(grid.size[0] == 1 && grid.size[1] == 1 && grid.size[2] == 1 && grid.voxel_size > 0.0);
    hao_grid_place(&view, &flat, RESOLUTION, &grid);
    assert_true(grid.size[0] > RESOLUTION / 2 && grid.size[2] == 1);
}

static void test_a_sky_far_away_takes_no_more_than_the_reach_of_the_grid(void **state)
{
    (void)state;
    const hao_box sky = { { -1e6, -1e6, -1e6 }, { 1e6, 1e6, 1e6 } };
    hao_view view = { .grid_from_view = nook_matrix_identity(), .ray_scale = { 0.5, 0.5 }, .r_max = 1.0, .far = 10.0 };
    hao_grid grid;
    hao_grid_place(&view, &sky, RESOLUTION, &grid);
    assert_true(grid.size[0] > 0);
    for (int axis = 0; axis < 3; axis++)
        assert_true(grid.box.min[axis] >= -11.0 && grid.box.max[axis] <= 11.0); /* r_max beyond what is looked at */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_whatever_is_within_r_max_of_a_point_in_the_picture_has_its_voxel),
        cmocka_unit_test(test_voxels_lie_at_whole_multiples_of_a_size_that_is_a_power_of_an_eighth_of_two),
        cmocka_unit_test(test_a_point_of_the_world_keeps_its_place_in_the_voxels_while_the_camera_moves),
        cmocka_unit_test(test_nothing_in_reach_is_no_grid),
        cmocka_unit_test(test_a_scene_without_size_has_voxels),
        cmocka_unit_test(test_a_sky_far_away_takes_no_more_than_the_reach_of_the_grid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
