#version 450
// One bit for the voxel in which the triangle crosses the line through the pixel's centre; the target ORs them (Eisemann and
// Decoret 2006, "Fast Scene Voxelization and Applications").
layout(location = 0) in float layer;

layout(location = 0) out uvec4 slices; // RGBA32UI: 128 layers

// A surface on the boundary of two layers takes the upper one, as in modules/bake/voxelize.h.
const float TIE = 1.0 / 1000.0;

void main()
{
    float at = floor(layer + TIE);
    if (at < 0.0 || at >= 128.0)
        discard;
    uint bit = uint(at);
    slices = uvec4(0u);
    slices[bit / 32u] = 1u << (bit % 32u);
}
