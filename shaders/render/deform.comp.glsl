#version 450
// Vertices of a deformable in a pose: morphs, then skins. The same on the CPU: engine/animation/deform.c.
#include "render/deform.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Rest { float rest[]; };             // nook_vertex
layout(std430, binding = 2) readonly buffer Influences { uint influences[]; };  // nook_influence: 2 x 2 joints, 4 weights
layout(std430, binding = 3) readonly buffer Deltas { float deltas[]; };         // nook_morph_delta
layout(std430, binding = 4) readonly buffer Joints { vec4 joints[]; };          // nook_joint_matrix: rows
layout(std430, binding = 5) readonly buffer Weights { float weights[]; };       // of morph targets

layout(location = 0) uniform uvec4 mesh;    // first vertex in `rest` and `posed`, vertices, first influence or NONE, first joint
layout(location = 1) uniform uvec4 targets; // number, first weight, first delta

const uint NONE = 0xffffffffu;

struct Rows {
    vec4 x, y, z;
};

Rows blended(uint vertex)
{
    uint at = (mesh.z + vertex) * 6u;
    uint pairs[2] = uint[2](influences[at], influences[at + 1u]);
    Rows m = Rows(vec4(0.0), vec4(0.0), vec4(0.0));
    for (uint i = 0u; i < 4u; i++) {
        float weight = uintBitsToFloat(influences[at + 2u + i]);
        uint joint = (mesh.w + ((pairs[i / 2u] >> (16u * (i % 2u))) & 0xffffu)) * 3u;
        if (weight > 0.0) {
            m.x += weight * joints[joint];
            m.y += weight * joints[joint + 1u];
            m.z += weight * joints[joint + 2u];
        }
    }
    return m;
}

// Of the inverse transpose only the direction counts: cofactors, which no scale of zero divides by.
vec3 transformed_normal(Rows m, vec3 normal)
{
    vec3 x = cross(m.y.xyz, m.z.xyz), y = cross(m.z.xyz, m.x.xyz), z = cross(m.x.xyz, m.y.xyz);
    float side = dot(m.x.xyz, x) < 0.0 ? -1.0 : 1.0;
    return side * vec3(dot(x, normal), dot(y, normal), dot(z, normal));
}

// Also of lengths whose squares are no floats. @return the fallback when it has no direction
vec3 unit_or(vec3 v, vec3 fallback)
{
    float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    return largest > 0.0 ? normalize(v / largest) : fallback;
}

void main()
{
    uint vertex = gl_GlobalInvocationID.x;
    if (vertex >= mesh.y)
        return;
    uint at = (mesh.x + vertex) * VERTEX_FLOATS;
    vec3 position = vec3(rest[at], rest[at + 1u], rest[at + 2u]);
    vec3 rest_normal = vec3(rest[at + 3u], rest[at + 4u], rest[at + 5u]);
    vec4 tangent = vec4(rest[at + 6u], rest[at + 7u], rest[at + 8u], rest[at + 9u]);
    vec3 normal = rest_normal;
    for (uint t = 0u; t < targets.x; t++) {
        uint delta = (targets.z + t * mesh.y + vertex) * 6u;
        float weight = weights[targets.y + t];
        position += weight * vec3(deltas[delta], deltas[delta + 1u], deltas[delta + 2u]);
        normal += weight * vec3(deltas[delta + 3u], deltas[delta + 4u], deltas[delta + 5u]);
    }
    if (mesh.z != NONE) {
        Rows m = blended(vertex);
        position = vec3(dot(m.x, vec4(position, 1.0)), dot(m.y, vec4(position, 1.0)), dot(m.z, vec4(position, 1.0)));
        normal = transformed_normal(m, normal);
        vec3 along = vec3(dot(m.x.xyz, tangent.xyz), dot(m.y.xyz, tangent.xyz), dot(m.z.xyz, tangent.xyz));
        bool mirrors = dot(m.x.xyz, cross(m.y.xyz, m.z.xyz)) < 0.0;
        tangent = vec4(unit_or(along, tangent.xyz), mirrors ? -tangent.w : tangent.w);
    }
    set_posed_vector(at, position);
    set_posed_vector(at + VERTEX_NORMAL, unit_or(normal, rest_normal));
    set_posed_vector(at + VERTEX_TANGENT, tangent.xyz);
    posed[at + 9u] = tangent.w;
}
