#version 450
// Three slicemaps, one seen along each axis, become voxels of the atlas: a voxel is full where any of the three has its bit.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(binding = 0, r8) uniform writeonly image3D atlas;
layout(binding = 0) uniform usampler2D along_x; // pixels (y, z)
layout(binding = 1) uniform usampler2D along_y; // pixels (x, z)
layout(binding = 2) uniform usampler2D along_z; // pixels (x, y)

layout(location = 0) uniform ivec3 origin; // of the volume in the atlas
layout(location = 1) uniform ivec3 size;   // voxels

bool has_layer(uvec4 slices, int layer)
{
    return (slices[layer / 32] >> uint(layer % 32) & 1u) != 0u;
}

void main()
{
    ivec3 voxel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(voxel, size)))
        return;
    bool inside = all(greaterThan(voxel, ivec3(0))) && all(lessThan(voxel, size - 1)); // the outermost ones are empty
    bool full = has_layer(texelFetch(along_x, voxel.yz, 0), voxel.x) ||
                has_layer(texelFetch(along_y, voxel.xz, 0), voxel.y) ||
                has_layer(texelFetch(along_z, voxel.xy, 0), voxel.z);
    imageStore(atlas, origin + voxel, vec4(inside && full ? 1.0 : 0.0));
}
