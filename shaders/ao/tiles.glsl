#pragma once
// Which 8x8 pixels a work group traces: those of its place in the picture; or with TILES defined those that reuse.comp.glsl has
// left to trace, tile by tile. A tile's are moved to its first invocations: a software driver then leaves out the others eight at a time.
#include "ao/frame.glsl"

const int TILE_SIZE = 8;
const uint TILES_IN_ROW = 65535u; // groups along x that every device takes; the list goes on in the next row

struct Tile {
    uvec2 first, bits; // its first pixel; a bit for each pixel that is to be traced, by rows
    vec2 depths;       // of the nearest and of the farthest of all its pixels
    uvec2 padding;
};

#ifdef TILES
layout(std430, binding = 3) readonly buffer Tiles { // struct tiles_head of modules/ao/reuse.c
    uint groups_x, groups_y, groups_z, count;
    Tile tiles[];
} left;

// This work group's; behind the last one of the list a tile without pixels.
Tile own_tile()
{
    uint number = gl_WorkGroupID.y * TILES_IN_ROW + gl_WorkGroupID.x;
    if (number >= left.count)
        return Tile(uvec2(0u), uvec2(0u), vec2(0.0), uvec2(0u));
    return left.tiles[number];
}

// Trace pixel of the tile's corner.
ivec2 tile_first()
{
    return ivec2(own_tile().first);
}

// Place of the rank-th bit that is set, counted from 0. Bits by halves: without memory that is shared nobody has to wait.
int bit_place(uvec2 bits, int rank)
{
    int low = bitCount(bits.x), place = rank < low ? 0 : 32;
    uint word = rank < low ? bits.x : bits.y;
    rank -= rank < low ? 0 : low;
    for (int half_width = frame.scale > 0 ? 16 : 0; half_width > 0; half_width >>= 1) { // compilers would write out 16, 8, ...
        int below = bitCount(word & ((1u << half_width) - 1u));
        bool above = rank >= below;
        rank -= above ? below : 0;
        word >>= above ? half_width : 0;
        place += above ? half_width : 0;
    }
    return place;
}

// This invocation's pixel; one that is not wanted when there is none.
ivec2 tile_pixel()
{
    Tile tile = own_tile();
    int own = int(gl_LocalInvocationIndex), place = bit_place(tile.bits, own);
    bool traces = own < bitCount(tile.bits.x) + bitCount(tile.bits.y);
    return traces ? ivec2(tile.first) + ivec2(place % TILE_SIZE, place / TILE_SIZE) : ivec2(-1);
}
#else
ivec2 tile_first()
{
    return frame.origin + ivec2(gl_WorkGroupID.x, group_row()) * TILE_SIZE;
}

ivec2 tile_pixel()
{
    return invocation_pixel();
}
#endif
