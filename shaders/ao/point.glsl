#pragma once
// The point that an invocation of a trace is about: of a pixel of the trace or, with LISTED defined, of a pixel of the picture on the
// refinement's list (refine.glsl). Included after depth_texture and normal_texture are declared.
#include "ao/counter.glsl"
#include "nook/octahedral.glsl"
#ifdef LISTED
#include "ao/refine.glsl"
#endif

struct Point {
    ivec2 pixel;   // whose random numbers it takes
    ivec2 place;   // its texel of the images that a trace writes
    bool wanted;
    float depth;   // 0: nothing to trace
    vec3 position; // view space
};

#ifdef LISTED
Point point_of_invocation()
{
    uint i = gl_WorkGroupID.x * REFINE_GROUP + gl_LocalInvocationIndex;
    bool wanted = i < listed_count();
    uvec4 record = wanted ? listed.records[i] : uvec4(0u);
    ivec2 pixel = unpack_pixel(record.x), numbers = unpack_pixel(record.w);
    float depth = uintBitsToFloat(record.y);
    return Point(numbers, listed_place(i), wanted, depth, full_ray(vec2(pixel)) * depth);
}

vec3 normal_of(Point point)
{
    uint i = uint(point.place.y) * REFINE_GROUP + uint(point.place.x);
    return point.wanted ? nook_octahedral_decode(unpackUnorm2x16(listed.records[i].z)) : vec3(0.0, 0.0, 1.0);
}

void add_counts_of(Point point)
{
    uint i = uint(point.place.y) * REFINE_GROUP + uint(point.place.x);
    if (point.wanted)
        add_counts_of(unpack_pixel(listed.records[i].x), 1);
}
#else
Point point_of_invocation()
{
#ifdef TILES
    ivec2 pixel = tile_pixel();
#else
    ivec2 pixel = invocation_pixel();
#endif
    bool wanted = is_wanted(pixel);
    float depth = wanted ? fetch_trace(depth_texture, pixel).r : 0.0;
    return Point(pixel, pixel, wanted, depth, view_position(pixel, depth));
}

vec3 normal_of(Point point)
{
    return point.wanted ? nook_octahedral_decode(fetch_trace(normal_texture, point.pixel).xy) : vec3(0.0, 0.0, 1.0);
}

void add_counts_of(Point point)
{
    add_counts_of(point.pixel * frame.scale, frame.scale);
}
#endif
