#pragma once
// Pixels of the trace that the tile filter finds few like them for, and which trace the rays that those missing would have had:
// docs/techniques.md, Support. The lists are those of refine.glsl, before upscaling has them; a candidate here is a pixel of the trace
// with how many are missing.
#include "ao/refine_list.glsl"

const int SIDE_BITS = 14, LACKING_BITS = 4; // of a trace, half as large as a picture at most; below 16, the largest support

uint pack_unsupported(ivec2 p, int lacking)
{
    return uint(p.x) | uint(p.y) << SIDE_BITS | uint(lacking) << 2 * SIDE_BITS;
}

ivec2 unsupported_pixel(uint bits)
{
    return ivec2(bitfieldExtract(bits, 0, SIDE_BITS), bitfieldExtract(bits, SIDE_BITS, SIDE_BITS));
}

int unsupported_lacking(uint bits)
{
    return int(bitfieldExtract(bits, 2 * SIDE_BITS, LACKING_BITS));
}

// `support`: samples that its mean is of.
void list_unsupported(ivec2 p, float support)
{
    int lacking = min(int(float(frame.support) - min(support, 16.0) + 0.5), frame.support - 1);
    if (lacking <= 0)
        return;
    atomicAdd(candidates.lacking, uint(lacking));
    candidates.pixels[reserve_candidates(1u)] = pack_unsupported(p, lacking);
}
