#include "modules/ao/sampling.h"
#include "engine/core/result.h"
#include <math.h>
#include <stddef.h>

uint32_t nook_mix_bits(uint32_t x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

/** Bits mirrored: van der Corput, the first Sobol dimension. */
static uint32_t first_dimension(uint32_t index)
{
    uint32_t bits = 0;
    for (int i = 0; i < 32; i++)
        bits |= ((index >> i) & 1u) << (31 - i);
    return bits;
}

static uint32_t second_dimension(uint32_t index)
{
    uint32_t bits = 0;
    for (uint32_t direction = 1u << 31; index; index >>= 1, direction ^= direction >> 1) {
        if (index & 1u)
            bits ^= direction;
    }
    return bits;
}

/** 23 bits and half a step: never 0, never 1 as a float. */
static float unit_interval(uint32_t bits)
{
    return ((float)(bits >> 9) + 0.5f) * (1.0f / 8388608.0f);
}

void nook_sobol_point(uint32_t index, uint32_t seed, float out_point[2])
{
    uint32_t shift_x = seed ? nook_mix_bits(seed) : 0, shift_y = seed ? nook_mix_bits(seed ^ 0x9e3779b9u) : 0;
    out_point[0] = unit_interval(first_dimension(index) ^ shift_x);
    out_point[1] = unit_interval(second_dimension(index) ^ shift_y);
}

void nook_cosine_direction(const float point[2], float out_direction[3])
{
    float radius = sqrtf(point[0]), angle = 6.283185307179586f * point[1];
    out_direction[0] = radius * cosf(angle);
    out_direction[1] = radius * sinf(angle);
    out_direction[2] = sqrtf(1.0f - point[0]);
}

uint32_t nook_direction_block(uint32_t x, uint32_t y)
{
    uint32_t odd = x ^ y;
    return (odd & 1) << 3 | (y & 1) << 2 | (odd & 2) | (y >> 1 & 1);
}

/**
 * What moves between the blocks in part `part`: without, a pixel's points of all parts would lie in one strip of the square, as the low bits of their
 * indices are the same. Of all linear maps of four bits that which leaves one point of a pixel in most of the elementary boxes: of 1 to 16 rays
 * and 2 to 16 parts in 95 of 110 ways to cut the square, without any in 40. Of a part nothing changes but who takes which block.
 */
static uint32_t block_shift(uint32_t part)
{
    static const uint32_t shifts[] = { 15, 1, 2, 4 };
    uint32_t shift = 0;
    for (uint32_t bit = 0; bit < NOOK_COUNT(shifts); bit++)
        shift ^= part >> bit & 1u ? shifts[bit] : 0u;
    return shift;
}

void nook_fill_directions(uint32_t rays, uint32_t seed, uint32_t part, float *out)
{
    const uint32_t shift = block_shift(part);
    for (uint32_t i = 0; i < rays * NOOK_DIRECTION_BLOCKS; i++) {
        float point[2];
        uint32_t block = part * NOOK_DIRECTION_BLOCKS + (i / rays ^ shift);
        nook_sobol_point(block * rays + i % rays, seed, point);
        nook_cosine_direction(point, out + (size_t)i * 4);
        out[(size_t)i * 4 + 3] = 0.0f;
    }
}
