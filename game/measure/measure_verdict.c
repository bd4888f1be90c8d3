#include "game/measure/measure_verdict.h"
#include <math.h>

/* Infinite where noise stands against no error, or is no number. */
static double part_of(double noise, double error)
{
    if (noise == 0.0)
        return 0.0;
    double part = noise / error;
    return isnan(part) ? INFINITY : part;
}

nook_measure_verdict nook_measure_judge(const nook_results *results)
{
    nook_measure_verdict verdict = { .largest_part = 0.0 };
    for (size_t i = 0; i < results->row_count; i++) {
        const nook_result_row *row = &results->rows[i];
        const nook_sample *sample = &row->sample;
        double truth = part_of(sample->reference_noise, sample->truth.rmse);
        double screen = sample->screen.count > 0 ? part_of(sample->screen_noise, sample->screen.rmse) : 0.0;
        double part = fmax(truth, screen);
        verdict.non_finite += sample->truth.non_finite + sample->instability.non_finite;
        verdict.over += part > NOOK_MEASURE_NOISE_PART;
        if (verdict.worst && part <= verdict.largest_part)
            continue;
        verdict.largest_part = part;
        verdict.worst = row;
        verdict.worst_is_screen = screen > truth;
    }
    return verdict;
}
