#include "game/measure/sample_columns.h"
#include <math.h>
#include <string.h>

static const nook_sample_column columns[] = {
#define NOOK_SAMPLE_NUMBER(member, name, key, over) { #key, NOOK_OVER_##over, offsetof(nook_sample, member) },
#define NOOK_SAMPLE_DETAIL(member, name, kind)
#include "game/measure/sample_members.def"
#undef NOOK_SAMPLE_NUMBER
#undef NOOK_SAMPLE_DETAIL
};

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
