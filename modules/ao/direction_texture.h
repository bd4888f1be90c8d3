/** direction_texture.h - the directions of sampling.h on the GPU, for shaders/ao/directions.glsl. */
#pragma once
#include "engine/gpu/gpu.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_direction_texture {
    nook_texture texture; /**< RGBA32F of the buffer: NOOK_DIRECTION_BLOCKS blocks of `rays`, one after the other. */
    nook_buffer buffer;   /**< Room for the most rays so far. */
    float *values;        /**< Owned: room for as many, to upload from. */
    uint32_t room;        /**< The most rays so far. */
    uint32_t rays, seed, part;
} nook_direction_texture;

/** Makes it hold `rays` per block for `seed`, of that part of the sequence; does nothing when it does. Zero-initialise before the first call.
    @return NOOK_E_MEMORY */
nook_result nook_direction_texture_fit(nook_direction_texture *directions, nook_gpu *gpu, uint32_t rays, uint32_t seed,
                                       uint32_t part);
void nook_direction_texture_release(nook_direction_texture *directions, nook_gpu *gpu);

#ifdef __cplusplus
}
#endif
