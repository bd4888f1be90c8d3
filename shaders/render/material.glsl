// The material of a draw. Bindings: uniform 2 the material, textures 0 - 4, location 0 the draw. Defines: IMAGES, the
// MATERIAL_*_IMAGE that it has, where the program is compiled for them; ENCODED, sRGB images come as they are stored; what stands in an if costs a software driver in any case.
#pragma once
#include "render/tone.glsl"
struct Material {
    vec4 base_colour;
    vec4 emissive_cutoff; // w: alpha below which a masked surface is cut
    float metallic;
    float roughness;
    float normal_scale;
    float occlusion_strength;
    uvec4 flags; // x: MATERIAL_*
};
const uint MATERIAL_BASE_COLOUR_IMAGE = 1u;
const uint MATERIAL_METALLIC_ROUGHNESS_IMAGE = 2u;
const uint MATERIAL_NORMAL_IMAGE = 4u;
const uint MATERIAL_EMISSIVE_IMAGE = 8u;
const uint MATERIAL_OCCLUSION_IMAGE = 16u;
const uint MATERIAL_UNLIT = 32u;

layout(std140, binding = 2) uniform MaterialOfDraw { Material drawn; };
layout(binding = 0) uniform sampler2D base_colour_image;
layout(binding = 1) uniform sampler2D metallic_roughness_image;
layout(binding = 2) uniform sampler2D normal_image;
layout(binding = 3) uniform sampler2D emissive_image;
layout(binding = 4) uniform sampler2D occlusion_image;

layout(location = 0) uniform uvec2 draw; // first triangle, triangle count

bool has_image(uint image)
{
#ifdef IMAGES
    return (IMAGES & image) != 0u;
#else
    return (drawn.flags.x & image) != 0u;
#endif
}

vec4 encoded_colour(vec4 linear)
{
    return vec4(srgb_encode(clamp(linear.rgb, 0.0, 1.0)), linear.a);
}

// colour: of the vertices; with ENCODED that times the material's, and all colours are sRGB
vec4 material_base_colour(vec2 uv, vec4 colour)
{
#ifdef ENCODED
    vec4 result = colour;
#else
    vec4 result = drawn.base_colour * colour;
#endif
    if (has_image(MATERIAL_BASE_COLOUR_IMAGE))
        result *= texture(base_colour_image, uv);
    return result;
}
