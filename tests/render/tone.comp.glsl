#version 450
// For test_tone.c: sRGB of numbers in [0, 1].
#include "render/tone.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Input { float linear[]; };
layout(std430, binding = 1) writeonly buffer Output { float encoded[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < uint(linear.length()))
        encoded[i] = srgb_encode(vec3(linear[i])).g;
}
