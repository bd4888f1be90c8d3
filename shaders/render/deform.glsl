// Vertices as the deforming passes see them: nook_vertex, 16 floats. Bindings: docs/rendering.md.
#pragma once

const uint VERTEX_FLOATS = 16u;
const uint VERTEX_NORMAL = 3u;
const uint VERTEX_TANGENT = 6u;

layout(std430, binding = 1) buffer Posed { float posed[]; }; // nook_vertex

vec3 posed_vector(uint at)
{
    return vec3(posed[at], posed[at + 1u], posed[at + 2u]);
}

void set_posed_vector(uint at, vec3 v)
{
    posed[at] = v.x;
    posed[at + 1u] = v.y;
    posed[at + 2u] = v.z;
}
