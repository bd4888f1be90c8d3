#include "engine/gpu/gpu.h"
#include "engine/platform/context.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_display.h"
#include "tests/support/test_gpu.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h> /* wants those above first */

#define TITLE "nook window test"

/* What the environment said before the tests. */
typedef struct saved_environment {
    char display[256], wayland[256];
} saved_environment;

static void take_displays_away(saved_environment *out_saved)
{
    const char *display = getenv("DISPLAY"), *wayland = getenv("WAYLAND_DISPLAY");
    snprintf(out_saved->display, sizeof out_saved->display, "%s", display ? display : "");
    snprintf(out_saved->wayland, sizeof out_saved->wayland, "%s", wayland ? wayland : "");
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
}

static void give_displays_back(const saved_environment *saved)
{
    unsetenv("DISPLAY");
    if (saved->display[0])
        setenv("DISPLAY", saved->display, 1);
    if (saved->wayland[0])
        setenv("WAYLAND_DISPLAY", saved->wayland, 1);
}

static test_display *display_of(void **state)
{
    test_display *display = *state;
    const char *name = getenv("DISPLAY");
    if (!name || !*name) {
        print_message("no DISPLAY and no Xvfb: the window is not tested\n");
        skip();
    }
    return display;
}

static int open_display(void **state)
{
    test_display *display = calloc(1, sizeof *display);
    if (!display)
        return -1;
    test_display_open(display);
    *state = display;
    return 0;
}

static int close_display(void **state)
{
    test_display_close(*state);
    free(*state);
    return 0;
}

static nook_context *open_window(bool hidden)
{
    nook_context *context = NULL;
    const nook_context_desc desc = {
        .backend = NOOK_BACKEND_WINDOW, .width = 320, .height = 200, .title = TITLE, .hidden = hidden
    };
    assert_int_equal(nook_context_create(&desc, &context), NOOK_OK);
    return context;
}

static void test_window_without_a_display_says_what_to_do(void **state)
{
    (void)state;
    saved_environment saved = { 0 };
    nook_log_capture log;
    nook_context *context = (nook_context *)&log;
    take_displays_away(&saved);
    nook_log_capture_begin(&log);
    nook_result result = nook_context_create(&(nook_context_desc){ .backend = NOOK_BACKEND_WINDOW }, &context);
    nook_log_capture_end();
    give_displays_back(&saved);
    assert_int_equal(result, NOOK_E_DEVICE);
    assert_null(context);
    assert_int_equal(log.count, 1);
    assert_string_equal(log.text, "window: no display (DISPLAY and WAYLAND_DISPLAY are not set); use --backend osmesa");
}

static void test_automatic_choice_without_a_display_is_silent_and_headless(void **state)
{
    (void)state;
    saved_environment saved = { 0 };
    nook_log_capture log;
    nook_context *context = NULL;
    take_displays_away(&saved);
    nook_log_capture_begin(&log);
    nook_result result = nook_context_create(&(nook_context_desc){ .want_window = true }, &context);
    nook_log_capture_end();
    give_displays_back(&saved);
    assert_int_equal(result, NOOK_OK);
    assert_int_not_equal(nook_context_backend(context), NOOK_BACKEND_WINDOW);
    assert_int_equal(log.count, 0);
    nook_context_destroy(context);
}

static void test_automatic_choice_with_a_dead_display_warns_and_goes_on(void **state)
{
    (void)state;
    saved_environment saved = { 0 };
    nook_log_capture log;
    nook_context *context = NULL;
    take_displays_away(&saved);
    setenv("DISPLAY", ":60999", 1);
    nook_log_capture_begin(&log);
    nook_result result = nook_context_create(&(nook_context_desc){ .want_window = true }, &context);
    nook_log_capture_end();
    give_displays_back(&saved);
    assert_int_equal(result, NOOK_OK);
    assert_int_not_equal(nook_context_backend(context), NOOK_BACKEND_WINDOW);
    assert_int_equal(log.count, 1);
    assert_int_equal(log.level, NOOK_LOG_WARNING);
    assert_non_null(strstr(log.text, ":60999"));
    nook_context_destroy(context);
}

