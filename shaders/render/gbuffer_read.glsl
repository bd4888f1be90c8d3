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

// Of the pixel that is being drawn: where it lies, 0 to 1; its relative_ray(); its view_distance().
#ifdef BY_VERTEX
noperspective in vec4 ray_near; // of lighting.vert.glsl
noperspective in vec2 place;

vec2 pixel_place()
{
    return place;
}

vec3 pixel_ray()
{
    return ray_near.xyz;
}

float pixel_distance(float depth)
{
    return ray_near.w / depth;
}
#else
vec2 pixel_place()
{
    return gl_FragCoord.xy / frame.size;
}

vec3 pixel_ray()
{
    return relative_ray(gl_FragCoord.xy);
}

float pixel_distance(float depth)
{
    return view_distance(depth);
}
#endif

vec4 read_pixel(sampler2D from)
{
    return textureLod(from, pixel_place(), 0.0);
}

float read_visibility()
{
    return read_pixel(visibility_texture).r;
}

Lit read_surface(float depth)
{
    vec4 material = read_pixel(material_texture);
    Lit s;
    s.relative = pixel_ray() * pixel_distance(depth);
    s.normal = nook_octahedral_decode(read_pixel(normal_texture).rg);
    s.geometric_normal = nook_octahedral_decode(read_pixel(geometric_normal_texture).rg);
    s.base_colour = read_pixel(base_colour_texture).rgb;
    s.metallic = material.r;
    s.roughness = material.g;
    s.visibility = read_visibility() * material.b;
    return s;
}
