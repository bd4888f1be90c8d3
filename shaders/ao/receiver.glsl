#pragma once
// A technique whose occlusion of one point stands alone: what it is told of the point, its bindings, and its main(). The technique itself
// is occlusion(); its parameters are uniform block 1.
#include "ao/frame.glsl"
#include "ao/falloff.glsl"
#include "ao/counter.glsl"
#include "nook/octahedral.glsl"
#include "nook/params.glsl"
#ifdef LISTED
layout(local_size_x = 64) in;
#else
layout(local_size_x = 16, local_size_y = 8) in;
#endif
layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D normal_texture;
layout(binding = 0, r32f) uniform image2D visibility_image;
// This dispatch's share of the work, items x to y - 1: nook_ao_pass_dispatch_parts of modules/ao/technique.h. Else 0.
layout(location = 0) uniform ivec2 part;
#include "ao/point.glsl"

// This part's share of A at view position p with unit normal n.
float occlusion(ivec2 pixel, vec3 p, vec3 n);

void main()
{
    Point point = point_of_invocation();
    if (!point.wanted)
        return;
    float visibility = part.x == 0 ? 1.0 : imageLoad(visibility_image, point.place).r;
    if (point.depth > 0.0)
        visibility = bounded(visibility - occlusion(point.pixel, point.position, normal_of(point)));
    imageStore(visibility_image, point.place, vec4(visibility));
    add_counts_of(point);
}
