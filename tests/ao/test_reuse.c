/* ao.reuse: what stands still takes over its value from the last frame, what moves is as without. */
#include "modules/ao/technique.h"
#include "tests/support/ao_room.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = AO_ROOM_WIDTH, HEIGHT = AO_ROOM_HEIGHT, PIXELS = WIDTH * HEIGHT, MESHES = AO_ROOM_MESHES, PERIOD = 4 };

typedef ao_room room;

static const char *const kinds[] = { "binary", "density", "surfel", "distance" };
static const char *const combines[] = { "union", "multiply" };
static const char *const upscales[] = { "direct", "bilinear" };

static void set_reuse(const room *r, int frames)
{
    assert_int_equal(nook_ao_set_param(r->view->ao, "ao.reuse", frames), NOOK_OK);
}

static uint32_t traced(const room *r)
{
    nook_ao_statistics statistics;
    nook_ao_get_statistics(r->view->ao, &statistics);
    return statistics.traced;
}

/** A record that takes over, and what one without makes of the same; afterwards the first's values are the last ones. */
static void expect_as_without(room *r, const char *what)
{
    float with[PIXELS];
    ao_view_record(r->view, "volume");
    assert_true(r->view->width * r->view->height <= PIXELS);
    size_t size = (size_t)r->view->width * r->view->height * sizeof *with;
    memcpy(with, r->view->visibility, size);
    nook_ao *ao = r->view->ao;
    double reuse;
    assert_int_equal(nook_ao_get_param(ao, "ao.reuse", &reuse), NOOK_OK);
    set_reuse(r, 1);
    ao_view_record(r->view, "volume");
    set_reuse(r, (int)reuse);
    if (memcmp(with, r->view->visibility, size) != 0)
        fail_msg("%s: not as without reuse", what);
}

/** Records the whole in its turns, so that values of all ages are there. */
static void warm_up(room *r)
{
    for (int i = 0; i < PERIOD; i++)
        ao_view_record(r->view, "volume");
}

/* ---- What must not change ---------------------------------------------------------------------------------------- */

static void expect_standing(room *r, const char *kind, const char *combine, const char *scale)
{
    float once[PIXELS];
    set_reuse(r, 1);
    ao_view_param(r->view, "volume.kind", kind);
    ao_view_param(r->view, "volume.combine", combine);
    ao_view_param(r->view, "ao.scale", scale);
    ao_view_record(r->view, "volume");
    assert_true(traced(r) == UINT32_MAX);
    memcpy(once, r->view->visibility, sizeof once);
    uint32_t dark = 0, all = 0, later = 0;
    for (size_t i = 0; i < PIXELS; i++)
        dark += once[i] < 0.9f;
    if (dark < 10)
        fail_msg("%s, %s, scale %s: %u pixels are dark", kind, combine, scale, dark);
    set_reuse(r, 3);
    for (int i = 0; i < 5; i++) {
        ao_view_record(r->view, "volume");
        if (memcmp(once, r->view->visibility, sizeof once) != 0)
            fail_msg("%s, %s, scale %s: frame %d differs", kind, combine, scale, i);
        all = i == 0 ? traced(r) : all;
        later += i == 0 ? 0 : traced(r);
    }
    assert_true(all < UINT32_MAX && later >= all && later < 2 * all); /* 4 frames of 3 turns */
}

static void test_what_stands_still_is_the_same_bit_for_bit_whatever_is_marched(void **state)
{
    room *r = *state;
    for (size_t k = 0; k < NOOK_COUNT(kinds); k++) {
        for (size_t c = 0; c < NOOK_COUNT(combines); c++) {
            for (size_t s = 0; s < NOOK_FIXTURE_SCALES; s++) {
                ao_view_param(r->view, "ao.upscale", upscales[(k + c) % 2]);
                expect_standing(r, kinds[k], combines[c], nook_fixture_scales[s]);
            }
        }
    }
    ao_view_param(r->view, "ao.filter", "none"); /* the trace itself is what is read */
    expect_standing(r, "binary", "union", "full");
    ao_view_param(r->view, "ao.filter", "tile");
    ao_view_param(r->view, "ao.scale", "half");
    ao_view_param(r->view, "ao.upscale", "stepped");
}

static void test_work_that_is_cut_into_dispatches_is_taken_over_too(void **state)
{
    room *r = *state;
    ao_view_param(r->view, "volume.steps", "1024"); /* loops of 65535 turns: rays by rays */
    ao_view_param(r->view, "volume.rays", "64");
    expect_standing(r, "binary", "union", "half");
    expect_standing(r, "surfel", "multiply", "half");
    expect_standing(r, "binary", "union", "half");
    ao_view_param(r->view, "volume.steps", "96");
    ao_view_param(r->view, "volume.rays", "2");
}

