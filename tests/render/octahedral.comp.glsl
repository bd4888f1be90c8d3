#version 450
// The round trip of test_normals.c: encode, round to 16 bits as a target of format RG16 does, decode.
#include "nook/octahedral.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Input { vec4 directions[]; };
layout(std430, binding = 1) writeonly buffer Output { vec4 results[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(directions.length()))
        return;
    vec2 texel = unpackUnorm2x16(packUnorm2x16(nook_octahedral_encode(directions[i].xyz)));
    results[i] = vec4(nook_octahedral_decode(texel), 0.0);
}
