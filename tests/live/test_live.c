/* Views side by side without a window: made-up keys and mice, pictures compared byte for byte. */
#include "engine/core/file.h"
#include "game/compare/camera.h"
#include "game/live/live_internal.h"
#include "game/settings/settings_file.h"
#include "modules/measure/errors.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <math.h>
#include <setjmp.h>
#include <stb/stb_image.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { WIDTH = 480, HEIGHT = 300, SIZE = WIDTH * HEIGHT * 3 };

typedef struct fixture {
    nook_stage stage;
    nook_camera camera;
    nook_live *live;
    nook_input input, rest;
    char settings[4096], pictures[4096];
    uint8_t picture[SIZE];
} fixture;

static int open_stage(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    const char *root = getenv("NOOK_ROOT");
    char scene[4096], label[64];
    *state = f;
    if (!f)
        return -1;
    snprintf(scene, sizeof scene, "%s/tests/game/data/crate.gltf", root ? root : ".");
    const nook_stage_desc desc = {
        .root = root ? root : ".", .scene_path = scene, .backend = NOOK_BACKEND_OSMESA, .width = WIDTH, .height = HEIGHT
    };
    const nook_game_world_desc world = { 32, 0.5, NULL };
    return nook_stage_open(&desc, &f->stage) != NOOK_OK || nook_stage_fill(&f->stage, &world) != NOOK_OK ||
           nook_ao_set_param(f->stage.ao, "ao.r_max", 0.5) != NOOK_OK ||
           nook_camera_choose(f->stage.scene, NULL, (double)WIDTH / HEIGHT, &f->camera, label, sizeof label) != NOOK_OK;
}

static int close_stage(void **state)
{
    fixture *f = *state;
    bool wrong = nook_gpu_check(f->stage.gpu, "the live views");
    nook_stage_close(&f->stage);
    free(f);
    return wrong;
}

static void set_setting(fixture *f, uint32_t view, const char *text)
{
    nook_live_view *v = &nook_live_state(f->live)->views[view];
    memset(v->setting, 0, sizeof v->setting);
    snprintf(v->setting, sizeof v->setting, "%s", text);
}

static int set_up(void **state)
{
    fixture *f = *state;
    const nook_live_desc desc = {
        .stage = &f->stage,
        .settings_path = nook_scratch_path(f->settings, sizeof f->settings, "live.settings"),
        .pictures = nook_scratch_path(f->pictures, sizeof f->pictures, "pictures"),
        .notes = "level of the test",
    };
    remove(f->settings);
    memset(&f->input, 0, sizeof f->input);
    f->input.width = WIDTH, f->input.height = HEIGHT, f->input.content_scale = 1.0;
    f->input.mouse_x = 0.5 * WIDTH, f->input.mouse_y = 0.9 * HEIGHT;
    if (nook_live_create(&desc, &f->live) != NOOK_OK)
        return -1;
    set_setting(f, 0, "volume rays=1 ao.scale=quarter"); /* quick, unless a test asks for more */
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    nook_live_destroy(f->live);
    f->live = NULL;
    return nook_gpu_check(f->stage.gpu, "the live views");
}

/* A frame with the input as it is; keys and clicks are short. */
static void step(fixture *f)
{
    nook_live_input(f->live, &f->input, true, &f->rest);
    assert_int_equal(nook_live_draw(f->live, &f->camera), NOOK_OK);
    memset(f->input.pressed, 0, sizeof f->input.pressed);
    memset(f->input.mouse_pressed, 0, sizeof f->input.mouse_pressed);
    f->input.mouse_dx = f->input.mouse_dy = 0.0;
}

static void press(fixture *f, nook_key key)
{
    f->input.pressed[key] = true;
    step(f);
}

static void take_picture(fixture *f)
{
    assert_int_equal(nook_live_picture(f->live, WIDTH, HEIGHT, f->picture), NOOK_OK);
}

/* What the plain stage draws with a setting: the whole picture. */
static void draw_plain(fixture *f, const char *text, nook_view view, uint8_t *out)
{
    nook_setting setting;
    assert_int_equal(nook_setting_parse("the test", text, &setting), NOOK_OK);
    assert_int_equal(nook_setting_apply(f->stage.ao, &setting), NOOK_OK);
    assert_int_equal(nook_stage_begin(&f->stage, &f->camera), NOOK_OK);
    assert_int_equal(nook_stage_occlude(&f->stage), NOOK_OK);
    assert_int_equal(nook_stage_finish(&f->stage, true, view), NOOK_OK);
    nook_renderer_read(f->stage.renderer, out);
}

