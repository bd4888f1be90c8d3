// Device depth and world normals of the host -> distance along -Z and view normals: the inputs of every technique. With AT_TRACE
// defined only for the pixels of the trace, one of each block, never an average (it lies on no surface); with MAJORITY too, the one that
// most of the block agree with.
#include "ao/host.glsl"
#ifdef MAJORITY
#include "ao/representative.glsl"
#endif
layout(local_size_x = 16, local_size_y = 8) in;
layout(binding = 0, r32f) uniform writeonly image2D depth_out;
layout(binding = 1, rg16) uniform writeonly image2D normal_out;

float surface_at(ivec2 p, out vec3 normal)
{
#ifdef MAJORITY
    return representative(p, normal);
#else
#ifdef AT_TRACE
    p = full_pixel(p);
#endif
    float depth = distance_at(p);
    normal = normal_at(p, depth);
    return depth;
#endif
}

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
#ifdef AT_TRACE
    if (any(greaterThanEqual(p, frame.size)))
        return;
#else
    if (any(greaterThanEqual(p, frame.full_size)))
        return;
#endif
    vec3 normal;
    float depth = surface_at(p, normal);
    imageStore(depth_out, p, vec4(depth));
    imageStore(normal_out, p, vec4(nook_octahedral_encode(normal), 0.0, 0.0));
#ifdef AT_TRACE
    add_counts_of(p * frame.scale, frame.scale);
#else
    add_counts_of(p, 1);
#endif
}
