// Writes what came of the refined pixels into the picture.
#include "ao/refine.glsl"
layout(local_size_x = 64) in;
layout(binding = 0, r32f) uniform writeonly image2D visibility_out;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= listed_count())
        return;
    uvec4 record = listed.records[i];
    imageStore(visibility_out, unpack_pixel(record.x), vec4(uintBitsToFloat(record.w)));
}
