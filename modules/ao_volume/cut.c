#include "modules/ao/technique.h"
#include "modules/ao_volume/cut_internal.h"

/**
 * Loop turns: a ray at an occluder takes up to TURNS_PER_MISS when it misses the box, and one more per sample and at the end when it
 * meets it. RAYS_PER_DISPATCH keeps a GPU's dispatches short.
 */
enum {
    TURNS_PER_DISPATCH = NOOK_AO_TURNS_PER_DISPATCH,
    TURNS_PER_MISS = 3,
    BOXES_PER_RAY = 16,
    RAYS_PER_DISPATCH = 64
};

static uint32_t clamp(uint64_t value, uint32_t lowest, uint32_t highest)
{
    return value < lowest ? lowest : value > highest ? highest : (uint32_t)value;
}

static uint32_t turns_per_hit(const volume_work *work)
{
    return TURNS_PER_MISS + work->steps + 1;
}

/* Turns of one ray at all occluders when it meets `met` of them. */
static uint64_t turns_per_ray(const volume_work *work, uint32_t met)
{
    uint64_t boxes = met < work->occluders ? met : work->occluders;
    return boxes * turns_per_hit(work) + (work->occluders - boxes) * TURNS_PER_MISS;
}

static volume_cut cut_union(const volume_work *work, uint32_t met)
{
    uint64_t rays = TURNS_PER_DISPATCH / turns_per_ray(work, met);
    return (volume_cut){ clamp(rays, 1, RAYS_PER_DISPATCH), work->occluders, false };
}

volume_cut volume_cut_careful(const volume_work *work)
{
    uint32_t pairs = TURNS_PER_DISPATCH / turns_per_hit(work); /* of a ray and an occluder */
    volume_cut cut;
    if (work->multiply)
        cut = (volume_cut){ clamp(pairs, 1, work->rays), clamp(pairs / work->rays, 1, work->occluders), true };
    else if (work->occluders <= pairs)
        cut = cut_union(work, work->occluders);
    else
        cut = (volume_cut){ 1, pairs, true };
    cut.sure = true;
    return cut;
}

volume_cut volume_cut_likely(const volume_work *work)
{
    volume_cut careful = volume_cut_careful(work);
    if (work->occluders <= BOXES_PER_RAY)
        return careful;
    if (!work->multiply) {
        volume_cut likely = cut_union(work, BOXES_PER_RAY);
        return likely.rays > careful.rays || careful.occluders < work->occluders ? likely : careful;
    }
    /* All rays of more occluders, when those that a ray does not meet are so cheap. */
    uint64_t turns = TURNS_PER_DISPATCH / work->rays, met = (uint64_t)BOXES_PER_RAY * turns_per_hit(work);
    if (careful.occluders < BOXES_PER_RAY || turns <= met)
        return careful;
    uint64_t occluders = BOXES_PER_RAY + (turns - met) / TURNS_PER_MISS;
    return (volume_cut){ work->rays, clamp(occluders, 1, work->occluders), false };
}

bool volume_cut_needs_image(const volume_work *work, const volume_cut *cut)
{
    return work->multiply ? cut->rays < work->rays : cut->occluders < work->occluders;
}
