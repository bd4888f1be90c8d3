#version 450
// Triangles seen along one axis of a voxel grid: modules/ao/slicemap.h. Define: MASKED, they have a texture.
layout(location = 0) in vec3 position; // mesh space

layout(location = 0) out float layer; // voxels along the axis
#ifdef MASKED
layout(location = 1) in vec2 place;
layout(location = 1) out vec2 uv;
#endif

layout(location = 0) uniform vec4 row_x; // of voxel_from_mesh
layout(location = 1) uniform vec4 row_y;
layout(location = 2) uniform vec4 row_z;
layout(location = 3) uniform int axis;
layout(location = 4) uniform float side; // pixels of the target

void main()
{
    vec4 point = vec4(position, 1.0);
    vec3 voxel = vec3(dot(row_x, point), dot(row_y, point), dot(row_z, point));
    layer = voxel[axis];
#ifdef MASKED
    uv = place;
#endif
    vec2 across = axis == 0 ? voxel.yz : axis == 1 ? voxel.xz : voxel.xy;
    gl_Position = vec4(across * (2.0 / side) - 1.0, 0.0, 1.0);
}
