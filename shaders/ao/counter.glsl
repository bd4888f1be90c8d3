#pragma once
// What a pass reads and writes, counted while ao.count = 1: nook_ao_statistics. Every texture fetch of an AO shader goes through here.
#include "ao/frame.glsl"
layout(std430, binding = 7) buffer Counter {
    uint fetches_low, fetches_high; // 64 bits
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

// Call once, at the end of main(), in every invocation that has fetched.
void count_fetches()
{
    if (frame.counting == 0 || fetches == 0u)
        return;
    uint before = atomicAdd(counter.fetches_low, fetches);
    if (before + fetches < before)
        atomicAdd(counter.fetches_high, 1u);
}
