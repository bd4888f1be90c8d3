/**
 * cut_internal.h - how the work of "volume" is cut into dispatches; inside modules/ao_volume only.
 *
 * llvmpipe ends all loops of an invocation without a word after 65535 turns in sum, and a GPU that works for seconds on one dispatch
 * is reset. Union needs all occluders of a ray at once, so it is cut into groups of rays. The product needs all rays of an
 * occluder, so it is cut into groups of occluders. Where a single ray, or the rays of a single occluder, are too many for one
 * dispatch, both are cut, and what is known so far of the ray's nearest hit, or of the occluder's sum, waits in an image.
 */
#pragma once
#include <stdbool.h>
#include <stdint.h>

/** What there is to do. */
typedef struct volume_work {
    uint32_t rays, steps, occluders;
    bool multiply;   /**< Else union. */
    uint32_t tested; /**< Of the occluders by one tile, at the most. 0: all. */
} volume_work;

/** Rays and occluders of one dispatch. */
typedef struct volume_cut {
    uint32_t rays, occluders;
    bool sure; /**< Within the limit whatever meets what; else by the assumption that no ray meets many volumes. */
} volume_cut;

/** Few dispatches: a ray meets no more than 16 boxes, which holds but for volumes piled up by the dozen. */
volume_cut volume_cut_likely(const volume_work *work);
/** As many dispatches as it takes when every ray meets every volume and takes all of its samples there. */
volume_cut volume_cut_careful(const volume_work *work);
/** Is there something to keep from one dispatch to the next? */
bool volume_cut_needs_image(const volume_work *work, const volume_cut *cut);
