#version 450
// Triangles seen along one axis of a voxel grid: modules/ao/live_volume.c.
layout(location = 0) in vec3 position; // mesh space

layout(location = 0) out float layer; // voxels along the axis

layout(location = 0) uniform vec4 grid; // origin, mesh space; w: 1 / side of a voxel
layout(location = 1) uniform int axis;
layout(location = 2) uniform float side; // pixels of the target

void main()
{
    vec3 voxel = (position - grid.xyz) * grid.w;
    layer = voxel[axis];
    vec2 across = axis == 0 ? voxel.yz : axis == 1 ? voxel.xz : voxel.xy;
    gl_Position = vec4(across * (2.0 / side) - 1.0, 0.0, 1.0);
}
