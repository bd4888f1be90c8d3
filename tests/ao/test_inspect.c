/* What the AO core tells of itself: volumes in the atlas, occluders of each pixel, frames for work on the CPU. */
#include "modules/ao/inspect.h"
#include "tests/support/ao_screen.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 40, PIXELS = SIDE * SIDE };

/** A floor seen from above, and boxes on it, each its own volume. */
static int setup(void **state)
{
    nook_fixture_view *view = ao_view_create(SIDE, SIDE);
    ao_screen_look(view, (double[]){ 0, 0, 6 }, (double[]){ 0, 0, 0 }, 0.8, 0.5);
    nook_fixture_mesh floor = { 0 };
    ao_screen_add_floor(&floor);
    ao_view_draw(view, &floor);
    nook_fixture_mesh_free(&floor);
    for (int i = 0; i < 3; i++) {
        nook_fixture_mesh box = { 0 };
        const double low[3] = { -1.0 + 0.6 * i, -0.2, 0.0 }, high[3] = { -0.7 + 0.6 * i, 0.2, 0.3 };
        nook_fixture_add_box(&box, low, high, 63);
        ao_view_draw(view, &box);
        ao_view_add(view, &box, 12);
        nook_fixture_mesh_free(&box);
    }
    *state = view;
    return 0;
}

/** After a record, so that the host's textures hold the picture. */
static nook_ao_frame frame_of(nook_fixture_view *view)
{
    nook_ao_frame frame = { .depth = { view->depth.id, view->width, view->height },
                            .normal = { view->normal.id, view->width, view->height },
                            .index = 3 };
    memcpy(frame.view_from_world, view->view_from_world.m, sizeof frame.view_from_world);
    memcpy(frame.clip_from_view, view->clip_from_view.m, sizeof frame.clip_from_view);
    return frame;
}

static void test_occluders_of_a_pixel_are_the_boxes_it_lies_in_with_their_reach(void **state)
{
    nook_fixture_view *view = *state;
    nook_texture image;
    uint32_t counts[PIXELS];
    assert_int_equal(nook_texture_create_2d(view->gpu, GL_R32UI, SIDE, SIDE, GL_NEAREST, &image), NOOK_OK);
    ao_view_record(view, "volume");
    nook_ao_frame frame = frame_of(view);
    assert_int_equal(nook_ao_count_occluders(view->ao, &frame, (nook_ao_texture){ image.id, SIDE, SIDE }), NOOK_OK);
    nook_texture_read(view->gpu, image, GL_RED_INTEGER, GL_UNSIGNED_INT, counts, sizeof counts);
    uint32_t seen[4] = { 0 };
    for (uint32_t i = 0; i < PIXELS; i++) {
        double ndc[2] = { 2.0 * (i % SIDE + 0.5) / SIDE - 1.0, 2.0 * (i / SIDE + 0.5) / SIDE - 1.0 };
        double depth = view->clip_from_view.m[14] / (view->device_depth[i] + view->clip_from_view.m[10]);
        double p[3] = { ndc[0] / view->clip_from_view.m[0] * depth, ndc[1] / view->clip_from_view.m[5] * depth,
                        6 - depth };
        int at_least = 0, at_most = 0; /* boxes lie in their volumes, which may be up to a voxel and a half larger */
        for (int k = 0; k < 3; k++) {
            const double low[3] = { -1.0 + 0.6 * k, -0.2, 0.0 }, high[3] = { -0.7 + 0.6 * k, 0.2, 0.3 };
            bool inside = true, near = true;
            for (int axis = 0; axis < 3; axis++) {
                inside = inside && p[axis] > low[axis] - 0.5 && p[axis] < high[axis] + 0.5;
                near = near && p[axis] > low[axis] - 0.56 && p[axis] < high[axis] + 0.56;
            }
            at_least += inside, at_most += near;
        }
        assert_in_range(counts[i], at_least, at_most);
        assert_in_range(counts[i], 0, 3);
        seen[counts[i]]++;
    }
    assert_true(seen[0] > 100 && seen[1] > 30 && seen[2] > 30 && seen[3] > 5);
    nook_texture_destroy(view->gpu, &image);
}

static void test_texture_of_counts_of_another_size_is_refused(void **state)
{
    nook_fixture_view *view = *state;
    nook_log_capture log;
    nook_ao_frame frame = frame_of(view);
    nook_log_capture_begin(&log);
    nook_result result = nook_ao_count_occluders(view->ao, &frame, (nook_ao_texture){ 0 });
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_ARG);
}

