// For every voxel of the atlas, which of the eight that a filtered sample would weigh are full: bit 0 the voxel itself, and 1, 2 and 4
// added to the number for its neighbour in x, y and z. One fetch then does for eight. An invocation makes four, in x; those from begin
// to end - 1 are made.
#include "ao/occluders.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r8ui) uniform writeonly uimageBuffer corners;

layout(location = 0) uniform ivec3 begin;
layout(location = 1) uniform ivec3 end;

const int WIDTH = 4;

// Bits 0, 2, 4 and 6: the voxels at y and z, and after them in y, z, and both.
uint column(ivec3 at, ivec3 last)
{
    uint bits = 0u;
    for (int i = 0; i < 4; i++)
        bits |= texelFetch(volume_atlas, min(at + ivec3(0, i & 1, i >> 1), last), 0).r > 0.5 ? 1u << 2 * i : 0u;
    return bits;
}

void main()
{
    ivec3 size = textureSize(volume_atlas, 0), last = size - 1;
    ivec3 voxel = begin + ivec3(gl_GlobalInvocationID) * ivec3(WIDTH, 1, 1);
    if (any(greaterThanEqual(voxel, end)))
        return;
    uint here = column(min(voxel, last), last);
    for (int i = 0; i < WIDTH && voxel.x < end.x; i++, voxel.x++) {
        uint next = column(voxel + ivec3(1, 0, 0), last);
        imageStore(corners, (voxel.z * size.y + voxel.y) * size.x + voxel.x, uvec4(here | next << 1));
        here = next;
    }
}
