#include "engine/render/renderer.h"
#include "game/live/history.h"
#include "game/live/live_views.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static nook_live_views make(uint32_t count, bool columns)
{
    nook_live_views views;
    nook_live_views_reset(&views, "volume rays=4");
    views.columns = columns;
    nook_live_views_set_count(&views, count);
    return views;
}

/* Every pixel belongs to exactly one view, and the view that is found there is that one. */
static void expect_cover(const nook_live_views *views, uint32_t width, uint32_t height)
{
    nook_rectangle places[NOOK_LIVE_VIEWS_MAX];
    uint8_t *owners = calloc(width, height);
    assert_non_null(owners);
    nook_live_views_place(views, width, height, places);
    for (uint32_t i = 0; i < views->count; i++) {
        const nook_rectangle *p = &places[i];
        assert_true(p->width > 0 && p->height > 0 && p->x + p->width <= width && p->y + p->height <= height);
        for (uint32_t y = p->y; y < p->y + p->height; y++) {
            for (uint32_t x = p->x; x < p->x + p->width; x++)
                owners[y * width + x] = (uint8_t)(owners[y * width + x] * 8 + i + 1);
        }
    }
    for (uint32_t i = 0; i < width * height; i++)
        assert_in_range(owners[i], 1, views->count);
    free(owners);
}

static void test_views_cover_the_picture_without_gap_or_overlap(void **state)
{
    static const uint32_t sizes[][2] = { { 4, 4 }, { 5, 7 }, { 64, 37 }, { 640, 360 }, { 37, 300 } };
    static const double places[] = { -1.0, 0.0, 0.02, 0.31, 0.5, 0.77, 0.999, 5.0 };
    (void)state;
    for (uint32_t count = 1; count <= NOOK_LIVE_VIEWS_MAX; count++) {
        for (size_t s = 0; s < NOOK_COUNT(sizes); s++) {
            nook_live_views views = make(count, s % 2 == 0);
            expect_cover(&views, sizes[s][0], sizes[s][1]);
            for (size_t i = 0; i < NOOK_COUNT(places); i++) {
                nook_live_views_drag(&views, (uint32_t)(i % 2), places[i], places[NOOK_COUNT(places) - 1 - i]);
                expect_cover(&views, sizes[s][0], sizes[s][1]);
            }
        }
    }
}

static void test_in_a_slit_every_view_is_the_whole_picture(void **state)
{
    static const uint32_t sizes[][2] = { { 1, 1 }, { 3, 3 }, { 400, 1 }, { 2, 300 } };
    (void)state;
    for (size_t i = 0; i < NOOK_COUNT(sizes); i++) {
        for (uint32_t count = 1; count <= NOOK_LIVE_VIEWS_MAX; count++) {
            nook_rectangle places[NOOK_LIVE_VIEWS_MAX];
            nook_live_views views = make(count, true);
            nook_live_views_place(&views, sizes[i][0], sizes[i][1], places);
            for (uint32_t k = 0; k < count; k++) {
                assert_true(places[k].x == 0 && places[k].y == 0);
                assert_true(places[k].width == sizes[i][0] && places[k].height == sizes[i][1]);
            }
        }
    }
}

static void test_view_at_a_place_is_the_one_drawn_there(void **state)
{
    enum { WIDTH = 400, HEIGHT = 300 };
    (void)state;
    for (uint32_t count = 1; count <= NOOK_LIVE_VIEWS_MAX; count++) {
        nook_rectangle places[NOOK_LIVE_VIEWS_MAX];
        nook_live_views views = make(count, count % 2 == 0);
        nook_live_views_drag(&views, 0, 0.3, 0.3);
        nook_live_views_drag(&views, 1, 0.6, 0.6);
        nook_live_views_place(&views, WIDTH, HEIGHT, places);
        for (uint32_t i = 0; i < count; i++) {
            double x = (places[i].x + 0.5 * places[i].width) / WIDTH;
            double y = 1.0 - (places[i].y + 0.5 * places[i].height) / HEIGHT;
            assert_int_equal(nook_live_views_at(&views, x, y), i);
        }
        views.active = count - 1;
        assert_int_equal(nook_live_views_at(&views, 1.5, 0.5), count - 1); /* beside the picture */
    }
}

static void test_border_is_found_near_it_and_moves_with_the_hand(void **state)
{
    static const double reach[2] = { 0.01, 0.01 };
    (void)state;
    nook_live_views views = make(4, true);
    assert_int_equal(nook_live_views_border_at(&views, 0.505, 0.2, reach), 0);
    assert_int_equal(nook_live_views_border_at(&views, 0.2, 0.495, reach), 1);
    assert_int_equal(nook_live_views_border_at(&views, 0.2, 0.2, reach), NOOK_LIVE_SPLITS_MAX);
    nook_live_views_drag(&views, 0, 0.7, 0.2);
    assert_true(views.splits[0] == 0.7 && views.splits[1] == 0.5);
    nook_live_views_drag(&views, 1, 0.2, 0.9);
    assert_true(views.splits[0] == 0.7 && views.splits[1] == 0.9);
    nook_live_views_drag(&views, 7, 0.1, 0.1); /* there is none */
    assert_true(views.splits[0] == 0.7 && views.splits[1] == 0.9);
    views = make(1, true);
    assert_int_equal(nook_live_views_border_at(&views, 0.5, 0.5, reach), NOOK_LIVE_SPLITS_MAX);
}

