#version 450 core
layout(local_size_x = 8) in;
layout(binding = 2) uniform samplerBuffer texels;
layout(std430, binding = 4) writeonly buffer Values { vec4 values[]; };

void main()
{
    int index = int(gl_GlobalInvocationID.x);
    if (index < textureSize(texels))
        values[index] = texelFetch(texels, index);
}
