#version 450
// Letters and pictures, blended over the picture in sRGB as it is shown.
layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 colour;
layout(binding = 0) uniform sampler2D image;
layout(location = 0) out vec4 result;

void main()
{
    result = colour * texture(image, uv);
}
