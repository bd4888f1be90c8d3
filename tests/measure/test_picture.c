#include "engine/core/file.h"
#include "modules/measure/picture.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <stb/stb_image.h>

#include <cmocka.h>

static void assert_colour(const nook_picture *picture, uint32_t x, uint32_t y, nook_rgb colour)
{
    nook_rgb pixel = picture->pixels[y * picture->width + x];
    assert_int_equal(pixel.r, colour.r);
    assert_int_equal(pixel.g, colour.g);
    assert_int_equal(pixel.b, colour.b);
}

static const nook_rgb black = { 0, 0, 0 }, red = { 255, 0, 0 }, green = { 0, 255, 0 };

static void test_picture_create_refuses_absurd_sizes(void **state)
{
    (void)state;
    nook_picture picture;
    assert_int_equal(nook_picture_create(0, 1, &picture), NOOK_E_RANGE);
    assert_int_equal(nook_picture_create(1, 0, &picture), NOOK_E_RANGE);
    assert_int_equal(nook_picture_create(NOOK_PICTURE_SIDE_MAX + 1, 1, &picture), NOOK_E_RANGE);
}

static void test_fill_and_blit_keep_inside_the_picture(void **state)
{
    (void)state;
    nook_picture picture, small;
    assert_int_equal(nook_picture_create(4, 4, &picture), NOOK_OK);
    assert_int_equal(nook_picture_create(3, 3, &small), NOOK_OK);
    nook_picture_fill(&picture, -5, 2, 100, 100, red);
    assert_colour(&picture, 0, 1, black);
    assert_colour(&picture, 0, 2, red);
    assert_colour(&picture, 3, 3, red);
    nook_picture_fill(&small, 0, 0, 3, 3, green);
    nook_picture_blit(&picture, &small, -2, -2);
    assert_colour(&picture, 0, 0, green);
    assert_colour(&picture, 1, 0, black);
    nook_picture_blit(&picture, &small, 3, 3);
    assert_colour(&picture, 3, 3, green);
    assert_colour(&picture, 2, 3, red);
    nook_picture_blit(&picture, &small, 40, 40);
    nook_picture_blit(&picture, &small, -40, -40);
    nook_picture_blend(&picture, -1, 0, red, 255);
    nook_picture_blend(&picture, 1, 4, red, 255);
    nook_picture_blend(&picture, 1, 1, red, 128);
    assert_colour(&picture, 1, 1, (nook_rgb){ 128, 0, 0 });
    nook_picture_free(&picture);
    nook_picture_free(&small);
}

static void test_rows_from_gl_are_turned_the_right_way_up(void **state)
{
    (void)state;
    const float grey[] = { 0.0f, 1.0f }; /* 1 x 2, bottom row first */
    nook_picture picture;
    assert_int_equal(nook_picture_from_grey(grey, 1, 2, &picture), NOOK_OK);
    assert_colour(&picture, 0, 0, (nook_rgb){ 255, 255, 255 });
    assert_colour(&picture, 0, 1, black);
    nook_picture_free(&picture);
}

static void test_grey_is_rounded_clamped_and_shows_nan(void **state)
{
    (void)state;
    const float grey[] = { 0.5f, -3.0f, INFINITY, NAN };
    nook_picture picture;
    assert_int_equal(nook_picture_from_grey(grey, 4, 1, &picture), NOOK_OK);
    assert_colour(&picture, 0, 0, (nook_rgb){ 128, 128, 128 });
    assert_colour(&picture, 1, 0, black);
    assert_colour(&picture, 2, 0, (nook_rgb){ 255, 255, 255 });
    assert_colour(&picture, 3, 0, (nook_rgb){ 255, 0, 255 });
    nook_picture_free(&picture);
}

static void test_resize_keeps_a_constant_picture(void **state)
{
    (void)state;
    const nook_rgb colour = { 200, 100, 50 };
    nook_picture picture, small;
    assert_int_equal(nook_picture_create(33, 17, &picture), NOOK_OK);
    nook_picture_fill(&picture, 0, 0, 33, 17, colour);
    assert_int_equal(nook_picture_resize(&picture, 8, 5, &small), NOOK_OK);
    for (uint32_t i = 0; i < 40; i++)
        assert_colour(&small, i % 8, i / 8, colour);
    nook_picture_free(&picture);
    nook_picture_free(&small);
}

static void test_png_is_read_back_as_written(void **state)
{
    (void)state;
    char folder[] = "/tmp/nook_test_picture_XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/a.png", folder);
    nook_picture picture;
    assert_int_equal(nook_picture_create(37, 19, &picture), NOOK_OK);
    for (unsigned i = 0; i < 37 * 19; i++)
        picture.pixels[i] = (nook_rgb){ (uint8_t)i, (uint8_t)(i * 7), (uint8_t)(i * i) };
    assert_int_equal(nook_picture_write_png(&picture, path), NOOK_OK);
    nook_file file;
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    int width, height, channels;
    uint8_t *pixels = stbi_load_from_memory(file.bytes, (int)file.size, &width, &height, &channels, 3);
    assert_non_null(pixels);
    assert_int_equal(width, 37);
    assert_int_equal(height, 19);
    assert_memory_equal(pixels, picture.pixels, 37 * 19 * 3);
    stbi_image_free(pixels);
    nook_file_free(&file);
    unlink(path);
    rmdir(folder);
    assert_int_equal(nook_picture_write_png(&picture, path), NOOK_E_IO); /* its folder is gone */
    nook_picture_free(&picture);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_picture_create_refuses_absurd_sizes),
        cmocka_unit_test(test_fill_and_blit_keep_inside_the_picture),
        cmocka_unit_test(test_rows_from_gl_are_turned_the_right_way_up),
        cmocka_unit_test(test_grey_is_rounded_clamped_and_shows_nan),
        cmocka_unit_test(test_resize_keeps_a_constant_picture),
        cmocka_unit_test(test_png_is_read_back_as_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
