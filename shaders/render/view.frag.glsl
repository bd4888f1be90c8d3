#version 450
// The picture, tone mapped and sRGB encoded, or one of the buffers. Binding: texture 13 light, location 0 the view.
#include "render/frame.glsl"
#include "render/shade.glsl"
#include "render/gbuffer_read.glsl"

layout(binding = 13) uniform sampler2D light_texture;
layout(location = 0) uniform int view; // nook_view
layout(location = 0) out vec4 image;   // RGBA8

// In nook_view's order.
const int VIEW_LIT = 0, VIEW_BASE_COLOUR = 1, VIEW_NORMAL = 2, VIEW_GEOMETRIC_NORMAL = 3, VIEW_DEPTH = 4,
          VIEW_METALLIC = 5, VIEW_ROUGHNESS = 6, VIEW_EMISSIVE = 7, VIEW_VISIBILITY = 8, VIEW_SHADOW = 9;

// Narkowicz, "ACES Filmic Tone Mapping Curve", 2015: rises everywhere, 0 stays 0.
vec3 tone_map(vec3 c)
{
    return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
}

vec3 srgb_encode(vec3 c)
{
    return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

vec3 buffer_view(ivec2 pixel, float depth)
{
    Lit s = read_surface(pixel, relative_ray(gl_FragCoord.xy), depth);
    switch (view) {
    case VIEW_BASE_COLOUR:
        return srgb_encode(s.base_colour);
    case VIEW_NORMAL:
        return s.normal * 0.5 + 0.5;
    case VIEW_GEOMETRIC_NORMAL:
        return s.geometric_normal * 0.5 + 0.5;
    case VIEW_DEPTH:
        float range = max(frame.depth_far - frame.depth_near, 1e-6);
        return vec3(1.0 - 0.9 * clamp((view_distance(depth) - frame.depth_near) / range, 0.0, 1.0));
    case VIEW_METALLIC:
        return vec3(s.metallic);
    case VIEW_ROUGHNESS:
        return vec3(s.roughness);
    case VIEW_EMISSIVE:
        return srgb_encode(clamp(texelFetch(emissive_texture, pixel, 0).rgb, 0.0, 1.0));
    case VIEW_VISIBILITY:
        return vec3(read_visibility(pixel));
    case VIEW_SHADOW:
        return vec3(sun_arrives(s));
    }
    return vec3(0.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depth_texture, pixel, 0).r;
    vec3 colour;
    if (view == VIEW_LIT)
        colour = srgb_encode(tone_map(texelFetch(light_texture, pixel, 0).rgb));
    else if (depth == 0.0)
        colour = vec3(view == VIEW_VISIBILITY ? 1.0 : 0.0);
    else
        colour = buffer_view(pixel, depth);
    image = vec4(colour, 1.0);
}
