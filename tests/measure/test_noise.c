#include "modules/measure/noise.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { PIXELS = 4096, PICTURES = 5 };

static void assert_near(double value, double truth, double tolerance)
{
    if (!(fabs(value - truth) <= tolerance))
        fail_msg("%.17g is not within %g of %.17g", value, tolerance, truth);
}

/* Uniform in [0, 1): variance 1/12. */
static void fill_random(float *picture, unsigned seed)
{
    for (int i = 0; i < PIXELS; i++) {
        seed = seed * 1664525u + 1013904223u;
        picture[i] = (float)(seed >> 8) / 16777216.0f;
    }
}

static void test_equal_pictures_have_no_noise(void **state)
{
    (void)state;
    float picture[PIXELS];
    fill_random(picture, 1);
    nook_noise noise = nook_noise_measure((const float *const[]){ picture, picture, picture }, 3, NULL, PIXELS);
    assert_true(noise.valid && noise.rms == 0.0);
    assert_int_equal(noise.count, PIXELS);
    assert_true(nook_noise_of_mean(picture, picture, NULL, PIXELS).rms == 0.0);
}

static void test_noise_is_the_unbiased_deviation_at_each_pixel(void **state)
{
    (void)state;
    const float a[] = { 0.0f, 0.25f }, b[] = { 0.5f, 0.25f }, c[] = { 1.0f, 1.0f };
    /* Variances 1/4 and 3/16 of three. */
    nook_noise noise = nook_noise_measure((const float *const[]){ a, b, c }, 3, NULL, 2);
    assert_near(noise.rms, sqrt((0.25 + 0.1875) / 2), 1e-15);
    /* Of two: half of the squared difference, 1/8 and 0. */
    noise = nook_noise_measure((const float *const[]){ a, b }, 2, NULL, 2);
    assert_near(noise.rms, sqrt(0.125 / 2), 1e-15);
    assert_near(nook_noise_of_mean(a, b, NULL, 2).rms, sqrt(0.25 / 2) / 2, 1e-15); /* RMS(a - b) / 2 */
}

static void test_noise_of_random_pictures_is_that_of_their_distribution(void **state)
{
    (void)state;
    static float pictures[PICTURES][PIXELS];
    const float *list[PICTURES], *reversed[PICTURES];
    for (unsigned i = 0; i < PICTURES; i++) {
        fill_random(pictures[i], 20221107u + 7919u * i);
        list[i] = reversed[PICTURES - 1 - i] = pictures[i];
    }
    nook_noise noise = nook_noise_measure(list, PICTURES, NULL, PIXELS);
    assert_near(noise.rms, sqrt(1.0 / 12), 0.005); /* its own deviation is about 0.002 */
    assert_near(nook_noise_measure(reversed, PICTURES, NULL, PIXELS).rms, noise.rms, 1e-14);
    assert_near(nook_noise_of_mean(list[0], list[1], NULL, PIXELS).rms, sqrt(1.0 / 24), 0.005);
}

static void test_masked_pixels_have_no_noise(void **state)
{
    (void)state;
    const float a[] = { 0.0f, NAN, 0.5f }, b[] = { 0.5f, 0.0f, 0.5f };
    const uint8_t mask[] = { 0, 0, 9 };
    nook_noise noise = nook_noise_measure((const float *const[]){ a, b }, 2, mask, 3);
    assert_true(noise.valid && noise.rms == 0.0);
    assert_int_equal(noise.count, 1);
}

static void test_values_that_are_not_finite_make_the_noise_invalid(void **state)
{
    (void)state;
    const float a[] = { 0.0f, 1.0f, 0.5f }, b[] = { NAN, 1.0f, 0.5f }, c[] = { 0.0f, INFINITY, 0.5f };
    nook_noise noise = nook_noise_measure((const float *const[]){ a, b, c }, 3, NULL, 3);
    assert_false(noise.valid);
    assert_int_equal(noise.non_finite, 2);
    assert_true(isnan(noise.rms));
    noise = nook_noise_of_mean(a, c, NULL, 3);
    assert_false(noise.valid);
    assert_int_equal(noise.non_finite, 1);
    assert_true(isnan(noise.rms));
}

