#pragma once
// Samples of the filtered trace as upscaling weighs them: shared by upscale.comp.glsl and refine_around.comp.glsl.
#include "ao/guide.glsl"

struct Mean {
    float reference, sum, weights;
};

void add(inout Mean mean, float visibility, float weight)
{
    mean.reference = mean.weights == 0.0 && weight > 0.0 ? visibility : mean.reference;
    mean.sum += weight * (visibility - mean.reference);
    mean.weights += weight;
}

// Position of a sample at trace pixel q, from its normal times its depth; also one over the depth.
vec3 sample_position(ivec2 q, vec3 normal_depth, out float inverse)
{
    float square = dot(normal_depth, normal_depth);
    inverse = inversesqrt(max(square, 1e-37));
    return view_position(q, square * inverse);
}

// filter.comp.glsl's weight in one exponential. 0 where there is no geometry; always a number.
float weight_on_surface(Guide guide, ivec2 q, vec3 normal_depth)
{
    const float LOG2_E = 1.44269504;
    float inverse, plane = plane_distance(guide, sample_position(q, normal_depth, inverse));
    float facing = max(dot(guide.normal, normal_depth) * inverse, 1e-6);
    float weight = exp2(log2(facing) * frame.filter_normal - plane * plane * LOG2_E);
    return normal_depth != vec3(0.0) && weight >= WEIGHT_MIN ? weight : 0.0;
}

// When no sample lies on the pixel's own surface (the bottom of a joint that the trace has jumped over): by the plane alone.
float weight_around(Guide guide, ivec2 q, vec3 normal_depth)
{
    float inverse, plane = plane_distance(guide, sample_position(q, normal_depth, inverse));
    return normal_depth != vec3(0.0) && plane < 1e15 ? 1.0 / (1.0 + plane * plane) : 0.0;
}

// A sample of the filtered trace.
struct Corner {
    vec3 normal_depth, position;
    float inverse, visibility;
};

Corner read_corner(sampler2D filtered, ivec2 q)
{
    vec4 texel = fetch_trace(filtered, q);
    Corner corner;
    corner.normal_depth = texel.xyz;
    corner.position = sample_position(q, texel.xyz, corner.inverse);
    corner.visibility = texel.w;
    return corner;
}

// How a sample lies to the guide's surface. On it, nearly as filter.comp.glsl weighs but without exponentials, it weighs facing / spread.
struct Fit {
    float facing; // 1: it faces as the guide does; 0: away
    float spread; // from 1 on its plane; may be infinite
    float square; // of the distance to the plane
    bool seen;    // there is a sample at all
};

Fit fit_of(Guide guide, Corner corner)
{
    float plane = plane_distance(guide, corner.position), square = plane * plane;
    float facing = max(dot(guide.normal, corner.normal_depth) * corner.inverse, 0.0), slant = facing * facing;
    slant *= slant;
    slant *= slant; // to the 8th
    return Fit(slant, 1.0 + square * (1.0 + square * (0.5 + square)), square, corner.normal_depth != vec3(0.0) && plane < 1e9);
}
