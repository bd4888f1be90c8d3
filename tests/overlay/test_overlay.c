/* The overlay without a window: widgets are drawn on OSMesa and answer made-up input. */
#include "engine/overlay/overlay.h"
#include "tests/support/scratch.h"
#include "tests/support/test_gpu.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 320, HEIGHT = 240 };

/* An overlay over a grey picture, and what a panel of it holds. */
typedef struct fixture {
    test_gpu gpu;
    nook_overlay *overlay;
    nook_texture image;
    nook_framebuffer target;
    nook_input input;
    nook_overlay_taken taken;
    double reach, fraction;
    int rays, choice, pressed, settled;
    bool on, open, pad;
    char text[32];
    double place[8][4]; /* of the widgets, in order */
    uint8_t (*pixels)[4];
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    if (!f || test_gpu_create(NULL, &f->gpu) != NOOK_OK || nook_overlay_create(f->gpu.gpu, &f->overlay) != NOOK_OK)
        return -1;
    f->reach = 1.0, f->fraction = 0.5, f->rays = 8, f->open = true;
    f->input.mouse_x = f->input.mouse_y = -1.0;
    f->pixels = malloc(WIDTH * HEIGHT * 4);
    return nook_texture_create_2d(f->gpu.gpu, GL_RGBA8, WIDTH, HEIGHT, GL_NEAREST, &f->image) != NOOK_OK ||
           nook_framebuffer_create(f->gpu.gpu, &f->image, 1, (nook_texture){ 0 }, &f->target) != NOOK_OK;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    bool wrong = nook_gpu_check(f->gpu.gpu, "the overlay");
    nook_overlay_destroy(f->overlay);
    nook_framebuffer_destroy(f->gpu.gpu, &f->target);
    nook_texture_destroy(f->gpu.gpu, &f->image);
    test_gpu_destroy(&f->gpu);
    free(f->pixels);
    free(f);
    return wrong;
}

static void show_panel(fixture *f)
{
    nook_overlay *o = f->overlay;
    const nook_overlay_panel panel = { .title = f->pad ? "Volume##pad" : "Volume",
                                       .x = 10,
                                       .y = 10,
                                       .width = 18,
                                       .height = 14,
                                       .pad = f->pad,
                                       .open = &f->open };
    int i = 0;
    if (nook_overlay_panel_begin(o, &panel)) {
        nook_overlay_slider(o, "fraction", &f->fraction, 0.0, 1.0, "%");
        f->settled += nook_overlay_settled(o);
        nook_overlay_place(o, f->place[i++]);
        nook_overlay_slider_logarithmic(o, "reach", &f->reach, 0.01, 100.0, "m");
        nook_overlay_place(o, f->place[i++]);
        nook_overlay_slider_int(o, "rays", &f->rays, 1, 64, "");
        nook_overlay_place(o, f->place[i++]);
        nook_overlay_choice(o, "scale", &f->choice, "full|half|quarter");
        nook_overlay_place(o, f->place[i++]);
        nook_overlay_checkbox(o, "count", &f->on);
        nook_overlay_place(o, f->place[i++]);
        f->pressed += nook_overlay_button(o, "reset");
        nook_overlay_place(o, f->place[i++]);
        nook_overlay_input(o, "path", f->text, sizeof f->text);
        nook_overlay_place(o, f->place[i++]);
    }
    nook_overlay_panel_end(o);
}

enum { FRACTION, REACH, RAYS, SCALE, COUNT, RESET, PATH };

/* One frame of the overlay with the input as it is. */
static void step(fixture *f)
{
    const nook_overlay_frame frame = { WIDTH, HEIGHT, 1.0, 0.02, &f->input };
    f->taken = nook_overlay_begin(f->overlay, &frame);
    show_panel(f);
    nook_overlay_end(f->overlay);
    memset(f->input.pressed, 0, sizeof f->input.pressed);
    memset(f->input.mouse_pressed, 0, sizeof f->input.mouse_pressed);
    memset(f->input.typed, 0, sizeof f->input.typed);
}

static void draw(fixture *f)
{
    const float grey[4] = { 0.5f, 0.5f, 0.5f, 1.0f };
    f->gpu.gpu->gl->ClearNamedFramebufferfv(f->target.id, GL_COLOR, 0, grey);
    assert_int_equal(nook_overlay_draw(f->overlay, f->target), NOOK_OK);
    nook_texture_read(f->gpu.gpu, f->image, GL_RGBA, GL_UNSIGNED_BYTE, f->pixels, WIDTH * HEIGHT * 4);
}