static void test_volume_is_found_in_the_atlas_with_its_voxels(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao_volume_place place;
    ao_view_record(view, "volume");
    assert_int_equal(nook_ao_inspect_volume(view->ao, view->occluders[1].volume, &place), NOOK_OK);
    assert_true(place.size[1] >= 12 && place.size[1] <= 16); /* the longest side, and two empty voxels */
    assert_true(fabs(place.corner[0] - (-0.4 - place.voxel_size)) < 2.0 * place.voxel_size);
    size_t bytes = (size_t)place.atlas.width * place.atlas.height * place.atlas.depth, full = 0;
    uint8_t *voxels = malloc(bytes);
    assert_non_null(voxels);
    nook_texture_read(view->gpu, place.atlas, GL_RED, GL_UNSIGNED_BYTE, voxels, bytes);
    for (uint32_t z = 0; z < place.size[2]; z++) {
        for (uint32_t y = 0; y < place.size[1]; y++) {
            for (uint32_t x = 0; x < place.size[0]; x++) {
                const uint32_t at[3] = { place.origin[0] + x, place.origin[1] + y, place.origin[2] + z };
                bool rim = x == 0 || y == 0 || z == 0 || x + 1 == place.size[0] || y + 1 == place.size[1] ||
                           z + 1 == place.size[2];
                uint8_t value = voxels[((size_t)at[2] * place.atlas.height + at[1]) * place.atlas.width + at[0]];
                assert_true(!rim || value == 0);
                full += value == 255;
            }
        }
    }
    assert_true(full > 50);
    free(voxels);
}

static void test_volume_that_was_removed_is_refused(void **state)
{
    nook_fixture_view *view = *state;
    nook_log_capture log;
    nook_ao_volume_place place = { .voxel_size = 7.0 };
    nook_log_capture_begin(&log);
    nook_result result = nook_ao_inspect_volume(view->ao, (nook_ao_volume){ 999 }, &place);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_NOT_FOUND);
    assert_true(place.voxel_size == 7.0);
}

static void test_snapshot_holds_the_frame_and_its_instances(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao_snapshot s;
    ao_view_record(view, "probe");
    ao_probe *probe = ao_view_probe(view);
    view->occluders[0].mesh.id = 0; /* the reference does not see it: instances are not the occluders' list */
    assert_int_equal(nook_ao_submit_occluders(view->ao, view->occluders, view->occluder_count), NOOK_OK);
    nook_ao_frame frame = frame_of(view);
    assert_int_equal(nook_ao_snapshot_take(view->ao, &frame, &s), NOOK_OK);
    assert_int_equal(s.pass.width, SIDE);
    assert_memory_equal(s.depth, probe->depth, PIXELS * sizeof *s.depth);
    for (size_t i = 0; i < 2 * PIXELS; i++)
        assert_true(fabsf(s.normal[i] / 65535.0f - probe->normals[i / 2][i % 2]) < 1e-5f);
    assert_int_equal(s.pass.instance_count, 2);
    assert_int_equal(s.occluders[0], 1);
    assert_int_equal(s.occluders[1], 2);
    assert_true(s.pass.meshes[s.pass.instances[0].mesh].id == view->occluders[1].mesh.id);
    assert_true(s.pass.seed == 3 && s.pass.r_max == 0.5 && s.pass.gpu == NULL);
    nook_ao_snapshot_free(&s);
    assert_null(s.depth);
    frame.depth.width++;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_result result = nook_ao_snapshot_take(view->ao, &frame, &s);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_ARG);
    assert_null(s.depth);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_occluders_of_a_pixel_are_the_boxes_it_lies_in_with_their_reach, setup,
                                        ao_view_teardown),
        cmocka_unit_test_setup_teardown(test_texture_of_counts_of_another_size_is_refused, setup, ao_view_teardown),
        cmocka_unit_test_setup_teardown(test_volume_is_found_in_the_atlas_with_its_voxels, setup, ao_view_teardown),
        cmocka_unit_test_setup_teardown(test_volume_that_was_removed_is_refused, setup, ao_view_teardown),
        cmocka_unit_test_setup_teardown(test_snapshot_holds_the_frame_and_its_instances, setup, ao_view_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
