#pragma once
// What a pass reads and writes, counted while ao.count = 1: nook_ao_statistics. Every texture fetch of an AO shader goes through here.
// Define: COUNTING, else nothing is counted (nook_ao_pass_defines); a software driver would run through all of it in any case.
#include "ao/frame.glsl"
layout(std430, binding = 7) buffer Counter {
    uint fetches_low, fetches_high; // 64 bits
    uint outside;
    uint seen; // full-size pixels with geometry, where the host's own depth is read last
} counter;

// What each full-size pixel has fetched, or its rays' steps, in sixteenths: nook_ao_frame.fetches.
layout(binding = 2, r32ui) uniform uimage2D fetch_image;
const int COUNT_SUMS = 1, COUNT_PIXELS = 2, COUNT_STEPS = 4; // bits of frame.counting; of the last two one at the most
const uint FETCH_UNITS = 16u;

uint fetches = 0u; // of this invocation
uint steps = 0u;   // the same: turns of the loops in which rays are followed

// One texel of a texture of the trace's or of the picture's size, inside of it, where the nearest is sampled. Not by texelFetch: a
// software driver works out sizes and level anew for each pixel.
vec4 fetch_trace(sampler2D from, ivec2 pixel)
{
    fetches++;
    return textureLod(from, (vec2(pixel) + 0.5) * frame.texel, 0.0);
}

vec4 fetch_full(sampler2D from, ivec2 pixel)
{
    fetches++;
    return textureLod(from, (vec2(pixel) + 0.5) * frame.full_texel, 0.0);
}

// One fetch, filtered or not.
vec4 fetch_filtered(sampler3D from, vec3 at)
{
    fetches++;
    return textureLod(from, at, 0.0);
}

// One texel as it is.
vec4 fetch_texel(sampler3D from, ivec3 at)
{
    fetches++;
    return texelFetch(from, at, 0);
}

uvec4 fetch_texel(usampler3D from, ivec3 at)
{
    fetches++;
    return texelFetch(from, at, 0);
}

// A record of a texture buffer.
uvec4 fetch_record(usamplerBuffer from, int index)
{
    fetches++;
    return texelFetch(from, index);
}

vec4 fetch_record(samplerBuffer from, int index)
{
    fetches++;
    return texelFetch(from, index);
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

#ifdef COUNTING
// Only of pixels that are wanted; boxes that are drawn over each other share some. `share`: of each, in FETCH_UNITS.
void add_to_pixels(ivec2 first, int side, uint share)
{
    ivec2 begin = max(first, frame.full_begin), end = min(first + side, frame.full_end);
    for (int y = begin.y; y < end.y; y++) {
        for (int x = begin.x; x < end.x; x++)
            imageAtomicAdd(fetch_image, ivec2(x, y), share);
    }
}

void add_to_sums()
{
    uint before = atomicAdd(counter.fetches_low, fetches);
    if (before + fetches < before)
        atomicAdd(counter.fetches_high, 1u);
    if (outside > 0u)
        atomicAdd(counter.outside, outside);
}

void add_seen(float depth)
{
    if ((frame.counting & COUNT_SUMS) != 0 && depth > 0.0)
        atomicAdd(counter.seen, 1u);
}
#endif

// `first`, `side`: the full-size pixels that the work was for.
void add_counts_of(ivec2 first, int side)
{
#ifdef COUNTING
    if ((frame.counting & COUNT_SUMS) != 0)
        add_to_sums();
    if ((frame.counting & COUNT_PIXELS) != 0 && fetches > 0u)
        add_to_pixels(first, side, fetches * FETCH_UNITS / uint(side * side));
    if ((frame.counting & COUNT_STEPS) != 0 && steps > 0u)
        add_to_pixels(first, side, steps * FETCH_UNITS / uint(side * side));
#endif
}

// Call at the end of main(), in every invocation of a trace that has fetched or computed something.
void add_counts()
{
    add_counts_of(invocation_pixel() * frame.scale, frame.scale);
}
