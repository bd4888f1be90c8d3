#include "modules/measure/ssim.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { WIDTH = 37, HEIGHT = 23, PIXELS = WIDTH * HEIGHT };
static const double c1 = 1e-4, c2 = 9e-4;

static void assert_near(double value, double truth, double tolerance)
{
    if (!(fabs(value - truth) <= tolerance))
        fail_msg("%.17g is not within %g of %.17g", value, tolerance, truth);
}

static nook_ssim measure(const float *a, const float *b, const uint8_t *mask, uint32_t width, uint32_t height)
{
    nook_ssim ssim;
    assert_int_equal(nook_ssim_measure(a, b, mask, width, height, &ssim), NOOK_OK);
    return ssim;
}

static void fill_random(float *picture, unsigned seed)
{
    for (int i = 0; i < PIXELS; i++) {
        seed = seed * 1664525u + 1013904223u;
        picture[i] = (float)(seed >> 8) / 16777216.0f;
    }
}

static void fill_random_mask(uint8_t *mask, unsigned seed)
{
    float values[PIXELS];
    fill_random(values, seed);
    for (int i = 0; i < PIXELS; i++)
        mask[i] = values[i] < 0.6f;
}

static void test_equal_pictures_have_a_similarity_of_exactly_one(void **state)
{
    (void)state;
    float picture[PIXELS];
    uint8_t mask[PIXELS];
    fill_random(picture, 1);
    fill_random_mask(mask, 2);
    nook_ssim ssim = measure(picture, picture, NULL, WIDTH, HEIGHT);
    assert_true(ssim.valid && ssim.mean == 1.0);
    assert_int_equal(ssim.count, PIXELS);
    assert_true(measure(picture, picture, mask, WIDTH, HEIGHT).mean == 1.0);
}

static void test_constant_pictures_differ_by_their_luminance(void **state)
{
    (void)state;
    float bright[PIXELS], dark[PIXELS];
    for (int i = 0; i < PIXELS; i++)
        bright[i] = 0.75f, dark[i] = 0.5f;
    double truth = (2 * 0.75 * 0.5 + c1) / (0.75 * 0.75 + 0.5 * 0.5 + c1);
    assert_near(measure(bright, dark, NULL, WIDTH, HEIGHT).mean, truth, 1e-12);
    assert_near(measure(bright, dark, NULL, 1, 1).mean, truth, 1e-15);
}

/* Around 1/2 the pictures are alternating columns of +d and -d, in the other picture of -d and +d. A window that sees them
   all has the means 1/2 + e and 1/2 - e, variances d^2 - e^2 and the covariance -(d^2 - e^2), e = d sum +-weight. */
static void test_opposite_stripes_have_the_similarity_of_the_formula(void **state)
{
    (void)state;
    enum { WIDE = 11 };
    const double d = 0.25;
    float a[WIDE * WIDE], b[WIDE * WIDE];
    uint8_t middle[WIDE * WIDE] = { 0 };
    double weights = 0.0, alternating = 0.0, mean = 0.0;
    for (int i = 0; i < WIDE * WIDE; i++) {
        a[i] = (float)(0.5 + (i % WIDE % 2 ? -d : d));
        b[i] = 1.0f - a[i];
    }
    for (int centre = 0; centre < WIDE; centre++) { /* columns all see all rows' stripes alike */
        weights = alternating = 0.0;
        for (int x = 0; x < WIDE; x++) {
            double weight = abs(x - centre) <= 5 ? exp(-(x - centre) * (x - centre) / 4.5) : 0.0;
            weights += weight, alternating += x % 2 ? -weight : weight;
        }
        double e = d * alternating / weights, high = 0.5 + e, low = 0.5 - e, variance = d * d - e * e;
        mean += (2 * high * low + c1) * (-2 * variance + c2) /
                ((high * high + low * low + c1) * (2 * variance + c2) * WIDE);
    }
    assert_near(measure(a, b, NULL, WIDE, WIDE).mean, mean, 1e-12);
    middle[WIDE * WIDE / 2] = 1; /* alone it has no contrast: its luminance is all */
    double high = a[WIDE * WIDE / 2], low = 1.0 - high;
    assert_near(measure(a, b, middle, WIDE, WIDE).mean, (2 * high * low + c1) / (high * high + low * low + c1), 1e-12);
}

/* Straight from the paper, with two loops over a window, no separation and no rows. */
static double written_out(const float *a, const float *b, const uint8_t *mask)
{
    double total = 0.0, count = 0.0;
    for (int i = 0; i < PIXELS; i++) {
        if (!mask[i])
            continue;
        double weight[PIXELS] = { 0 }, sum = 0.0, mean[2] = { 0 }, variance[2] = { 0 }, covariance = 0.0;
        for (int k = 0; k < PIXELS; k++) {
            int dx = k % WIDTH - i % WIDTH, dy = k / WIDTH - i / WIDTH;
            if (mask[k] && dx >= -5 && dx <= 5 && dy >= -5 && dy <= 5)
                weight[k] = exp(-(dx * dx + dy * dy) / (2.0 * 1.5 * 1.5));
            sum += weight[k];
        }
        for (int k = 0; k < PIXELS; k++)
            mean[0] += weight[k] / sum * (double)a[k], mean[1] += weight[k] / sum * (double)b[k];
        for (int k = 0; k < PIXELS; k++) {
            double from_a = (double)a[k] - mean[0], from_b = (double)b[k] - mean[1];
            variance[0] += weight[k] / sum * from_a * from_a, variance[1] += weight[k] / sum * from_b * from_b;
            covariance += weight[k] / sum * from_a * from_b;
        }
        total += (2 * mean[0] * mean[1] + c1) * (2 * covariance + c2) /
                 ((mean[0] * mean[0] + mean[1] * mean[1] + c1) * (variance[0] + variance[1] + c2));
        count += 1.0;
    }
    return total / count;
}