/* From the top left. */
static const uint8_t *pixel(const fixture *f, int x, int y)
{
    return f->pixels[(HEIGHT - 1 - y) * WIDTH + x];
}

static bool is_grey(const uint8_t p[4])
{
    return abs(p[0] - 128) <= 1 && abs(p[1] - 128) <= 1 && abs(p[2] - 128) <= 1;
}

/* Moves the mouse to a part of a widget's width, and lets ImGui see it there. */
static void point_at(fixture *f, int widget, double part)
{
    f->input.mouse_x = f->place[widget][0] + part * f->place[widget][2];
    f->input.mouse_y = f->place[widget][1] + 0.5 * f->place[widget][3];
    step(f);
}

static void click(fixture *f)
{
    f->input.mouse_down[0] = true;
    step(f);
    f->input.mouse_down[0] = false;
    step(f);
}

static void test_panel_is_drawn_over_the_picture_and_nothing_beside_it(void **state)
{
    fixture *f = *state;
    step(f);
    step(f); /* sizes of a panel are known from its second frame on */
    draw(f);
    assert_true(is_grey(pixel(f, 3, 3)) && is_grey(pixel(f, WIDTH - 3, HEIGHT - 3)));
    int dark = 0, light = 0;
    for (int y = 12; y < 200; y++) {
        for (int x = 12; x < 250; x++) {
            dark += pixel(f, x, y)[0] < 80;
            light += pixel(f, x, y)[0] > 180 && pixel(f, x, y)[2] > 180; /* letters */
        }
    }
    assert_true(dark > 20000);
    assert_true(light > 300);
}

static void test_same_widgets_are_the_same_picture_in_every_target(void **state)
{
    fixture *f = *state;
    step(f);
    step(f);
    draw(f);
    uint8_t(*first)[4] = malloc(WIDTH * HEIGHT * 4);
    memcpy(first, f->pixels, WIDTH * HEIGHT * 4);
    draw(f);
    assert_memory_equal(first, f->pixels, WIDTH * HEIGHT * 4);
    free(first);
}

static void test_slider_that_is_dragged_changes_its_number_and_settles_once(void **state)
{
    fixture *f = *state;
    step(f);
    step(f);
    point_at(f, FRACTION, 0.2);
    assert_true(f->taken.mouse);
    f->input.mouse_down[0] = true;
    step(f);
    double grabbed = f->fraction;
    assert_true(grabbed > 0.1 && grabbed < 0.4);
    point_at(f, FRACTION, 0.45);
    assert_true(f->fraction > grabbed + 0.1);
    assert_int_equal(f->settled, 0);
    f->input.mouse_down[0] = false;
    step(f);
    step(f);
    assert_int_equal(f->settled, 1);
}

static void test_logarithmic_slider_gives_every_decade_the_same_way(void **state)
{
    fixture *f = *state;
    step(f);
    step(f);
    double widget = f->place[REACH][2];
    point_at(f, REACH, 0.02);
    f->input.mouse_down[0] = true;
    step(f);
    double low = f->reach;
    f->input.mouse_x += widget * 0.16;
    step(f);
    double middle = f->reach;
    f->input.mouse_x += widget * 0.16;
    step(f);
    double high = f->reach;
    assert_true(low < middle && middle < high);
    double first = middle / low, second = high / middle;
    assert_true(first > 2.0 && first / second > 0.5 && first / second < 2.0);
}

static void test_click_with_control_types_a_number(void **state)
{
    fixture *f = *state;
    step(f);
    step(f);
    point_at(f, RAYS, 0.2);
    f->input.down[NOOK_KEY_CONTROL] = true;
    click(f);
    f->input.down[NOOK_KEY_CONTROL] = false;
    step(f);
    assert_true(f->taken.keys);
    f->input.down[NOOK_KEY_CONTROL] = f->input.down[NOOK_KEY_A] = true; /* all of it, to be replaced */
    step(f);
    f->input.down[NOOK_KEY_CONTROL] = f->input.down[NOOK_KEY_A] = false;
    f->input.typed[0] = '3', f->input.typed[1] = '2';
    step(f);
    f->input.pressed[NOOK_KEY_ENTER] = true;
    step(f);
    step(f);
    step(f); /* what is typed into is known a frame later */
    assert_int_equal(f->rays, 32);
    assert_false(f->taken.keys);
}

