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

// How much light of a direction goes to the viewer, by the colour that it takes on: Lambert's and, of the highlight, that of a mirror
// seen head on and none.
struct Reflected {
    vec3 diffuse, mirror, white;
};

// What of a surface reflects the same light for every direction of it.
struct Reflector {
    vec3 view; // unit, to the viewer
    float n_v, seen; // cosine; the same, never 0
    float square; // of alpha
    float root; // of Smith's term
};

Reflector make_reflector(Lit s, vec3 view)
{
    Reflector r;
    float alpha = s.roughness * s.roughness;
    r.view = view;
    r.n_v = dot(s.normal, view);
    r.seen = max(r.n_v, 1e-4);
    r.square = alpha * alpha;
    r.root = sqrt(r.seen * r.seen * (1.0 - r.square) + r.square);
    return r;
}

// Adds light of a direction: GGX with height-correlated Smith and Schlick, plus Lambert below it. The half vector h is as long as
// sqrt(2 + 2 v.l) before it is unit: n.h and v.h come of that, and the squares of its length end in one division.
void reflect_light(inout Reflected sum, vec3 colour, float intensity, Reflector r, float n_l, float v_l)
{
    float lit = max(n_l, 0.0), length_square = max(2.0 + 2.0 * v_l, 0.0), n_h = max(r.n_v + lit, 0.0);
    float d = max(length_square - (1.0 - r.square) * (n_h * n_h), r.square * length_square); // n.h is at most 1
    float smith = lit * r.root + r.seen * sqrt(lit * lit * (1.0 - r.square) + r.square);
    float specular = (0.5 / PI) * r.square * (length_square * length_square) / max(d * d * smith, 1e-30);
    float away = 1.0 - min(0.5 * sqrt(length_square), 1.0), two = away * away, fifth = two * two * away;
    float arrives = intensity * lit, shines = arrives * specular;
    sum.diffuse += colour * (arrives - arrives * fifth);
    sum.mirror += colour * (shines - shines * fifth);
    sum.white += colour * (shines * fifth);
}

// Fades light where the triangle turns away but its smooth normal does not yet. Slowly: a hard end at the triangle's own
// horizon would show the facets of coarse curved meshes.
float terminator(Lit s, vec3 to_light)
{
    float part = clamp(dot(s.geometric_normal, to_light) * 4.0 + 1.0, 0.0, 1.0);
    return part * part * (3.0 - 2.0 * part);
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

void add_point(inout Reflected sum, PointLight light, Lit s, Reflector r)
{
    vec3 to_light;
    float intensity = point_light(light, s.relative, to_light) * terminator(s, to_light);
#ifndef EACH_POINT
    intensity *= spot_factor(light, to_light);
#endif
    reflect_light(sum, light.colour_inner.rgb, intensity, r, dot(s.normal, to_light), dot(r.view, to_light));
}

// EACH_POINT(f), where it is defined, calls f(0); f(1); ... for lights of a known number without a spot: software GL reads what
// stands at a constant place once for all pixels, and else for each.
void add_points(inout Reflected sum, Lit s, Reflector r)
{
#ifdef EACH_POINT
#define ADD(i) add_point(sum, light_at(uint(i)), s, r)
    EACH_POINT(ADD)
#else
    for (uint i = 0u; i < lights.point_count.x; i++)
        add_point(sum, light_at(i), s, r);
#endif
}

vec3 shade(Lit s)
{
    s.roughness = max(s.roughness, 0.045); // below this the highlight of a point light is under a pixel and flickers
    vec3 view = normalize(-s.relative), to_light = lights.sun_direction.xyz;
    Reflector r = make_reflector(s, view);
    Reflected sum = Reflected(vec3(0.0), vec3(0.0), vec3(0.0));
    reflect_light(sum, lights.sun_colour.rgb, sun_arrives(s), r, dot(s.normal, to_light), dot(view, to_light));
    add_points(sum, s, r);
    vec3 diffuse = s.base_colour * ((1.0 - s.metallic) * (0.96 / PI)); // what is not reflected above, of 1.5 as glTF has it
    return ambient_light(s, view) + diffuse * sum.diffuse + mix(vec3(0.04), s.base_colour, s.metallic) * sum.mirror + sum.white;
}