static void test_random_pictures_and_masks_agree_with_the_formula_written_out(void **state)
{
    (void)state;
    float a[PIXELS], b[PIXELS];
    uint8_t mask[PIXELS];
    for (unsigned seed = 3; seed < 8; seed++) {
        fill_random(a, seed);
        fill_random(b, seed + 100);
        fill_random_mask(mask, seed + 200);
        for (int i = 0; i < PIXELS; i++)
            b[i] = 0.7f * a[i] + 0.3f * b[i];
        assert_near(measure(a, b, mask, WIDTH, HEIGHT).mean, written_out(a, b, mask), 1e-11);
    }
}

/* A picture without any error against a noisy reference, whose two halves are all that is known. */
static void test_the_ceiling_is_what_an_exact_picture_has_against_a_noisy_reference(void **state)
{
    (void)state;
    enum { SIDE = 64, COUNT = SIDE * SIDE };
    static float exact[COUNT], halves[2][COUNT], reference[COUNT];
    uint32_t seed = 1;
    for (int slope = 0; slope < 2; slope++) {
        for (int i = 0; i < COUNT; i++) {
            exact[i] =
                0.5f + 0.002f * (float)(slope * (i % SIDE)); /* flat, and about as much structure as there is noise */
            for (int k = 0; k < 2; k++) {
                seed = seed * 1664525u + 1013904223u;
                halves[k][i] = exact[i] + 0.1f * ((float)(seed >> 8) / 16777216.0f - 0.5f);
            }
            reference[i] = 0.5f * (halves[0][i] + halves[1][i]);
        }
        double of_halves = measure(halves[0], halves[1], NULL, SIDE, SIDE).mean;
        double actual = measure(exact, reference, NULL, SIDE, SIDE).mean;
        if (fabs(nook_ssim_ceiling(of_halves) - actual) > 0.03 || of_halves > actual - 0.15)
            fail_msg("halves %g, ceiling %g, actual %g", of_halves, nook_ssim_ceiling(of_halves), actual);
    }
    assert_true(nook_ssim_ceiling(1.0) == 1.0);
}

static void test_neither_order_nor_mirroring_matters(void **state)
{
    (void)state;
    float a[PIXELS], b[PIXELS], turned_a[PIXELS], turned_b[PIXELS];
    fill_random(a, 11);
    fill_random(b, 12);
    for (int i = 0; i < PIXELS; i++)
        turned_a[PIXELS - 1 - i] = a[i], turned_b[PIXELS - 1 - i] = b[i];
    double mean = measure(a, b, NULL, WIDTH, HEIGHT).mean;
    assert_true(measure(b, a, NULL, WIDTH, HEIGHT).mean == mean);
    assert_near(measure(turned_a, turned_b, NULL, WIDTH, HEIGHT).mean, mean, 1e-12);
}

static void test_masked_pixels_do_not_enter_any_window(void **state)
{
    (void)state;
    float a[PIXELS], b[PIXELS], spoilt[PIXELS];
    uint8_t mask[PIXELS];
    fill_random(a, 21);
    fill_random(b, 22);
    fill_random_mask(mask, 23);
    for (int i = 0; i < PIXELS; i++)
        spoilt[i] = mask[i] ? b[i] : i % 2 ? NAN : 1e30f;
    nook_ssim ssim = measure(a, spoilt, mask, WIDTH, HEIGHT);
    assert_true(ssim.valid);
    assert_true(ssim.mean == measure(a, b, mask, WIDTH, HEIGHT).mean);
}

static void test_values_that_are_not_finite_make_the_similarity_invalid(void **state)
{
    (void)state;
    float a[PIXELS], b[PIXELS];
    fill_random(a, 31);
    fill_random(b, 32);
    a[5] = NAN, b[PIXELS - 1] = INFINITY;
    nook_ssim ssim = measure(a, b, NULL, WIDTH, HEIGHT);
    assert_false(ssim.valid);
    assert_int_equal(ssim.count, PIXELS);
    assert_int_equal(ssim.non_finite, 2);
    assert_true(isnan(ssim.mean));
}

static void test_nothing_to_compare_is_invalid(void **state)
{
    (void)state;
    const float a[4] = { 0 }, b[4] = { 0 };
    const uint8_t mask[4] = { 0 };
    nook_ssim ssim = measure(a, b, mask, 2, 2);
    assert_false(ssim.valid);
    assert_int_equal(ssim.count, 0);
    assert_true(isnan(ssim.mean));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equal_pictures_have_a_similarity_of_exactly_one),
        cmocka_unit_test(test_constant_pictures_differ_by_their_luminance),
        cmocka_unit_test(test_opposite_stripes_have_the_similarity_of_the_formula),
        cmocka_unit_test(test_random_pictures_and_masks_agree_with_the_formula_written_out),
        cmocka_unit_test(test_the_ceiling_is_what_an_exact_picture_has_against_a_noisy_reference),
        cmocka_unit_test(test_neither_order_nor_mirroring_matters),
        cmocka_unit_test(test_masked_pixels_do_not_enter_any_window),
        cmocka_unit_test(test_values_that_are_not_finite_make_the_similarity_invalid),
        cmocka_unit_test(test_nothing_to_compare_is_invalid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
