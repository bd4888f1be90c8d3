#pragma once
// The point that an invocation of a trace is about: of a pixel of the trace, or of a pixel of the picture that is on a list (listed.glsl).
// Included after depth_texture and normal_texture are declared.
#include "ao/counter.glsl"
#include "ao/listed.glsl"
#include "nook/octahedral.glsl"

struct Point {
    ivec2 pixel;   // whose random numbers it takes
    ivec2 place;   // its texel of the images that a trace writes
    bool wanted;
    float depth;   // 0: nothing to trace
    vec3 position; // view space
};

#if defined(LISTED) || defined(EITHER)
uvec4 record_of(Point point)
{
    return listed.records[uint(point.place.y) * REFINE_GROUP + uint(point.place.x)];
}

Point point_of_list()
{
    uint i = gl_WorkGroupID.x * REFINE_GROUP + gl_LocalInvocationIndex;
    bool wanted = i < listed_count();
    uvec4 record = wanted ? listed.records[i] : uvec4(0u);
    ivec2 pixel = unpack_pixel(record.x), numbers = unpack_pixel(record.w);
    float depth = uintBitsToFloat(record.y);
    return Point(numbers, listed_place(i), wanted, depth, full_ray(vec2(pixel)) * depth);
}
#endif

#ifndef LISTED
Point point_of_trace()
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
#endif

Point point_of_invocation()
{
#if defined(LISTED)
    return point_of_list();
#else
#ifdef EITHER
    if (of_list)
        return point_of_list();
#endif
    return point_of_trace();
#endif
}

// Two numbers, as octahedral.glsl has them.
vec2 packed_normal(Point point)
{
#if defined(LISTED) || defined(EITHER)
    if (of_list)
        return unpackUnorm2x16(record_of(point).z);
#endif
    return fetch_trace(normal_texture, point.pixel).xy;
}

vec3 normal_of(Point point)
{
    return point.wanted ? nook_octahedral_decode(packed_normal(point)) : vec3(0.0, 0.0, 1.0);
}

void add_counts_of(Point point)
{
#if defined(LISTED) || defined(EITHER)
    if (of_list) {
        if (point.wanted)
            add_counts_of(unpack_pixel(record_of(point).x), 1);
        return;
    }
#endif
    add_counts_of(point.pixel * frame.scale, frame.scale);
}
