#include "modules/ao/technique.h"
#include "modules/ao_volume/cut_internal.h"
#include "modules/ao_volume/limits.def"

/**
 * Loop turns: a ray at an occluder that it meets takes one per sample and up to TURNS_PER_HIT more. Invocations look for the next occluder
 * that reaches their point each by itself (tile_next of shaders/ao/tile_list.glsl), once for all rays of a batch, and list it before. llvmpipe
 * counts turns of a vector, that is LANES invocations: where each passes over others, as many turns; neighbours as a rule pass over the same.
 * RAYS_PER_DISPATCH keeps a GPU's dispatches short.
 */
enum {
    TURNS_PER_DISPATCH = NOOK_AO_TURNS_PER_DISPATCH,
    TURNS_PER_HIT = 4,
    TURNS_PER_MISS = 3,
    TURNS_TO_LIST = 1,
    LANES = 8,
    BOXES_PER_RAY = 16,
    RAYS_PER_DISPATCH = 64
};

static uint32_t clamp(int64_t value, uint32_t lowest, uint32_t highest)
{
    return value < lowest ? lowest : value > highest ? highest : (uint32_t)value;
}

static int64_t turns_per_hit(const volume_work *work)
{
    return (int64_t)work->steps + TURNS_PER_HIT;
}

/** @param lanes  invocations of a vector that look at other occluders */
static volume_cut cut_union(const volume_work *work, uint32_t met, int64_t lanes)
{
    int64_t search = work->occluders * (lanes + TURNS_TO_LIST); /* of a batch; the last one may have one ray only */
    int64_t boxes = met < work->occluders ? met : work->occluders, ray = boxes * turns_per_hit(work);
    int64_t turns = TURNS_PER_DISPATCH, batch = VOLUME_RAYS_AT_ONCE, batches = turns / (batch * ray + search);
    int64_t rest = (turns - batches * (batch * ray + search) - search) / ray;
    return (volume_cut){ clamp(batches * batch + (rest > 0 ? rest : 0), 1, RAYS_PER_DISPATCH), work->occluders, false };
}

volume_cut volume_cut_careful(const volume_work *work)
{
    /* Of a ray and an occluder; all rays of one occluder take one look. */
    const int64_t turns = TURNS_PER_DISPATCH, hit = turns_per_hit(work), look = LANES + TURNS_TO_LIST;
    const uint32_t pairs = clamp(turns / (hit + look), 1, UINT32_MAX);
    volume_cut cut;
    if (work->multiply)
        cut = (volume_cut){ clamp((turns - look) / hit, 1, work->rays),
                            clamp(turns / (work->rays * hit + look), 1, work->occluders), true };
    else if (work->occluders <= pairs)
        cut = cut_union(work, work->occluders, LANES);
    else
        cut = (volume_cut){ 1, pairs, true };
    cut.sure = true;
    return cut;
}

/** Of what a tile does not test, nothing is looked at. Else piled up occluders are met by rays that the cut takes for misses: room for those. */
static int64_t turns_likely(int64_t tested, const volume_work *work)
{
    int64_t boxes = tested < BOXES_PER_RAY ? tested : BOXES_PER_RAY;
    return boxes * turns_per_hit(work) + (tested - boxes) * TURNS_PER_MISS;
}

volume_cut volume_cut_likely(const volume_work *work)
{
    volume_cut careful = volume_cut_careful(work);
    int64_t tested = work->tested && work->tested < work->occluders ? work->tested : work->occluders;
    if (work->occluders <= BOXES_PER_RAY)
        return careful;
    if (!work->multiply) {
        int64_t rays = TURNS_PER_DISPATCH / (turns_likely(tested, work) + 1);
        volume_cut likely = { clamp(rays, 1, RAYS_PER_DISPATCH), work->occluders, false };
        return likely.rays > careful.rays || careful.occluders < work->occluders ? likely : careful;
    }
    /* All rays of more occluders, when those that a ray does not meet are so cheap. */
    int64_t turns = TURNS_PER_DISPATCH / work->rays, met = turns_likely(BOXES_PER_RAY, work);
    if (careful.occluders < BOXES_PER_RAY || turns <= met)
        return careful;
    int64_t occluders =
        turns_likely(tested, work) < turns ? work->occluders : BOXES_PER_RAY + (turns - met) / TURNS_PER_MISS;
    return (volume_cut){ work->rays, clamp(occluders, 1, work->occluders), false };
}

bool volume_cut_needs_image(const volume_work *work, const volume_cut *cut)
{
    return work->multiply ? cut->rays < work->rays : cut->occluders < work->occluders;
}
