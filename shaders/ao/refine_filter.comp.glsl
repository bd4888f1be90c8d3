// The 4x4 neighbourhood of each refined pixel, as add_tile() of filter.comp.glsl, but over other refined pixels alone: they lie in the
// same strips of surface, which nothing else of the trace has met. Each has one of 16 blocks of rays.
#include "ao/guide.glsl"
#include "ao/refine.glsl"
layout(local_size_x = 64) in;
layout(binding = 0, r32f) uniform readonly image2D visibility_image; // of the picture: -1 - record where one is refined
layout(binding = 1, r32f) uniform readonly image2D traced_image;

Guide guide_of(uvec4 record)
{
    vec3 position = full_ray(vec2(unpack_pixel(record.x))) * uintBitsToFloat(record.y);
    return make_guide(position, nook_octahedral_decode(unpackUnorm2x16(record.z)));
}

// Samples lie a pixel of the picture apart.
float weight_of(Guide guide, Guide other)
{
    float plane = plane_distance(guide, other.position) * float(frame.scale);
    float facing = max(dot(guide.normal, other.normal), 1e-6);
    return exp(-plane * plane) * pow(facing, frame.filter_normal);
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= listed_count())
        return;
    uvec4 record = listed.records[i];
    ivec2 p = unpack_pixel(record.x);
    Guide guide = guide_of(record);
    float own = imageLoad(traced_image, listed_place(i)).r, sum = 0.0, weights = 0.0;
#if defined(DISC) || defined(TILE)
    const int radius = 2;
#else
    const int radius = 0;
#endif
    for (int y = -radius; y <= radius; y++) {
        for (int x = -radius; x <= radius; x++) {
            ivec2 q = p + ivec2(x, y);
            bool inside = all(greaterThanEqual(q, frame.full_begin)) && all(lessThan(q, frame.full_end));
            float held = inside ? imageLoad(visibility_image, q).r : 1.0;
            if (held >= 0.0)
                continue;
            uint other = uint(-1.0 - held);
            float weight = weight_of(guide, guide_of(listed.records[other]));
            weight *= (abs(x) == 2 ? 0.5 : 1.0) * (abs(y) == 2 ? 0.5 : 1.0);
            weight = weight >= WEIGHT_MIN ? weight : 0.0;
            sum += weight * (imageLoad(traced_image, listed_place(other)).r - own);
            weights += weight;
        }
    }
    listed.records[i].w = floatBitsToUint(bounded(own + (weights > 0.0 ? sum / weights : 0.0)));
    add_counts_of(p, 1);
}
