#version 450
// Three slicemaps, one seen along each axis, become voxels of the atlas: a voxel is full where any of the three has its bit.
#include "ao/slicemap.glsl"
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(binding = 0, r8) uniform writeonly image3D atlas;
layout(binding = 0) uniform usampler3D along_x; // pixels (y, z)
layout(binding = 1) uniform usampler3D along_y; // pixels (x, z)
layout(binding = 2) uniform usampler3D along_z; // pixels (x, y)

layout(location = 0) uniform ivec3 origin; // of the volume in the atlas
layout(location = 1) uniform ivec3 size;   // voxels

void main()
{
    ivec3 voxel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(voxel, size)))
        return;
    bool inside = all(greaterThan(voxel, ivec3(0))) && all(lessThan(voxel, size - 1)); // the outermost ones are empty
    bool full = has_layer(texelFetch(along_x, ivec3(voxel.yz, 0), 0), voxel.x) ||
                has_layer(texelFetch(along_y, ivec3(voxel.xz, 0), 0), voxel.y) ||
                has_layer(texelFetch(along_z, ivec3(voxel.xy, 0), 0), voxel.z);
    imageStore(atlas, origin + voxel, vec4(inside && full ? 1.0 : 0.0));
}
