#pragma once
// Counts texture fetches of the trace, 64 bits.
#include "ao/frame.glsl"
layout(std430, binding = 7) buffer Counter {
    uint low, high;
} counter;

void count_fetches(uint fetches)
{
    if (frame.counting == 0 || fetches == 0u)
        return;
    uint before = atomicAdd(counter.low, fetches);
    if (before + fetches < before)
        atomicAdd(counter.high, 1u);
}
