#pragma once
// Bits of a texel of a slicemap: modules/ao/slicemap.h.
const int SLICEMAP_BITS = 128;

// The 32 layers of a texel that hold a layer, lowest bit first. Chosen by halves: software drivers are slow at a variable index.
uint layers_of(uvec4 slices, int layer)
{
    uvec2 halves = (layer & 64) == 0 ? slices.xy : slices.zw;
    return (layer & 32) == 0 ? halves.x : halves.y;
}

// layer: of the whole column; `slices` is its texel layer / SLICEMAP_BITS.
bool has_layer(uvec4 slices, int layer)
{
    return (layers_of(slices, layer) >> uint(layer & 31) & 1u) != 0u;
}
