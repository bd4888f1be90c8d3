#include "game/extremes/extremes.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

bool nook_extreme_holds(const nook_extreme_found *found)
{
    bool looked = found->where[0] != '\0' || found->checked > 0;
    return looked && found->measured <= found->bound && found->outside == 0; /* false for NaN */
}

void nook_extreme_worst(nook_extreme_found *found, double value, const char *format, ...)
{
    bool first = found->where[0] == '\0', worse = !(value <= found->measured); /* true for NaN */
    if (isnan(found->measured) || !(first || worse))
        return;
    if (worse)
        found->measured = value;
    if (found->outside > 0)
        return; /* that place is kept: it is the graver one */
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(found->where, sizeof found->where, format, arguments);
    va_end(arguments);
}

void nook_extreme_check(nook_extreme_found *found, const float *visibility, size_t count, const char *format, ...)
{
    uint64_t before = found->outside;
    for (size_t i = 0; i < count; i++)
        found->outside += !(visibility[i] >= 0.0f && visibility[i] <= 1.0f); /* counts NaN */
    found->checked += count;
    if (before > 0 || found->outside == 0)
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(found->where, sizeof found->where, format, arguments);
    va_end(arguments);
}

void nook_extreme_progress(const nook_extremes *extremes, double fraction)
{
    if (extremes->progress)
        extremes->progress(extremes->progress_user, fraction);
}
