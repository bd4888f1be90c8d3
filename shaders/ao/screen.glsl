#pragma once
// A technique that sees nothing but the depth buffer: how it looks there, and all of receiver.glsl.
#include "ao/receiver.glsl"

struct Sample {
    vec3 position; // of the surface seen there
    bool seen;
    bool inside; // the picture
};

// What the depth buffer holds where `point` would be seen.
Sample look_at(vec3 point)
{
    Sample s = Sample(vec3(0.0), false, false);
    if (point.z >= 0.0)
        return s;
    vec2 at = round(trace_pixel(point)); // close to the eye it may be larger than any int
    s.inside = all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(frame.size))); // false for NaN
    if (!s.inside)
        return s;
    ivec2 q = ivec2(at);
    float depth = fetch_trace(depth_texture, q).r;
    s.position = view_position(q, depth);
    s.seen = depth > 0.0;
    return s;
}
