#include "game/extremes/extremes.h"
#include "modules/fixture/view.h"
#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

bool nook_extreme_stated_holds(const nook_extreme_stated *stated)
{
    return fabs(stated->measured - stated->stated) <= stated->tolerance; /* false for NaN */
}

bool nook_extreme_holds(const nook_extreme_found *found)
{
    bool looked = found->where[0] != '\0' || found->checked > 0;
    for (size_t i = 0; i < found->stated_count; i++) {
        if (!nook_extreme_stated_holds(&found->stated[i]))
            return false;
    }
    return looked && found->measured <= found->bound && found->outside == 0; /* false for NaN */
}

void nook_extreme_state(nook_extreme_found *found, double stated, double tolerance, double measured, const char *format,
                        ...)
{
    assert(found->stated_count < NOOK_EXTREME_STATED_MAX);
    nook_extreme_stated *added = &found->stated[found->stated_count++];
    *added = (nook_extreme_stated){ .stated = stated, .tolerance = tolerance, .measured = measured };
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(added->what, sizeof added->what, format, arguments);
    va_end(arguments);
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

static void add_outside(nook_extreme_found *found, uint64_t outside, uint64_t checked, const char *format,
                        va_list arguments)
{
    if (found->outside == 0 && outside > 0)
        vsnprintf(found->where, sizeof found->where, format, arguments);
    found->outside += outside;
    found->checked += checked;
}

void nook_extreme_check_view(nook_extreme_found *found, const nook_fixture_view *view, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add_outside(found, view->outside, (uint64_t)view->width * view->height, format, arguments);
    va_end(arguments);
}

void nook_extreme_check(nook_extreme_found *found, const float *visibility, size_t count, const char *format, ...)
{
    uint64_t outside = 0;
    for (size_t i = 0; i < count; i++)
        outside += !(visibility[i] >= 0.0f && visibility[i] <= 1.0f); /* counts NaN */
    va_list arguments;
    va_start(arguments, format);
    add_outside(found, outside, count, format, arguments);
    va_end(arguments);
}

void nook_extreme_progress(const nook_extremes *extremes, double fraction)
{
    if (extremes->progress)
        extremes->progress(extremes->progress_user, fraction);
}