static void test_choice_opens_a_list_and_takes_what_is_clicked(void **state)
{
    fixture *f = *state;
    step(f);
    step(f);
    point_at(f, SCALE, 0.2);
    click(f);
    f->input.mouse_y += 2.6 * nook_overlay_letter_height(f->overlay); /* the list lies below: its second row */
    step(f);
    step(f);
    click(f);
    step(f);
    assert_int_equal(f->choice, 1);
}

static void test_button_and_checkbox_answer_a_click_shorter_than_a_frame(void **state)
{
    fixture *f = *state;
    step(f);
    step(f);
    point_at(f, RESET, 0.5);
    f->input.mouse_pressed[0] = true; /* down and up again between two polls */
    step(f);
    step(f);
    assert_int_equal(f->pressed, 1);
    point_at(f, COUNT, 0.1);
    click(f);
    assert_true(f->on);
}

/* Presses a button of the gamepad for a frame, and lets go of it for one. */
static void press_pad(fixture *f, nook_pad_button button)
{
    f->input.pad.down[button] = true;
    step(f);
    f->input.pad.down[button] = false;
    step(f);
}

static void test_a_gamepad_reaches_panels_that_take_it_and_no_others(void **state)
{
    fixture *f = *state;
    f->input.pad.present = true;
    for (int takes = 0; takes < 2; takes++) {
        f->pad = takes != 0;
        f->on = false;
        f->pressed = 0;
        for (int i = 0; i < 3; i++)
            step(f);
        for (int i = 0; i < COUNT; i++) /* from the first widget on */
            press_pad(f, NOOK_PAD_DOWN);
        press_pad(f, NOOK_PAD_SOUTH);
        assert_int_equal(f->on, takes);
        f->input.pad.left[1] = -1.0; /* a stick does it too */
        step(f);
        f->input.pad.left[1] = 0.0;
        step(f);
        press_pad(f, NOOK_PAD_SOUTH);
        assert_int_equal(f->pressed, takes);
        assert_true(f->fraction == 0.5 && f->rays == 8);
    }
}

static void test_letters_go_where_the_cursor_is(void **state)
{
    fixture *f = *state;
    step(f);
    step(f);
    assert_false(f->taken.keys);
    point_at(f, PATH, 0.2);
    click(f);
    assert_true(f->taken.keys);
    f->input.typed[0] = 'a', f->input.typed[1] = 0xe4 /* a with dots */;
    step(f);
    f->input.pressed[NOOK_KEY_BACKSPACE] = true;
    step(f);
    assert_string_equal(f->text, "a");
}

static void test_mouse_beside_a_panel_is_not_taken(void **state)
{
    fixture *f = *state;
    step(f);
    f->input.mouse_x = WIDTH - 5.0, f->input.mouse_y = HEIGHT - 5.0;
    step(f);
    step(f);
    assert_false(f->taken.mouse);
    assert_false(nook_overlay_busy(f->overlay));
}

static void test_denser_displays_get_larger_letters(void **state)
{
    fixture *f = *state;
    step(f);
    double small = nook_overlay_letter_height(f->overlay);
    const nook_overlay_frame frame = { WIDTH, HEIGHT, 2.0, 0.02, NULL };
    nook_overlay_begin(f->overlay, &frame);
    show_panel(f);
    nook_overlay_end(f->overlay);
    draw(f);
    assert_true(nook_overlay_letter_height(f->overlay) > 1.9 * small);
}

static void test_lines_and_labels_lie_where_they_are_put(void **state)
{
    fixture *f = *state;
    const nook_overlay_frame frame = { WIDTH, HEIGHT, 1.0, 0.02, NULL };
    const nook_overlay_colour red = { 255, 0, 0, 255 }, white = { 255, 255, 255, 255 };
    nook_overlay_begin(f->overlay, &frame);
    nook_overlay_rectangle(f->overlay, (double[]){ 100, 50 }, (double[]){ 120, 60 }, red);
    nook_overlay_line(f->overlay, (double[]){ 200.5, 0 }, (double[]){ 200.5, HEIGHT }, white, 1.0);
    nook_overlay_label(f->overlay, (double[]){ 10, 200 }, white, "gtao");
    nook_overlay_end(f->overlay);
    draw(f);
    assert_true(pixel(f, 110, 55)[0] == 255 && pixel(f, 110, 55)[1] == 0);
    assert_true(is_grey(pixel(f, 110, 62)) && is_grey(pixel(f, 122, 55)));
    assert_true(pixel(f, 200, 120)[1] > 240 && is_grey(pixel(f, 203, 120)));
    assert_true(pixel(f, 12, 202)[0] < 80);
}

