/**
 * refine.h - the reference in the background: threads of its own add rays to a frame that stands still, while the host goes on.
 *
 *   create -> start (a snapshot) -> read what there is, any time -> stop -> start ... -> destroy
 *
 * Rays come in pictures of few and then more, each with a seed of its own; even ones make one mean and odd ones another, so that
 * half their RMS difference is the noise of the mean of both (as game/measure/truth.h). The threads have the lowest priority.
 * All calls are made on one thread. Triangles stay the AO context's: stop before a mesh is removed.
 */
#pragma once
#include "modules/ao/inspect.h"
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_refine nook_refine;

typedef struct nook_refine_desc {
    uint32_t rays_max; /**< A pixel; at least 8. */
    unsigned threads;  /**< 0: one less than there are cores, at least one. */
} nook_refine_desc;

/** @return NOOK_E_MEMORY, NOOK_E_DEVICE (Embree); *out_refine is NULL then */
nook_result nook_refine_create(nook_refine **out_refine);
void nook_refine_destroy(nook_refine *refine); /**< Stops. NULL is allowed. */

/**
 * Traces a frame from now on; what was traced before is forgotten.
 * @param snapshot  taken over, becomes zero, also on failure
 * @return NOOK_E_MEMORY, NOOK_E_DEVICE no thread can be started: it is stopped then
 */
nook_result nook_refine_start(nook_refine *refine, const nook_refine_desc *desc, nook_ao_snapshot *snapshot);
/**
 * Ends the threads: within a few thousand rays, or when the acceleration structure that is being built is done. What was traced
 * can still be read.
 */
void nook_refine_stop(nook_refine *refine);

typedef struct nook_refine_status {
    bool running;       /**< Threads are at work. */
    bool ready;         /**< The triangles are built: nook_refine_probe answers. */
    nook_result result; /**< Why it ended, if by a failure. */
    uint32_t rays;      /**< Of each pixel that can be read; 0: none yet. */
    uint32_t rays_max;
} nook_refine_status;
nook_refine_status nook_refine_look(nook_refine *refine);

/**
 * Copies what there is.
 * @param out_mean   width * height of the snapshot: visibility
 * @param out_noise  of it, root mean square over the geometry; NaN without any
 * @return rays of each pixel; 0: nothing is there, and nothing was copied
 */
uint32_t nook_refine_read(nook_refine *refine, float *out_mean, double *out_noise);
/** Of the frame in work, as nook_ao_pass.depth; NULL before the first start. */
const float *nook_refine_depth(const nook_refine *refine, uint32_t *out_width, uint32_t *out_height);

enum { NOOK_REFINE_SHARES_MAX = 8 };

/** What a pixel's rays meet. */
typedef struct nook_refine_probe_result {
    double visibility; /**< Of the rays of this probe. */
    uint32_t rays;
    uint32_t count;                             /**< Of shares. */
    uint32_t occluders[NOOK_REFINE_SHARES_MAX]; /**< Places in the list that was submitted. */
    double shares[NOOK_REFINE_SHARES_MAX];      /**< Of 1 - visibility, in visibility; the largest first. */
} nook_refine_probe_result;

/** Traces one pixel on the calling thread. @return false: the triangles are not built yet, or nothing is seen there */
bool nook_refine_probe(nook_refine *refine, uint32_t x, uint32_t y, nook_refine_probe_result *out_result);

#ifdef __cplusplus
}
#endif
