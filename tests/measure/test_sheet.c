#include "engine/core/file.h"
#include "modules/measure/colour_map.h"
#include "modules/measure/sheet.h"
#include "modules/measure/text.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static nook_font *load_font(void)
{
    nook_font *font;
    if (!nook_file_exists("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")) {
        print_message("skipped: the package fonts-dejavu-core is not installed\n");
        skip();
    }
    assert_int_equal(nook_font_load(NOOK_FONT_REGULAR, &font), NOOK_OK);
    return font;
}

static void test_text_width_grows_with_size_and_letters(void **state)
{
    (void)state;
    nook_font *font = load_font();
    int one = nook_text_width(font, 16.0f, "n"), ten = nook_text_width(font, 16.0f, "nnnnnnnnnn");
    assert_true(one > 4 && one < 16);
    assert_true(abs(ten - 10 * one) <= 10);
    assert_true(abs(nook_text_width(font, 32.0f, "nnnnnnnnnn") - 2 * ten) <= 2);
    assert_int_equal(nook_text_width(font, 16.0f, ""), 0);
    assert_int_equal(nook_text_width(font, 16.0f, "\xc3\xa9"), nook_text_width(font, 16.0f, "e"));
    assert_true(nook_text_width(font, 16.0f, "\xff\xc3") > 0); /* not UTF-8 */
    nook_font_destroy(font);
}

static void test_text_is_drawn_inside_its_line(void **state)
{
    (void)state;
    nook_font *font = load_font();
    nook_picture picture;
    assert_int_equal(nook_picture_create(200, 60, &picture), NOOK_OK);
    int end = nook_text_draw(&picture, font, 20.0f, 10, 20, (nook_rgb){ 255, 255, 255 }, "Agjyl");
    assert_int_equal(end, 10 + nook_text_width(font, 20.0f, "Agjyl"));
    unsigned inside = 0, outside = 0;
    for (uint32_t i = 0; i < 200 * 60; i++) {
        uint32_t x = i % 200, y = i / 200;
        unsigned lit = picture.pixels[i].r > 0;
        if (x >= 9 && x <= (uint32_t)end && y >= 20 && y < 40)
            inside += lit;
        else
            outside += lit;
    }
    assert_true(inside > 100);
    assert_int_equal(outside, 0);
    nook_text_draw(&picture, font, 20.0f, -30, -10, (nook_rgb){ 255, 255, 255 }, "over the edges of the picture");
    nook_picture_free(&picture);
    nook_font_destroy(font);
}

static void test_text_breaks_at_spaces_and_always_moves_on(void **state)
{
    (void)state;
    nook_font *font = load_font();
    const char *text = "one two three";
    int two_words = nook_text_width(font, 16.0f, "one two");
    assert_int_equal(nook_text_fit(font, 16.0f, text, 1000), strlen(text));
    assert_int_equal(nook_text_fit(font, 16.0f, text, two_words + 2), strlen("one two"));
    assert_int_equal(nook_text_fit(font, 16.0f, text, 1), 1);
    int half = nook_text_fit(font, 16.0f, "abcdefgh", nook_text_width(font, 16.0f, "abcd") + 1);
    assert_int_equal(half, 4);
    nook_font_destroy(font);
}

static void test_font_load_refuses_what_is_no_font(void **state)
{
    (void)state;
    char path[] = "/tmp/nook_test_font_XXXXXX";
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    nook_font *font;
    assert_int_equal(nook_font_load_file(path, &font), NOOK_E_FORMAT);
    assert_null(font);
    assert_int_equal(nook_file_write(path, "neither a font nor a short file", 31), NOOK_OK);
    assert_int_equal(nook_font_load_file(path, &font), NOOK_E_FORMAT);
    unlink(path);
    assert_int_equal(nook_font_load_file(path, &font), NOOK_E_NOT_FOUND);
    assert_null(font);
}

typedef struct panels {
    nook_picture lit, visibility, error;
} panels;

static panels make_panels(uint32_t width, uint32_t height)
{
    panels p;
    assert_int_equal(nook_picture_create(width, height, &p.lit), NOOK_OK);
    assert_int_equal(nook_picture_create(width, height, &p.visibility), NOOK_OK);
    assert_int_equal(nook_picture_create(width, height, &p.error), NOOK_OK);
    nook_picture_fill(&p.lit, 0, 0, (int)width, (int)height, (nook_rgb){ 250, 10, 20 });
    nook_picture_fill(&p.visibility, 0, 0, (int)width, (int)height, (nook_rgb){ 10, 250, 20 });
    nook_picture_fill(&p.error, 0, 0, (int)width, (int)height, (nook_rgb){ 10, 20, 250 });
    return p;
}

static void free_panels(panels *p)
{
    nook_picture_free(&p->lit);
    nook_picture_free(&p->visibility);
    nook_picture_free(&p->error);
}

