// Lights, exposed; positions in relative space. Binding: uniform 1. Defines: BY_VERTEX of by_vertex.glsl; VERTICES, this
// is the shader that hands them on.
#pragma once
#include "render/by_vertex.glsl"
struct PointLight {
    vec4 position_fade;   // metres; w: one over the range squared, 0: unbounded
    vec4 colour_inner;    // candela; w: cosine of the inner angle
    vec4 direction_outer; // where a spot shines to, 0: it is none; w: cosine of the outer angle
};
#if defined(BY_VERTEX) && !defined(VERTICES)
PointLight light_at(uint i)
{
    return PointLight(lights.position_fade[i], lights.colour[i], vec4(0.0));
}
#else
layout(std140, binding = 1) uniform Lights {
    vec4 sun_direction; // towards the sun, unit; w: 1 when there is one
    vec4 sun_colour;    // lux
    vec4 ambient_top;
    vec4 ambient_bottom;
    uvec4 point_count;
    PointLight points[64];
} lights;

PointLight light_at(uint i)
{
    return lights.points[i];
}
#endif

// How much of a spot's light goes there; 1 when it is none.
float spot_factor(PointLight light, vec3 to_light)
{
    if (light.direction_outer.xyz == vec3(0.0))
        return 1.0;
    float width = max(light.colour_inner.w - light.direction_outer.w, 1e-3);
    float spot = clamp((dot(-to_light, light.direction_outer.xyz) - light.direction_outer.w) / width, 0.0, 1.0);
    return spot * spot;
}

// Direction to a light and the part of its intensity that arrives on a surface that faces it (KHR_lights_punctual), if it is no spot.
float point_light(PointLight light, vec3 relative, out vec3 to_light)
{
    vec3 offset = light.position_fade.xyz - relative;
    float square = max(dot(offset, offset), 1e-8), inverse = inversesqrt(square), ratio = square * light.position_fade.w;
    to_light = offset * inverse;
    return max(1.0 - ratio * ratio, 0.0) * inverse * inverse;
}