static void test_borders_of_columns_stay_in_order(void **state)
{
    (void)state;
    nook_live_views views = make(3, true);
    nook_live_views_drag(&views, 0, 0.99, 0.0);
    assert_true(views.splits[0] <= views.splits[1] - 0.049);
    nook_live_views_drag(&views, 1, 0.01, 0.0);
    assert_true(views.splits[0] <= views.splits[1] - 0.049);
    assert_true(views.splits[0] > 0.0 && views.splits[1] < 1.0);
}

static void test_lying_border_of_three_ends_at_the_upright_one(void **state)
{
    static const double reach[2] = { 0.01, 0.01 };
    (void)state;
    nook_live_views views = make(3, false);
    assert_int_equal(nook_live_views_border_at(&views, 0.8, 0.5, reach), 1);
    assert_int_equal(nook_live_views_border_at(&views, 0.2, 0.5, reach), NOOK_LIVE_SPLITS_MAX);
    nook_live_views_turn(&views);
    assert_true(views.columns && fabs(views.splits[1] - 2.0 / 3.0) < 1e-9);
}

static void test_new_views_show_what_the_active_one_does(void **state)
{
    (void)state;
    nook_live_views views = make(2, true);
    snprintf(views.views[1].setting, sizeof views.views[1].setting, "gtao slices=3");
    views.views[1].mode = NOOK_LIVE_ERROR;
    views.active = 1;
    nook_live_views_set_count(&views, 4);
    assert_string_equal(views.views[0].setting, "volume rays=4");
    assert_string_equal(views.views[3].setting, "gtao slices=3");
    assert_int_equal(views.views[3].mode, NOOK_LIVE_ERROR);
    views.active = 3;
    nook_live_views_set_count(&views, 1);
    assert_int_equal(views.active, 0);
}

static void test_every_mode_has_a_name_of_its_own_that_reads_back(void **state)
{
    bool shown[NOOK_VIEW_COUNT] = { false };
    (void)state;
    for (uint32_t mode = 0; mode < nook_live_mode_count(); mode++) {
        uint32_t parsed = 99;
        assert_true(nook_live_mode_parse(nook_live_mode_name(mode), &parsed));
        assert_int_equal(parsed, mode);
        if (mode <= NOOK_LIVE_VISIBILITY || mode >= NOOK_LIVE_BUFFERS) {
            assert_false(shown[nook_live_mode_buffer(mode)]);
            shown[nook_live_mode_buffer(mode)] = true;
        }
    }
    for (int view = 0; view < NOOK_VIEW_COUNT; view++)
        assert_true(shown[view]);
    uint32_t untouched = 5;
    assert_false(nook_live_mode_parse("splendid", &untouched));
    assert_int_equal(untouched, 5);
}

static void test_undo_and_redo_walk_through_what_was_changed(void **state)
{
    static nook_live_history history;
    (void)state;
    nook_live_views views = make(1, true);
    memset(&history, 0, sizeof history);
    assert_false(nook_live_history_undo(&history, &views));
    nook_live_history_push(&history, &views);
    nook_live_history_push(&history, &views); /* nothing has changed */
    assert_false(nook_live_history_undo(&history, &views));
    views.r_max = 2.0;
    nook_live_history_push(&history, &views);
    views.r_max = 3.0;
    nook_live_history_push(&history, &views);
    assert_true(nook_live_history_undo(&history, &views) && views.r_max == 2.0);
    assert_true(nook_live_history_undo(&history, &views) && views.r_max == 1.0);
    assert_false(nook_live_history_undo(&history, &views));
    assert_true(nook_live_history_redo(&history, &views) && views.r_max == 2.0);
    views.r_max = 4.0; /* another way from here */
    nook_live_history_push(&history, &views);
    assert_false(nook_live_history_redo(&history, &views));
    assert_true(nook_live_history_undo(&history, &views) && views.r_max == 2.0);
}

static void test_full_history_forgets_the_oldest(void **state)
{
    static nook_live_history history;
    (void)state;
    nook_live_views views = make(1, true);
    memset(&history, 0, sizeof history);
    for (int i = 1; i <= 3 * NOOK_LIVE_HISTORY_MAX; i++) {
        views.r_max = i;
        nook_live_history_push(&history, &views);
    }
    for (int i = 1; i < NOOK_LIVE_HISTORY_MAX; i++)
        assert_true(nook_live_history_undo(&history, &views));
    assert_false(nook_live_history_undo(&history, &views));
    assert_true(views.r_max == 2.0 * NOOK_LIVE_HISTORY_MAX + 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_views_cover_the_picture_without_gap_or_overlap),
        cmocka_unit_test(test_in_a_slit_every_view_is_the_whole_picture),
        cmocka_unit_test(test_view_at_a_place_is_the_one_drawn_there),
        cmocka_unit_test(test_border_is_found_near_it_and_moves_with_the_hand),
        cmocka_unit_test(test_borders_of_columns_stay_in_order),
        cmocka_unit_test(test_lying_border_of_three_ends_at_the_upright_one),
        cmocka_unit_test(test_new_views_show_what_the_active_one_does),
        cmocka_unit_test(test_every_mode_has_a_name_of_its_own_that_reads_back),
        cmocka_unit_test(test_undo_and_redo_walk_through_what_was_changed),
        cmocka_unit_test(test_full_history_forgets_the_oldest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
