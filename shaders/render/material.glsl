// Materials of the scene. Bindings: storage 1 materials, textures 0 - 4, location 0 the draw.
#pragma once
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

layout(std430, binding = 1) readonly buffer Materials { Material materials[]; };
layout(binding = 0) uniform sampler2D base_colour_image;
layout(binding = 1) uniform sampler2D metallic_roughness_image;
layout(binding = 2) uniform sampler2D normal_image;
layout(binding = 3) uniform sampler2D emissive_image;
layout(binding = 4) uniform sampler2D occlusion_image;

layout(location = 0) uniform uvec3 draw; // material, first triangle, triangle count

vec4 material_base_colour(Material material, vec2 uv, vec4 colour)
{
    vec4 result = material.base_colour * colour;
    if ((material.flags.x & MATERIAL_BASE_COLOUR_IMAGE) != 0u)
        result *= texture(base_colour_image, uv);
    return result;
}
