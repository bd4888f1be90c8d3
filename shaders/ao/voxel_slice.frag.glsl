#version 450
// One bit for the voxel in which the triangle crosses the line through the pixel's centre; the target ORs them (Eisemann and
// Decoret 2006, "Fast Scene Voxelization and Applications"). Defines: TEXELS, of a column;
// MASKED, where the texture has a hole there is nothing: by the texel at that point, as engine/core/alpha.h says.
layout(location = 0) in float layer;

layout(location = 0) out uvec4 slices[TEXELS]; // RGBA32UI: 128 layers each

#ifdef MASKED
layout(location = 1) in vec2 uv;
layout(binding = 5) uniform sampler2D mask;
layout(location = 5) uniform vec2 alpha_cutoff; // what multiplies the texture's; least that is there

bool is_hole()
{
    ivec2 size = textureSize(mask, 0);
    ivec2 texel = min(ivec2(fract(uv) * vec2(size)), size - 1);
    bool nowhere = any(isnan(uv)) || any(isinf(uv));
    float alpha = nowhere ? 1.0 : texelFetch(mask, texel, 0).a;
    return alpha_cutoff.x * alpha < alpha_cutoff.y;
}
#endif

// A surface on the boundary of two layers takes the upper one, as in modules/bake/voxelize.h.
const float TIE = 1.0 / 1000.0;

void main()
{
    float at = floor(layer + TIE);
    if (at < 0.0 || at >= 128.0 * float(TEXELS))
        discard;
#ifdef MASKED
    if (is_hole())
        discard;
#endif
    uint bit = uint(at);
    for (uint i = 0u; i < uint(TEXELS); i++) {
        uvec4 texel = uvec4(0u);
        if (bit / 128u == i)
            texel[bit / 32u % 4u] = 1u << (bit % 32u);
        slices[i] = texel;
    }
}