/* Columns [left, right) of two pictures, without the rows of names and borders. */
static void expect_same_columns(const uint8_t *a, const uint8_t *b, uint32_t left, uint32_t right)
{
    for (uint32_t y = 30; y < HEIGHT; y++) {
        size_t at = ((size_t)y * WIDTH + left) * 3;
        if (memcmp(a + at, b + at, (right - left) * 3) != 0)
            fail_msg("row %u differs between columns %u and %u", y, left, right);
    }
}

static void test_one_view_is_the_plain_picture_byte_for_byte(void **state)
{
    fixture *f = *state;
    uint8_t *plain = malloc(SIZE);
    set_setting(f, 0, "volume rays=3 ao.scale=half");
    step(f);
    take_picture(f);
    draw_plain(f, "volume rays=3 ao.scale=half", NOOK_VIEW_LIT, plain);
    assert_memory_equal(f->picture, plain, SIZE);
    free(plain);
}

static void test_views_side_by_side_are_parts_of_the_whole_pictures(void **state)
{
    fixture *f = *state;
    static const char *const settings[] = { "volume rays=2", "gtao slices=1 ao.scale=half", "ssao samples=4" };
    uint8_t *plain = malloc(SIZE);
    nook_live_views_set_count(nook_live_state(f->live), 3);
    for (uint32_t i = 0; i < 3; i++)
        set_setting(f, i, settings[i]);
    nook_live_state(f->live)->views[1].mode = NOOK_LIVE_VISIBILITY;
    step(f);
    take_picture(f);
    for (uint32_t i = 0; i < 3; i++) {
        draw_plain(f, settings[i], i == 1 ? NOOK_VIEW_VISIBILITY : NOOK_VIEW_LIT, plain);
        expect_same_columns(f->picture, plain, i * WIDTH / 3 + 3, (i + 1) * WIDTH / 3 - 3);
    }
    free(plain);
}

static void test_number_keys_choose_the_technique_of_the_active_view(void **state)
{
    fixture *f = *state;
    nook_live_views *views = nook_live_state(f->live);
    press(f, NOOK_KEY_PLUS);
    assert_int_equal(views->count, 2);
    f->input.mouse_x = 0.75 * WIDTH, f->input.mouse_dx = 1.0;
    step(f);
    assert_int_equal(views->active, 1);
    press(f, NOOK_KEY_2);
    assert_memory_equal(views->views[1].setting, "ssao", 4);
    assert_memory_equal(views->views[0].setting, "volume", 6);
    press(f, NOOK_KEY_0);
    assert_true(views->views[1].open && !views->views[0].open);
    press(f, NOOK_KEY_9); /* there is none */
    assert_true(views->views[1].open);
    press(f, NOOK_KEY_TAB);
    assert_int_equal(views->active, 0);
    press(f, NOOK_KEY_5);
    assert_memory_equal(views->views[0].setting, "gtao", 4);
    press(f, NOOK_KEY_MINUS);
    assert_int_equal(views->count, 1);
}

static void test_technique_that_is_chosen_again_has_the_parameters_it_had(void **state)
{
    fixture *f = *state;
    set_setting(f, 0, "volume rays=3");
    press(f, NOOK_KEY_2);
    set_setting(f, 0, "ssao samples=9");
    press(f, NOOK_KEY_1);
    assert_string_equal(nook_live_state(f->live)->views[0].setting, "volume rays=3");
    press(f, NOOK_KEY_2);
    assert_string_equal(nook_live_state(f->live)->views[0].setting, "ssao samples=9");
}

static void test_keys_that_are_used_are_taken_from_the_host_and_others_are_not(void **state)
{
    fixture *f = *state;
    f->input.down[NOOK_KEY_W] = f->input.pressed[NOOK_KEY_SPACE] = true;
    f->input.down[NOOK_KEY_TAB] = f->input.pressed[NOOK_KEY_TAB] = true;
    f->input.mouse_down[0] = true, f->input.mouse_dx = 4.0;
    step(f);
    assert_true(f->rest.down[NOOK_KEY_W] && f->rest.pressed[NOOK_KEY_SPACE]);
    assert_false(f->rest.down[NOOK_KEY_TAB] || f->rest.pressed[NOOK_KEY_TAB]);
    assert_true(f->rest.mouse_down[0] && f->rest.mouse_dx == 4.0);
}

