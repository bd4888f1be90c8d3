#pragma once
// How much a sample of the trace has to say about a point: what filter.comp.glsl and upscale.comp.glsl share.
//
// Constant in gives constant out bit for bit: a result is one sample plus a weighted mean of differences to it.
#include "ao/frame.glsl"
#include "ao/counter.glsl"
#include "nook/octahedral.glsl"

// What the including shader knows of a trace pixel: its depth, 0 where there is no geometry, and its visibility.
float trace_depth(ivec2 q);
float trace_visibility(ivec2 q);

const float WEIGHT_MIN = 1e-3; // below this a sample is on another surface: it has no say at all

struct Guide {
    vec3 position, normal;
    float footprint; // metres
};

struct Mean {
    float reference, sum, weights;
};

Guide make_guide(vec3 position, vec3 normal)
{
    return Guide(position, normal, -position.z * pixel_footprint());
}

// In trace pixels times ao.filter_depth; never negative.
float plane_distance(Guide guide, vec3 position)
{
    vec3 offset = position - guide.position;
    return abs(dot(guide.normal, offset)) / (guide.footprint * float(frame.scale) * frame.filter_depth);
}

// Where the full-resolution pixel p lies among the trace's pixels.
vec2 trace_centre(ivec2 p)
{
    return (vec2(p) - float(frame.scale / 2)) / float(frame.scale);
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
        float depth = trace_depth(q);
        vec2 covered = clamp(2.5 - abs(vec2(q) - centre), 0.0, 1.0);
        float weight = covered.x * covered.y / (1.0 + pow(plane_distance(guide, view_position(q, depth)), 2.0));
        if (!(depth > 0.0 && weight > 0.0))
            continue;
        float visibility = trace_visibility(q);
        if (mean.weights == 0.0)
            mean.reference = visibility; // the one given may have seen nothing
        mean.sum += weight * (visibility - mean.reference);
        mean.weights += weight;
    }
}
