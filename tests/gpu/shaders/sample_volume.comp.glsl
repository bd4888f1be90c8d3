#version 450 core
layout(local_size_x = 8) in;
layout(binding = 2) uniform sampler3D volume_texture;
layout(std140, binding = 1) uniform Sizes {
    uint count; // points
    uint side;  // texels
} sizes;
layout(std430, binding = 3) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 4) writeonly buffer Values { float values[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index < sizes.count)
        values[index] = textureLod(volume_texture, points[index].xyz / float(sizes.side), 0.0).x * 255.0;
}
