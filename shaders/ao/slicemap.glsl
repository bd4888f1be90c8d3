#pragma once
// Bits of a texel of a slicemap: modules/ao/slicemap.h.
const int SLICEMAP_BITS = 128;

// layer: of the whole column; `slices` is its texel layer / SLICEMAP_BITS.
bool has_layer(uvec4 slices, int layer)
{
    int bit = layer % SLICEMAP_BITS;
    return (slices[bit / 32] >> uint(bit % 32) & 1u) != 0u;
}
