// For test_falloff.c: shaders/ao/falloff.glsl at a list of distances.
#include "ao/falloff.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Distances {
    float distances[];
};
layout(std430, binding = 1) writeonly buffer Values {
    float values[];
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < uint(distances.length()))
        values[i] = falloff(distances[i]);
}
