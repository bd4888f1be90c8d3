/**
 * truth.h - ray-traced visibility of one view, with its own noise known and as small as asked for.
 *
 * Rays come in batches, each a whole picture by the technique `reference` with a seed of its own. Even batches make one mean
 * and odd ones another: half the RMS difference of these two is the noise of the mean of both. More rays can be added at any
 * time, also by another process: the sums are kept in a cache, by content.
 */
#pragma once
#include "engine/core/result.h"
#include "engine/render/renderer.h"
#include "game/compare/surfaces.h"

struct nook_stage;

/** Raise it when the file changes: older files then belong to no key. See also NOOK_REFERENCE_VERSION. */
#define NOOK_TRUTH_VERSION 1u

typedef struct nook_truth_desc {
    const nook_surfaces *surfaces; /**< Of the view. Hashed, not kept. */
    const uint8_t *geometry;       /**< One byte a pixel: where noise is measured. Outlives the truth. */
    uint64_t scene_hash;           /**< nook_scene_hash. */
    bool screen;       /**< Rays meet what the depth buffer shows (reference.sees = screen), not the scene. */
    uint32_t rays_max; /**< A pixel; at least 2. */
    const char *cache; /**< Folder; NULL: none. */
} nook_truth_desc;

/** Members are for reading. */
typedef struct nook_truth {
    float *values; /**< Visibility, bottom row first: the mean of both halves. Owned. */
    double noise;  /**< Root mean square, over the geometry. Infinite before the first batches. */
    uint32_t rays; /**< Per pixel, so far. */
    uint32_t rays_max;
    uint32_t batch_rays; /**< Of one batch, per pixel. */
    uint32_t batches;    /**< So far: even. */
    float *sums[2];      /**< Of visibility over the batches of each half. Owned. */
    uint32_t width, height;
    const uint8_t *geometry;
    bool screen;
    uint64_t key;    /**< Of its content. */
    char path[4096]; /**< Of its file; "": no cache. */
    bool warned;     /**< That the cache cannot be written. */
} nook_truth;

/**
 * Takes what the cache has; traces nothing. A damaged file is one warning.
 * @param stage  r_max and falloff set: they are part of what the truth is
 * @return NOOK_E_MEMORY; *out_truth is zero then
 */
nook_result nook_truth_open(struct nook_stage *stage, const nook_truth_desc *desc, nook_truth *out_truth);
void nook_truth_close(nook_truth *truth); /**< Zeroed ones are allowed. */

/** Root mean square of its noise over some pixels; NaN when there are none. @param mask  one byte a pixel, not 0 = count */
double nook_truth_noise(const nook_truth *truth, const uint8_t *mask);

/** Mean structural similarity of its two halves. @return NOOK_E_MEMORY; *out_ssim untouched then */
nook_result nook_truth_compare_halves(const nook_truth *truth, double *out_ssim);

/**
 * Traces until the noise is at most `noise`, rays_max are taken or nook_interrupt_asked, and keeps what was traced. The stage's frame must be the
 * view's; its technique is the reference afterwards, and its frame_index as it was.
 * @return why tracing failed: close the truth then
 */
nook_result nook_truth_refine(nook_truth *truth, struct nook_stage *stage, double noise);
