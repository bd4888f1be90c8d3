// The G-buffer as the full-screen passes read it. Needs frame.glsl, shade.glsl. Bindings: textures 6 - 12.
#pragma once
#include "nook/octahedral.glsl"

layout(binding = 6) uniform sampler2D base_colour_texture;
layout(binding = 7) uniform sampler2D normal_texture;
layout(binding = 8) uniform sampler2D geometric_normal_texture;
layout(binding = 9) uniform sampler2D material_texture;
layout(binding = 10) uniform sampler2D emissive_texture;
layout(binding = 11) uniform sampler2D depth_texture;
layout(binding = 12) uniform sampler2D visibility_texture; // of the frame's size, or one texel

float read_visibility(ivec2 pixel)
{
    return texelFetch(visibility_texture, min(pixel, textureSize(visibility_texture, 0) - 1), 0).r;
}

Lit read_surface(ivec2 pixel, vec3 ray, float depth)
{
    vec4 material = texelFetch(material_texture, pixel, 0);
    Lit s;
    s.relative = ray * view_distance(depth);
    s.normal = nook_octahedral_decode(texelFetch(normal_texture, pixel, 0).rg);
    s.geometric_normal = nook_octahedral_decode(texelFetch(geometric_normal_texture, pixel, 0).rg);
    s.base_colour = texelFetch(base_colour_texture, pixel, 0).rgb;
    s.metallic = material.r;
    s.roughness = material.g;
    s.visibility = read_visibility(pixel) * material.b;
    return s;
}
