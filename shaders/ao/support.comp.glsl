// Pixels of the trace that few are like: from them to the list of points that are traced, and from what was traced into their means. One program
// for both: a software driver takes longer to make two than to run either.
#include "ao/counter.glsl"
#include "ao/support.glsl"
layout(local_size_x = 64) in;
layout(binding = 0, rgba32f) uniform image2D filtered; // as upscale.comp.glsl reads it
layout(binding = 1, r32f) uniform readonly image2D traced_image;
layout(binding = 2) uniform sampler2D depth_trace_texture;
layout(binding = 3) uniform sampler2D normal_trace;
layout(location = 0) uniform bool gathering; // else what was gathered has been traced

// A pixel of p's tile: that whose block of rays (blocks.glsl) differs from p's in the bits of `number`. 1 to 3 lie two away, at the rim of
// the filter's window; and with p's they are rays that follow each other in the sequence.
ivec2 missing_pixel(ivec2 p, int number)
{
    int y = (number >> 2 & 1) | (number & 1) << 1, odd = (number >> 3 & 1) | (number & 2);
    return p ^ ivec2(odd ^ y, y);
}

// For each that is missing a point, at the place of the pixel, with the rays of the one missing.
void list_missing(ivec2 p, int lacking)
{
    uint first = atomicAdd(listed.count, uint(lacking));
    uint end = min(first + uint(lacking), listed.capacity);
    atomicMax(listed.groups_x, (end + REFINE_GROUP - 1u) / REFINE_GROUP);
    uint depth = floatBitsToUint(fetch_trace(depth_trace_texture, p).r);
    uint normal = packUnorm2x16(fetch_trace(normal_trace, p).xy);
    for (uint i = first; i < end; i++)
        listed.records[i] = uvec4(pack_pixel(full_pixel(p)), depth, normal, pack_pixel(missing_pixel(p, int(i - first) + 1)));
    add_counts_of(p * frame.scale, frame.scale);
    fetches = 0u;
}

void gather()
{
    for (uint i = gl_GlobalInvocationID.x; i < candidates.count; i += stride()) {
        uint bits = candidates.pixels[i];
        ivec2 p = unsupported_pixel(bits);
        if (is_chosen(p, candidates.lacking, uint(frame.support - 1)))
            list_missing(p, unsupported_lacking(bits));
    }
}

// What was traced for a pixel, if the pixel's points, which stand in a row, begin with record `first`.
void take_in(uint first)
{
    uint pixel = listed.records[first].x, number = first, end = listed_count();
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

void main()
{
    if (gathering)
        gather();
    else if (gl_GlobalInvocationID.x < listed_count())
        take_in(gl_GlobalInvocationID.x);
}
