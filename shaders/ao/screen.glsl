#pragma once
// A technique that sees nothing but the depth buffer: its bindings, how it looks at the buffer, and its main(). The technique
// itself is occlusion(); its parameters are uniform block 1.
#include "ao/frame.glsl"
#include "ao/falloff.glsl"
#include "ao/counter.glsl"
#include "nook/octahedral.glsl"
#include "nook/params.glsl"
layout(local_size_x = 16, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D normal_texture;
layout(binding = 0, r32f) uniform image2D visibility_image;
// This dispatch's share of the work, items x to y - 1: nook_ao_pass_dispatch_parts of modules/ao/technique.h. Else 0.
layout(location = 0) uniform ivec2 part;

// This part's share of A at view position p with unit normal n.
float occlusion(ivec2 pixel, vec3 p, vec3 n);

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

void main()
{
    ivec2 pixel = invocation_pixel();
    if (!is_wanted(pixel))
        return;
    float depth = fetch_trace(depth_texture, pixel).r;
    float visibility = part.x == 0 ? 1.0 : imageLoad(visibility_image, pixel).r;
    if (depth > 0.0) {
        vec3 normal = nook_octahedral_decode(fetch_trace(normal_texture, pixel).xy);
        visibility = bounded(visibility - occlusion(pixel, view_position(pixel, depth), normal));
    }
    imageStore(visibility_image, pixel, vec4(visibility));
    add_counts();
}
