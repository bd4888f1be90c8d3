#pragma once
// Ray directions of modules/ao/sampling.h as a texture buffer.
#include "ao/blocks.glsl"
#include "ao/counter.glsl"
layout(binding = 4) uniform samplerBuffer directions;

// Around (0, 0, 1). `rays` of them were made for each block; block: block_of(pixel).
vec3 local_direction(int ray, int rays, int block)
{
    return fetch_record(directions, block * rays + ray).xyz;
}

vec3 direction(int ray, int rays, int block, vec3 tangent, vec3 bitangent, vec3 normal)
{
    vec3 local = local_direction(ray, rays, block);
    return tangent * local.x + bitangent * local.y + normal * local.z;
}