static void test_nothing_to_measure_is_invalid(void **state)
{
    (void)state;
    const float value = 0.5f;
    const uint8_t masked = 0;
    nook_noise noise = nook_noise_of_mean(&value, &value, &masked, 1);
    assert_false(noise.valid);
    assert_true(isnan(noise.rms));
}

/* Frames of 4 x 1 pixels in which every frame sees the same points, but for those named. */
enum { WIDTH = 4 };

static nook_match same_places(float *places, int hidden)
{
    nook_match match = { .places = places, .width = WIDTH, .height = 1, .second_width = WIDTH, .second_height = 1 };
    for (int i = 0; i < WIDTH; i++) {
        places[2 * i] = i < hidden ? -1.0f : (float)i;
        places[2 * i + 1] = i < hidden ? -1.0f : 0.0f;
        match.shared += i >= hidden;
    }
    match.geometry = WIDTH;
    return match;
}

static void test_flicker_pools_the_changes_of_all_frames(void **state)
{
    (void)state;
    float places[2][2 * WIDTH];
    const float still[WIDTH] = { 0.5f, 0.5f, 0.5f, 0.5f }, next[WIDTH] = { 0.5f, 0.5f, 0.75f, 0.5f };
    const float last[WIDTH] = { 0.0f, 0.0f, 0.75f, 1.0f };
    const nook_match matches[] = { same_places(places[0], 0), same_places(places[1], 3) };
    nook_noise flicker = nook_flicker_measure(matches, (const float *const[]){ still, next, last }, 3);
    assert_true(flicker.valid);
    assert_int_equal(flicker.count, 5); /* four points, then one; squares 1/16 and 1/4 among them */
    assert_near(flicker.rms, sqrt((1.0 / 16 + 1.0 / 4) / 5), 1e-12);
}

static void test_flicker_survives_a_pair_of_frames_that_shares_nothing(void **state)
{
    (void)state;
    float places[2][2 * WIDTH];
    const float a[WIDTH] = { 0.5f, 0.5f, 0.5f, 0.5f }, b[WIDTH] = { 0.25f, 0.25f, 0.25f, 0.25f };
    const nook_match matches[] = { same_places(places[0], WIDTH), same_places(places[1], 0) };
    nook_noise flicker = nook_flicker_measure(matches, (const float *const[]){ b, a, b }, 3);
    assert_true(flicker.valid);
    assert_near(flicker.rms, 0.25, 1e-12);
    flicker = nook_flicker_measure(matches, (const float *const[]){ a, b }, 2);
    assert_false(flicker.valid);
    assert_true(isnan(flicker.rms));
}

static void test_values_that_are_not_finite_make_the_flicker_invalid(void **state)
{
    (void)state;
    float places[2][2 * WIDTH];
    const float a[WIDTH] = { 0.5f, 0.5f, 0.5f, 0.5f }, spoilt[WIDTH] = { 0.5f, NAN, 0.5f, 0.5f };
    const nook_match matches[] = { same_places(places[0], 0), same_places(places[1], 0) };
    nook_noise flicker = nook_flicker_measure(matches, (const float *const[]){ a, a, spoilt }, 3);
    assert_false(flicker.valid);
    assert_int_equal(flicker.non_finite, 1);
    assert_true(isnan(flicker.rms));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equal_pictures_have_no_noise),
        cmocka_unit_test(test_noise_is_the_unbiased_deviation_at_each_pixel),
        cmocka_unit_test(test_noise_of_random_pictures_is_that_of_their_distribution),
        cmocka_unit_test(test_masked_pixels_have_no_noise),
        cmocka_unit_test(test_values_that_are_not_finite_make_the_noise_invalid),
        cmocka_unit_test(test_nothing_to_measure_is_invalid),
        cmocka_unit_test(test_flicker_pools_the_changes_of_all_frames),
        cmocka_unit_test(test_flicker_survives_a_pair_of_frames_that_shares_nothing),
        cmocka_unit_test(test_values_that_are_not_finite_make_the_flicker_invalid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