static void test_border_follows_the_mouse_and_the_host_gets_nothing_of_it(void **state)
{
    fixture *f = *state;
    nook_live_views *views = nook_live_state(f->live);
    nook_live_views_set_count(views, 2);
    f->input.mouse_x = 0.5 * WIDTH + 3.0;
    f->input.mouse_down[0] = f->input.mouse_pressed[0] = true;
    step(f);
    assert_false(f->rest.mouse_down[0]);
    f->input.mouse_x = 0.7 * WIDTH, f->input.mouse_dx = 0.2 * WIDTH;
    step(f);
    assert_true(views->splits[0] == 0.7 && f->rest.mouse_dx == 0.0);
    f->input.mouse_down[0] = false;
    step(f);
    f->input.mouse_x = 0.2 * WIDTH;
    step(f);
    assert_true(views->splits[0] == 0.7);
}

static void test_captured_mouse_moves_no_borders(void **state)
{
    fixture *f = *state;
    nook_live_views *views = nook_live_state(f->live);
    nook_live_views_set_count(views, 2);
    f->input.mouse_x = 0.5 * WIDTH;
    f->input.mouse_down[0] = f->input.mouse_pressed[0] = true;
    nook_live_input(f->live, &f->input, false, &f->rest);
    f->input.mouse_x = 0.2 * WIDTH, f->input.mouse_dx = -10.0;
    nook_live_input(f->live, &f->input, false, &f->rest);
    assert_true(views->splits[0] == 0.5 && f->rest.mouse_dx == -10.0 && f->rest.mouse_down[0]);
}

