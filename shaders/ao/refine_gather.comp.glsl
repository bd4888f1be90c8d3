// From the candidates to the list of pixels that are traced by themselves: all, or where there are too many of them some of each
// place. Defines: HAS_NORMAL. A listed pixel's visibility is -1 - its record until refine_scatter.comp.glsl has written it.
#include "ao/host.glsl"
#include "ao/refine.glsl"
layout(local_size_x = 64) in;
layout(binding = 0, r32f) uniform writeonly image2D visibility_out;

void list_pixel(ivec2 p)
{
    uint record = atomicAdd(listed.count, 1u);
    if (record >= listed.capacity)
        return;
    atomicMax(listed.groups_x, record / REFINE_GROUP + 1u);
    float depth = distance_at(p);
    vec3 normal = guide_normal(p, full_ray(vec2(p)) * depth);
    listed.records[record] =
        uvec4(pack_pixel(p), floatBitsToUint(depth), packUnorm2x16(nook_octahedral_encode(normal)), pack_pixel(p));
    imageStore(visibility_out, p, vec4(-1.0 - float(record)));
    add_counts_of(p, 1);
    fetches = 0u;
}

void main()
{
    for (uint i = gl_GlobalInvocationID.x; i < candidates.count; i += stride()) {
        ivec2 p = unpack_pixel(candidates.pixels[i]);
        if (is_chosen(p, candidates.count, 1u))
            list_pixel(p);
    }
}
