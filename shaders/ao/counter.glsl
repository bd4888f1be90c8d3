#pragma once
// What a pass reads and writes, counted while ao.count = 1: nook_ao_statistics. Every texture fetch of an AO shader goes through here.
#include "ao/frame.glsl"
layout(std430, binding = 7) buffer Counter {
    uint fetches_low, fetches_high; // 64 bits
    uint outside;
} counter;

uint fetches = 0u; // of this invocation

vec4 fetch(sampler2D from, ivec2 pixel)
{
    fetches++;
    return texelFetch(from, pixel, 0);
}

// One fetch, filtered or not.
vec4 fetch_filtered(sampler3D from, vec3 at)
{
    fetches++;
    return textureLod(from, at, 0.0);
}

const float ROUNDING = 1e-5; // of a sum of thousands of terms
uint outside = 0u;

// What a pass writes of the visibility it has computed. The clamp takes off rounding and nothing else: what is further out, or not a
// number (told from its bits, which no optimisation takes for granted), is a mistake and counted.
float bounded(float visibility)
{
    bool is_number = (floatBitsToUint(visibility) & 0x7fffffffu) <= 0x7f800000u;
    outside += uint(!is_number || visibility < -ROUNDING || visibility > 1.0 + ROUNDING);
    return clamp(visibility, 0.0, 1.0);
}

// Call at the end of main(), in every invocation that has fetched or computed something.
void add_counts()
{
    if (frame.counting == 0)
        return;
    uint before = atomicAdd(counter.fetches_low, fetches);
    if (before + fetches < before)
        atomicAdd(counter.fetches_high, 1u);
    if (outside > 0u)
        atomicAdd(counter.outside, outside);
}
