// A surface point as the fragment shaders of geometry passes see it: material and both normals.
// Bindings: those of material.glsl, storage 2 triangle normals. Defines: IMAGES of material.glsl; NO_TANGENTS, the vertices have
// none; NO_COLOURS, their colours are white; QUICK, with NO_TANGENTS, normals are those of surface_quick.glsl; ENCODED of material.glsl,
// the base colour is sRGB.
#pragma once
#include "render/frame.glsl"
#include "render/material.glsl"
#include "render/tone.glsl"

#ifdef QUICK
layout(location = 0) in vec3 surface_position_relative;
#else
layout(location = 0) in vec3 surface_position_view;
#endif
layout(location = 1) in vec3 surface_normal_world;
#ifndef NO_TANGENTS
layout(location = 2) in vec4 surface_tangent_world;
#endif
layout(location = 3) in vec2 surface_uv;
#ifndef NO_COLOURS
layout(location = 4) in vec4 surface_colour;
#elif defined(ENCODED)
vec4 surface_colour = encoded_colour(drawn.base_colour);
#else
const vec4 surface_colour = vec4(1.0);
#endif
#ifndef QUICK
layout(location = 5) flat in mat3 surface_world_normal_from_mesh;

layout(std430, binding = 2) readonly buffer TriangleNormals { float triangle_normals[]; }; // xyz, mesh space
#endif

struct Surface {
    vec3 base_colour;
    float alpha;
    vec3 normal;           // world, on the viewer's side of the triangle; unit, but for QUICK
    vec3 geometric_normal; // world, faces the viewer; likewise
    float metallic;
    float roughness;
    float occlusion;
    vec3 emissive;
    bool unlit;
};

#ifdef QUICK
#include "render/surface_quick.glsl"
#else
// The id may or may not start again with each instance; the remainder is right either way.
vec3 triangle_normal(vec3 relative)
{
    uint triangle = draw.x + uint(gl_PrimitiveID) % draw.y;
    vec3 normal_mesh = vec3(triangle_normals[triangle * 3u], triangle_normals[triangle * 3u + 1u],
                            triangle_normals[triangle * 3u + 2u]);
    return surface_world_normal_from_mesh * normal_mesh;
}

// The triangle's own plane.
vec3 geometric_normal(vec3 relative)
{
    vec3 normal = triangle_normal(relative);
    if (dot(normal, normal) == 0.0) // a triangle without area still touched a pixel
        normal = dot(surface_normal_world, surface_normal_world) > 0.0 ? surface_normal_world : -relative;
    normal = normalize(normal);
    return dot(normal, relative) > 0.0 ? -normal : normal;
}

// Tangent and bitangent from screen derivatives, for meshes without tangents (Schueler, "Followup: Normal Mapping
// Without Precomputed Tangents", 2013). v runs down the image, green up: the bitangent points against v.
mat3 tangent_frame(vec3 normal, vec3 relative)
{
    vec3 position_x = dFdx(relative), position_y = dFdy(relative);
    vec2 uv_x = dFdx(surface_uv), uv_y = dFdy(surface_uv);
#ifndef NO_TANGENTS
    if (dot(surface_tangent_world.xyz, surface_tangent_world.xyz) > 0.0) {
        vec3 tangent = normalize(surface_tangent_world.xyz - normal * dot(normal, surface_tangent_world.xyz));
        return mat3(tangent, cross(normal, tangent) * surface_tangent_world.w, normal);
    }
#endif
    vec3 across_y = cross(position_y, normal), across_x = cross(normal, position_x);
    vec3 along_u = across_y * uv_x.x + across_x * uv_y.x;
    vec3 along_v = across_y * uv_x.y + across_x * uv_y.y;
    float area = max(dot(along_u, along_u), dot(along_v, along_v));
    float side = dot(cross(position_x, position_y), normal) < 0.0 ? -1.0 : 1.0; // quads run the other way on back faces
    float scale = area > 0.0 ? side * inversesqrt(area) : 0.0;
    return mat3(along_u * scale, -along_v * scale, normal);
}

vec3 shading_normal(vec3 geometric, vec3 relative)
{
    vec3 normal = dot(surface_normal_world, surface_normal_world) > 0.0 ? normalize(surface_normal_world) : geometric;
    float side = dot(normal, geometric) < 0.0 ? -1.0 : 1.0;
    if (has_image(MATERIAL_NORMAL_IMAGE)) {
        vec3 bump = texture(normal_image, surface_uv).xyz * 2.0 - 1.0;
        bump.xy *= drawn.normal_scale;
        vec3 mapped = tangent_frame(normal, relative) * bump;
        if (dot(mapped, mapped) > 0.0)
            normal = normalize(mapped);
    }
    return normal * side;
}

void surface_normals(out vec3 shading, out vec3 geometric)
{
    vec3 relative = mat3(frame.world_from_view) * surface_position_view;
    geometric = geometric_normal(relative);
    shading = shading_normal(geometric, relative);
}
#endif

Surface surface_read()
{
    Surface s;
    vec4 base_colour = material_base_colour(surface_uv, surface_colour);
    s.base_colour = base_colour.rgb;
    s.alpha = base_colour.a;
    surface_normals(s.normal, s.geometric_normal);
    s.metallic = drawn.metallic;
    s.roughness = drawn.roughness;
    if (has_image(MATERIAL_METALLIC_ROUGHNESS_IMAGE)) {
        vec4 texel = texture(metallic_roughness_image, surface_uv);
        s.metallic *= texel.b;
        s.roughness *= texel.g;
    }
    s.occlusion = 1.0;
    if (has_image(MATERIAL_OCCLUSION_IMAGE))
        s.occlusion = 1.0 + drawn.occlusion_strength * (texture(occlusion_image, surface_uv).r - 1.0);
    s.emissive = drawn.emissive_cutoff.rgb;
    if (has_image(MATERIAL_EMISSIVE_IMAGE))
#ifdef ENCODED
        s.emissive *= srgb_decode(texture(emissive_image, surface_uv).rgb);
#else
        s.emissive *= texture(emissive_image, surface_uv).rgb;
#endif
    s.unlit = (drawn.flags.x & MATERIAL_UNLIT) != 0u;
    return s;
}
