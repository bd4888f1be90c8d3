// What was traced for missing pixels into the mean of the pixels that lack them. Points of one pixel stand in a row.
#include "ao/refine.glsl"
layout(local_size_x = 64) in;
layout(binding = 0, rgba32f) uniform image2D filtered; // as upscale.comp.glsl reads it
layout(binding = 1, r32f) uniform readonly image2D traced_image;

void main()
{
    uint first = gl_GlobalInvocationID.x, end = listed_count();
    if (first >= end)
        return;
    uint pixel = listed.records[first].x, number = first;
    if (first > 0u && listed.records[first - 1u].x == pixel)
        return;
    ivec2 p = unpack_pixel(pixel) / frame.scale;
    vec4 mean = imageLoad(filtered, p);
    float sum = 0.0;
    for (; number < end && listed.records[number].x == pixel; number++)
        sum += imageLoad(traced_image, listed_place(number)).r - mean.w;
    mean.w = clamp(mean.w + sum / float(frame.support), 0.0, 1.0);
    imageStore(filtered, p, mean);
}