static void test_every_mode_draws_something_of_its_own(void **state)
{
    fixture *f = *state;
    nook_live_views *views = nook_live_state(f->live);
    uint64_t sums[64];
    press(f, NOOK_KEY_F1);
    press(f, NOOK_KEY_F1); /* nothing stays over the picture */
    for (uint32_t mode = 0; mode < nook_live_mode_count(); mode++) {
        views->views[0].mode = mode;
        step(f);
        uint64_t sum = 1469598103934665603u; /* FNV-1a */
        nook_renderer_read(f->stage.renderer, f->picture);
        for (size_t i = 0; i < SIZE; i++)
            sum = (sum ^ f->picture[i]) * 1099511628211u;
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
        press(f, NOOK_KEY_M);
    assert_int_equal(views->views[0].mode, nook_live_mode_count() - 1);
    press(f, NOOK_KEY_M);
    assert_int_equal(views->views[0].mode, NOOK_LIVE_LIT);
    f->input.down[NOOK_KEY_SHIFT] = true;
    press(f, NOOK_KEY_M);
    f->input.down[NOOK_KEY_SHIFT] = false;
    assert_int_equal(views->views[0].mode, nook_live_mode_count() - 1);
}

/* Drags every part of the panel to the right until the setting of the view differs. @return whether it ever did */
static bool drag_a_slider(fixture *f)
{
    char before[NOOK_SETTING_TEXT_MAX];
    nook_live_view *view = &nook_live_state(f->live)->views[0];
    memcpy(before, view->setting, sizeof before);
    for (double y = 110.0; y < HEIGHT; y += 7.0) {
        f->input.mouse_x = WIDTH - 340.0, f->input.mouse_y = y;
        step(f);
        f->input.mouse_down[0] = true;
        step(f);
        f->input.mouse_x += 60.0;
        step(f);
        f->input.mouse_x += 20.0;
        step(f);
        f->input.mouse_down[0] = false;
        step(f);
        step(f);
        if (strcmp(before, view->setting) != 0)
            return true;
    }
    return false;
}

static void test_slider_of_the_panel_changes_a_parameter_and_undo_takes_it_back(void **state)
{
    fixture *f = *state;
    nook_live_view *view = &nook_live_state(f->live)->views[0];
    set_setting(f, 0, "ssao samples=4");
    press(f, NOOK_KEY_F2);
    step(f);
    assert_true(nook_live_wants_pointer(f->live));
    assert_true(drag_a_slider(f));
    assert_false(f->rest.mouse_down[0]);
    nook_setting changed;
    assert_int_equal(nook_setting_parse("the panel", view->setting, &changed), NOOK_OK);
    char after[NOOK_SETTING_TEXT_MAX];
    memcpy(after, view->setting, sizeof after);
    f->input.down[NOOK_KEY_CONTROL] = true;
    press(f, NOOK_KEY_Z);
    assert_string_equal(view->setting, "ssao samples=4");
    press(f, NOOK_KEY_Y);
    assert_string_equal(view->setting, after);
    f->input.down[NOOK_KEY_CONTROL] = false;
}

static void test_mouse_over_a_panel_is_not_the_host_s(void **state)
{
    fixture *f = *state;
    press(f, NOOK_KEY_F2);
    f->input.mouse_x = WIDTH - 100.0, f->input.mouse_y = 60.0;
    step(f);
    f->input.mouse_pressed[0] = true, f->input.scroll = 1.0;
    step(f);
    assert_true(!f->rest.mouse_pressed[0] && f->rest.scroll == 0.0);
    f->input.scroll = 0.0;
    press(f, NOOK_KEY_F2);
    f->input.mouse_down[0] = true;
    step(f);
    assert_true(f->rest.mouse_down[0]);
    assert_false(nook_live_wants_pointer(f->live));
}

static bool has_red(const fixture *f)
{
    int red = 0;
    for (size_t i = 0; i < (size_t)WIDTH * 100; i++)
        red += f->picture[i * 3] > 200 && f->picture[i * 3 + 1] < 140 && f->picture[i * 3 + 2] < 140;
    return red > 10;
}

static void test_messages_stay_until_they_are_taken_back(void **state)
{
    fixture *f = *state;
    uint8_t *before = malloc(SIZE);
    step(f);
    take_picture(f);
    memcpy(before, f->picture, SIZE);
    nook_live_message(f->live, "shaders", "shaders/ao/volume.comp.glsl:12: error: no such thing");
    nook_live_message(f->live, "game", "crashed in its first frame");
    step(f);
    step(f);
    take_picture(f);
    assert_true(has_red(f));
    nook_live_message(f->live, "shaders", "");
    nook_live_message(f->live, "game", "");
    step(f);
    take_picture(f);
    assert_memory_equal(f->picture, before, SIZE);
    for (int i = 0; i < 3 * NOOK_LIVE_MESSAGES_MAX; i++) { /* more senders than there is room for */
        char from[32];
        snprintf(from, sizeof from, "sender %d", i);
        nook_live_message(f->live, from, "text");
    }
    step(f);
    free(before);
}

static void test_setting_that_cannot_be_read_any_more_becomes_its_technique(void **state)
{
    fixture *f = *state;
    nook_log_capture log;
    set_setting(f, 0, "ssao gone=3");
    nook_log_capture_begin(&log);
    step(f);
    nook_log_capture_end();
    assert_string_equal(nook_live_state(f->live)->views[0].setting, "ssao");
    set_setting(f, 0, "splendid");
    nook_log_capture_begin(&log);
    step(f);
    nook_log_capture_end();
    assert_string_equal(nook_live_state(f->live)->views[0].setting, "volume");
    nook_log_capture_begin(&log);
    step(f);
    nook_log_capture_end();
    assert_int_equal(log.count, 0); /* said once */
}

static void test_size_of_the_window_may_differ_from_the_picture_s(void **state)
{
    fixture *f = *state;
    uint8_t *large = malloc((size_t)4 * SIZE);
    f->input.width = 2 * WIDTH, f->input.height = 2 * HEIGHT;
    press(f, NOOK_KEY_F2);
    step(f);
    assert_int_equal(nook_live_picture(f->live, 2 * WIDTH, 2 * HEIGHT, large), NOOK_OK);
    free(large);
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_result result = nook_live_picture(f->live, 0, 5, f->picture);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_RANGE);
}

/* Frames until so many rays of the truth are there. */
static void wait_for_rays(fixture *f, uint32_t rays)
{
    for (int i = 0; f->live->truth.rays < rays; i++) {
        assert_true(i < 5000);
        usleep(2000);
        step(f);
    }
}

