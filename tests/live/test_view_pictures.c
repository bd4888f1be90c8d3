/* Pictures of views side by side, compared byte for byte with what the plain stage draws. */
#include "game/live/live_internal.h"
#include "tests/support/live_room.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* What the plain stage draws with a setting: the whole picture. */
static void draw_plain(live_room *room, const char *text, nook_view view, uint8_t *out)
{
    nook_setting setting;
    assert_int_equal(nook_setting_parse("the test", text, &setting), NOOK_OK);
    assert_int_equal(nook_setting_apply(room->stage.ao, &setting), NOOK_OK);
    assert_int_equal(nook_stage_begin(&room->stage, &room->camera), NOOK_OK);
    assert_int_equal(nook_stage_occlude(&room->stage), NOOK_OK);
    assert_int_equal(nook_stage_finish(&room->stage, true, view), NOOK_OK);
    nook_renderer_read(room->stage.renderer, out);
}

/* Columns [left, right) of two pictures, without the rows of names and borders. */
static void expect_same_columns(const uint8_t *a, const uint8_t *b, uint32_t left, uint32_t right)
{
    for (uint32_t y = 30; y < LIVE_ROOM_HEIGHT; y++) {
        size_t at = ((size_t)y * LIVE_ROOM_WIDTH + left) * 3;
        if (memcmp(a + at, b + at, (right - left) * 3) != 0)
            fail_msg("row %u differs between columns %u and %u", y, left, right);
    }
}

static void test_one_view_is_the_plain_picture_byte_for_byte(void **state)
{
    live_room *room = *state;
    uint8_t *plain = malloc(LIVE_ROOM_SIZE);
    live_room_set(room, 0, "volume rays=3 ao.scale=half");
    live_room_step(room);
    live_room_picture(room);
    draw_plain(room, "volume rays=3 ao.scale=half", NOOK_VIEW_LIT, plain);
    assert_memory_equal(room->picture, plain, LIVE_ROOM_SIZE);
    free(plain);
}

static void test_views_side_by_side_are_parts_of_the_whole_pictures(void **state)
{
    live_room *room = *state;
    static const char *const settings[] = { "volume rays=2", "gtao slices=1 ao.scale=half", "ssao samples=4" };
    uint8_t *plain = malloc(LIVE_ROOM_SIZE);
    nook_live_views_set_count(nook_live_state(room->live), 3);
    for (uint32_t i = 0; i < 3; i++)
        live_room_set(room, i, settings[i]);
    nook_live_state(room->live)->views[1].mode = NOOK_LIVE_VISIBILITY;
    live_room_step(room);
    live_room_picture(room);
    for (uint32_t i = 0; i < 3; i++) {
        draw_plain(room, settings[i], i == 1 ? NOOK_VIEW_VISIBILITY : NOOK_VIEW_LIT, plain);
        expect_same_columns(room->picture, plain, i * LIVE_ROOM_WIDTH / 3 + 3, (i + 1) * LIVE_ROOM_WIDTH / 3 - 3);
    }
    free(plain);
}

static void test_every_mode_draws_something_of_its_own(void **state)
{
    live_room *room = *state;
    nook_live_views *views = nook_live_state(room->live);
    uint64_t sums[64];
    live_room_press(room, NOOK_KEY_F1);
    live_room_press(room, NOOK_KEY_F1); /* nothing stays over the picture */
    for (uint32_t mode = 0; mode < nook_live_mode_count(); mode++) {
        views->views[0].mode = mode;
        live_room_step(room);
        uint64_t sum = 1469598103934665603u; /* FNV-1a */
        nook_renderer_read(room->stage.renderer, room->picture);
        for (size_t i = 0; i < LIVE_ROOM_SIZE; i++)
            sum = (sum ^ room->picture[i]) * 1099511628211u;
        sums[mode] = sum;
        for (uint32_t before = 0; before < mode; before++) {
            bool no_truth = mode == NOOK_LIVE_ERROR && before == NOOK_LIVE_VISIBILITY;
            bool shown = nook_live_mode_buffer(mode) == NOOK_VIEW_NORMAL ||
                         nook_live_mode_buffer(mode) == NOOK_VIEW_DEPTH || mode < NOOK_LIVE_BUFFERS;
            if (shown && !no_truth && sums[before] == sum)
                fail_msg("%s looks like %s", nook_live_mode_name(mode), nook_live_mode_name(before));
        }
    }
    views->views[0].mode = NOOK_LIVE_LIT;
    for (uint32_t i = 1; i < nook_live_mode_count(); i++)
        live_room_press(room, NOOK_KEY_M);
    assert_int_equal(views->views[0].mode, nook_live_mode_count() - 1);
    live_room_press(room, NOOK_KEY_M);
    assert_int_equal(views->views[0].mode, NOOK_LIVE_LIT);
    room->input.down[NOOK_KEY_SHIFT] = true;
    live_room_press(room, NOOK_KEY_M);
    room->input.down[NOOK_KEY_SHIFT] = false;
    assert_int_equal(views->views[0].mode, nook_live_mode_count() - 1);
    room->input.pressed[NOOK_KEY_SHIFT] = true; /* tapped with it, and let go before the frame */
    live_room_press(room, NOOK_KEY_M);
    assert_int_equal(views->views[0].mode, nook_live_mode_count() - 2);
}

static void test_stage_may_change_its_size(void **state)
{
    live_room *room = *state;
    nook_live_views_set_count(nook_live_state(room->live), 4);
    nook_live_state(room->live)->views[2].mode = NOOK_LIVE_FETCHES;
    nook_live_state(room->live)->views[3].mode = NOOK_LIVE_OCCLUDERS;
    live_room_step(room);
    assert_int_equal(nook_stage_set_size(&room->stage, 90, 70), NOOK_OK);
    live_room_step(room);
    assert_int_equal(nook_stage_set_size(&room->stage, LIVE_ROOM_WIDTH, LIVE_ROOM_HEIGHT), NOOK_OK);
    live_room_step(room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        LIVE_ROOM_TEST(test_one_view_is_the_plain_picture_byte_for_byte),
        LIVE_ROOM_TEST(test_views_side_by_side_are_parts_of_the_whole_pictures),
        LIVE_ROOM_TEST(test_every_mode_draws_something_of_its_own),
        LIVE_ROOM_TEST(test_stage_may_change_its_size),
    };
    return cmocka_run_group_tests(tests, live_room_open, live_room_close);
}
