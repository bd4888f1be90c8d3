// Light that leaves a surface towards the viewer: glTF 2.0, appendix B. Needs frame.glsl.
#pragma once
#include "render/lights.glsl"
#include "render/sky.glsl"
#include "render/sun_shadow.glsl"

const float PI = 3.14159265358979;

struct Lit {
    vec3 relative; // position
    vec3 normal, geometric_normal;
    vec3 base_colour;
    float metallic, roughness;
    float visibility; // of the sky: ambient occlusion * occlusion map
};

// GGX with height-correlated Smith and Schlick, plus Lambert below it; times the cosine.
vec3 reflect_light(Lit s, vec3 view, vec3 to_light)
{
    float n_l = dot(s.normal, to_light);
    if (n_l <= 0.0)
        return vec3(0.0);
    vec3 h = normalize(view + to_light);
    float n_v = max(dot(s.normal, view), 1e-4), n_h = clamp(dot(s.normal, h), 0.0, 1.0);
    float alpha = s.roughness * s.roughness, square = alpha * alpha;
    float d = n_h * n_h * (square - 1.0) + 1.0;
    float smith = n_l * sqrt(n_v * n_v * (1.0 - square) + square) + n_v * sqrt(n_l * n_l * (1.0 - square) + square);
    float specular = square / (PI * d * d) * 0.5 / max(smith, 1e-6);
    float away = 1.0 - clamp(dot(view, h), 0.0, 1.0), fifth = away * away * away * away * away;
    vec3 f0 = mix(vec3(0.04), s.base_colour, s.metallic);
    vec3 fresnel = f0 + (1.0 - f0) * fifth;
    vec3 diffuse = s.base_colour * ((1.0 - s.metallic) / PI) * (1.0 - (0.04 + 0.96 * fifth));
    return (diffuse + fresnel * specular) * n_l;
}

// Fades light where the triangle turns away but its smooth normal does not yet. Slowly: a hard end at the triangle's own
// horizon would show the facets of coarse curved meshes.
float terminator(Lit s, vec3 to_light)
{
    return smoothstep(-0.25, 0.0, dot(s.geometric_normal, to_light));
}

float sun_arrives(Lit s)
{
    if (lights.sun_direction.w == 0.0 || dot(s.normal, lights.sun_direction.xyz) <= 0.0)
        return 0.0;
    return sun_shadow(s.relative, s.geometric_normal) * terminator(s, lights.sun_direction.xyz);
}

// The split sum's second half (Karis, "Physically Based Shading on Mobile", 2014).
vec3 specular_albedo(vec3 f0, float roughness, float n_v)
{
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
    vec2 scale_offset = vec2(-1.04, 1.04) * a + r.zw;
    return f0 * scale_offset.x + scale_offset.y;
}

// How much of a glossy lobe is open when `visibility` of the hemisphere is (Lagarde, de Rousiers, "Moving Frostbite to
// PBR", 2014). 0 stays 0, 1 stays 1.
float specular_visibility(float visibility, float roughness, float n_v)
{
    return clamp(pow(n_v + visibility, exp2(-16.0 * roughness - 1.0)) - 1.0 + visibility, 0.0, 1.0);
}

vec3 ambient_light(Lit s, vec3 view)
{
    float n_v = clamp(dot(s.normal, view), 0.0, 1.0);
    vec3 albedo = specular_albedo(mix(vec3(0.04), s.base_colour, s.metallic), s.roughness, n_v);
    vec3 diffuse = s.base_colour * (1.0 - s.metallic) * (1.0 - specular_albedo(vec3(0.04), s.roughness, n_v));
    return diffuse * sky_diffuse(s.normal) * s.visibility +
           albedo * sky_specular(reflect(-view, s.normal), s.roughness) *
               specular_visibility(s.visibility, s.roughness, n_v);
}

vec3 light_from(PointLight light, Lit s, vec3 view)
{
    vec3 to_light, irradiance = point_light(light, s.relative, to_light);
#ifndef EACH_POINT
    irradiance *= spot_factor(light, to_light);
#endif
    if (irradiance == vec3(0.0))
        return vec3(0.0);
    return irradiance * reflect_light(s, view, to_light) * terminator(s, to_light);
}

// EACH_POINT(f), where it is defined, calls f(0); f(1); ... for lights of a known number without a spot: software GL reads what
// stands at a constant place once for all pixels, and else for each.
vec3 light_from_points(Lit s, vec3 view)
{
    vec3 sum = vec3(0.0);
#ifdef EACH_POINT
#define ADD(i) sum += light_from(lights.points[i], s, view)
    EACH_POINT(ADD)
#else
    for (uint i = 0u; i < lights.point_count.x; i++)
        sum += light_from(lights.points[i], s, view);
#endif
    return sum;
}

vec3 shade(Lit s)
{
    s.roughness = max(s.roughness, 0.045); // below this the highlight of a point light is under a pixel and flickers
    vec3 view = normalize(-s.relative);
    vec3 sum = ambient_light(s, view);
    vec3 to_light = lights.sun_direction.xyz;
    vec3 sun = reflect_light(s, view, to_light) * lights.sun_colour.rgb;
    if (sun != vec3(0.0))
        sum += sun * sun_arrives(s);
    return sum + light_from_points(s, view);
}
