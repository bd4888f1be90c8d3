/**
 * refine_internal.h - the lists of pixels that no pixel of the trace stands for; inside modules/ao only.
 *
 * Upscaling lists candidates; a pass over them takes at most `capacity`; the technique traces those into `traced`; two more passes filter
 * them and write them into the picture. Numbers of them stay on the GPU: each pass is dispatched with the groups that the one before has
 * counted.
 */
#pragma once
#include "engine/gpu/gpu.h"

typedef struct ao_refine {
    nook_buffer candidates; /**< Groups x, y, z of a dispatch over them, how many, what they lack, and the pixels. */
    nook_buffer listed;     /**< Groups, how many, how many at most, and a record each. */
    nook_texture traced;    /**< R32F, visibility of one record each, 64 in a row, and maybe more that nobody uses. */
    uint32_t pixels;        /**< Room for candidates; 0 before there is any. */
    uint32_t capacity;      /**< Room for records. */
} ao_refine;

/**
 * Makes the lists fit a picture; keeps them when they do.
 * @param share  of the pixels that are refined at most, in (0, 1]; and no more than 64 * gpu->max_texture_size
 * @param scale  pixels of the picture along a side of one of the trace
 * @return NOOK_E_MEMORY
 */
nook_result ao_refine_fit(nook_gpu *gpu, ao_refine *refine, uint32_t width, uint32_t height, uint32_t scale,
                          double share);
void ao_refine_release(nook_gpu *gpu, ao_refine *refine);
uint64_t ao_refine_bytes(const ao_refine *refine); /**< On the GPU. */
/** Empties the lists and binds them. */
void ao_refine_begin(nook_gpu *gpu, const ao_refine *refine);
/** Binds the lists, where shaders/ao/refine.glsl has them. */
void ao_refine_bind(nook_gpu *gpu, const ao_refine *refine);
/** Waits for the GPU. @return how many pixels the last record has refined */
uint32_t ao_refine_count(nook_gpu *gpu, const ao_refine *refine);
