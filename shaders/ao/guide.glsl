#pragma once
// How much a sample of the trace has to say about a point: what filter.comp.glsl and upscale.comp.glsl share.
//
// Constant in gives constant out bit for bit: a result is one sample plus a weighted mean of differences to it.
#include "ao/frame.glsl"
#include "ao/counter.glsl"
#include "nook/octahedral.glsl"

const float WEIGHT_MIN = 1e-3; // below this a sample is on another surface: it has no say at all

struct Guide {
    vec3 position, normal;
    float footprint; // metres
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
