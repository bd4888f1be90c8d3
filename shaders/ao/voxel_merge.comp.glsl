#version 450
// Three slicemaps, one seen along each axis, become voxels of the atlas: a voxel is full where any of the three has its bit. An
// invocation makes a run of 32 voxels along z, whose layers along x and y are bits of the same place in each texel.
#include "ao/slicemap.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r8) uniform writeonly image3D atlas;
layout(binding = 0) uniform usampler3D along_x; // pixels (y, z)
layout(binding = 1) uniform usampler3D along_y; // pixels (x, z)
layout(binding = 2) uniform usampler3D along_z; // pixels (x, y)

layout(location = 0) uniform ivec3 origin; // of the volume in the atlas
layout(location = 1) uniform ivec3 size;   // voxels

void main()
{
    ivec3 voxel = ivec3(gl_GlobalInvocationID) * ivec3(1, 1, 32);
    if (any(greaterThanEqual(voxel, size)))
        return;
    bool inside = all(greaterThan(voxel.xy, ivec2(0))) && all(lessThan(voxel.xy, size.xy - 1)); // the outermost ones are empty
    uint run = layers_of(texelFetch(along_z, ivec3(voxel.xy, voxel.z / SLICEMAP_BITS), 0), voxel.z);
    ivec2 texel = voxel.xy / SLICEMAP_BITS;
    int end = min(voxel.z + 32, size.z);
    for (; voxel.z < end; voxel.z++) {
        bool full = (run & 1u) != 0u || has_layer(texelFetch(along_x, ivec3(voxel.yz, texel.x), 0), voxel.x) ||
                    has_layer(texelFetch(along_y, ivec3(voxel.xz, texel.y), 0), voxel.y);
        run >>= 1;
        full = full && inside && voxel.z > 0 && voxel.z < size.z - 1;
        imageStore(atlas, origin + voxel, vec4(full ? 1.0 : 0.0));
    }
}