static void test_techniques_that_see_the_screen_take_nothing_over(void **state)
{
    static const char *const others[] = { "gtao", "hbao", "hsao", "ssao", "hao" };
    float once[PIXELS];
    room *r = *state;
    for (size_t i = 0; i < NOOK_COUNT(others); i++) {
        set_reuse(r, 1);
        ao_view_record(r->view, others[i]);
        memcpy(once, r->view->visibility, sizeof once);
        set_reuse(r, PERIOD);
        for (int k = 0; k < 3; k++) {
            ao_view_record(r->view, others[i]);
            assert_true(traced(r) == UINT32_MAX);
            assert_memory_equal(once, r->view->visibility, sizeof once);
        }
    }
}

static void test_boxes_that_are_drawn_take_nothing_over(void **state)
{
    room *r = *state;
    set_reuse(r, PERIOD);
    ao_view_param(r->view, "volume.path", "raster");
    for (int i = 0; i < 2; i++) {
        ao_view_record(r->view, "volume");
        assert_true(traced(r) == UINT32_MAX);
    }
    expect_as_without(r, "drawn");
    ao_view_param(r->view, "volume.path", "compute");
}

/* ---- What moves -------------------------------------------------------------------------------------------------- */

static void test_after_a_body_has_moved_the_picture_is_that_of_a_frame_without_reuse(void **state)
{
    room *r = *state;
    set_reuse(r, PERIOD);
    for (size_t k = 0; k < NOOK_COUNT(kinds); k++) {
        ao_view_param(r->view, "volume.kind", kinds[k]);
        for (int step = 1; step <= 3; step++) {
            warm_up(r);
            r->view->occluders[0].world_from_mesh[12] = 0.02 * step;
            ao_room_draw(r);
            expect_as_without(r, kinds[k]);
        }
        r->view->occluders[0].world_from_mesh[12] = 0.0;
        ao_room_draw(r);
    }
    ao_view_param(r->view, "volume.kind", "binary");
}

static void test_the_statistics_count_what_is_kept_of_each_trace_pixel(void **state)
{
    const room *r = *state;
    enum { KEPT = 16 }; /* depth 4, normal 4, visibility 4, twice ages of 2 */
    nook_ao_statistics without, with;
    set_reuse(r, 1);
    ao_view_param(r->view, "ao.scale", "full");
    ao_view_record(r->view, "volume");
    nook_ao_get_statistics(r->view->ao, &without);
    set_reuse(r, PERIOD);
    ao_view_record(r->view, "volume");
    nook_ao_get_statistics(r->view->ao, &with);
    assert_int_equal(with.texture_bytes - without.texture_bytes, KEPT * PIXELS);
}

static void test_only_what_is_near_a_body_that_moves_is_traced_out_of_turn(void **state)
{
    room *r = *state;
    set_reuse(r, 8);
    for (int i = 0; i < 9; i++)
        ao_view_record(r->view, "volume");
    uint32_t still = traced(r);
    r->view->occluders[0].world_from_mesh[12] = 0.01;
    ao_view_record(r->view, "volume");
    uint32_t moved = traced(r);
    nook_ao_set_param(r->view->ao, "volume.rays", 3.0);
    ao_view_record(r->view, "volume");
    uint32_t all = traced(r);
    ao_view_param(r->view, "volume.rays", "2");
    r->view->occluders[0].world_from_mesh[12] = 0.0;
    assert_true(still < moved && moved < all);
}

static void test_bodies_that_come_go_or_change_places_leave_nothing_behind(void **state)
{
    room *r = *state;
    nook_fixture_view *view = r->view;
    set_reuse(r, PERIOD);
    warm_up(r);
    view->occluder_count = 2; /* the floor: it darkens the boxes' sides */
    expect_as_without(r, "one gone");
    warm_up(r);
    view->occluder_count = 3;
    expect_as_without(r, "one come");
    warm_up(r);
    nook_ao_occluder first = view->occluders[0];
    view->occluders[0] = view->occluders[1];
    view->occluders[1] = first;
    expect_as_without(r, "in another order");
    warm_up(r);
    view->occluders[1] = view->occluders[0];
    view->occluders[0] = first;
    expect_as_without(r, "in the first order");
}

