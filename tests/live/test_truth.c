/* Frames that are frozen, and their truth that is traced in the background. */
#include "engine/core/clock.h"
#include "game/live/live_internal.h"
#include "modules/measure/errors.h"
#include "tests/support/live_room.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const double patience_ms = 120000.0;

/* Frames until so many rays of the truth are there: its thread has the lowest priority, and waits for all others of the machine. */
static void wait_for_rays(live_room *room, uint32_t rays)
{
    double start = nook_clock_ms();
    while (room->live->truth.rays < rays) {
        assert_true(nook_clock_ms() - start < patience_ms);
        usleep(2000);
        live_room_step(room);
    }
}

static void test_frozen_frame_stays_whatever_the_camera_does(void **state)
{
    live_room *room = *state;
    uint8_t *before = malloc(LIVE_ROOM_SIZE);
    const nook_camera camera = room->camera;
    live_room_press(room, NOOK_KEY_T);
    assert_true(nook_live_frozen(room->live) && nook_live_wants_pointer(room->live));
    nook_renderer_read(room->stage.renderer, before);
    room->camera.view_from_world.m[12] += 0.3;
    live_room_step(room);
    nook_renderer_read(room->stage.renderer, room->picture);
    assert_memory_equal(before, room->picture, LIVE_ROOM_SIZE);
    live_room_press(room, NOOK_KEY_T);
    nook_renderer_read(room->stage.renderer, room->picture);
    assert_memory_not_equal(before, room->picture, LIVE_ROOM_SIZE);
    room->camera = camera;
    free(before);
}

/* A view's error by the definition that reports use. */
static void expect_error(const live_room *room, uint32_t view)
{
    const live_truth *t = &room->live->truth;
    const nook_rectangle *place = &room->live->places[view];
    uint32_t width, height;
    const float *depth = nook_refine_depth(t->refine, &width, &height);
    uint8_t *mask = calloc(width, height);
    nook_errors errors;
    for (uint32_t y = place->y; y < place->y + place->height; y++) {
        for (uint32_t x = place->x; x < place->x + place->width; x++)
            mask[y * width + x] = depth[y * width + x] > 0.0f;
    }
    assert_int_equal(nook_errors_measure(t->visibility, t->mean, mask, (size_t)width * height, &errors), NOOK_OK);
    free(mask);
    assert_int_equal(t->errors[view].pixels, errors.count);
    assert_true(errors.count > 1000 && errors.rmse > 0.001);
    assert_true(fabs(t->errors[view].rmse - errors.rmse) < 1e-9 && fabs(t->errors[view].bias - errors.bias) < 1e-9);
}

static void test_errors_of_views_are_those_of_the_pictures(void **state)
{
    live_room *room = *state;
    nook_live_views *views = nook_live_state(room->live);
    nook_live_views_set_count(views, 3);
    live_room_set(room, 0, "volume rays=16 ao.filter=none");
    live_room_set(room, 1, "ssao samples=2");
    views->views[2].open = true;
    live_room_press(room, NOOK_KEY_T);
    wait_for_rays(room, 24);
    expect_error(room, 0);
    expect_error(room, 1);
    assert_true(room->live->truth.errors[2].bias > 0.0); /* all open is too bright */
    double before = room->live->truth.errors[1].rmse;
    live_room_set(room, 1, "volume rays=16 ao.filter=none"); /* measured at once as it is now */
    live_room_step(room);
    expect_error(room, 1);
    assert_true(room->live->truth.errors[1].rmse != before);
}

