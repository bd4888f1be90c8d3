#include "game/measure/measure_verdict.h"
#include <math.h>

/* Of normal noise with an RMS of 1: root of 2 / pi. Where the noise of pixels differs it is less. */
static const double mean_absolute_noise = 0.7978845608028654;

typedef struct noisy_error {
    const char *name;
    double noise, error;
} noisy_error;

/* Infinite where noise stands against no error, or is no number. */
static double part_of(double noise, double error)
{
    if (noise == 0.0)
        return 0.0;
    double part = noise / error;
    return isnan(part) ? INFINITY : part;
}

static double largest_part(const noisy_error *errors, size_t count, const char **out_error)
{
    double largest = 0.0;
    size_t worst = 0;
    for (size_t i = 0; i < count; i++) {
        double part = part_of(errors[i].noise, errors[i].error);
        if (part <= largest)
            continue;
        largest = part;
        worst = i;
    }
    if (out_error)
        *out_error = errors[worst].name;
    return largest;
}

/* A side of silhouettes without a pixel has no noise. */
static double or_none(double noise)
{
    return isnan(noise) ? 0.0 : noise;
}

double nook_measure_noise_part(const nook_sample *sample, bool screen, const char **out_error)
{
    if (screen) {
        const noisy_error errors[] = { { "RMSE against the screen's truth", sample->screen_noise, sample->screen.rmse },
                                       { "MAE against the screen's truth", mean_absolute_noise * sample->screen_noise,
                                         sample->screen.mae } };
        return largest_part(errors, NOOK_COUNT(errors), out_error);
    }
    const noisy_error errors[] = { { "RMSE", sample->reference_noise, sample->truth.rmse },
                                   { "MAE", mean_absolute_noise * sample->reference_noise, sample->truth.mae },
                                   { "RMSE inside", or_none(sample->noise_inside), sample->rmse_inside },
                                   { "RMSE outside", or_none(sample->noise_outside), sample->rmse_outside },
                                   { "RMSE away", or_none(sample->noise_away), sample->rmse_away } };
    return largest_part(errors, NOOK_COUNT(errors), out_error);
}

uint64_t nook_sample_non_finite(const nook_sample *sample)
{
    return sample->truth.non_finite + sample->screen.non_finite + sample->noise_non_finite +
           sample->instability.non_finite + sample->flicker_non_finite;
}

nook_measure_verdict nook_measure_judge(const nook_results *results)
{
    nook_measure_verdict verdict = { .largest_part = 0.0, .worst_error = "" };
    for (size_t i = 0; i < results->row_count; i++) {
        const nook_result_row *row = &results->rows[i];
        const nook_sample *sample = &row->sample;
        const char *of_truth, *of_screen = "";
        double truth = nook_measure_noise_part(sample, false, &of_truth);
        double screen = sample->screen.count > 0 ? nook_measure_noise_part(sample, true, &of_screen) : 0.0;
        double part = fmax(truth, screen);
        verdict.non_finite += nook_sample_non_finite(sample);
        verdict.outside += sample->outside;
        verdict.over += part > NOOK_MEASURE_NOISE_PART;
        if (verdict.worst && part <= verdict.largest_part)
            continue;
        verdict.largest_part = part;
        verdict.worst = row;
        verdict.worst_error = screen > truth ? of_screen : of_truth;
    }
    return verdict;
}
