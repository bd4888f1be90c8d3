#pragma once
// Ray directions of modules/ao/sampling.h as a texture: x = ray, y = block_of(pixel).
#include "ao/blocks.glsl"
#include "ao/counter.glsl"
layout(binding = 4) uniform sampler2D directions;

vec3 direction(int ray, int block, vec3 tangent, vec3 bitangent, vec3 normal)
{
    vec3 local = fetch(directions, ivec2(ray, block)).xyz;
    return tangent * local.x + bitangent * local.y + normal * local.z;
}
