// The G-buffer as the full-screen passes read it. Needs frame.glsl, shade.glsl. Bindings: textures 6 - 12, sampled nearest: a software
// driver takes longer for texelFetch, whose level it works out for each pixel.
#pragma once
#include "nook/octahedral.glsl"

layout(binding = 6) uniform sampler2D base_colour_texture;
layout(binding = 7) uniform sampler2D normal_texture;
layout(binding = 8) uniform sampler2D geometric_normal_texture;
layout(binding = 9) uniform sampler2D material_texture;
layout(binding = 10) uniform sampler2D emissive_texture;
layout(binding = 11) uniform sampler2D depth_texture;
layout(binding = 12) uniform sampler2D visibility_texture; // of the frame's size, or one texel

// Of the pixel that is being drawn.
vec4 read_pixel(sampler2D from)
{
    return textureLod(from, gl_FragCoord.xy / frame.size, 0.0);
}

float read_visibility()
{
    return read_pixel(visibility_texture).r;
}

Lit read_surface(vec3 ray, float depth)
{
    vec4 material = read_pixel(material_texture);
    Lit s;
    s.relative = ray * view_distance(depth);
    s.normal = nook_octahedral_decode(read_pixel(normal_texture).rg);
    s.geometric_normal = nook_octahedral_decode(read_pixel(geometric_normal_texture).rg);
    s.base_colour = read_pixel(base_colour_texture).rgb;
    s.metallic = material.r;
    s.roughness = material.g;
    s.visibility = read_visibility() * material.b;
    return s;
}
