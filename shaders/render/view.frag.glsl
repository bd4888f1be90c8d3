#version 450
// The picture, tone mapped and sRGB encoded, or one of the buffers. Binding: texture 13 light, location 0 the view.
#include "render/frame.glsl"
#include "render/shade.glsl"
#include "render/gbuffer_read.glsl"
#include "render/tone.glsl"

layout(binding = 13) uniform sampler2D light_texture;
layout(location = 0) uniform int view; // nook_view
layout(location = 0) out vec4 image;   // RGBA8

// In nook_view's order.
const int VIEW_LIT = 0, VIEW_BASE_COLOUR = 1, VIEW_NORMAL = 2, VIEW_GEOMETRIC_NORMAL = 3, VIEW_DEPTH = 4,
          VIEW_METALLIC = 5, VIEW_ROUGHNESS = 6, VIEW_EMISSIVE = 7, VIEW_VISIBILITY = 8, VIEW_SHADOW = 9,
          VIEW_OCCLUSION_MAP = 10, VIEW_LIGHT = 11, VIEW_SHADOW_MAP = 12;

// 16 doublings from 1/1024 to 64: what tone mapping leaves of bright and dark cannot be told apart in the picture.
vec3 light_view(vec3 radiance)
{
    return clamp((log2(max(radiance, vec3(1e-9))) + 10.0) / 16.0, 0.0, 1.0);
}

// The whole map in a square in the middle of the picture. Grey outside.
vec3 shadow_map_view(vec2 pixel)
{
    vec2 place = (pixel - 0.5 * frame.size) / min(frame.size.x, frame.size.y) + 0.5;
    if (any(lessThan(place, vec2(0.0))) || any(greaterThanEqual(place, vec2(1.0))))
        return vec3(0.25);
    if (lights.sun_direction.w == 0.0)
        return vec3(0.0);
    ivec2 size = textureSize(shadow_map, 0);
    return vec3(1.0 - texelFetch(shadow_map, min(ivec2(place * vec2(size)), size - 1), 0).r);
}

vec3 buffer_view(float depth)
{
    Lit s = read_surface(depth);
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
        return srgb_encode(clamp(read_pixel(emissive_texture).rgb, 0.0, 1.0));
    case VIEW_VISIBILITY:
        return vec3(read_visibility());
    case VIEW_SHADOW:
        return vec3(sun_arrives(s));
    case VIEW_OCCLUSION_MAP:
        return vec3(read_pixel(material_texture).b);
    }
    return vec3(0.0);
}

void main()
{
    float depth = read_pixel(depth_texture).r;
    vec3 colour;
    if (view == VIEW_LIT)
        colour = srgb_encode(tone_map(read_pixel(light_texture).rgb));
    else if (view == VIEW_LIGHT)
        colour = light_view(read_pixel(light_texture).rgb);
    else if (view == VIEW_SHADOW_MAP)
        colour = shadow_map_view(gl_FragCoord.xy);
    else if (depth == 0.0)
        colour = vec3(view == VIEW_VISIBILITY ? 1.0 : 0.0);
    else
        colour = buffer_view(depth);
    image = vec4(colour, 1.0);
}
