#include "modules/bake/surfel_extent.h"
#include <assert.h>
#include <math.h>

enum { NIBBLE = 15, AT_HIGH = 12, POINTS = NOOK_EXTENT_STEPS + 1, PAIRS = POINTS * NOOK_EXTENT_STEPS / 2 };

static const nook_surfel_extent whole = { { -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 } };
/* Steps: what an end may cut off, so that what is rounded to just past a point does not take a step more. */
static const double grain = 0.1;

/* ---- Box -------------------------------------------------------------------------------------------------------- */

uint32_t nook_surfel_box_pack(const nook_surfel_extent *wanted, nook_surfel_extent *out)
{
    uint32_t word = 0;
    for (int axis = 0; axis < 3; axis++) {
        double low = floor((wanted->low[axis] + 0.5) * NOOK_EXTENT_BOX_STEPS);
        double high = floor((0.5 - wanted->high[axis]) * NOOK_EXTENT_BOX_STEPS);
        low = fmax(0.0, fmin(low, NIBBLE));
        high = fmax(0.0, fmin(high, NIBBLE - low)); /* a step at least is left between the two */
        word |= (uint32_t)low << 4 * axis | (uint32_t)high << (AT_HIGH + 4 * axis);
    }
    *out = nook_surfel_box_unpack(word);
    return word;
}

nook_surfel_extent nook_surfel_box_unpack(uint32_t word)
{
    nook_surfel_extent box;
    for (int axis = 0; axis < 3; axis++) {
        box.low[axis] = (double)(word >> 4 * axis & NIBBLE) / NOOK_EXTENT_BOX_STEPS - 0.5;
        box.high[axis] = 0.5 - (double)(word >> (AT_HIGH + 4 * axis) & NIBBLE) / NOOK_EXTENT_BOX_STEPS;
    }
    return box;
}

bool nook_surfel_is_box(uint32_t word)
{
    nook_surfel_extent box = nook_surfel_box_unpack(word);
    return word >> 24 == 0 && box.low[0] < box.high[0] && box.low[1] < box.high[1] && box.low[2] < box.high[2];
}

/* ---- Interval --------------------------------------------------------------------------------------------------- */

uint32_t nook_surfel_interval_pack(const nook_surfel_extent *wanted, int axis, nook_surfel_extent *out)
{
    int low = (int)floor((wanted->low[axis] + 0.5) * NOOK_EXTENT_STEPS + grain);
    int high = (int)ceil((wanted->high[axis] + 0.5) * NOOK_EXTENT_STEPS - grain);
    low = low < 0 ? 0 : low < NOOK_EXTENT_STEPS ? low : NOOK_EXTENT_STEPS - 1;
    high = high <= low ? low + 1 : high < NOOK_EXTENT_STEPS ? high : NOOK_EXTENT_STEPS;
    bool round = high - low > POINTS / 2; /* the shorter way goes over the ring's end */
    int place = round ? high : low, distance = round ? POINTS - (high - low) : high - low;
    uint32_t code = (uint32_t)(axis * PAIRS + (distance - 1) * POINTS + place);
    *out = nook_surfel_interval_unpack(code);
    return code;
}

nook_surfel_extent nook_surfel_interval_unpack(uint32_t code)
{
    assert(code < NOOK_EXTENT_CODES);
    nook_surfel_extent extent = whole;
    uint32_t axis = code / PAIRS, place = code % POINTS;
    uint32_t other = (place + code / POINTS % (PAIRS / POINTS) + 1) % POINTS;
    extent.low[axis] = (double)(place < other ? place : other) / NOOK_EXTENT_STEPS - 0.5;
    extent.high[axis] = (double)(place < other ? other : place) / NOOK_EXTENT_STEPS - 0.5;
    return extent;
}