static void test_frozen_frame_stays_whatever_the_camera_does(void **state)
{
    fixture *f = *state;
    uint8_t *before = malloc(SIZE);
    const nook_camera camera = f->camera;
    press(f, NOOK_KEY_T);
    assert_true(nook_live_frozen(f->live) && nook_live_wants_pointer(f->live));
    nook_renderer_read(f->stage.renderer, before);
    f->camera.view_from_world.m[12] += 0.3;
    step(f);
    nook_renderer_read(f->stage.renderer, f->picture);
    assert_memory_equal(before, f->picture, SIZE);
    press(f, NOOK_KEY_T);
    nook_renderer_read(f->stage.renderer, f->picture);
    assert_memory_not_equal(before, f->picture, SIZE);
    f->camera = camera;
    free(before);
}

/* A view's error by the definition that reports use. */
static void expect_error(const fixture *f, uint32_t view)
{
    const live_truth *t = &f->live->truth;
    const nook_rectangle *place = &f->live->places[view];
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
    fixture *f = *state;
    nook_live_views *views = nook_live_state(f->live);
    nook_live_views_set_count(views, 3);
    set_setting(f, 0, "volume rays=16 ao.filter=none");
    set_setting(f, 1, "ssao samples=2");
    views->views[2].open = true;
    press(f, NOOK_KEY_T);
    wait_for_rays(f, 24);
    expect_error(f, 0);
    expect_error(f, 1);
    assert_true(f->live->truth.errors[2].bias > 0.0); /* all open is too bright */
    double before = f->live->truth.errors[1].rmse;
    set_setting(f, 1, "volume rays=16 ao.filter=none"); /* measured at once as it is now */
    step(f);
    expect_error(f, 1);
    assert_true(f->live->truth.errors[1].rmse != before);
}

static void test_reference_s_view_shows_the_truth_as_it_comes(void **state)
{
    fixture *f = *state;
    nook_live_views *views = nook_live_state(f->live);
    set_setting(f, 0, "reference");
    views->views[0].mode = NOOK_LIVE_VISIBILITY;
    press(f, NOOK_KEY_T);
    double noise = 1.0;
    for (uint32_t rays = 8; rays <= 56; rays = 2 * rays + 8) {
        wait_for_rays(f, rays);
        assert_true(f->live->truth.noise < 0.8 * noise);
        noise = f->live->truth.noise;
    }
    assert_true(f->live->visibility[0].id == f->live->truth.texture.id);
    assert_int_equal(f->live->truth.errors[0].pixels, 0);
    nook_renderer_read(f->stage.renderer, f->picture);
    double sum = 0.0, truth = 0.0;
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
        sum += f->picture[3 * i] / 255.0, truth += (double)f->live->truth.mean[i];
    assert_true(fabs(sum - truth) < 0.01 * truth && truth < 0.999 * WIDTH * HEIGHT);
}

static void test_truth_follows_the_reach_that_is_changed(void **state)
{
    fixture *f = *state;
    press(f, NOOK_KEY_T);
    wait_for_rays(f, 8);
    nook_live_state(f->live)->r_max *= 0.1;
    step(f);
    assert_int_equal(f->live->truth.rays, 0);
    wait_for_rays(f, 8);
    assert_true(f->live->truth.reach[0] == nook_live_state(f->live)->r_max);
}

static void test_frame_of_another_size_is_frozen_anew(void **state)
{
    fixture *f = *state;
    press(f, NOOK_KEY_T);
    wait_for_rays(f, 8);
    assert_int_equal(nook_stage_set_size(&f->stage, 100, 80), NOOK_OK);
    step(f);
    wait_for_rays(f, 8);
    assert_int_equal(f->live->truth.texture.width, 100);
    assert_int_equal(nook_stage_set_size(&f->stage, WIDTH, HEIGHT), NOOK_OK);
    step(f);
    nook_live_suspend(f->live); /* as before a reload: it is traced again after it */
    assert_false(nook_refine_look(f->live->truth.refine).running);
    step(f);
    wait_for_rays(f, 8);
}

