#include "game/play/picture_fit.h"
#include "engine/core/order.h"
#include <math.h>
#include <string.h>

enum {
    SETTLE = 4,       /* frames of a new size that tell nothing */
    SLOW = 3,         /* of the recent ones; fewer are chance */
    CALM_FRAMES = 40, /* two seconds, at 20 frames a second */
    DOUBTS_MOST = 4,  /* 16 times that */
    SOON_FRAMES = 100 /* a size that lasted longer was no mistake */
};

static const double headroom = 15.0 / 16.0; /* of the budget: frames of one size differ by about a tenth */

double nook_picture_fit_scale(const nook_picture_fit *fit)
{
    return 1.0 - 0.1 * fit->step;
}

/* Of the side itself, its half and its quarter, rounded up. */
static bool becomes_power_of_two(uint32_t side, uint32_t whole)
{
    for (uint32_t scale = 1; scale <= 4; scale *= 2) {
        uint32_t part = (side + scale - 1) / scale, of_whole = (whole + scale - 1) / scale;
        if ((part & (part - 1)) == 0 && (of_whole & (of_whole - 1)) != 0)
            return true;
    }
    return false;
}

uint32_t nook_picture_fit_side(const nook_picture_fit *fit, uint32_t pixels)
{
    uint32_t wanted = (uint32_t)lround(pixels * nook_picture_fit_scale(fit)), least = wanted > 4 ? wanted - 4 : 1;
    uint32_t side = wanted;
    while (side > least && becomes_power_of_two(side, pixels))
        side--;
    if (side > 0 && !becomes_power_of_two(side, pixels))
        return side;
    return wanted > 0 ? wanted : 1; /* so small that there is none */
}

/* What a frame of now would take in another size: as measured, its time follows its pixels. */
static double ms_at(const nook_picture_fit *fit, double ms, uint32_t step)
{
    const nook_picture_fit other = { .step = step };
    double ratio = nook_picture_fit_scale(&other) / nook_picture_fit_scale(fit);
    return ms * ratio * ratio;
}

/* @param rank  from 1, the longest. @return 0 while fewer frames are known */
static double longest(const nook_picture_fit *fit, uint32_t rank)
{
    float sorted[NOOK_PICTURE_FIT_RECENT];
    uint32_t known = fit->count > SETTLE ? fit->count - SETTLE : 0;
    if (known > NOOK_PICTURE_FIT_RECENT)
        known = NOOK_PICTURE_FIT_RECENT;
    if (known < rank)
        return 0.0;
    memcpy(sorted, fit->recent, known * sizeof *sorted); /* until the ring is full it is filled from its start */
    nook_order_floats(sorted, known);
    return (double)sorted[known - rank];
}

static void change(nook_picture_fit *fit, uint32_t step)
{
    bool larger = step < fit->step, soon = fit->count < SOON_FRAMES;
    if (!larger && fit->larger)
        fit->doubts = soon ? (fit->doubts < DOUBTS_MOST ? fit->doubts + 1 : DOUBTS_MOST) : 0;
    fit->larger = larger;
    fit->step = step;
    fit->count = fit->calm = 0;
    fit->changes++;
}

bool nook_picture_fit_reset(nook_picture_fit *fit)
{
    bool was_smaller = fit->step > 0;
    *fit = (nook_picture_fit){ .changes = fit->changes + was_smaller };
    return was_smaller;
}

/* The largest size in which such a frame is in time; the smallest when it is in none. */
static uint32_t step_in_time(const nook_picture_fit *fit, double ms, double budget_ms)
{
    uint32_t step = fit->step + 1;
    while (step + 1 < NOOK_PICTURE_FIT_STEPS && ms_at(fit, ms, step) > budget_ms)
        step++;
    return step;
}

bool nook_picture_fit_add(nook_picture_fit *fit, double ms, double budget_ms)
{
    if (!(budget_ms > 0.0))
        return nook_picture_fit_reset(fit);
    if (fit->count++ < SETTLE)
        return false;
    fit->recent[(fit->count - SETTLE - 1) % NOOK_PICTURE_FIT_RECENT] = (float)ms;
    double slow = longest(fit, SLOW), wanted = headroom * budget_ms;
    if (slow > wanted && fit->step + 1 < NOOK_PICTURE_FIT_STEPS) {
        change(fit, step_in_time(fit, slow, wanted));
        return true;
    }
    bool fits_larger = fit->step > 0 && slow > 0.0 && ms_at(fit, slow, fit->step - 1) <= wanted;
    fit->calm = fits_larger ? fit->calm + 1 : 0;
    if (fit->calm < (uint32_t)CALM_FRAMES << fit->doubts)
        return false;
    change(fit, fit->step - 1);
    return true;
}
