#version 450
// Triangles of the overlay: pixels from the top left.
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 colour; // sRGB, alpha
layout(location = 0) uniform vec2 size; // of the target, pixels
layout(location = 0) out vec2 uv_out;
layout(location = 1) out vec4 colour_out;

void main()
{
    uv_out = uv;
    colour_out = colour;
    gl_Position = vec4(position.x / size.x * 2.0 - 1.0, 1.0 - position.y / size.y * 2.0, 0.0, 1.0);
}
