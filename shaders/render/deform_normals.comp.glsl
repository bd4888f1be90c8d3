#version 450
// Normals of the triangles of a posed primitive; where the file has none, those of its vertices too.
#include "render/deform.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 2) buffer Normals { float normals[]; };           // xyz of each triangle
layout(std430, binding = 3) readonly buffer Indices { uint indices[]; };

layout(location = 0) uniform uvec4 primitive; // first triangle, triangles, first vertex in `posed`, 1: flat

void main()
{
    if (gl_GlobalInvocationID.x >= primitive.y)
        return;
    uint triangle = primitive.x + gl_GlobalInvocationID.x;
    uint corners[3];
    for (uint i = 0u; i < 3u; i++)
        corners[i] = (primitive.z + indices[triangle * 3u + i]) * VERTEX_FLOATS;
    vec3 a = posed_vector(corners[0]);
    vec3 ab = posed_vector(corners[1]) - a, ac = posed_vector(corners[2]) - a;
    float size = max(max(max(abs(ab.x), abs(ab.y)), max(abs(ab.z), abs(ac.x))), max(abs(ac.y), abs(ac.z)));
    vec3 normal = size > 0.0 ? cross(ab / size, ac / size) : vec3(0.0); // areas of tiny triangles are no floats
    float area = length(normal);
    normal = area > 0.0 ? normal / area : vec3(0.0);
    for (uint i = 0u; i < 3u; i++)
        normals[triangle * 3u + i] = normal[i];
    if (primitive.w == 0u)
        return;
    for (uint i = 0u; i < 3u; i++)
        set_posed_vector(corners[i] + VERTEX_NORMAL, area > 0.0 ? normal : vec3(0.0, 1.0, 0.0));
}
