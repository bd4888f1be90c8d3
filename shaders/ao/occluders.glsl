#pragma once
// This frame's volumes: struct ao_gpu_occluder of modules/ao/ao_internal.h. Voxel coordinates: (0, 0, 0) at the outer corner of
// the volume, one unit a voxel.
#include "ao/frame.glsl"

struct Occluder {
    vec4 voxel_from_view[3];  // rows
    vec4 normal_from_view[3]; // rows of the inverse transpose
    vec4 size;                // voxels
    vec4 place;               // voxel of the atlas that is our (0, 0, 0); surfel: first brick, x + 65536 y;
                              // density, w: of a medium, the optical depth of a voxel of 255; else 0
    vec4 centre;              // view space; w: bounding radius, metres
};
const int OCCLUDER_ROWS = 9;
layout(binding = 3) uniform samplerBuffer occluder_rows; // a software driver reads storage at half the speed
layout(binding = 2) uniform sampler3D volume_atlas; // of the kind that is marched; linear filtering

// The filtered volume is 0 outside of [MARGIN, size - MARGIN]: the outermost voxels are empty.
const float MARGIN = 0.5;

vec4 occluder_row(int occluder, int row)
{
    return texelFetch(occluder_rows, occluder * OCCLUDER_ROWS + row);
}

Occluder occluder_at(int i)
{
    return Occluder(vec4[3](occluder_row(i, 0), occluder_row(i, 1), occluder_row(i, 2)),
                    vec4[3](occluder_row(i, 3), occluder_row(i, 4), occluder_row(i, 5)), occluder_row(i, 6),
                    occluder_row(i, 7), occluder_row(i, 8));
}

vec3 to_voxel(Occluder o, vec3 position)
{
    vec4 p = vec4(position, 1.0);
    return vec3(dot(o.voxel_from_view[0], p), dot(o.voxel_from_view[1], p), dot(o.voxel_from_view[2], p));
}

vec3 direction_to_voxel(Occluder o, vec3 d)
{
    return vec3(dot(o.voxel_from_view[0].xyz, d), dot(o.voxel_from_view[1].xyz, d), dot(o.voxel_from_view[2].xyz, d));
}

// Not of unit length: 1 / its length is how many voxels along the voxel-space normal one metre along the view normal is.
vec3 normal_to_voxel(Occluder o, vec3 n)
{
    return vec3(dot(o.normal_from_view[0].xyz, n), dot(o.normal_from_view[1].xyz, n), dot(o.normal_from_view[2].xyz, n));
}

// Voxels along each axis within which a distance in metres ends, whatever its direction.
vec3 reach_of(Occluder o, float distance)
{
    return distance * vec3(length(o.voxel_from_view[0].xyz), length(o.voxel_from_view[1].xyz),
                           length(o.voxel_from_view[2].xyz));
}

// Is the point within r_max of the volume, axis by axis (the paper's extended box)?
bool is_near(Occluder o, vec3 voxel)
{
    vec3 reach = reach_of(o, frame.r_max);
    return all(greaterThan(voxel, MARGIN - reach)) && all(lessThan(voxel, o.size.xyz - MARGIN + reach));
}

// Part of a ray inside the volume: x = enter, y = leave, metres; empty when x >= y.
vec2 clip_to_volume(Occluder o, vec3 voxel, vec3 d)
{
    vec3 safe = mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20)));
    vec3 a = (MARGIN - voxel) / safe, b = (o.size.xyz - MARGIN - voxel) / safe;
    vec3 near = min(a, b), far = max(a, b);
    return vec2(max(max(near.x, near.y), near.z), min(min(far.x, far.y), far.z));
}
