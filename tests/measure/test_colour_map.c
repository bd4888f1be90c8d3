#include "modules/measure/colour_map.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static int same(nook_rgb a, nook_rgb b)
{
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

/* CIE lightness of a colour, 0 to 100. */
static double lightness(nook_rgb colour)
{
    const double weights[] = { 0.2126, 0.7152, 0.0722 };
    const uint8_t encoded[] = { colour.r, colour.g, colour.b };
    double luminance = 0.0;
    for (int i = 0; i < 3; i++) {
        double x = encoded[i] / 255.0;
        luminance += weights[i] * (x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4));
    }
    return 116.0 * cbrt(luminance) - 16.0;
}

static void test_no_error_is_nearly_white(void **state)
{
    (void)state;
    nook_rgb zero = nook_error_colour(0.0f, 0.25f);
    assert_true(zero.r == zero.g && zero.g == zero.b);
    assert_true(zero.r > 240);
}

static void test_too_bright_is_blue_and_too_dark_is_red(void **state)
{
    (void)state;
    nook_rgb bright = nook_error_colour(0.1f, 0.25f), dark = nook_error_colour(-0.1f, 0.25f);
    assert_true(bright.b > bright.r + 40);
    assert_true(dark.r > dark.b + 40);
}

static void test_larger_errors_are_darker_by_equal_steps_on_both_sides(void **state)
{
    (void)state;
    double before = lightness(nook_error_colour(0.0f, 1.0f));
    for (int i = 1; i <= 10; i++) {
        double blue = lightness(nook_error_colour((float)i / 10.0f, 1.0f));
        double red = lightness(nook_error_colour((float)-i / 10.0f, 1.0f));
        assert_true(before - blue > 3.0 && before - blue < 11.0);
        assert_true(fabs(red - blue) < 6.0);
        before = blue;
    }
}

static void test_errors_beyond_the_range_are_clamped(void **state)
{
    (void)state;
    assert_true(same(nook_error_colour(7.0f, 0.25f), nook_error_colour(0.25f, 0.25f)));
    assert_true(same(nook_error_colour(-INFINITY, 0.25f), nook_error_colour(-0.25f, 0.25f)));
    assert_false(same(nook_error_colour(0.25f, 0.25f), nook_error_colour(0.2f, 0.25f)));
}

static void test_nan_is_magenta(void **state)
{
    (void)state;
    assert_true(same(nook_error_colour(NAN, 0.25f), (nook_rgb){ 255, 0, 255 }));
}

static void test_error_picture_is_upright_and_greys_out_what_is_not_geometry(void **state)
{
    (void)state;
    const float visibility[] = { 1.0f, 0.5f, 0.5f, 0.5f }, reference[] = { 0.5f, 0.5f, 1.0f, 0.5f };
    const uint8_t mask[] = { 1, 1, 1, 0 };
    nook_picture picture;
    assert_int_equal(nook_error_picture(visibility, reference, mask, 2, 2, 0.25f, &picture), NOOK_OK);
    assert_true(same(picture.pixels[2], nook_error_colour(0.5f, 0.25f))); /* bottom left */
    assert_true(same(picture.pixels[0], nook_error_colour(-0.5f, 0.25f)));
    assert_true(same(picture.pixels[1], nook_error_no_geometry()));
    nook_picture_free(&picture);
}

static void test_no_error_looks_like_missing_geometry(void **state)
{
    (void)state;
    for (int i = -1000; i <= 1000; i++)
        assert_false(same(nook_error_colour((float)i / 1000.0f, 1.0f), nook_error_no_geometry()));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_error_is_nearly_white),
        cmocka_unit_test(test_too_bright_is_blue_and_too_dark_is_red),
        cmocka_unit_test(test_larger_errors_are_darker_by_equal_steps_on_both_sides),
        cmocka_unit_test(test_errors_beyond_the_range_are_clamped),
        cmocka_unit_test(test_nan_is_magenta),
        cmocka_unit_test(test_error_picture_is_upright_and_greys_out_what_is_not_geometry),
        cmocka_unit_test(test_no_error_looks_like_missing_geometry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
