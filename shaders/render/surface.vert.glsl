#version 450
// Vertices of the G-buffer and of blended surfaces. Attributes: docs/rendering.md. Defines: those of surface.glsl.
#include "render/frame.glsl"
#include "render/material.glsl"
#include "render/tone.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
#ifndef NO_COLOURS
layout(location = 4) in vec4 colour;
#endif
layout(location = 5) in mat4 view_from_mesh;
layout(location = 9) in vec4 world_normal_from_mesh_0; // w: -1 when the transform mirrors
layout(location = 10) in vec4 world_normal_from_mesh_1;
layout(location = 11) in vec4 world_normal_from_mesh_2;

#ifdef QUICK
layout(location = 0) out vec3 surface_position_relative;
#else
layout(location = 0) out vec3 surface_position_view;
#endif
layout(location = 1) out vec3 surface_normal_world;
#ifndef NO_TANGENTS
layout(location = 2) out vec4 surface_tangent_world;
#endif
layout(location = 3) out vec2 surface_uv;
#ifndef NO_COLOURS
layout(location = 4) out vec4 surface_colour;
#endif
#ifndef QUICK
layout(location = 5) flat out mat3 surface_world_normal_from_mesh;
#endif

void main()
{
    mat3 world_normal_from_mesh =
        mat3(world_normal_from_mesh_0.xyz, world_normal_from_mesh_1.xyz, world_normal_from_mesh_2.xyz);
    vec4 position_view = view_from_mesh * vec4(position, 1.0);
#ifdef QUICK
    surface_position_relative = mat3(frame.world_from_view) * position_view.xyz;
#else
    surface_position_view = position_view.xyz;
#endif
    surface_normal_world = world_normal_from_mesh * normal;
#ifndef NO_TANGENTS
    surface_tangent_world.xyz = mat3(frame.world_from_view) * (mat3(view_from_mesh) * tangent.xyz);
    surface_tangent_world.w = tangent.w * world_normal_from_mesh_0.w;
#endif
    surface_uv = uv;
#ifdef NO_COLOURS
#elif defined(ENCODED)
    surface_colour = encoded_colour(drawn.base_colour * colour);
#else
    surface_colour = colour;
#endif
#ifndef QUICK
    surface_world_normal_from_mesh = world_normal_from_mesh;
#endif
    gl_Position = frame.clip_from_view * position_view;
}
