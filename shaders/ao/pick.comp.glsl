// Full-resolution depth and normals -> trace resolution: one pixel of each block, never an average (it lies on no surface).
#include "ao/frame.glsl"
#include "ao/counter.glsl"
layout(local_size_x = 16, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D depth_full;
layout(binding = 1) uniform sampler2D normal_full;
layout(binding = 0, r32f) uniform writeonly image2D depth_out;
layout(binding = 1, rg16) uniform writeonly image2D normal_out;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.size)))
        return;
    ivec2 from = full_pixel(p);
    imageStore(depth_out, p, fetch(depth_full, from));
    imageStore(normal_out, p, fetch(normal_full, from));
    add_counts_of(p * frame.scale, frame.scale);
}