/** One of two boxes, in the same grid: of what is told of the volume nothing changes. */
static void voxelize(const room *r, nook_ao_volume volume, const nook_buffer buffers[2], uint32_t box)
{
    const nook_ao_triangle_range range = { 36 * box, 36, 0, 0 };
    nook_ao_live_part part = { .ranges = &range, .range_count = 1 };
    memcpy(part.volume_from_part, nook_matrix_identity().m, sizeof part.volume_from_part);
    const nook_ao_live_mesh mesh = { .vertex_buffer = buffers[0].id,
                                     .vertex_stride = 3 * sizeof(float),
                                     .index_buffer = buffers[1].id,
                                     .parts = &part,
                                     .part_count = 1,
                                     .box_min = { -0.9f, -0.9f, 0.0f },
                                     .box_max = { 0.9f, 0.9f, 0.4f },
                                     .voxel_size = 0.1 };
    assert_int_equal(nook_ao_voxelize(r->view->ao, volume, &mesh), NOOK_OK);
}

static void test_a_volume_that_is_voxelised_anew_leaves_nothing_behind(void **state)
{
    room *r = *state;
    nook_gpu *gpu = r->view->gpu;
    nook_fixture_mesh boxes = { 0 };
    nook_buffer buffers[2];
    nook_ao_volume volume;
    nook_fixture_add_box(&boxes, (double[]){ -0.9, -0.9, 0.0 }, (double[]){ -0.6, -0.6, 0.4 }, 63);
    nook_fixture_add_box(&boxes, (double[]){ 0.3, 0.5, 0.0 }, (double[]){ 0.7, 0.9, 0.4 }, 63);
    assert_int_equal(boxes.index_count, 72);
    assert_int_equal(nook_buffer_create(gpu, boxes.positions, boxes.vertex_count * 3 * sizeof(float), &buffers[0]),
                     NOOK_OK);
    assert_int_equal(nook_buffer_create(gpu, boxes.indices, boxes.index_count * sizeof(uint32_t), &buffers[1]),
                     NOOK_OK);
    nook_fixture_mesh_free(&boxes);
    assert_int_equal(nook_ao_add_live_volume(r->view->ao, "live", (const uint32_t[]){ 24, 24, 10 }, &volume), NOOK_OK);
    r->view->occluders[MESHES] = r->view->occluders[0];
    r->view->occluders[MESHES].volume = volume;
    r->view->occluder_count = MESHES + 1;
    set_reuse(r, PERIOD);
    for (uint32_t turn = 0; turn < 3; turn++) {
        voxelize(r, volume, buffers, turn % 2);
        expect_as_without(r, "made anew");
        warm_up(r);
    }
    r->view->occluder_count = MESHES;
    nook_ao_remove_volume(r->view->ao, volume);
    for (int i = 0; i < 2; i++)
        nook_buffer_destroy(gpu, &buffers[i]);
}

static void test_surfaces_that_move_without_a_volume_take_over_nothing_of_what_was_there_before(void **state)
{
    room *r = *state;
    double *x = &r->view->occluders[0].world_from_mesh[12];
    set_reuse(r, PERIOD);
    warm_up(r);
    for (int step = 1; step <= 3; step++) { /* what is drawn moves away; what is marched stays */
        *x = -0.4 * step;
        ao_room_draw(r);
        *x = 0.0;
        expect_as_without(r, "a surface that has moved");
        warm_up(r);
    }
    ao_room_draw(r);
}

/* ---- What is taken over ------------------------------------------------------------------------------------------ */

static void test_every_pixel_is_traced_anew_within_as_many_frames_as_said(void **state)
{
    room *r = *state;
    set_reuse(r, PERIOD);
    for (int i = 0; i < 9; i++) { /* values that wander over the picture, of all ages */
        ao_room_look(r, 0.03 * i, 0.0);
        ao_room_draw(r);
        ao_view_record(r->view, "volume");
    }
    float with[PERIOD][PIXELS];
    r->view->index = 7; /* another seed: values of before can be told */
    for (int i = 0; i < PERIOD; i++) {
        ao_view_record(r->view, "volume");
        memcpy(with[i], r->view->visibility, sizeof with[i]);
    }
    set_reuse(r, 1);
    ao_view_record(r->view, "volume");
    assert_memory_not_equal(with[0], r->view->visibility, sizeof with[0]);
    assert_memory_equal(with[PERIOD - 1], r->view->visibility, sizeof with[0]);
    r->view->index = 0;
    ao_room_look(r, 0.0, 0.0);
    ao_room_draw(r);
}