static void test_probe_tells_of_the_pixel_under_the_mouse(void **state)
{
    fixture *f = *state;
    press(f, NOOK_KEY_T);
    wait_for_rays(f, 8);
    uint32_t probed = 0;
    for (double x = 0.1; x < 1.0; x += 0.2) {
        f->input.mouse_x = x * WIDTH, f->input.mouse_y = 0.6 * HEIGHT, f->input.mouse_dx = 1.0;
        step(f);
        const live_truth *t = &f->live->truth;
        assert_int_equal(t->pixel[0], (uint32_t)(x * WIDTH));
        assert_int_equal(t->pixel[1], (uint32_t)(0.4 * HEIGHT));
        probed += t->probed;
        if (t->probed)
            assert_true(fabs(t->probe.visibility - (double)t->mean[t->pixel[1] * WIDTH + t->pixel[0]]) < 0.5);
    }
    assert_true(probed > 0);
}

static void test_key_writes_a_picture_and_what_made_it(void **state)
{
    fixture *f = *state;
    char png[4200], text[4200];
    nook_settings_file file;
    nook_live_views_set_count(nook_live_state(f->live), 2);
    set_setting(f, 0, "volume rays=5 ao.scale=half");
    set_setting(f, 1, "ssao samples=7");
    for (int i = 1; i <= 2; i++) {
        press(f, NOOK_KEY_F12);
        take_picture(f);
        snprintf(png, sizeof png, "%s/nook_%04d.png", f->pictures, i);
        snprintf(text, sizeof text, "%s/nook_%04d.settings", f->pictures, i);
        int width = 0, height = 0, channels = 0;
        uint8_t *pixels = stbi_load(png, &width, &height, &channels, 3);
        assert_true(pixels && width == WIDTH && height == HEIGHT);
        if (i == 1)
            assert_memory_equal(pixels, f->picture, SIZE); /* later there is a note in it */
        stbi_image_free(pixels);
    }
    assert_int_equal(nook_settings_file_read(text, &file), NOOK_OK);
    char setting[NOOK_SETTING_TEXT_MAX];
    assert_string_equal(nook_setting_print(&file.setting, setting), "volume rays=5 ao.scale=half");
    assert_true(file.r_max == nook_live_state(f->live)->r_max);
    nook_file whole;
    assert_int_equal(nook_file_read(text, &whole), NOOK_OK);
    assert_non_null(strstr((char *)whole.bytes, "ssao samples=7"));
    assert_non_null(strstr((char *)whole.bytes, "--camera "));
    assert_non_null(strstr((char *)whole.bytes, "level of the test"));
    nook_file_free(&whole);
}

static void test_picture_that_cannot_be_written_is_said_and_the_frames_go_on(void **state)
{
    fixture *f = *state;
    nook_log_capture log;
    snprintf(f->live->pictures, sizeof f->live->pictures, "/proc/no such folder");
    nook_log_capture_begin(&log);
    press(f, NOOK_KEY_F12);
    nook_log_capture_end();
    assert_int_equal(log.count, 1);
    assert_non_null(strstr(f->live->note, "could not be written"));
    step(f);
}

static void test_saved_settings_read_back(void **state)
{
    fixture *f = *state;
    nook_settings_file file;
    set_setting(f, 0, "gtao slices=3 ao.scale=quarter");
    nook_live_state(f->live)->falloff = 2.0;
    step(f);
    assert_int_equal(live_save(f->live), NOOK_OK);
    assert_int_equal(nook_settings_file_read(f->settings, &file), NOOK_OK);
    char setting[NOOK_SETTING_TEXT_MAX];
    assert_string_equal(nook_setting_print(&file.setting, setting), "gtao slices=3 ao.scale=quarter");
    assert_string_equal(file.falloff, "quadratic");
    assert_non_null(strstr(f->live->note, f->settings));
    snprintf(f->live->settings_path, sizeof f->live->settings_path, "/proc/no such folder/x");
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_result result = live_save(f->live);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_IO);
}

static void test_captured_frames_are_what_is_seen(void **state)
{
    fixture *f = *state;
    char folder[4096], png[4200];
    nook_scratch_path(folder, sizeof folder, "captured");
    step(f);
    assert_int_equal(nook_live_capture(f->live, &(nook_capture_desc){ .path = folder }), NOOK_OK);
    step(f);
    press(f, NOOK_KEY_2);
    take_picture(f);
    assert_int_equal(nook_live_capture_end(f->live), NOOK_OK);
    step(f);
    int width = 0, height = 0, channels = 0;
    snprintf(png, sizeof png, "%s/frame_000002.png", folder);
    uint8_t *pixels = stbi_load(png, &width, &height, &channels, 3);
    assert_non_null(pixels);
    assert_memory_equal(pixels, f->picture, SIZE);
    stbi_image_free(pixels);
    snprintf(png, sizeof png, "%s/frame_000003.png", folder);
    assert_false(nook_file_exists(png));
}

