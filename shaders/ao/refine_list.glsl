#pragma once
// How candidates are listed; upscaling's are the pixels whose samples of the trace weigh too little together.
#include "ao/refine.glsl"

// Room for `wanted` candidates in a row: neighbours stay together, so that they meet the same volumes.
uint reserve_candidates(uint wanted)
{
    uint first = atomicAdd(candidates.count, wanted);
    atomicMax(candidates.groups_x, min((first + wanted + REFINE_GROUP - 1u) / REFINE_GROUP, GROUPS_MAX));
    return first;
}

// The pixels first + (x, y) for which bit y * side + x is set. Sides are 1, 2 or 4.
void list_block(ivec2 first, int side, uint bits)
{
    uint next = bits == 0u ? 0u : reserve_candidates(uint(bitCount(bits)));
    while (bits != 0u) {
        int i = findLSB(bits);
        candidates.pixels[next++] = pack_pixel(first + ivec2(i & (side - 1), i >> (side >> 1))); // a division takes longer than the rest
        bits &= bits - 1u;
    }
}
