/**
 * sampling.h - ray directions for hemispheres around +Z, cosine weighted: A = mean of rho over them (no cosine, no factor).
 *
 * Points of the (0,2)-Sobol sequence in 16 consecutive blocks: the pixels of a 4x4 tile take one block each, so that a
 * tile together holds 16 times as many jointly stratified rays. A digital shift by the seed keeps the stratification.
 */
#pragma once
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { NOOK_DIRECTION_BLOCKS = 16 };

/** A hash whose every bit depends on every bit of x (hash() of shaders/ao/frame.glsl). */
uint32_t nook_mix_bits(uint32_t x);

/** Point `index` of the (0,2)-sequence, each coordinate in (0, 1), shifted by `seed`. */
void nook_sobol_point(uint32_t index, uint32_t seed, float out_point[2]);

/** Unit direction in the +Z hemisphere from a point of the unit square; density cos / pi. */
void nook_cosine_direction(const float point[2], float out_direction[3]);

/** Which block the pixel (x, y) takes, by Bayer's 4x4 matrix (1973): block_of() of shaders/ao/blocks.glsl. */
uint32_t nook_direction_block(uint32_t x, uint32_t y);

/** Fills 16 * rays directions as xyz and 0; block b starts at out + b * rays * 4. Of part 0 they are the first points;
    each part takes as many that follow, dealt out so that a block's of several parts are evenly spread, too. */
void nook_fill_directions(uint32_t rays, uint32_t seed, uint32_t part, float *out);

#ifdef __cplusplus
}
#endif
