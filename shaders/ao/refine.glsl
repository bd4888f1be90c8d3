#pragma once
// Pixels of the picture that no pixel of the trace stands for: docs/techniques.md "Refinement". Upscaling lists them as candidates, which
// refine_around.comp.glsl takes from samples farther away. With ao.refine = traced, refine_gather.comp.glsl lists as many of them as there
// is room for, to be traced. Heads of modules/ao/refine.c.
#include "ao/frame.glsl"

const uint REFINE_GROUP = 64u; // invocations of a group, and texels of a row of what is traced
const uint GROUPS_MAX = 65535u; // of a dispatch along x, that every device takes

layout(std430, binding = 6) buffer Candidates {
    uint groups_x, groups_y, groups_z; // of a dispatch over them
    uint count;
    uint lacking; // pixels that all of them lack together: support.glsl
    uint pixels[]; // x + 65536 y: room for all of the picture
} candidates;

layout(std430, binding = 4) buffer Listed {
    uint groups_x, groups_y, groups_z;
    uint count; // may be more than the capacity
    uint capacity, padding0, padding1, padding2;
    uvec4 records[]; // pixel, distance, normal, and the pixel whose random numbers it takes; later what came of it
} listed;

uint pack_pixel(ivec2 p)
{
    return uint(p.x) | uint(p.y) << 16;
}

ivec2 unpack_pixel(uint bits)
{
    return ivec2(bits & 65535u, bits >> 16);
}

// The texel of the refined trace that record i is traced into.
ivec2 listed_place(uint i)
{
    return ivec2(i % REFINE_GROUP, i / REFINE_GROUP);
}

// Candidates are gone through in strides: there may be more than a dispatch has invocations.
uint stride()
{
    return gl_NumWorkGroups.x * REFINE_GROUP;
}

// Of candidates that make `wanted` points together, up to `most` each. By a hash of the pixel, so that the order of the list does not decide.
// Four standard deviations of their number are kept free: were there too many of them, the order would.
bool is_chosen(ivec2 p, uint wanted, uint most)
{
    float room = float(listed.capacity), share = (room - 4.0 * sqrt(room * float(most))) / float(wanted);
    return wanted <= listed.capacity || float(hash(pack_pixel(p)) >> 8) * (1.0 / 16777216.0) < share;
}

uint listed_count()
{
    return min(listed.count, listed.capacity);
}
