#include "modules/measure/errors.h"
#include "engine/core/log.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Neumaier's compensated summation. */
typedef struct sum {
    double value, lost;
} sum;

static void sum_add(sum *s, double x)
{
    double next = s->value + x;
    s->lost += fabs(s->value) >= fabs(x) ? (s->value - next) + x : (x - next) + s->value;
    s->value = next;
}

static double sum_total(const sum *s)
{
    return s->value + s->lost;
}

typedef struct totals {
    sum signed_sum, absolute_sum, squared_sum;
    double max;
    uint64_t count, non_finite;
} totals;

static void add_pixel(totals *t, float visibility, float reference)
{
    t->count++;
    if (!isfinite(visibility) || !isfinite(reference)) {
        t->non_finite++;
        return;
    }
    double difference = (double)visibility - (double)reference;
    sum_add(&t->signed_sum, difference);
    sum_add(&t->absolute_sum, fabs(difference));
    sum_add(&t->squared_sum, difference * difference);
    t->max = fmax(t->max, fabs(difference));
}

enum { HALF_BINS = 65536 };

/* Bits of |a - b|; for floats that are not negative the order of the bits is the order of the values. */
static uint32_t difference_bits(float a, float b)
{
    float difference = fabsf(a - b);
    uint32_t bits;
    memcpy(&bits, &difference, sizeof bits);
    return bits;
}

/* The bin that holds the *rank-th (from 1) smallest entry; *rank becomes the rank within that bin. */
static uint32_t find_bin(const uint64_t *bins, uint64_t *rank)
{
    uint32_t bin = 0;
    while (*rank > bins[bin])
        *rank -= bins[bin++];
    return bin;
}

/* Exact selection by the two halves of the bits: no copy of the picture, two passes. */
static double select_difference(const float *a, const float *b, const uint8_t *mask, size_t pixels, uint64_t rank,
                                uint64_t *bins)
{
    memset(bins, 0, HALF_BINS * sizeof *bins);
    for (size_t i = 0; i < pixels; i++) {
        if (!mask || mask[i])
            bins[difference_bits(a[i], b[i]) >> 16]++;
    }
    uint32_t high = find_bin(bins, &rank);
    memset(bins, 0, HALF_BINS * sizeof *bins);
    for (size_t i = 0; i < pixels; i++) {
        uint32_t bits = difference_bits(a[i], b[i]);
        if ((!mask || mask[i]) && bits >> 16 == high)
            bins[bits & 0xffffu]++;
    }
    uint32_t found = high << 16 | find_bin(bins, &rank);
    float value;
    memcpy(&value, &found, sizeof value);
    return value;
}

nook_result nook_errors_measure(const float *visibility, const float *reference, const uint8_t *mask, size_t pixels,
                                nook_errors *out_errors)
{
    totals t = { 0 };
    for (size_t i = 0; i < pixels; i++) {
        if (!mask || mask[i])
            add_pixel(&t, visibility[i], reference[i]);
    }
    nook_errors errors = {
        .count = t.count, .non_finite = t.non_finite, .rmse = NAN, .mae = NAN, .bias = NAN, .p99 = NAN, .max = NAN
    };
    if (t.count > 0 && t.non_finite == 0) {
        uint64_t *bins = malloc(HALF_BINS * sizeof *bins);
        if (!bins)
            return nook_fail(NOOK_E_MEMORY, "errors: no memory for the percentile");
        double n = (double)t.count;
        errors.valid = true;
        errors.rmse = sqrt(sum_total(&t.squared_sum) / n);
        errors.mae = sum_total(&t.absolute_sum) / n;
        errors.bias = sum_total(&t.signed_sum) / n;
        errors.max = t.max;
        uint64_t rank = (t.count * 99 + 99) / 100; /* nearest rank: ceil(0.99 n) */
        errors.p99 = select_difference(visibility, reference, mask, pixels, rank, bins);
        free(bins);
    }
    *out_errors = errors;
    return NOOK_OK;
}
