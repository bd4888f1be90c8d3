#pragma once
// Per work group of 8x8 pixels: which occluders can reach any of its pixels, in their order. Cost then follows covered pixels and near
// occluders, not objects times screen. Lists are made of CHUNK occluders at a time, so that none is ever left out. From such a list each
// invocation takes those that reach its own point:
//   tile_begin; places = tile_places; for chunks of the places: tile_list; for (i = tile_next(0); i < tile_count; i = tile_next(i + 1)) ...
#include "ao/listed.glsl"
#include "ao/occluders.glsl"
#include "ao/tiles.glsl"

const int CHUNK = 256;
const int BIN_SIZE = 32;             // trace pixels: modules/ao/bins_internal.h
const uint BIN_OF_ALL = 0xffffffffu; // instead of a bin's count: it has no list
shared uint tile_bits[CHUNK / 32];   // of a chunk's places: who is listed
shared int tile_items[CHUNK];        // occluders, ascending
uint tile_count = 0u;                // of them; the same in every invocation
vec3 tile_box_min, tile_box_max; // view space, the same in every invocation

#if defined(LISTED) || defined(EITHER)
shared int tile_least[3], tile_most[3]; // of positions, as numbers that sort like them

// Floats of either sign in the order of integers; its own inverse.
int sortable(int bits)
{
    return bits >= 0 ? bits : bits ^ 0x7fffffff;
}

// Of points that may lie anywhere: the box around them.
bool tile_begin_list(float depth, vec3 position)
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
#endif

#ifndef LISTED
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

bool tile_begin_trace(float depth)
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

// Call once, in uniform control flow; `depth` is 0 without geometry. @return false when no pixel of the tile has geometry
bool tile_begin(float depth, vec3 position)
{
#if defined(LISTED)
    return tile_begin_list(depth, position);
#else
#ifdef EITHER
    if (of_list)
        return tile_begin_list(depth, position);
#endif
    return tile_begin_trace(depth);
#endif
}

bool tile_reaches(Occluder o)
{
    vec3 outside = max(max(tile_box_min - o.centre.xyz, o.centre.xyz - tile_box_max), vec3(0.0));
    float reach = o.centre.w + frame.r_max;
    return dot(outside, outside) <= reach * reach;
}

// Where occluders are looked for. Places are numbers of occluders or, with BINNED defined, of entries of the list of this tile's bin:
// modules/ao/bins_internal.h.
#ifdef BINNED
layout(std430, binding = 2) readonly buffer Bins {
    uint words[];
} bins;

uvec2 tile_bin; // where its list begins, and its length or BIN_OF_ALL

// The places x to y - 1 have all of the occluders first to end - 1 that may reach the tile; of a bin's list others too.
ivec2 tile_places(int first, int end)
{
    if (of_list) { // its groups are no tiles of the picture
        tile_bin = uvec2(0u, BIN_OF_ALL);
        return ivec2(first, end);
    }
    ivec2 bin = tile_first() / BIN_SIZE;
    int at = 2 * (bin.y * frame.bins_across + bin.x);
    tile_bin = uvec2(bins.words[at], bins.words[at + 1]);
    return tile_bin.y == BIN_OF_ALL ? ivec2(first, end) : ivec2(0, tile_bin.y);
}

int occluder_of(int place)
{
    return tile_bin.y == BIN_OF_ALL ? place : int(bins.words[tile_bin.x + uint(place)]);
}
#else
ivec2 tile_places(int first, int end)
{
    return ivec2(first, end);
}

int occluder_of(int place)
{
    return place;
}
#endif

// Of the places from `chunk` on, CHUNK of them or up to places.y - 1: lists the occluders that reach the tile and are wanted.x to
// wanted.y - 1. Their order is that of bits, which no race can change. Uniform control flow.
void tile_list(int chunk, ivec2 places, ivec2 wanted)
{
    int own = int(gl_LocalInvocationIndex), last = min(chunk + CHUNK, places.y);
    if (own < CHUNK / 32)
        tile_bits[own] = 0u;
    barrier();
    for (int i = chunk + own; i < last; i += TILE_SIZE * TILE_SIZE) {
        int occluder = occluder_of(i), bit = i - chunk;
        if (occluder >= wanted.x && occluder < wanted.y && tile_reaches(occluder_at(occluder)))
            atomicOr(tile_bits[bit >> 5], 1u << (bit & 31));
    }
    barrier();
    tile_count = 0u;
    for (int word = 0; word * 32 < last - chunk; word++) {
        uint bits = tile_bits[word], bit = 1u << (own & 31);
        if ((own >> 5) == (word & 1) && (bits & bit) != 0u)
            tile_items[tile_count + uint(bitCount(bits & (bit - 1u)))] = occluder_of(chunk + word * 32 + (own & 31));
        tile_count += uint(bitCount(bits));
    }
    barrier();
}

// The first entry of the list from the i-th on that reaches the position; tile_count when there is none. A software driver runs all lanes
// of a vector through what one of them does: so each looks for its own next occluder, which is cheap, and then all do the work of theirs
// at once, as often as one pixel has occluders, not as often as eight neighbours have different ones. Do that work in a loop that asks at
// its end: llvmpipe runs a loop's body once more than it is entered when it asks at the beginning.
uint tile_next(uint i, vec3 position)
{
    while (i < tile_count) {
        Occluder o = occluder_at(tile_items[i]);
        if (is_near(o, to_voxel(o, position)))
            break;
        i++;
    }
    return i;
}