/* Frames of a target of that size with a line of text in a panel at (x, y). @return where the text is */
static void show_line(fixture *f, uint32_t width, uint32_t height, const nook_overlay_panel *panel, double out_place[4])
{
    const nook_overlay_frame frame = { width, height, 1.0, 0.02, NULL };
    for (int i = 0; i < 4; i++) {
        nook_overlay_begin(f->overlay, &frame);
        nook_overlay_panel_begin(f->overlay, panel);
        nook_overlay_text(f->overlay, "a line of text");
        nook_overlay_place(f->overlay, out_place);
        nook_overlay_panel_end(f->overlay);
        nook_overlay_end(f->overlay);
    }
}

static int count_letters(fixture *f)
{
    int count = 0;
    draw(f);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        count += f->pixels[i][0] > 160;
    return count;
}

static void test_panels_are_kept_within_the_target_and_whole(void **state)
{
    fixture *f = *state;
    double place[4];
    for (int bare = 0; bare < 2; bare++) {
        const nook_overlay_panel inside = { .title = "##inside", .x = 20, .y = 20, .bare = bare };
        const nook_overlay_panel low = { .title = "##low", .x = WIDTH - 10, .y = HEIGHT - 5, .bare = bare };
        const nook_overlay_panel left = { .title = "##left", .x = 20 - WIDTH, .y = -10, .bare = bare };
        show_line(f, WIDTH, HEIGHT, &inside, place);
        int letters = count_letters(f);
        assert_true(letters > 50);
        show_line(f, WIDTH, HEIGHT, &low, place);
        assert_true(place[0] + place[2] <= WIDTH && place[1] + place[3] <= HEIGHT);
        assert_int_equal(count_letters(f), letters);
        show_line(f, WIDTH, HEIGHT, &left, place);
        assert_true(place[0] >= 0.0 && place[1] + place[3] <= HEIGHT);
        assert_int_equal(count_letters(f), letters);
        show_line(f, WIDTH - 100, HEIGHT - 100, &low, place); /* the target has become smaller */
        assert_true(place[0] + place[2] <= WIDTH - 100 && place[1] + place[3] <= HEIGHT - 100);
    }
}

static void test_wrapped_text_is_no_wider_than_a_panel_that_a_small_target_made_narrow(void **state)
{
    fixture *f = *state;
    const nook_overlay_frame frame = { WIDTH - 120, HEIGHT, 1.0, 0.02, NULL };
    double place[4];
    for (int tall = 0; tall < 2; tall++) {
        const nook_overlay_panel panel = { .title = "##narrow", .x = 10, .y = 10, .width = 26, .height = 6 };
        for (int i = 0; i < 4; i++) {
            nook_overlay_begin(f->overlay, &frame);
            nook_overlay_panel_begin(f->overlay, &panel);
            for (int line = 0; line < 20 * tall; line++)
                nook_overlay_text(f->overlay, "more than there is room for"); /* so that it gets a scroll bar */
            nook_overlay_text_wrapped(f->overlay, 24.0, "words that are to be read to the end of each of their lines");
            nook_overlay_place(f->overlay, place);
            nook_overlay_panel_end(f->overlay);
            nook_overlay_end(f->overlay);
        }
        assert_true(place[0] >= 0.0 && place[0] + place[2] <= WIDTH - 120 - (tall ? 20 : 0));
        assert_true(place[3] > 20.0); /* in lines */
    }
}

static void test_panel_in_a_target_of_another_size_is_put_and_sized_as_at_first(void **state)
{
    fixture *f = *state;
    const nook_overlay_panel right = { .title = "##right", .x = -10, .y = 10, .width = 10, .height = 6 };
    double wide[4], narrow[4], again[4];
    show_line(f, WIDTH, HEIGHT, &right, wide);
    show_line(f, WIDTH - 120, HEIGHT, &right, narrow);
    assert_true(narrow[0] == wide[0] - 120.0 && narrow[1] == wide[1]);
    show_line(f, WIDTH, HEIGHT, &right, again);
    assert_memory_equal(wide, again, sizeof wide);
}