static void test_reference_s_view_shows_the_truth_as_it_comes(void **state)
{
    live_room *room = *state;
    nook_live_views *views = nook_live_state(room->live);
    live_room_set(room, 0, "reference");
    views->views[0].mode = NOOK_LIVE_VISIBILITY;
    live_room_press(room, NOOK_KEY_T);
    double noise = 1.0;
    for (int i = 0; i < 3; i++) {
        wait_for_rays(room, 2 * room->live->truth.rays + 8); /* more may have come than were waited for */
        assert_true(room->live->truth.noise < 0.8 * noise);
        noise = room->live->truth.noise;
    }
    assert_true(room->live->visibility[0].id == room->live->truth.texture.id);
    assert_int_equal(room->live->truth.errors[0].pixels, 0);
    nook_renderer_read(room->stage.renderer, room->picture);
    double sum = 0.0, truth = 0.0;
    for (size_t i = 0; i < LIVE_ROOM_WIDTH * LIVE_ROOM_HEIGHT; i++)
        sum += room->picture[3 * i] / 255.0, truth += (double)room->live->truth.mean[i];
    assert_true(fabs(sum - truth) < 0.01 * truth && truth < 0.999 * LIVE_ROOM_WIDTH * LIVE_ROOM_HEIGHT);
}

static void test_truth_follows_the_reach_that_is_changed(void **state)
{
    live_room *room = *state;
    live_room_press(room, NOOK_KEY_T);
    wait_for_rays(room, 8);
    nook_live_state(room->live)->r_max *= 0.1;
    live_room_step(room);
    assert_int_equal(room->live->truth.rays, 0);
    wait_for_rays(room, 8);
    assert_true(room->live->truth.reach[0] == nook_live_state(room->live)->r_max);
}

static void test_frame_of_another_size_is_frozen_anew(void **state)
{
    live_room *room = *state;
    live_room_press(room, NOOK_KEY_T);
    wait_for_rays(room, 8);
    assert_int_equal(nook_stage_set_size(&room->stage, 100, 80), NOOK_OK);
    live_room_step(room);
    wait_for_rays(room, 8);
    assert_int_equal(room->live->truth.texture.width, 100);
    assert_int_equal(nook_stage_set_size(&room->stage, LIVE_ROOM_WIDTH, LIVE_ROOM_HEIGHT), NOOK_OK);
    live_room_step(room);
    nook_live_suspend(room->live); /* as before a reload: it is traced again after it */
    assert_false(nook_refine_look(room->live->truth.refine).running);
    live_room_step(room);
    wait_for_rays(room, 8);
}

static void test_probe_tells_of_the_pixel_under_the_mouse(void **state)
{
    live_room *room = *state;
    live_room_press(room, NOOK_KEY_T);
    wait_for_rays(room, 8);
    uint32_t probed = 0;
    for (double x = 0.1; x < 1.0; x += 0.2) {
        room->input.mouse_x = x * LIVE_ROOM_WIDTH, room->input.mouse_y = 0.6 * LIVE_ROOM_HEIGHT,
        room->input.mouse_dx = 1.0;
        live_room_step(room);
        const live_truth *t = &room->live->truth;
        assert_int_equal(t->pixel[0], (uint32_t)(x * LIVE_ROOM_WIDTH));
        assert_int_equal(t->pixel[1], (uint32_t)(0.4 * LIVE_ROOM_HEIGHT));
        probed += t->probed;
        if (t->probed)
            assert_true(fabs(t->probe.visibility - (double)t->mean[t->pixel[1] * LIVE_ROOM_WIDTH + t->pixel[0]]) < 0.5);
    }
    assert_true(probed > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        LIVE_ROOM_TEST(test_frozen_frame_stays_whatever_the_camera_does),
        LIVE_ROOM_TEST(test_errors_of_views_are_those_of_the_pictures),
        LIVE_ROOM_TEST(test_reference_s_view_shows_the_truth_as_it_comes),
        LIVE_ROOM_TEST(test_truth_follows_the_reach_that_is_changed),
        LIVE_ROOM_TEST(test_frame_of_another_size_is_frozen_anew),
        LIVE_ROOM_TEST(test_probe_tells_of_the_pixel_under_the_mouse),
    };
    return cmocka_run_group_tests(tests, live_room_open, live_room_close);
}