static void test_stage_may_change_its_size(void **state)
{
    fixture *f = *state;
    nook_live_views_set_count(nook_live_state(f->live), 4);
    nook_live_state(f->live)->views[2].mode = NOOK_LIVE_FETCHES;
    nook_live_state(f->live)->views[3].mode = NOOK_LIVE_OCCLUDERS;
    step(f);
    assert_int_equal(nook_stage_set_size(&f->stage, 90, 70), NOOK_OK);
    step(f);
    assert_int_equal(nook_stage_set_size(&f->stage, WIDTH, HEIGHT), NOOK_OK);
    step(f);
}

/* How many pixels of a part are darker than the scene is there. */
static int count_dark(const fixture *f, uint32_t left, uint32_t right)
{
    int dark = 0;
    for (uint32_t y = 60; y < 250; y++) {
        for (uint32_t x = left; x < right; x++)
            dark += f->picture[((size_t)y * WIDTH + x) * 3] < 60;
    }
    return dark;
}

static void test_times_have_a_panel_of_their_own_only_where_there_is_room(void **state)
{
    fixture *f = *state;
    step(f);
    take_picture(f);
    int before = count_dark(f, 0, 100);
    press(f, NOOK_KEY_F2);
    step(f);
    step(f);
    take_picture(f);
    assert_true(count_dark(f, 120, WIDTH) > 20000);
    assert_true(abs(count_dark(f, 0, 100) - before) < 500);
    f->input.width = 2 * WIDTH; /* of the window: the picture is shown twice as wide */
    uint8_t *wide = malloc((size_t)2 * SIZE);
    step(f);
    step(f);
    assert_int_equal(nook_live_picture(f->live, 2 * WIDTH, HEIGHT, wide), NOOK_OK);
    int dark = 0;
    for (uint32_t y = 60; y < 250; y++) {
        for (uint32_t x = 20; x < 300; x++)
            dark += wide[((size_t)y * 2 * WIDTH + x) * 3] < 60;
    }
    assert_true(dark > 30000);
    free(wide);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(test_one_view_is_the_plain_picture_byte_for_byte),
        TEST(test_views_side_by_side_are_parts_of_the_whole_pictures),
        TEST(test_number_keys_choose_the_technique_of_the_active_view),
        TEST(test_technique_that_is_chosen_again_has_the_parameters_it_had),
        TEST(test_keys_that_are_used_are_taken_from_the_host_and_others_are_not),
        TEST(test_border_follows_the_mouse_and_the_host_gets_nothing_of_it),
        TEST(test_captured_mouse_moves_no_borders),
        TEST(test_every_mode_draws_something_of_its_own),
        TEST(test_slider_of_the_panel_changes_a_parameter_and_undo_takes_it_back),
        TEST(test_mouse_over_a_panel_is_not_the_host_s),
        TEST(test_messages_stay_until_they_are_taken_back),
        TEST(test_setting_that_cannot_be_read_any_more_becomes_its_technique),
        TEST(test_size_of_the_window_may_differ_from_the_picture_s),
        TEST(test_frozen_frame_stays_whatever_the_camera_does),
        TEST(test_errors_of_views_are_those_of_the_pictures),
        TEST(test_reference_s_view_shows_the_truth_as_it_comes),
        TEST(test_truth_follows_the_reach_that_is_changed),
        TEST(test_frame_of_another_size_is_frozen_anew),
        TEST(test_probe_tells_of_the_pixel_under_the_mouse),
        TEST(test_key_writes_a_picture_and_what_made_it),
        TEST(test_picture_that_cannot_be_written_is_said_and_the_frames_go_on),
        TEST(test_saved_settings_read_back),
        TEST(test_captured_frames_are_what_is_seen),
        TEST(test_stage_may_change_its_size),
        TEST(test_times_have_a_panel_of_their_own_only_where_there_is_room),
    };
    return cmocka_run_group_tests(tests, open_stage, close_stage);
}
