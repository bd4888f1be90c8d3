#version 450
// One bit for the voxel in which the triangle crosses the line through the pixel's centre; the target ORs them (Eisemann and
// Decoret 2006, "Fast Scene Voxelization and Applications"). Define: TEXELS, of a column.
layout(location = 0) in float layer;

layout(location = 0) out uvec4 slices[TEXELS]; // RGBA32UI: 128 layers each

// A surface on the boundary of two layers takes the upper one, as in modules/bake/voxelize.h.
const float TIE = 1.0 / 1000.0;

void main()
{
    float at = floor(layer + TIE);
    if (at < 0.0 || at >= 128.0 * float(TEXELS))
        discard;
    uint bit = uint(at);
    for (uint i = 0u; i < uint(TEXELS); i++) {
        uvec4 texel = uvec4(0u);
        if (bit / 128u == i)
            texel[bit / 32u % 4u] = 1u << (bit % 32u);
        slices[i] = texel;
    }
}
