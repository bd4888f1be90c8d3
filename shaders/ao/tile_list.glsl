#pragma once
// Per work group of 8x8 pixels: which occluders can reach any of its pixels. Cost then follows covered pixels and near
// occluders, not objects times screen. Lists are made for CHUNK occluders at a time, so that none is ever left out.
#include "ao/occluders.glsl"
#include "ao/tiles.glsl"

const int CHUNK = 256;
shared uint tile_count;
shared int tile_items[CHUNK];
vec3 tile_box_min, tile_box_max; // view space, the same in every invocation

#ifdef LISTED
shared int tile_least[3], tile_most[3]; // of positions, as numbers that sort like them

// Floats of either sign in the order of integers; its own inverse.
int sortable(int bits)
{
    return bits >= 0 ? bits : bits ^ 0x7fffffff;
}

// Of points that may lie anywhere: the box around them.
bool tile_begin(float depth, vec3 position)
{
    uint i = gl_LocalInvocationIndex;
    if (i < 3u) {
        tile_least[i] = 0x7fffffff;
        tile_most[i] = -0x7fffffff;
    }
    barrier();
    for (int axis = 0; depth > 0.0 && axis < 3; axis++) {
        int number = sortable(floatBitsToInt(position[axis]));
        atomicMin(tile_least[axis], number);
        atomicMax(tile_most[axis], number);
    }
    barrier();
    for (int axis = 0; axis < 3; axis++) {
        tile_box_min[axis] = intBitsToFloat(sortable(tile_least[axis]));
        tile_box_max[axis] = intBitsToFloat(sortable(tile_most[axis]));
    }
    return tile_least[0] <= tile_most[0];
}
#else
#ifdef TILES
vec2 tile_depths(float depth)
{
    return own_tile().depths;
}
#else
shared uint tile_depth_min, tile_depth_max; // as bits: positive floats sort like integers

vec2 tile_depths(float depth)
{
    if (gl_LocalInvocationIndex == 0u) {
        tile_depth_min = 0x7f7fffffu;
        tile_depth_max = 0u;
    }
    barrier();
    if (depth > 0.0) {
        atomicMin(tile_depth_min, floatBitsToUint(depth));
        atomicMax(tile_depth_max, floatBitsToUint(depth));
    }
    barrier();
    return uintBitsToFloat(uvec2(tile_depth_min, tile_depth_max));
}
#endif

// Call once, in uniform control flow; `depth` is 0 without geometry. @return false when no pixel of the tile has geometry
bool tile_begin(float depth, vec3 position)
{
    vec2 depths = tile_depths(depth);
    float nearest = depths.x, farthest = depths.y;
    ivec2 first = tile_first(), last = min(first + TILE_SIZE - 1, frame.size - 1);
    vec3 a = full_ray(vec2(full_pixel(first))), b = full_ray(vec2(full_pixel(last)));
    tile_box_min = min(min(a * nearest, a * farthest), min(b * nearest, b * farthest));
    tile_box_max = max(max(a * nearest, a * farthest), max(b * nearest, b * farthest));
    return farthest > 0.0;
}
#endif

bool tile_reaches(Occluder o)
{
    vec3 outside = max(max(tile_box_min - o.centre.xyz, o.centre.xyz - tile_box_max), vec3(0.0));
    float reach = o.size.w + frame.r_max;
    return dot(outside, outside) <= reach * reach;
}

// Lists the occluders [first, min(first + CHUNK, end)) that reach the tile. Uniform control flow.
void tile_list(int first, int end)
{
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        tile_count = 0u;
    barrier();
    int last = min(first + CHUNK, end);
    for (int i = first + int(gl_LocalInvocationIndex); i < last; i += TILE_SIZE * TILE_SIZE) {
        if (tile_reaches(occluder_at(i)))
            tile_items[atomicAdd(tile_count, 1u)] = i;
    }
    barrier();
}

// Puts the list in the order of the occluders, for those to whom it matters: invocations list them as they come. Uniform control flow.
void tile_sort()
{
    int item[CHUNK / (TILE_SIZE * TILE_SIZE)];
    int place[CHUNK / (TILE_SIZE * TILE_SIZE)];
    for (int k = 0; k < CHUNK / (TILE_SIZE * TILE_SIZE); k++) {
        uint i = gl_LocalInvocationIndex + uint(k * TILE_SIZE * TILE_SIZE);
        item[k] = i < tile_count ? tile_items[i] : -1;
        place[k] = 0;
        for (uint other = 0u; item[k] >= 0 && other < tile_count; other++)
            place[k] += int(tile_items[other] < item[k]);
    }
    barrier();
    for (int k = 0; k < CHUNK / (TILE_SIZE * TILE_SIZE); k++) {
        if (item[k] >= 0)
            tile_items[place[k]] = item[k];
    }
    barrier();
}
