#include "game/measure/sample_columns.h"
#include <math.h>
#include <string.h>

/* clang-format off */
#define COLUMN(key, how, member) { key, NOOK_OVER_##how, offsetof(nook_sample, member) }
static const nook_sample_column columns[] = {
    COLUMN("ms", MEAN, ms_median),
    COLUMN("ms_min", MEAN, ms_min),
    COLUMN("ms_max", MEAN, ms_max),
    COLUMN("gpu_ms", MEAN, gpu_ms_median),
    COLUMN("fetches", MEAN, fetches),
    COLUMN("volume_bytes", LARGEST, volume_bytes),
    COLUMN("texture_bytes", LARGEST, texture_bytes),
    COLUMN("bake_ms", LARGEST, bake_ms),
    COLUMN("rmse", RMS, truth.rmse),
    COLUMN("bias", MEAN, truth.bias),
    COLUMN("mae", MEAN, truth.mae),
    COLUMN("p99", LARGEST, truth.p99),
    COLUMN("max", LARGEST, truth.max),
    COLUMN("ssim", MEAN, ssim),
    COLUMN("ssim_ceiling", MEAN, ssim_ceiling),
    COLUMN("screen_rmse", RMS, screen.rmse),
    COLUMN("screen_bias", MEAN, screen.bias),
    COLUMN("screen_mae", MEAN, screen.mae),
    COLUMN("screen_p99", LARGEST, screen.p99),
    COLUMN("screen_max", LARGEST, screen.max),
    COLUMN("inside", RMS, rmse_inside),
    COLUMN("outside", RMS, rmse_outside),
    COLUMN("away", RMS, rmse_away),
    COLUMN("noise", RMS, noise),
    COLUMN("flicker", RMS, flicker),
    COLUMN("instability", RMS, instability.rms),
    COLUMN("instability_relative", MEAN, instability.relative),
    COLUMN("reference_noise", RMS, reference_noise),
};
/* clang-format on */

const nook_sample_column *nook_sample_columns(size_t *out_count)
{
    *out_count = NOOK_COUNT(columns);
    return columns;
}

double nook_sample_number(const nook_sample *sample, const nook_sample_column *column)
{
    double value;
    memcpy(&value, (const char *)sample + column->offset, sizeof value);
    return value;
}

const char *nook_over_cameras_name(nook_over_cameras over)
{
    static const char *const names[] = { "mean", "rms", "largest" };
    return names[over];
}

double nook_over_cameras_of(nook_over_cameras over, const double *values, size_t count)
{
    double sum = 0.0, largest = -INFINITY;
    size_t numbers = 0;
    for (size_t i = 0; i < count; i++) {
        if (isnan(values[i]))
            continue;
        sum += over == NOOK_OVER_RMS ? values[i] * values[i] : values[i];
        largest = fmax(largest, values[i]);
        numbers++;
    }
    if (numbers == 0)
        return NAN;
    if (over == NOOK_OVER_LARGEST)
        return largest;
    double mean = sum / (double)numbers;
    return over == NOOK_OVER_RMS ? sqrt(mean) : mean;
}