static void test_other_parameters_take_nothing_over(void **state)
{
    static const char *const changes[][2] = { { "volume.rays", "3" },
                                              { "volume.threshold", "0.4" },
                                              { "ao.r_max", "0.6" },
                                              { "ao.falloff", "linear" },
                                              { "ao.scale", "quarter" } };
    static const char *const before[] = { "2", "0.5", "0.45", "hard", "half" };
    room *r = *state;
    for (size_t i = 0; i < NOOK_COUNT(changes); i++) {
        set_reuse(r, PERIOD);
        warm_up(r);
        ao_view_param(r->view, changes[i][0], changes[i][1]);
        expect_as_without(r, changes[i][0]);
        ao_view_param(r->view, changes[i][0], before[i]);
    }
}

static void test_nothing_of_the_old_picture_is_there_after_a_cut_of_the_camera(void **state)
{
    room *r = *state;
    nook_fixture_view *view = r->view;
    nook_matrix there = nook_matrix_translation(-1000.0, 0.0, 0.0); /* too far to be seen */
    for (uint32_t i = 0; i < MESHES; i++) /* the same room elsewhere, its pixels in the same places */
        assert_int_equal(nook_fixture_view_add_instance(view, i, &there), NOOK_OK);
    view->occluders[MESHES].world_from_mesh[12] += 0.2;
    ao_room_draw(r);
    set_reuse(r, PERIOD);
    warm_up(r);
    ao_room_look(r, -1000.0, 0.0);
    ao_room_draw(r);
    ao_view_record(view, "volume");
    uint32_t cut = traced(r);
    ao_room_look(r, 0.0, 0.0);
    ao_room_draw(r);
    warm_up(r);
    ao_room_look(r, -1000.0, 0.0);
    ao_room_draw(r);
    expect_as_without(r, "after a cut");
    ao_view_record(view, "volume"); /* the first after one without: all of it */
    assert_int_equal(cut, traced(r));
    view->occluder_count = MESHES;
    ao_room_look(r, 0.0, 0.0);
    ao_room_draw(r);
}

/** A pixel of before then stands for 5 x 5, of which those are too far from it that lie more than one away: 16 of 25. */
static void test_coming_close_does_not_spread_a_pixel_over_many(void **state)
{
    room *r = *state;
    set_reuse(r, 8);
    ao_view_param(r->view, "ao.scale", "full");
    r->view->view_from_world =
        nook_matrix_look_at((double[]){ -7.9, -10.0, 6.7 }, (double[]){ 0.1, 0, 0.2 }, (double[]){ 0, 0, 1 });
    ao_room_draw(r);
    warm_up(r);
    ao_room_look(r, 0.0, 0.0);
    ao_room_draw(r);
    ao_view_record(r->view, "volume");
    uint32_t close = traced(r);
    r->view->index = 3; /* all of it, to know how many there are */
    ao_view_param(r->view, "volume.rays", "3");
    ao_view_record(r->view, "volume");
    uint32_t all = traced(r);
    r->view->index = 0;
    ao_view_param(r->view, "volume.rays", "2");
    ao_view_param(r->view, "ao.scale", "half");
    if (!(all < UINT32_MAX && close < all && close > 0.5 * all))
        fail_msg("%u of %u pixels are traced", close, all);
}

static void test_another_size_takes_nothing_over(void **state)
{
    room *r = *state;
    set_reuse(r, PERIOD);
    warm_up(r);
    ao_view_resize(r->view, 50, 34);
    ao_room_draw(r);
    expect_as_without(r, "50 x 34");
    warm_up(r);
    ao_view_resize(r->view, WIDTH, HEIGHT);
    ao_room_draw(r);
    expect_as_without(r, "the first size");
}

static void test_parts_take_nothing_over_and_nothing_is_taken_over_from_them(void **state)
{
    float whole[PIXELS];
    room *r = *state;
    set_reuse(r, 1);
    ao_view_record(r->view, "volume");
    memcpy(whole, r->view->visibility, sizeof whole);
    set_reuse(r, PERIOD);
    warm_up(r);
    r->view->part = (nook_rectangle){ 10, 10, 20, 15 };
    r->view->index = 5;
    ao_view_record(r->view, "volume");
    assert_true(traced(r) == UINT32_MAX);
    r->view->part = (nook_rectangle){ 0 };
    r->view->index = 0;
    ao_view_record(r->view, "volume");
    assert_memory_equal(whole, r->view->visibility, sizeof whole);
}

/* ---- Walking ----------------------------------------------------------------------------------------------------- */

enum { STEPS = 10 };

static double squares(const nook_fixture_view *view, const float *truth)
{
    double sum = 0.0;
    for (size_t i = 0; i < PIXELS; i++) {
        double error = (double)view->visibility[i] - (double)truth[i];
        sum += error * error;
    }
    return sum;
}

