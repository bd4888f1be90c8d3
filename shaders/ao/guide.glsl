#pragma once
// How much a sample of the trace has to say about a point: what filter.comp.glsl and upscale.comp.glsl share. Both bind alike.
//
// Constant in gives constant out bit for bit: a result is one sample plus a weighted mean of differences to it.
#include "ao/frame.glsl"
#include "ao/counter.glsl"
#include "nook/octahedral.glsl"
layout(binding = 0) uniform sampler2D depth_full;
layout(binding = 1) uniform sampler2D normal_full;
layout(binding = 2) uniform sampler2D depth_trace;
layout(binding = 3) uniform sampler2D normal_trace;
layout(binding = 4) uniform sampler2D visibility_trace;
layout(binding = 0, r32f) uniform writeonly image2D visibility_out;

const float WEIGHT_MIN = 1e-3; // below this a sample is on another surface: it has no say at all

struct Guide {
    vec3 position, normal;
    float footprint; // metres
};

// In trace pixels times ao.filter_depth; never negative.
float plane_distance(Guide guide, ivec2 q, float depth)
{
    vec3 offset = view_position(q, depth) - guide.position;
    return abs(dot(guide.normal, offset)) / (guide.footprint * float(frame.scale) * frame.filter_depth);
}

float guide_weight(Guide guide, ivec2 q, float depth)
{
    float plane = plane_distance(guide, q, depth);
    float facing = max(dot(guide.normal, nook_octahedral_decode(fetch(normal_trace, q).xy)), 0.0);
    return exp(-plane * plane) * pow(max(facing, 1e-6), frame.filter_normal);
}

// What the full-resolution pixel p shows. @param depth > 0
Guide guide_full(ivec2 p, float depth)
{
    return Guide(full_ray(vec2(p)) * depth, nook_octahedral_decode(fetch(normal_full, p).xy), depth * pixel_footprint());
}

// What trace pixel p shows. @param depth > 0
Guide guide_trace(ivec2 p, float depth)
{
    return Guide(view_position(p, depth), nook_octahedral_decode(fetch(normal_trace, p).xy), depth * pixel_footprint());
}

// Where the full-resolution pixel p lies among the trace's pixels.
vec2 trace_centre(ivec2 p)
{
    return (vec2(p) - float(frame.scale / 2)) / float(frame.scale);
}

struct Mean {
    float reference, sum, weights;
};

void add_sample(inout Mean mean, Guide guide, ivec2 q, float window)
{
    if (window <= 0.0 || any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, frame.size)))
        return;
    float depth = fetch(depth_trace, q).r;
    float weight = depth > 0.0 ? guide_weight(guide, q, depth) : 0.0;
    if (!(weight >= WEIGHT_MIN)) // nor has one that is not a number
        return;
    mean.sum += window * weight * (fetch(visibility_trace, q).r - mean.reference);
    mean.weights += window * weight;
}

// When no sample lies on the pixel's own surface (the bottom of a joint that the trace has jumped over), one alone would show
// its noise: all around have a say, those near the pixel's plane most.
void add_around(inout Mean mean, Guide guide, vec2 centre)
{
    ivec2 base = ivec2(round(centre));
    for (int i = 0; i < 25; i++) {
        ivec2 q = base + ivec2(i % 5 - 2, i / 5 - 2);
        if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, frame.size)))
            continue;
        float depth = fetch(depth_trace, q).r;
        vec2 covered = clamp(2.5 - abs(vec2(q) - centre), 0.0, 1.0);
        float weight = covered.x * covered.y / (1.0 + pow(plane_distance(guide, q, depth), 2.0));
        if (!(depth > 0.0 && weight > 0.0))
            continue;
        float visibility = fetch(visibility_trace, q).r;
        if (mean.weights == 0.0)
            mean.reference = visibility; // the one given may have seen nothing
        mean.sum += weight * (visibility - mean.reference);
        mean.weights += weight;
    }
}