static void test_window_shows_what_was_drawn(void **state)
{
    display_of(state);
    nook_context *context = open_window(true);
    nook_gpu *gpu = NULL;
    nook_input input;
    const float orange[4] = { 1, 0.5f, 0, 1 };
    uint8_t pixel[4] = { 0 };
    assert_int_equal(nook_context_backend(context), NOOK_BACKEND_WINDOW);
    assert_int_equal(nook_gpu_create(&(nook_gpu_desc){ .get_proc = nook_context_get_proc(context),
                                                       .source_root = test_gpu_root(),
                                                       .log_debug_output = true },
                                     &gpu),
                     NOOK_OK);
    nook_context_poll(context, &input);
    assert_int_equal(input.width, 320);
    assert_int_equal(input.height, 200);
    assert_false(input.close_requested);
    nook_framebuffer_bind(gpu, (nook_framebuffer){ .id = 0, .width = input.width, .height = input.height });
    gpu->gl->ClearBufferfv(GL_COLOR, 0, orange);
    gpu->gl->ReadPixels(100, 100, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    assert_int_equal(pixel[0], 255);
    assert_in_range(pixel[1], 127, 128);
    assert_int_equal(pixel[2], 0);
    nook_context_present(context);
    assert_false(nook_gpu_check(gpu, "the test"));
    nook_gpu_destroy(gpu);
    nook_context_destroy(context);
}

static void test_window_and_headless_contexts_follow_one_another(void **state)
{
    display_of(state);
    for (int i = 0; i < 2; i++) {
        test_gpu headless;
        nook_context *window = open_window(true);
        nook_context_destroy(window);
        assert_int_equal(test_gpu_create(NULL, &headless), NOOK_OK);
        test_gpu_destroy(&headless);
    }
}

static void test_ending_an_older_window_leaves_the_current_one_alive(void **state)
{
    display_of(state);
    nook_context *first = open_window(true), *second = open_window(true);
    nook_gpu *gpu = NULL;
    nook_context_destroy(first);
    assert_int_equal(nook_gpu_create(&(nook_gpu_desc){ .get_proc = nook_context_get_proc(second),
                                                       .source_root = test_gpu_root(),
                                                       .log_debug_output = true },
                                     &gpu),
                     NOOK_OK);
    assert_false(nook_gpu_check(gpu, "the test"));
    nook_gpu_destroy(gpu);
    nook_context_destroy(second);
}

/* Sends input by xdotool; the window must be focused first, there is no window manager to do it. */
static void send_input(const char *arguments)
{
    char command[512];
    snprintf(command, sizeof command, "xdotool search --sync --name '" TITLE " with input' windowfocus --sync %s",
             arguments);
    if (system(command) != 0)
        fail_msg("failed: %s", command);
}

/* Events take their time through the server: polls until one of them says so, and keeps the last input. */
#define poll_until(context, input, condition)           \
    do {                                                \
        int tries = 0;                                  \
        do {                                            \
            if (tries++ == 500)                         \
                fail_msg("never seen: %s", #condition); \
            usleep(10000);                              \
            nook_context_poll(context, input);          \
        } while (!(condition));                         \
    } while (0)

static void test_input_reaches_the_program(void **state)
{
    display_of(state);
    if (system("command -v xdotool >/dev/null") != 0) {
        print_message("no xdotool: the window's input is not tested\n");
        skip();
    }
    nook_context *context = open_window(true);
    nook_input input;
    nook_context_show(context);
    nook_context_set_title(context, TITLE " with input");
    nook_context_present(context);
    nook_context_poll(context, &input);

    send_input("key w"); /* down and up again before the poll */
    poll_until(context, &input, input.pressed[NOOK_KEY_W]);
    nook_context_poll(context, &input);
    assert_false(input.pressed[NOOK_KEY_W]);
    assert_false(input.down[NOOK_KEY_W]);

    send_input("keydown Shift_R key 3");
    poll_until(context, &input, input.pressed[NOOK_KEY_3]);
    assert_true(input.down[NOOK_KEY_SHIFT]);
    send_input("keyup Shift_R");
    poll_until(context, &input, !input.down[NOOK_KEY_SHIFT]);

    send_input("mousemove --window %1 100 50");
    poll_until(context, &input, input.mouse_x > 99.5 && input.mouse_x < 100.5);
    send_input("mousemove --window %1 130 40 mousedown 1");
    poll_until(context, &input, input.mouse_down[0]);
    assert_true(input.mouse_x > 129.5 && input.mouse_x < 130.5 && input.mouse_y > 39.5 && input.mouse_y < 40.5);
    nook_context_poll(context, &input);
    assert_true(input.mouse_dx > -0.5 && input.mouse_dx < 0.5);
    send_input("mouseup 1 click 4");
    poll_until(context, &input, input.scroll > 0);
    assert_false(input.mouse_down[0]);
    assert_false(input.mouse_pressed[0]);
    send_input("click 1"); /* down and up again before the poll */
    poll_until(context, &input, input.mouse_pressed[0]);
    send_input("key a");
    poll_until(context, &input, input.typed[0] == 'a');
    assert_int_equal(input.typed[1], 0);
    send_input("key F12");
    poll_until(context, &input, input.pressed[NOOK_KEY_F12]);
    assert_true(input.content_scale > 0.0);
    assert_false(input.pad.present);
    nook_context_destroy(context);
}

static void test_full_screen_covers_the_monitor_and_gives_the_window_its_size_back(void **state)
{
    display_of(state);
    nook_context *context = open_window(false);
    nook_input input;
    nook_context_poll(context, &input);
    nook_context_set_fullscreen(context, true);
    poll_until(context, &input, input.width > 320 && input.height > 200);
    nook_context_set_fullscreen(context, true); /* it does already */
    nook_context_set_fullscreen(context, false);
    poll_until(context, &input, input.width == 320 && input.height == 200);
    nook_context_destroy(context);
}

static void test_a_captured_mouse_moves_further_than_the_window_reaches(void **state)
{
    display_of(state);
    if (system("command -v xdotool >/dev/null") != 0) {
        print_message("no xdotool: the window's input is not tested\n");
        skip();
    }
    nook_context *context = open_window(true);
    nook_input input;
    double moved = 0.0;
    nook_context_show(context);
    nook_context_set_title(context, TITLE " with input");
    nook_context_present(context);
    send_input("key w");
    nook_context_poll(context, &input);
    nook_context_capture_mouse(context, true);
    nook_context_poll(context, &input);
    assert_true(input.mouse_dx == 0.0); /* no jump */
    for (int i = 0; i < 12 && moved < 500.0; i++) {
        send_input("mousemove_relative -- 90 0");
        usleep(50000);
        nook_context_poll(context, &input);
        moved += input.mouse_dx;
    }
    assert_true(moved >= 500.0); /* of a window of 320 */
    nook_context_capture_mouse(context, false);
    nook_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_window_without_a_display_says_what_to_do),
        cmocka_unit_test(test_automatic_choice_without_a_display_is_silent_and_headless),
        cmocka_unit_test(test_automatic_choice_with_a_dead_display_warns_and_goes_on),
        cmocka_unit_test(test_window_shows_what_was_drawn),
        cmocka_unit_test(test_window_and_headless_contexts_follow_one_another),
        cmocka_unit_test(test_ending_an_older_window_leaves_the_current_one_alive),
        cmocka_unit_test(test_input_reaches_the_program),
        cmocka_unit_test(test_full_screen_covers_the_monitor_and_gives_the_window_its_size_back),
        cmocka_unit_test(test_a_captured_mouse_moves_further_than_the_window_reaches),
    };
    return cmocka_run_group_tests_name("window", tests, open_display, close_display);
}