/** @return RMSE along the path; *out_traced pixels of the trace in the mean of the frames after the first */
static double walk(room *r, int reuse, float truths[STEPS][PIXELS], double *out_traced)
{
    double sum = 0.0;
    *out_traced = 0.0;
    set_reuse(r, reuse);
    for (int i = 0; i < STEPS; i++) {
        ao_room_look(r, 0.012 * i, 0.009 * i); /* as 1.4 m/s in a hall five times as large */
        ao_room_draw(r);
        ao_view_record(r->view, "volume");
        *out_traced += i > 0 ? (double)traced(r) / (STEPS - 1) : 0.0;
        sum += squares(r->view, truths[i]);
    }
    return sqrt(sum / (STEPS * PIXELS));
}

static void test_walking_costs_less_and_its_error_is_at_most_a_fifth_larger(void **state)
{
    static float truths[STEPS][PIXELS];
    room *r = *state;
    double all, some, none;
    ao_view_param(r->view, "ao.scale", "full");
    ao_view_param(r->view, "reference.rays", "64");
    for (int i = 0; i < STEPS; i++) {
        ao_room_look(r, 0.012 * i, 0.009 * i); /* as 1.4 m/s in a hall five times as large */
        ao_room_draw(r);
        ao_view_record(r->view, "reference");
        memcpy(truths[i], r->view->visibility, sizeof truths[i]);
    }
    double without = walk(r, 1, truths, &none), with = walk(r, PERIOD, truths, &some);
    r->view->index = 1; /* all of the last picture, to know how many there are */
    ao_view_param(r->view, "volume.rays", "3");
    ao_view_record(r->view, "volume");
    all = traced(r);
    r->view->index = 0;
    ao_view_param(r->view, "volume.rays", "2");
    ao_room_look(r, 0.0, 0.0);
    ao_room_draw(r);
    print_message("RMSE %.4f without, %.4f with; %.0f of %.0f pixels traced\n", without, with, some, all);
    assert_true(none > 1e6 && with > 0.0 && with < 1.2 * without);
    assert_true(some > 0.0 && some < 0.4 * all);
}

static void test_a_number_of_frames_that_is_none_is_refused(void **state)
{
    static const double wrong[] = { 0.0, -1.0, 9.0, 1.5, NAN };
    room *r = *state;
    set_reuse(r, 2);
    for (size_t i = 0; i < NOOK_COUNT(wrong); i++) {
        nook_log_capture log;
        double value;
        nook_log_capture_begin(&log);
        nook_result result = nook_ao_set_param(r->view->ao, "ao.reuse", wrong[i]);
        nook_log_capture_end();
        assert_int_equal(result, NOOK_E_RANGE);
        assert_int_equal(log.count, 1);
        assert_non_null(strstr(log.text, "reuse"));
        assert_int_equal(nook_ao_get_param(r->view->ao, "ao.reuse", &value), NOOK_OK);
        assert_true(value == 2.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_stands_still_is_the_same_bit_for_bit_whatever_is_marched),
        cmocka_unit_test(test_work_that_is_cut_into_dispatches_is_taken_over_too),
        cmocka_unit_test(test_techniques_that_see_the_screen_take_nothing_over),
        cmocka_unit_test(test_boxes_that_are_drawn_take_nothing_over),
        cmocka_unit_test(test_after_a_body_has_moved_the_picture_is_that_of_a_frame_without_reuse),
        cmocka_unit_test(test_the_statistics_count_what_is_kept_of_each_trace_pixel),
        cmocka_unit_test(test_only_what_is_near_a_body_that_moves_is_traced_out_of_turn),
        cmocka_unit_test(test_bodies_that_come_go_or_change_places_leave_nothing_behind),
        cmocka_unit_test(test_a_volume_that_is_voxelised_anew_leaves_nothing_behind),
        cmocka_unit_test(test_surfaces_that_move_without_a_volume_take_over_nothing_of_what_was_there_before),
        cmocka_unit_test(test_every_pixel_is_traced_anew_within_as_many_frames_as_said),
        cmocka_unit_test(test_other_parameters_take_nothing_over),
        cmocka_unit_test(test_nothing_of_the_old_picture_is_there_after_a_cut_of_the_camera),
        cmocka_unit_test(test_coming_close_does_not_spread_a_pixel_over_many),
        cmocka_unit_test(test_another_size_takes_nothing_over),
        cmocka_unit_test(test_parts_take_nothing_over_and_nothing_is_taken_over_from_them),
        cmocka_unit_test(test_walking_costs_less_and_its_error_is_at_most_a_fifth_larger),
        cmocka_unit_test(test_a_number_of_frames_that_is_none_is_refused),
    };
    return cmocka_run_group_tests(tests, ao_room_setup, ao_room_teardown);
}
