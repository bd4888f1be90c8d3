#include "modules/measure/ssim.h"
#include "engine/core/log.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

enum { REACH = 5, WINDOW = 2 * REACH + 1 };
static const double sigma = 1.5, luminance_floor = 0.01 * 0.01, contrast_floor = 0.03 * 0.03; /* C1 and C2 at L = 1 */

/* Weighted sums of both pictures' values and products over a part of a window. */
typedef struct moments {
    double weight, a, b, aa, bb, ab;
} moments;

typedef struct pictures {
    const float *a, *b;
    const uint8_t *mask;
    uint32_t width, height;
    double kernel[WINDOW]; /* one dimension of the Gaussian, not normalised */
} pictures;

static bool counts(const pictures *p, size_t i)
{
    return !p->mask || p->mask[i];
}

static void add_scaled(moments *to, double weight, const moments *m)
{
    to->weight += weight * m->weight;
    to->a += weight * m->a, to->b += weight * m->b;
    to->aa += weight * m->aa, to->bb += weight * m->bb, to->ab += weight * m->ab;
}

/* One row blurred along itself. */
static void blur_row(const pictures *p, uint32_t y, moments *out)
{
    for (uint32_t x = 0; x < p->width; x++) {
        out[x] = (moments){ 0 };
        uint32_t first = x > REACH ? x - REACH : 0, last = p->width - 1 - x > REACH ? x + REACH : p->width - 1;
        for (uint32_t k = first; k <= last; k++) {
            size_t i = (size_t)y * p->width + k;
            if (!counts(p, i))
                continue;
            double a = (double)p->a[i], b = (double)p->b[i];
            add_scaled(&out[x], p->kernel[k + REACH - x], &(moments){ 1.0, a, b, a * a, b * b, a * b });
        }
    }
}

/* Equation 13. Equal pictures have equal sums, bit by bit, so that both factors are exactly 1. */
static double similarity(const moments *sum)
{
    double a = sum->a / sum->weight, b = sum->b / sum->weight;
    double variance_a = sum->aa / sum->weight - a * a, variance_b = sum->bb / sum->weight - b * b;
    double covariance = sum->ab / sum->weight - a * b;
    return (2.0 * a * b + luminance_floor) * (2.0 * covariance + contrast_floor) /
           ((a * a + b * b + luminance_floor) * (variance_a + variance_b + contrast_floor));
}

/* Sum of the similarity over a row's pixels. @param rows  blurred, row y in place y % WINDOW */
static double sum_row(const pictures *p, uint32_t y, const moments *rows)
{
    uint32_t first = y > REACH ? y - REACH : 0, last = p->height - 1 - y > REACH ? y + REACH : p->height - 1;
    double total = 0.0;
    for (uint32_t x = 0; x < p->width; x++) {
        if (!counts(p, (size_t)y * p->width + x))
            continue;
        moments sum = { 0 };
        for (uint32_t k = first; k <= last; k++)
            add_scaled(&sum, p->kernel[k + REACH - y], &rows[(size_t)(k % WINDOW) * p->width + x]);
        total += similarity(&sum);
    }
    return total;
}

static double sum_picture(const pictures *p, moments *rows)
{
    double total = 0.0;
    uint32_t blurred = 0;
    for (uint32_t y = 0; y < p->height; y++) {
        for (; blurred < p->height && blurred <= y + REACH; blurred++)
            blur_row(p, blurred, rows + (size_t)(blurred % WINDOW) * p->width);
        total += sum_row(p, y, rows);
    }
    return total;
}

static nook_ssim count_pixels(const pictures *p)
{
    nook_ssim ssim = { .mean = NAN };
    for (size_t i = 0; i < (size_t)p->width * p->height; i++) {
        if (!counts(p, i))
            continue;
        ssim.count++;
        ssim.non_finite += !isfinite(p->a[i]) || !isfinite(p->b[i]);
    }
    ssim.valid = ssim.count > 0 && ssim.non_finite == 0;
    return ssim;
}

nook_result nook_ssim_measure(const float *visibility, const float *reference, const uint8_t *mask, uint32_t width,
                              uint32_t height, nook_ssim *out_ssim)
{
    pictures p = { .a = visibility, .b = reference, .mask = mask, .width = width, .height = height };
    for (int i = 0; i < WINDOW; i++)
        p.kernel[i] = exp(-(i - REACH) * (i - REACH) / (2.0 * sigma * sigma));
    nook_ssim ssim = count_pixels(&p);
    if (ssim.valid) {
        moments *rows = malloc((size_t)WINDOW * width * sizeof *rows);
        if (!rows)
            return nook_fail(NOOK_E_MEMORY, "ssim: no memory for rows of %u pixels", width);
        ssim.mean = sum_picture(&p, rows) / (double)ssim.count;
        free(rows);
    }
    *out_ssim = ssim;
    return NOOK_OK;
}

double nook_ssim_ceiling(double similarity_of_halves)
{
    return 4.0 * similarity_of_halves / (1.0 + 3.0 * similarity_of_halves);
}
