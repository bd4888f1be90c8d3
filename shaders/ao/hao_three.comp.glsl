// Technique "hao", hao.slicemaps = three: a voxel is full where any of the maps has its bit.
#include "ao/hao.glsl"
layout(binding = 3) uniform usampler3D along_x; // columns (y, z)
layout(binding = 5) uniform usampler3D along_y; // columns (x, z)

bool is_full(ivec3 voxel)
{
    return is_full_along_z(voxel) ||
           has_layer(fetch_texel(along_x, ivec3(voxel.yz, voxel.x / SLICEMAP_BITS)), voxel.x) ||
           has_layer(fetch_texel(along_y, ivec3(voxel.xz, voxel.y / SLICEMAP_BITS)), voxel.y);
}