static void test_lines_end_at_spaces_where_they_fit(void **state)
{
    fixture *f = *state;
    const nook_overlay_frame frame = { WIDTH, HEIGHT, 1.0, 0.02, NULL };
    double size[2];
    nook_overlay_begin(f->overlay, &frame);
    nook_overlay_label_size(f->overlay, "one two", size);
    assert_int_equal(nook_overlay_line_length(f->overlay, "one two three", size[0]), 7);
    assert_int_equal(nook_overlay_line_length(f->overlay, "one two three", size[0] - 1.0), 3);
    assert_int_equal(nook_overlay_line_length(f->overlay, "one two", size[0]), 7);
    assert_int_equal(nook_overlay_line_length(f->overlay, "immeasurable", 5.0), 12); /* a word is not cut */
    assert_int_equal(nook_overlay_line_length(f->overlay, "", 5.0), 0);
    nook_overlay_end(f->overlay);
}

static void test_frame_begun_twice_forgets_the_first(void **state)
{
    fixture *f = *state;
    const nook_overlay_frame frame = { WIDTH, HEIGHT, 1.0, 0.02, NULL };
    nook_overlay_begin(f->overlay, &frame);
    show_panel(f);
    nook_overlay_begin(f->overlay, &frame);
    nook_overlay_end(f->overlay);
    nook_overlay_end(f->overlay); /* of nothing */
    draw(f);
    assert_true(is_grey(pixel(f, 50, 50)));
}

static void test_two_overlays_do_not_disturb_each_other(void **state)
{
    fixture *f = *state;
    nook_overlay *other = NULL;
    const nook_overlay_frame frame = { WIDTH, HEIGHT, 1.0, 0.02, NULL };
    assert_int_equal(nook_overlay_create(f->gpu.gpu, &other), NOOK_OK);
    step(f);
    nook_overlay_begin(other, &frame);
    nook_overlay_end(other);
    step(f);
    nook_overlay_destroy(other);
    draw(f);
    assert_true(pixel(f, 60, 100)[0] < 100);
}

static void test_overlay_without_its_shaders_says_which_is_missing(void **state)
{
    (void)state;
    char empty[4096];
    test_gpu gpu;
    nook_overlay *overlay = (nook_overlay *)&gpu;
    assert_int_equal(test_gpu_create(nook_scratch_path(empty, sizeof empty, "no_such_folder"), &gpu), NOOK_OK);
    assert_int_equal(nook_overlay_create(gpu.gpu, &overlay), NOOK_E_NOT_FOUND);
    assert_null(overlay);
    nook_overlay_destroy(NULL);
    test_gpu_destroy(&gpu);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(test_panel_is_drawn_over_the_picture_and_nothing_beside_it),
        TEST(test_same_widgets_are_the_same_picture_in_every_target),
        TEST(test_slider_that_is_dragged_changes_its_number_and_settles_once),
        TEST(test_logarithmic_slider_gives_every_decade_the_same_way),
        TEST(test_click_with_control_types_a_number),
        TEST(test_choice_opens_a_list_and_takes_what_is_clicked),
        TEST(test_button_and_checkbox_answer_a_click_shorter_than_a_frame),
        TEST(test_a_gamepad_reaches_panels_that_take_it_and_no_others),
        TEST(test_letters_go_where_the_cursor_is),
        TEST(test_mouse_beside_a_panel_is_not_taken),
        TEST(test_denser_displays_get_larger_letters),
        TEST(test_lines_and_labels_lie_where_they_are_put),
        TEST(test_panels_are_kept_within_the_target_and_whole),
        TEST(test_wrapped_text_is_no_wider_than_a_panel_that_a_small_target_made_narrow),
        TEST(test_panel_in_a_target_of_another_size_is_put_and_sized_as_at_first),
        TEST(test_lines_end_at_spaces_where_they_fit),
        TEST(test_frame_begun_twice_forgets_the_first),
        TEST(test_two_overlays_do_not_disturb_each_other),
        cmocka_unit_test(test_overlay_without_its_shaders_says_which_is_missing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
