#pragma once
// Ray directions of modules/ao/sampling.h as a texture: x = ray, y = block of the 4x4 pixel tile.
layout(binding = 4) uniform sampler2D directions;

// Order of the blocks in a tile: neighbours get blocks that are far apart in the sequence.
const int BLOCK[16] = int[16](0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5);

int direction_block(ivec2 pixel)
{
    return BLOCK[(pixel.y & 3) * 4 + (pixel.x & 3)];
}

vec3 direction(int ray, int block, vec3 tangent, vec3 bitangent, vec3 normal)
{
    vec3 local = texelFetch(directions, ivec2(ray, block), 0).xyz;
    return tangent * local.x + bitangent * local.y + normal * local.z;
}
