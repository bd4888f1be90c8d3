#version 450
// Depth along the sun's direction. Here view_from_mesh is the whole way to the shadow map's clip space.
layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 colour;
layout(location = 5) in mat4 view_from_mesh;

layout(location = 0) out vec2 shadow_uv;
layout(location = 1) out vec4 shadow_colour;

void main()
{
    shadow_uv = uv;
    shadow_colour = colour;
    gl_Position = view_from_mesh * vec4(position, 1.0);
}