static nook_picture draw_sheet(const panels *p, uint32_t row_count)
{
    static const nook_sheet_fact facts[] = { { "time", "12.34 ms" }, { "RMSE", "0.0123" } };
    static const char *const lines[] = { "one line", "another line" };
    nook_sheet_row rows[8] = { 0 };
    for (uint32_t i = 0; i < row_count; i++)
        rows[i] = (nook_sheet_row){ "name",
                                    "A summary that is long enough to need a second line of the caption.",
                                    &p->lit,
                                    &p->visibility,
                                    i ? &p->error : NULL,
                                    facts,
                                    2,
                                    "rays 16" };
    nook_sheet sheet = { "Title", lines, 2, rows, row_count, NOOK_ERROR_RANGE_DEFAULT };
    nook_picture picture;
    assert_int_equal(nook_sheet_draw(&sheet, &picture), NOOK_OK);
    return picture;
}

static size_t count_colour(const nook_picture *picture, nook_rgb colour)
{
    size_t count = 0;
    for (size_t i = 0; i < (size_t)picture->width * picture->height; i++)
        count += memcmp(&picture->pixels[i], &colour, sizeof colour) == 0;
    return count;
}

static void test_sheet_shows_every_panel_whole(void **state)
{
    (void)state;
    nook_font_destroy(load_font());
    panels p = make_panels(320, 200);
    nook_picture sheet = draw_sheet(&p, 3);
    assert_int_equal(count_colour(&sheet, (nook_rgb){ 250, 10, 20 }), 3 * 320 * 200);
    assert_int_equal(count_colour(&sheet, (nook_rgb){ 10, 250, 20 }), 3 * 320 * 200);
    assert_int_equal(count_colour(&sheet, (nook_rgb){ 10, 20, 250 }), 2 * 320 * 200);
    assert_true(sheet.width > 3 * 320 && sheet.width < 3 * 320 + 500);
    assert_true(sheet.height > 3 * 200 && sheet.height < 3 * 200 + 400);
    nook_picture_free(&sheet);
    free_panels(&p);
}

static void test_sheet_grows_by_one_row_at_a_time(void **state)
{
    (void)state;
    nook_font_destroy(load_font());
    panels p = make_panels(300, 240);
    nook_picture one = draw_sheet(&p, 1), two = draw_sheet(&p, 2), five = draw_sheet(&p, 5);
    assert_int_equal(one.width, five.width);
    assert_int_equal(five.height - two.height, 3 * (two.height - one.height));
    nook_picture_free(&one);
    nook_picture_free(&two);
    nook_picture_free(&five);
    free_panels(&p);
}

static void test_sheet_shrinks_large_pictures_and_takes_tiny_ones(void **state)
{
    (void)state;
    nook_font_destroy(load_font());
    panels large = make_panels(4000, 1000), tiny = make_panels(1, 1);
    nook_picture sheet = draw_sheet(&large, 2);
    assert_true(sheet.width < 2000 && sheet.height < 1000);
    assert_int_equal(count_colour(&sheet, (nook_rgb){ 250, 10, 20 }), 2 * 480 * 120);
    nook_picture_free(&sheet);
    sheet = draw_sheet(&tiny, 2);
    assert_int_equal(count_colour(&sheet, (nook_rgb){ 250, 10, 20 }), 2);
    nook_picture_free(&sheet);
    free_panels(&large);
    free_panels(&tiny);
}

static void test_sheet_keeps_the_colour_scale_above_the_next_row(void **state)
{
    (void)state;
    nook_font_destroy(load_font());
    panels small = make_panels(96, 54);
    nook_picture sheet = draw_sheet(&small, 2);
    nook_rgb grey = nook_error_no_geometry(), blue = { 10, 20, 250 };
    uint32_t legend_end = 0, error_begin = 0;
    for (uint32_t y = 0; y < sheet.height; y++) {
        for (uint32_t x = 0; x < sheet.width; x++) {
            const nook_rgb *pixel = &sheet.pixels[(size_t)y * sheet.width + x];
            if (memcmp(pixel, &grey, sizeof grey) == 0)
                legend_end = y + 1;
            if (!error_begin && memcmp(pixel, &blue, sizeof blue) == 0)
                error_begin = y;
        }
    }
    assert_true(legend_end > 0);
    assert_true(legend_end + 14 < error_begin); /* the line between rows has room too */
    nook_picture_free(&sheet);
    free_panels(&small);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_text_width_grows_with_size_and_letters),
        cmocka_unit_test(test_text_is_drawn_inside_its_line),
        cmocka_unit_test(test_text_breaks_at_spaces_and_always_moves_on),
        cmocka_unit_test(test_font_load_refuses_what_is_no_font),
        cmocka_unit_test(test_sheet_shows_every_panel_whole),
        cmocka_unit_test(test_sheet_grows_by_one_row_at_a_time),
        cmocka_unit_test(test_sheet_shrinks_large_pictures_and_takes_tiny_ones),
        cmocka_unit_test(test_sheet_keeps_the_colour_scale_above_the_next_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
