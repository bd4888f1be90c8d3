#include "modules/measure/noise.h"
#include <assert.h>
#include <math.h>

/* Unbiased variance of one pixel over the pictures, by Welford's method; not finite when a value is not. */
static double pixel_variance(const float *const *pictures, uint32_t picture_count, size_t pixel)
{
    double mean = 0.0, squares = 0.0;
    for (uint32_t i = 0; i < picture_count; i++) {
        double value = (double)pictures[i][pixel], from_old = value - mean;
        mean += from_old / (i + 1);
        squares += from_old * (value - mean);
    }
    return squares / (picture_count - 1);
}

nook_noise nook_noise_measure(const float *const *pictures, uint32_t picture_count, const uint8_t *mask, size_t pixels)
{
    assert(picture_count >= 2);
    nook_noise noise = { .rms = NAN };
    double sum = 0.0;
    for (size_t i = 0; i < pixels; i++) {
        if (mask && !mask[i])
            continue;
        double variance = pixel_variance(pictures, picture_count, i);
        noise.count++;
        if (isfinite(variance))
            sum += variance;
        else
            noise.non_finite++;
    }
    noise.valid = noise.count > 0 && noise.non_finite == 0;
    if (noise.valid)
        noise.rms = sqrt(sum / (double)noise.count);
    return noise;
}

nook_noise nook_noise_of_mean(const float *first, const float *second, const uint8_t *mask, size_t pixels)
{
    /* The variance of two is (first - second)^2 / 2: that of one half. */
    nook_noise noise = nook_noise_measure((const float *const[2]){ first, second }, 2, mask, pixels);
    noise.rms /= sqrt(2.0);
    return noise;
}

nook_noise nook_flicker_measure(const nook_match *matches, const float *const *pictures, uint32_t frame_count)
{
    assert(frame_count >= 2);
    nook_noise flicker = { .rms = NAN };
    double sum = 0.0;
    for (uint32_t i = 0; i + 1 < frame_count; i++) {
        nook_instability pair = nook_instability_measure(&matches[i], pictures[i], pictures[i + 1]);
        flicker.count += pair.pixels;
        flicker.non_finite += pair.non_finite;
        if (pair.valid)
            sum += pair.rms * pair.rms * (double)pair.pixels;
    }
    flicker.valid = flicker.count > 0 && flicker.non_finite == 0;
    if (flicker.valid)
        flicker.rms = sqrt(sum / (double)flicker.count);
    return flicker;
}
